#include "app/session/mattes/matte_shapes.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/exchange/track_file.h"
#include "app/mattes/matte_layer.h"
#include "app/session/mattes/shown_mattes.h"
#include "engine/form/planar_track.h"
#include "engine/mask/shape_matte.h"
#include "engine/media/frame_writer.h"

namespace weft {
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
                            " was painted, and a shape cannot follow it.",
                        "Remove it first.");
        out.keys[frame] = *key.shape;
    }
    if (out.keys.empty()) return fail(ErrorCode::kUsage, "Draw a shape first.");
    const auto& first = *out.keys.begin();
    for (const auto& [frame, shape] : out.keys)
        if (shape.points.size() != first.second.points.size())
            return fail(ErrorCode::kUsage,
                        "The shapes of frames " + std::to_string(first.first) + " and " +
                            std::to_string(frame) + " have different numbers of points.",
                        "Give them the same points first.");
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

// The motion of a region's surface from a shape on `frame`, as a track of four corners around it.
Status write_surface_track(const Preview& preview, RegionId region, const RotoShape& shape,
                           int frame, const FrameReader& plate, const std::string& path) {
    PlanarTracker tracker(places_in(shape, plate.size()));
    for (const int f : plate.frames()) {
        WEFT_TRY(motion, preview.track(region, f, frame));
        WEFT_CHECK_OK(tracker.add(f, motion));
    }
    std::error_code error;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
    return write_corner_track(path, tracker.track(), WriteRule::own());
}

Status write_shape_mattes(const KeyedShape& shape, const std::map<int, std::string>& paths,
                          Size size, PixelAspect aspect) {
    for (const auto& [frame, path] : paths) {
        std::error_code error;
        std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
        const Matte matte = matte_of_shape(shape.keys.at(frame), size, aspect);
        WEFT_CHECK_OK(write_matte(path, matte, WriteRule::own()));
    }
    return {};
}

}  // namespace

void MatteShapes::follow(const FollowShape& action) {
    const Region* followed = region();
    if (!use_.document.is_open() || !followed || !use_.plate.reader() || use_.selection.is_locked())
        return;
    const int layer = use_.selection.layer;
    const MatteSource& source = layer_source(*followed, layer);
    auto shape = keyed_shape_of(source);
    if (!shape) return use_.notices.add(NoticeKind::kWarning, shape.error().sentence());
    const bool tracks = action.follow != ShapeFollow::kNone && action.track.empty() &&
                        (action.again || shape->track.empty());
    if (tracks) return track(action, shape->keys.begin()->second, shape->keys.begin()->first);
    shape->follow = action.follow;
    if (!action.track.empty()) shape->track = use_.folder.beside_project(action.track);
    MatteSource matte = source;
    matte.keyframes.clear();
    matte.confirmed.clear();
    matte.frozen.clear();
    matte.frozen_files.clear();
    matte.shape = std::move(*shape);
    use_.kept.commit_layer(*followed, layer, matte, "Shape of " + layer_name(*followed, layer));
}

void MatteShapes::track(const FollowShape& action, const RotoShape& shape, int frame) {
    const RegionId id = use_.selection.region;
    const std::string beside = use_.folder.new_path(id, frame);
    const std::string path = beside.substr(0, beside.rfind('.')) + "_track.json";
    use_.notices.add(NoticeKind::kInfo, "Following the surface…");
    use_.tasks.start_for_document([this, action, shape, frame, path, id,
                                   layer = use_.selection.layer,
                                   plate = use_.plate.reader()]() -> DocumentTasks::Finish {
        const Status done = write_surface_track(use_.preview, id, shape, frame, *plate, path);
        return [this, action, path, done, id, layer] {
            if (!done)
                return use_.notices.add(
                    NoticeKind::kWarning,
                    "The shape cannot follow the surface: " + done.error().text() +
                        " Wait for the analysis, or choose a track from a file.");
            if (id == use_.selection.region && layer == use_.selection.layer)
                follow({action.follow, path, false});
        };
    });
}

void MatteShapes::detach() {
    const Region* drawn = region();
    const int layer = use_.selection.layer;
    if (!use_.document.is_open() || !drawn || !use_.plate.reader() ||
        layer_source(*drawn, layer).shape.empty())
        return;
    const KeyedShape shape = layer_source(*drawn, layer).shape;
    std::map<int, std::string> paths;
    for (const auto& [frame, key] : shape.keys)
        paths[frame] = use_.folder.new_path(drawn->id, frame);
    use_.tasks.start_for_document([this, shape, paths, size = use_.plate.reader()->size(),
                                   aspect = use_.plate.aspect(), id = drawn->id,
                                   layer]() -> DocumentTasks::Finish {
        const Status written = write_shape_mattes(shape, paths, size, aspect);
        return [this, shape, paths, written, id, layer] {
            if (!written) return use_.notices.add(NoticeKind::kError, written.error().text());
            const Region* now = region_by_id(use_.document.project(), id);
            if (!now || layer_source(*now, layer).shape != shape) return;
            MatteSource matte = layer_source(*now, layer);
            matte.shape = {};
            for (const auto& [frame, path] : paths)
                matte.keyframes[frame] = {use_.folder.beside_project(path), shape.keys.at(frame)};
            use_.kept.commit_layer(*now, layer, matte, "Paint " + layer_name(*now, layer));
        };
    });
}

void MatteShapes::show(SessionView& view) const {
    view.shape.reset();
    view.shape_frames.clear();
    const Region* shown = region();
    if (!shown) return;
    const int here = use_.playback.frame();
    const MatteSource& source = layer_source(*shown, use_.selection.layer);
    if (!source.shape.empty()) {
        for (const auto& [frame, shape] : source.shape.keys)
            view.shape_frames.push_back(frame);
        if (use_.plate.drawn())
            view.shape = use_.plate.drawn()->known_shape(
                absolute_shape(source, use_.document.folder()), here);
        return;
    }
    for (const auto& [frame, key] : source.keyframes) {
        if (!key.shape) continue;
        if (!key.shape_between) view.shape_frames.push_back(frame);
        if (frame == here) view.shape = key.shape;
    }
    // A new frame starts with the shape of the last frame before it.
    if (view.shape || source.keyframes.contains(here)) return;
    for (const int frame : view.shape_frames)
        if (frame < here) view.shape = source.keyframes.at(frame).shape;
}

}  // namespace weft
