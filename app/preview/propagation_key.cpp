#include "app/preview/propagation_key.h"

#include "app/mattes/matte_layer.h"
#include "app/shot/drawn_mattes.h"
#include "engine/core/hash.h"

namespace weft {
namespace {

void add_select(Hasher& hasher, const MatteSelect& select) {
    hasher.value(select.value.has_value()).value(select.value.value_or(0));
    hasher.text(select.channel).value(select.invert).text(select.crypto);
}

void add_source(Hasher& hasher, const MatteSource& matte, std::optional<int> but) {
    hasher.text(matte.files);
    hasher.value(matte.keyframes.size());
    for (const auto& [frame, key] : matte.keyframes)
        hasher.value(frame).text(key.path);
    for (const auto& [frame, edge] : matte.confirmed)
        if (frame != but) hasher.value(frame).text(edge.path).text(edge.area);
    if (!matte.shape.empty()) add_shape(hasher, matte.shape);
    add_select(hasher, matte.select);
    for (const int frame : matte.frozen)
        hasher.value(frame);
    hasher.text(matte.frozen_files)
        .value(matte.steadiness)
        .value(static_cast<int>(matte.propagate_direction))
        .value(matte.propagate_from.value_or(-1))
        .value(matte.propagate_to.value_or(-1));
}

}  // namespace

std::string propagation_key(const Project& absolute, const Region& region, int layer,
                            std::optional<int> but) {
    const Plate& plate = absolute.plate;
    Hasher hasher;
    hasher.text(plate.path).text(plate.layer).text(plate.space);
    hasher.value(plate.movie_start).value(static_cast<int>(plate.missing));
    hasher.value(plate.pixel_aspect.value_or(0));  // of shapes
    add_source(hasher, layer_source(region, layer), but);
    // What is in front of a matte hides the surface that it is propagated along.
    if (layer <= 0)
        for (const MatteSource& holdout : *region.holdouts)
            add_source(hasher, holdout, {});
    return hasher.finish().hex();
}

}  // namespace weft
