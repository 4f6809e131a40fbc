#include "app/session/mattes/shown_mattes.h"

#include <iterator>
#include <utility>

#include "app/mattes/matte_layer.h"
#include "app/project/codec/project_file.h"
#include "app/shot/matte_movies.h"
#include "app/shot/region_projection.h"
#include "engine/core/hash.h"
#include "engine/media/image_files.h"

namespace weft {
namespace {

using Kind = RegionMatteView::Kind;

std::string select_text(const MatteSelect& select) {
    return (select.value ? std::to_string(*select.value) : std::string()) + "/" + select.channel +
           (select.invert ? "/inverted" : "") + "/" + select.crypto;
}

// The files of a matte for every frame; a Cryptomatte without files uses the plate's.
std::string files_of(const MatteSource& source, const std::string& plate) {
    if (!source.files.empty()) return source.files;
    return source.select.crypto.empty() ? std::string() : plate;
}

void show_stroke(const MattePainting::Shown& stroke, RegionMatteView& out) {
    out.kind = Kind::kPainted;
    out.pixels = stroke.pixels;
    out.version = stroke.version;
    out.changed = stroke.changed;
}

}  // namespace

KeyedShape absolute_shape(const MatteSource& source, const std::string& folder) {
    KeyedShape out = source.shape;
    if (!out.track.empty()) out.track = resolve_path(folder, out.track);
    return out;
}

ShownMattes::Wanted ShownMattes::drawn(const MatteSource& source, int frame) const {
    const KeyedShape shape = absolute_shape(source, use_.document.folder());
    Hasher hasher;
    add_shape(hasher, shape);
    hasher.value(source.select.invert).value(frame);
    return {Kind::kFile, "shape " + hasher.finish().hex(),
            [drawn = use_.plate.drawn(), shape, invert = source.select.invert, frame] {
                return drawn->matte(shape, invert, frame);
            }};
}

Expected<ShownMattes::Wanted> ShownMattes::from_files(const std::string& files,
                                                      const MatteSelect& select, int frame) const {
    WEFT_TRY(mattes,
             matte_files(resolve_path(use_.document.folder(), files), *use_.plate.reader()));
    Wanted out{Kind::kFile, mattes.path_for(frame) + "|" + select_text(select), {}};
    if (mattes.is_movie()) out.name += "|" + std::to_string(frame);
    out.read = [mattes, select, size = use_.plate.reader()->size(), frame] {
        return mattes.read(frame, select, size);
    };
    return out;
}

bool ShownMattes::is_propagated(const MatteSource& source, int frame) const {
    return !source.empty() && use_.plate.reader() && source.shape.empty() &&
           files_of(source, use_.document.project().plate.path).empty() &&
           !source.keyframes.contains(frame);
}

Expected<ShownMattes::Wanted> ShownMattes::wanted(const Region& region, int layer, int frame) {
    const MatteSource& source = layer_source(region, layer);
    if (source.empty() || !use_.plate.reader()) return Wanted{};
    if (!source.shape.empty()) return drawn(source, frame);
    if (const std::string files = files_of(source, use_.document.project().plate.path);
        !files.empty())
        return from_files(files, source.select, frame);
    const std::string path = resolve_path(use_.document.folder(), source.keyframes.at(frame).path);
    return Wanted{Kind::kPainted, path,
                  [path, select = source.select, size = use_.plate.reader()->size()] {
                      return read_matte(path, select, size);
                  }};
}

RegionMatteView ShownMattes::matte_of(const Region& region, int layer, int frame, Place place) {
    RegionMatteView out;
    out.region = region.id;
    out.layer = layer;
    out.frame = frame;
    if (const auto stroke = use_.painting.at({region.id, layer, frame})) {
        show_stroke(*stroke, out);
        return out;
    }
    const std::string name = find(region, layer, out);
    if (!out.keep) return out;
    Shown& shown = shown_[{region.id, layer, place}];
    out.edged = shown.edged.of(out.keep, project_edge(layer_source(region, layer).edge).at(frame),
                               name, use_.shelf);
    const MattePtr& visible = out.edged ? out.edged : out.keep;
    if (shown.matte != visible) shown = {shown.edged, visible, next_picture_id()};
    out.version = shown.version;
    out.pixels = visible->view();
    return out;
}

// Finds the matte of the view's frame, or says why there is none. Returns its name on the shelf.
std::string ShownMattes::find(const Region& region, int layer, RegionMatteView& out) {
    if (is_propagated(layer_source(region, layer), out.frame))
        return find_propagated(region, layer, out);
    const auto want = wanted(region, layer, out.frame);
    if (!want) {
        out.kind = Kind::kFailed;
        out.error = want.error().text();
        return {};
    }
    out.kind = want->kind;
    if (out.kind == Kind::kNone) return {};
    out.keep = use_.shelf.get(want->name, want->read);
    if (!out.keep) {
        out.error = use_.shelf.error(want->name);
        out.kind = out.error.empty() ? Kind::kLoading : Kind::kFailed;
    }
    return want->name;
}

std::string ShownMattes::find_propagated(const Region& region, int layer, RegionMatteView& out) {
    PropagatedMatte found =
        use_.propagated.find(region, layer, out.frame, use_.plate.reader()->size());
    out.keep = std::move(found.matte);
    out.kind = out.keep ? Kind::kPropagated : found.reached ? Kind::kLoading : Kind::kUnreached;
    out.outdated = out.keep && !found.current;
    return found.name;
}

ShownMattes::Base ShownMattes::base_of(const Region& region, int layer, int frame) {
    if (is_propagated(layer_source(region, layer), frame)) {
        PropagatedMatte found =
            use_.propagated.find(region, layer, frame, use_.plate.reader()->size());
        const bool reading = !found.matte && found.reached;
        return {std::move(found.matte), reading, found.reached, std::move(found.depends_on)};
    }
    RegionMatteView out;
    out.frame = frame;
    (void)find(region, layer, out);
    return {out.keep, out.kind == Kind::kLoading, true, {}};
}

MattePtr ShownMattes::confirmed_area(const Region& region, int layer, int frame) {
    const MatteSource& source = layer_source(region, layer);
    const auto edge = source.confirmed.find(frame);
    if (edge == source.confirmed.end() || source.keyframes.contains(frame) || !use_.plate.reader())
        return {};
    const std::string path = resolve_path(use_.document.folder(), edge->second.area);
    return use_.shelf.get(
        path, [path, size = use_.plate.reader()->size()] { return read_matte(path, {}, size); });
}

std::string ShownMattes::confirmed_error(const Region& region, int layer, int frame) const {
    const auto& edges = layer_source(region, layer).confirmed;
    const auto edge = edges.find(frame);
    if (edge == edges.end()) return {};
    return use_.shelf.error(resolve_path(use_.document.folder(), edge->second.area));
}

void ShownMattes::forget() {
    shown_.clear();
    use_.propagated.forget();
}

void ShownMattes::show(SessionView& view) {
    view.mattes.clear();
    view.holdouts.clear();
    view.zones.clear();
    view.matte_layer = 0;
    if (!use_.document.is_open()) return;
    for (const Leaf<Region>& region : use_.document.project().regions)
        view.mattes.push_back(matte_of(*region, 0));
    const int painted = use_.selection.layer;
    view.matte_layer = painted;
    view.begun_zone = use_.selection.begun_zone;
    const Region* region = use_.selection.of(use_.document.project());
    if (region) {
        for (int layer = 1; layer < last_layer(*region) || layer <= painted; ++layer)
            view.holdouts.push_back(matte_of(*region, layer));
        for (int layer = -1; layer > first_layer(*region) || layer >= painted; --layer)
            view.zones.push_back(matte_of(*region, layer));
    }
    view.reached.clear();
    if (region && !layer_source(*region, painted).keyframes.empty() && use_.plate.reader())
        view.reached = use_.propagated.reached(*region, painted);
    show_onion(region, view);
    show_confirmed(region, view);
}

// The nearest keyframes on both sides; each has a place of its own among the shown mattes, so that
// it is uploaded once.
void ShownMattes::show_onion(const Region* region, SessionView& view) {
    view.onion.clear();
    view.onion_skin = onion_skin_;
    if (!onion_skin_ || !region || use_.playback.direction() != 0) return;
    const int layer = use_.selection.layer, frame = use_.playback.frame();
    const auto& keys = layer_source(*region, layer).keyframes;
    if (const auto next = keys.lower_bound(frame); next != keys.begin())
        view.onion.push_back(matte_of(*region, layer, std::prev(next)->first, Place::kBefore));
    if (const auto next = keys.upper_bound(frame); next != keys.end())
        view.onion.push_back(matte_of(*region, layer, next->first, Place::kAfter));
}

void ShownMattes::show_confirmed(const Region* region, SessionView& view) {
    view.confirmed = {};
    if (!region || !use_.plate.reader() || use_.playback.direction() != 0) return;
    RegionMatteView& out = view.confirmed;
    out.region = region->id;
    out.layer = use_.selection.layer;
    out.frame = use_.playback.frame();
    if (const auto stroke = use_.painting.at({out.region, out.layer, out.frame, true}))
        return show_stroke(*stroke, out);
    out.keep = confirmed_area(*region, out.layer, out.frame);
    Shown& shown = shown_[{region->id, out.layer, Place::kConfirmed}];
    if (shown.matte != out.keep) shown = {shown.edged, out.keep, next_picture_id()};
    if (!out.keep) return;
    out.kind = Kind::kPainted;
    out.version = shown.version;
    out.pixels = out.keep->view();
}

}  // namespace weft
