// Mattes from scribbles and roto shapes.
#include <filesystem>

#include "app/base/background.h"
#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
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
        "Scribble");
}

void Session::set_shape(const RotoShape& shape) {
    constexpr std::size_t kLeast = 3;
    if (shape.points.size() < kLeast || follows_change(SetShape{shape})) return;
    end_stroke();
    if (!open_ || !may_paint()) return;
    changing_.emplace();
    changing_->place = painted_place();
    changing_->label = "Shape";
    changing_->shape = shape;
    changing_->matte =
        in_background([shape, size = reader_->size()] { return matte_of_shape(shape, size); });
}

// Makes a matte for every frame between two shapes from the interpolated shape.
void Session::fill_between_shapes() {
    const Region* region = region_by_id(document(), selected_);
    if (!region || !reader_ || !may_paint()) return;
    std::map<int, RotoShape> keys;
    for (const auto& [frame, key] : layer_source(*region, layer_).keyframes)
        if (key.shape && !key.shape_between) keys[frame] = *key.shape;
    struct Made {
        int frame = 0;
        RotoShape shape;
        std::string path;
    };
    std::vector<Made> list;
    for (auto a = keys.begin(), b = a; a != keys.end() && (b = std::next(a)) != keys.end(); ++a) {
        if (a->second.points.size() != b->second.points.size()) {
            notify(NoticeKind::kWarning, "The shapes of frames " + std::to_string(a->first) +
                                             " and " + std::to_string(b->first) +
                                             " have different numbers of points. Give them "
                                             "the same points, then interpolate again.");
            return;
        }
        for (const int frame : reader_->frames()) {
            if (frame <= a->first || frame >= b->first) continue;
            const float t =
                static_cast<float>(frame - a->first) / static_cast<float>(b->first - a->first);
            list.push_back(
                {frame, between(a->second, b->second, t), new_matte_path(region->id, frame)});
        }
    }
    if (list.empty()) {
        notify(NoticeKind::kWarning, "Draw the shape on two frames first.");
        return;
    }
    start_for_document([this, list = std::move(list), size = reader_->size(), id = region->id,
                        layer = layer_]() -> Finish {
        Status written;
        for (const Made& one : list) {
            std::error_code error;
            std::filesystem::create_directories(std::filesystem::path(one.path).parent_path(),
                                                error);
            if (written)
                written = write_matte(one.path, matte_of_shape(one.shape, size), WriteRule::own());
        }
        return [this, list, id, layer, written] {
            if (!written) return notify(NoticeKind::kError, written.error().text());
            const Region* now = region_by_id(document(), id);
            if (!now) return;
            MatteSource matte = layer_source(*now, layer);
            std::erase_if(matte.keyframes,
                          [](const auto& key) { return key.second.shape_between; });
            for (const Made& one : list)
                matte.keyframes[one.frame] = {beside_project(one.path), one.shape, true};
            auto changed =
                apply_edit(history_.current(), set_layer(*now, layer, matte, begun_zone_));
            if (!changed) return notify(NoticeKind::kError, changed.error().text());
            commit(std::move(*changed), "Interpolate shapes of " + layer_name(*now, layer));
        };
    });
}

void Session::show_shape() {
    view_.shape.reset();
    view_.shape_frames.clear();
    const Region* region = region_by_id(document(), selected_);
    if (!region) return;
    const MatteSource& source = layer_source(*region, layer_);
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
