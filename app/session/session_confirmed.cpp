// "This edge is right": parts of a propagated matte that are confirmed on a frame.
#include <algorithm>

#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/session/session.h"
#include "engine/mask/confirmed_part.h"
#include "engine/media/image_files.h"

namespace weft {
namespace {

bool any_confirmed(const Matte& area) {
    return std::any_of(area.data(), area.data() + area.size_bytes(), is_confirmed);
}

// On such a frame all of the matte counts.
bool is_whole(const MatteSource& source, int frame) {
    return source.keyframes.contains(frame) ||
           std::find(source.frozen.begin(), source.frozen.end(), frame) != source.frozen.end();
}

}  // namespace

void Session::mark_confirmed() {
    const Region* region = painted_region();
    if (!region || view_.marks.empty()) return;
    const MatteSource& source = layer_source(*region, layer_);
    const std::vector<int>& frames = view_.plate.frames;
    for (const auto& [frame, edge] : source.confirmed) {
        const auto at = std::lower_bound(frames.begin(), frames.end(), frame);
        if (at != frames.end() && *at == frame && !source.keyframes.contains(frame))
            view_.marks[static_cast<std::size_t>(at - frames.begin())].confirmed = true;
    }
}

// Until it is propagated again, a frame with a confirmed part shows what was seen there then.
MattePtr Session::confirmed_matte(const MatteSource& source, int frame) {
    const auto edge = source.confirmed.find(frame);
    if (edge == source.confirmed.end()) return {};
    const std::string path = resolve_path(project_dir(path_), edge->second.path);
    return shelf_.get(path, [path, select = source.select, size = reader_->size()] {
        return read_matte(path, select, size);
    });
}

MattePtr Session::confirmed_area(const Region& region, int layer, int frame) {
    const MatteSource& source = layer_source(region, layer);
    const auto edge = source.confirmed.find(frame);
    if (edge == source.confirmed.end() || source.keyframes.contains(frame) || !reader_) return {};
    const std::string path = resolve_path(project_dir(path_), edge->second.area);
    return shelf_.get(path, [path, size = reader_->size()] { return read_matte(path, {}, size); });
}

// What a stroke that confirms or corrects a part begins with; nothing if it cannot begin.
std::optional<Session::Confirming> Session::confirming_here() {
    const Region* region = region_by_id(document(), selected_);
    const MatteSource& source = layer_source(*region, layer_);
    const int frame = playback_.frame();
    const auto later = [&](const char* what) {
        notify(NoticeKind::kWarning, std::string(what) + " Try again in a moment.");
        return std::nullopt;
    };
    Confirming out{matte_of(*region, layer_, frame).keep, {}};
    if (!out.matte) return later("The matte of this frame is still being propagated.");
    if (!source.confirmed.contains(frame)) {
        out.area = std::make_shared<const Matte>(reader_->size());
    } else if (out.area = confirmed_area(*region, layer_, frame); !out.area) {
        return later("What is confirmed on this frame is still being read.");
    }
    return out;
}

void Session::begin_confirming(const BeginStroke& action) {
    const Region* region = region_by_id(document(), selected_);
    const MatteSource& source = layer_source(*region, layer_);
    if (source.keyframes.empty())
        return notify(NoticeKind::kWarning,
                      "Paint a keyframe first. Then confirm edges on the frames it is propagated "
                      "to.");
    if (is_whole(source, playback_.frame()))
        return notify(NoticeKind::kInfo,
                      "This frame is a keyframe or frozen: its whole matte counts as right "
                      "already.");
    confirming_ = confirming_here();
    if (!confirming_) return;
    playback_.stop();
    MattePlace place = painted_place();
    place.confirmed = true;
    Brush brush = action.brush;
    brush.opacity = 1;
    brush.pressure_opacity = false;
    painting_.begin(place, confirming_->area, reader_->size(), brush);
    painting_.move_to(action.at, action.pressure);
}

bool Session::counts_in_part(bool here_only) const {
    const MatteSource& source = layer_source(*painted_region(), layer_);
    return here_only && !source.keyframes.empty() && !is_whole(source, playback_.frame());
}

void Session::keep_here(MattePtr matte, const Matte& changed, const Confirming& before,
                        const MattePlace& place, const std::string& what) {
    Matte area = *before.area;
    std::transform(area.data(), area.data() + area.size_bytes(), changed.data(), area.data(),
                   [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    keep_confirmed({std::move(matte), std::make_shared<const Matte>(std::move(area))}, place, what);
}

void Session::keep_confirmed(const Confirming& now, const MattePlace& place,
                             const std::string& what) {
    const Region* region = region_by_id(document(), place.region);
    if (!region) return;
    MatteSource source = layer_source(*region, place.layer);
    if (any_confirmed(*now.area)) {
        ConfirmedEdge edge;
        for (const auto& [pixels, path] :
             {std::pair{now.matte, &edge.path}, {now.area, &edge.area}}) {
            const std::string file = new_matte_path(place.region, place.frame);
            shelf_.write(file, pixels);
            *path = beside_project(file);
        }
        mattes_unwritten_ = true;
        source.confirmed[place.frame] = edge;
    } else {
        source.confirmed.erase(place.frame);
    }
    commit_layer(
        *region, place.layer, source,
        what + layer_name(*region, place.layer) + " on frame " + std::to_string(place.frame));
}

void Session::show_confirmed() {
    view_.confirmed = {};
    const Region* region = painted_region();
    if (!region || !reader_ || playback_.direction() != 0) return;
    RegionMatteView& out = view_.confirmed;
    out.region = region->id;
    out.layer = layer_;
    out.frame = playback_.frame();
    MattePlace place = painted_place();
    place.confirmed = true;
    if (const auto stroke = painting_.at(place)) return show_stroke(*stroke, out);
    out.keep = confirmed_area(*region, layer_, out.frame);
    constexpr int kPlace = 3;  // among those of show_onion_skin()
    Shown& shown = shown_mattes_[{region->id, layer_, kPlace}];
    if (shown.matte != out.keep) shown = {shown.edged, out.keep, next_picture_id()};
    if (!out.keep) return;
    out.kind = RegionMatteView::Kind::kPainted;
    out.version = shown.version;
    out.pixels = out.keep->view();
}

}  // namespace weft
