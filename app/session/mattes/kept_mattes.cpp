#include "app/session/mattes/kept_mattes.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "app/mattes/matte_layer.h"
#include "engine/mask/confirmed_part.h"

namespace weft {
namespace {

bool any_confirmed(const Matte& area) {
    return std::any_of(area.data(), area.data() + area.size_bytes(), is_confirmed);
}

}  // namespace

Edit KeptMattes::layer_edit(const Region& region, int layer, const MatteSource& matte) const {
    return set_layer(region, layer, matte, use_.selection.begun_zone);
}

void KeptMattes::commit_layer(const Region& region, int layer, const MatteSource& matte,
                              const std::string& label) {
    use_.document.commit(layer_edit(region, layer, matte), label);
}

// Returns the file as the project names it.
std::string KeptMattes::write(const MattePtr& matte, const MattePlace& place) {
    const std::string path = use_.folder.new_path(place.region, place.frame);
    use_.shelf.write(path, matte);
    unwritten_ = true;
    return use_.folder.beside_project(path);
}

void KeptMattes::keep(MattePtr matte, const MattePlace& place, const std::string& label,
                      const std::optional<RotoShape>& shape) {
    const Region* target = region_by_id(use_.document.project(), place.region);
    if (!target) return;
    // The shape of an older keyframe does not describe the new matte.
    MatteSource source = layer_source(*target, place.layer);
    source.keyframes[place.frame] = {write(matte, place), shape};
    source.confirmed.erase(place.frame);
    commit_layer(*target, place.layer, source, label);
}

void KeptMattes::keep_change(ChangedMatte made, const std::optional<ConfirmedMatte>& part,
                             const MattePlace& place, const ChangeLabels& labels,
                             const std::optional<RotoShape>& shape) {
    if (!made.matte) return;
    if (place.confirmed)
        return keep_confirmed({part->matte, std::move(made.matte), part->depends_on}, place,
                              labels.part);
    if (part) return keep_part(std::move(made.matte), made.where, *part, place, labels.part);
    keep(std::move(made.matte), place, labels.whole + " on frame " + std::to_string(place.frame),
         shape);
}

void KeptMattes::keep_part(MattePtr matte, const Matte& changed, const ConfirmedMatte& before,
                           const MattePlace& place, const std::string& what) {
    Matte area = *before.area;
    std::transform(area.data(), area.data() + area.size_bytes(), changed.data(), area.data(),
                   [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    keep_confirmed(
        {std::move(matte), std::make_shared<const Matte>(std::move(area)), before.depends_on},
        place, what);
}

void KeptMattes::keep_confirmed(const ConfirmedMatte& now, const MattePlace& place,
                                const std::string& what) {
    const Region* region = region_by_id(use_.document.project(), place.region);
    if (!region) return;
    MatteSource source = layer_source(*region, place.layer);
    if (any_confirmed(*now.area)) {
        ConfirmedEdge edge;
        edge.path = write(now.matte, place);
        edge.area = write(now.area, place);
        use_.propagated.painted_on(resolve_path(use_.document.folder(), edge.path), now.depends_on);
        source.confirmed[place.frame] = edge;
    } else {
        source.confirmed.erase(place.frame);
    }
    commit_layer(
        *region, place.layer, source,
        what + layer_name(*region, place.layer) + " on frame " + std::to_string(place.frame));
}

void KeptMattes::keep_instead(const MattePtr& matte, const MattePlace& place) {
    const Region* region = region_by_id(use_.document.project(), place.region);
    if (!region) return;
    MatteSource painted;
    painted.keyframes[place.frame] = {write(matte, place), {}};
    const std::string name = layer_name(*region, place.layer);
    use_.document.edit(layer_edit(*region, place.layer, painted));
    use_.notices.add(NoticeKind::kInfo, "Frame " + std::to_string(place.frame) +
                                            " is now a painted keyframe of '" + name +
                                            "'. It is propagated to the other frames.");
}

void KeptMattes::copy_keyframe(int from, int to) {
    const Region* region = use_.selection.of(use_.document.project());
    const int layer = use_.selection.layer;
    if (!region || !layer_source(*region, layer).keyframes.contains(from)) {
        use_.notices.add(NoticeKind::kWarning, "There is no painted keyframe before this frame.");
        return;
    }
    // Files never change once written, so both keyframes may use the same one.
    MatteSource source = layer_source(*region, layer);
    source.keyframes[to] = {source.keyframes.at(from).path, {}};
    source.confirmed.erase(to);
    use_.document.edit(layer_edit(*region, layer, source));
}

bool KeptMattes::were_written() {
    const bool before = std::exchange(unwritten_, use_.shelf.writing());
    return before && !unwritten_;
}

}  // namespace weft
