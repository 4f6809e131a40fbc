// Mattes from scribbles and roto shapes.
#include <filesystem>

#include "app/base/background.h"
#include "app/exchange/track_file.h"
#include "app/mattes/matte_layer.h"
#include "app/mattes/scribble_matte.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "engine/form/planar_track.h"
#include "engine/mask/shape_matte.h"
#include "engine/media/frame_writer.h"

namespace weft {
namespace {

Matte drawn(const std::vector<std::vector<Vec2>>& lines, Size size) {
    Matte out(size);
    Brush pen;
    pen.radius_px = 3;
    pen.hardness = 1;
    for (const auto& line : lines) {
        Stroke stroke(std::make_shared<const Matte>(out), pen);
        for (const Vec2 point : line)
            (void)stroke.move_to(point, 1, out);
    }
    return out;
}

}  // namespace

void Session::scribble(const ScribbleSelect& action) {
    const PicturePtr picture = view_.plate_picture;
    if (!picture || action.keep.empty() || follows_change(action)) return;
    change_matte(
        [action, picture](const Matte& before) {
            return segment_scribbles(before, shrink(*picture, 1 << 20),
                                     drawn(action.keep, before.size()),
                                     drawn(action.drop, before.size()));
        },
        "Scribble", action.here_only);
}

void Session::set_shape(const RotoShape& shape) {
    constexpr std::size_t kLeast = 3;
    if (shape.points.size() < kLeast || follows_change(SetShape{shape})) return;
    end_stroke();
    const Region* region = region_by_id(document(), selected_);
    if (open_ && region && !locked_.contains(selected_) &&
        !layer_source(*region, layer_).shape.empty()) {
        MatteSource matte = layer_source(*region, layer_);
        auto& keys = matte.shape.keys;
        if (keys.begin()->second.points.size() != shape.points.size()) keys.clear();
        keys[playback_.frame()] = shape;
        return commit_layer(*region, layer_, matte,
                            "Shape on frame " + std::to_string(playback_.frame()));
    }
    if (!open_ || !may_paint()) return;
    changing_.emplace();
    changing_->place = painted_place();
    changing_->label = "Shape";
    changing_->shape = shape;
    changing_->matte =
        in_background([shape, size = reader_->size()] { return matte_of_shape(shape, size); });
}

void Session::commit_layer(const Region& region, int layer, const MatteSource& matte,
                           const std::string& label) {
    auto changed = apply_edit(history_.current(), set_layer(region, layer, matte, begun_zone_));
    if (!changed) return notify(NoticeKind::kError, changed.error().text());
    commit(std::move(*changed), label);
}

namespace {

// The shape over time of a layer whose shapes are painted keyframes. Errors: what is missing.
Expected<KeyedShape> keyed_shape_of(const MatteSource& matte) {
    if (!matte.shape.empty()) return matte.shape;
    KeyedShape out;
    for (const auto& [frame, key] : matte.keyframes) {
        if (key.shape_between) continue;
        if (!key.shape)
            return fail(ErrorCode::kUsage,
                        "The keyframe of frame " + std::to_string(frame) +
                            " was painted, and a shape cannot follow it. Remove it first.");
        out.keys[frame] = *key.shape;
    }
    if (out.keys.empty()) return fail(ErrorCode::kUsage, "Draw a shape first.");
    const auto& first = *out.keys.begin();
    for (const auto& [frame, shape] : out.keys)
        if (shape.points.size() != first.second.points.size())
            return fail(ErrorCode::kUsage,
                        "The shapes of frames " + std::to_string(first.first) + " and " +
                            std::to_string(frame) +
                            " have different numbers of points. Give them the same points first.");
    return out;
}

// Places inside of a shape, a few hundred of them.
std::vector<Vec2> places_in(const RotoShape& shape, Size size) {
    const Matte matte = matte_of_shape(shape, size);
    std::vector<Vec2> all;
    constexpr int kAcross = 64, kMost = 400;
    const int step = std::max(1, std::max(size.width, size.height) / (2 * kAcross));
    for (int y = step / 2; y < size.height; y += step)
        for (int x = step / 2; x < size.width; x += step)
            if (matte.at(x, y) > 127) all.emplace_back(x + 0.5f, y + 0.5f);
    std::vector<Vec2> out;
    const std::size_t every = 1 + all.size() / kMost;
    for (std::size_t k = 0; k < all.size(); k += every)
        out.push_back(all[k]);
    return out;
}

}  // namespace

void Session::follow_shape(const FollowShape& action) {
    const Region* region = region_by_id(document(), selected_);
    if (!open_ || !region || !reader_ || locked_.contains(selected_)) return;
    const MatteSource& source = layer_source(*region, layer_);
    auto shape = keyed_shape_of(source);
    if (!shape) return notify(NoticeKind::kWarning, shape.error().message);
    const bool tracks = action.follow != ShapeFollow::kNone && action.track.empty() &&
                        (action.again || shape->track.empty());
    if (tracks) return track_shape(action, shape->keys.begin()->second, shape->keys.begin()->first);
    shape->follow = action.follow;
    if (!action.track.empty()) shape->track = beside_project(action.track);
    MatteSource matte = source;
    matte.keyframes.clear();
    matte.confirmed.clear();
    matte.frozen.clear();
    matte.frozen_files.clear();
    matte.shape = std::move(*shape);
    commit_layer(*region, layer_, matte, "Shape of " + layer_name(*region, layer_));
}

// The motion of the region's surface inside the shape, as a track of four corners around it.
void Session::track_shape(const FollowShape& action, const RotoShape& shape, int frame) {
    const Region* region = region_by_id(document(), selected_);
    const std::string beside = new_matte_path(region->id, frame);
    std::string path = beside.substr(0, beside.rfind('.')) + "_track.json";
    notify(NoticeKind::kInfo, "Following the surface…");
    start_for_document([this, action, shape, frame, path, id = region->id, layer = layer_,
                        frames = reader_->frames(), size = reader_->size()]() -> Finish {
        const auto follow = [&]() -> Status {
            PlanarTracker tracker(places_in(shape, size));
            for (const int f : frames) {
                WEFT_TRY(motion, preview_.track(id, f, frame));
                WEFT_CHECK_OK(tracker.add(f, motion));
            }
            std::error_code error;
            std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
            return write_corner_track(path, tracker.track(), WriteRule::own());
        };
        const Status done = follow();
        return [this, action, path, done, id, layer] {
            if (!done)
                return notify(NoticeKind::kWarning,
                              "The shape cannot follow the surface: " + done.error().text() +
                                  " Wait for the analysis, or choose a track from a file.");
            if (id == selected_ && layer == layer_) follow_shape({action.follow, path, false});
        };
    });
}

void Session::detach_shape() {
    const Region* region = region_by_id(document(), selected_);
    if (!open_ || !region || !reader_ || layer_source(*region, layer_).shape.empty()) return;
    const KeyedShape shape = layer_source(*region, layer_).shape;
    std::map<int, std::string> paths;
    for (const auto& [frame, drawn] : shape.keys)
        paths[frame] = new_matte_path(region->id, frame);
    start_for_document([this, shape, paths, size = reader_->size(), id = region->id,
                        layer = layer_]() -> Finish {
        Status written;
        for (const auto& [frame, path] : paths) {
            std::error_code error;
            std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
            if (written)
                written =
                    write_matte(path, matte_of_shape(shape.keys.at(frame), size), WriteRule::own());
        }
        return [this, shape, paths, written, id, layer] {
            if (!written) return notify(NoticeKind::kError, written.error().text());
            const Region* now = region_by_id(document(), id);
            if (!now || layer_source(*now, layer).shape != shape) return;
            MatteSource matte = layer_source(*now, layer);
            matte.shape = {};
            for (const auto& [frame, path] : paths)
                matte.keyframes[frame] = {beside_project(path), shape.keys.at(frame)};
            commit_layer(*now, layer, matte, "Paint " + layer_name(*now, layer));
        };
    });
}

KeyedShape Session::absolute_shape(const MatteSource& source) const {
    KeyedShape out = source.shape;
    if (!out.track.empty()) out.track = resolve_path(project_dir(path_), out.track);
    return out;
}

void Session::show_shape() {
    view_.shape.reset();
    view_.shape_frames.clear();
    const Region* region = region_by_id(document(), selected_);
    if (!region) return;
    const MatteSource& source = layer_source(*region, layer_);
    if (!source.shape.empty()) {
        for (const auto& [frame, shape] : source.shape.keys)
            view_.shape_frames.push_back(frame);
        if (drawn_) view_.shape = drawn_->known_shape(absolute_shape(source), playback_.frame());
        return;
    }
    for (const auto& [frame, key] : source.keyframes) {
        if (!key.shape) continue;
        if (!key.shape_between) view_.shape_frames.push_back(frame);
        if (frame == playback_.frame()) view_.shape = key.shape;
    }
    // A new frame starts with the shape of the last frame before it.
    if (view_.shape || source.keyframes.contains(playback_.frame())) return;
    for (const int frame : view_.shape_frames)
        if (frame < playback_.frame()) view_.shape = source.keyframes.at(frame).shape;
}

}  // namespace weft
