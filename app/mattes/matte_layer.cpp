#include "app/mattes/matte_layer.h"

namespace weft {

const MatteSource& layer_source(const Region& region, int layer) {
    static const MatteSource kNone;
    if (layer == 0) return *region.matte;
    const auto at = static_cast<std::size_t>(layer) - 1;
    return at < region.holdouts->size() ? (*region.holdouts)[at] : kNone;
}

Edit set_layer(const Region& region, int layer, MatteSource source) {
    const RegionRef ref{region.id, {}};
    if (layer == 0) return SetMatte{ref, std::move(source)};
    std::vector<MatteSource> holdouts = *region.holdouts;
    const auto at = static_cast<std::size_t>(layer) - 1;
    if (at < holdouts.size())
        holdouts[at] = std::move(source);
    else
        holdouts.push_back(std::move(source));
    return SetHoldouts{ref, std::move(holdouts)};
}

Edit without_layer_key(const Region& region, int layer, int frame) {
    const RegionRef ref{region.id, {}};
    if (layer == 0) return RemoveMatteKeyframe{ref, frame};
    std::vector<MatteSource> holdouts = *region.holdouts;
    const auto at = static_cast<std::size_t>(layer) - 1;
    if (at < holdouts.size()) {
        holdouts[at].keyframes.erase(frame);
        if (holdouts[at].empty()) holdouts.erase(holdouts.begin() + layer - 1);
    }
    return SetHoldouts{ref, std::move(holdouts)};
}

std::string layer_name(const Region& region, int layer) {
    return layer == 0 ? region.name : "holdout " + std::to_string(layer) + " of " + region.name;
}

}  // namespace weft
