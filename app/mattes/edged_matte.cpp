#include "app/mattes/edged_matte.h"

#include "engine/core/hash.h"

namespace weft {
namespace {

std::string text_of(const MatteEdge& edge) {
    Hasher hasher;
    hasher.value(edge.min_island_px).value(edge.min_hole_px).value(edge.smooth_px);
    hasher.value(edge.choke_px).value(edge.feather_px).value(edge.blur_px);
    return hasher.finish().hex();
}

}  // namespace

MattePtr EdgedMatte::of(const MattePtr& matte, const MatteEdge& edge, const std::string& name,
                        MatteShelf& shelf) {
    if (matte != matte_ || edge.none()) {
        matte_ = matte;
        shown_.reset();
        pending_.clear();
    }
    if (edge.none() || !matte) return nullptr;
    const std::string wanted = name + " with edge " + text_of(edge);
    const bool busy = !pending_.empty() && pending_ != wanted && !shelf.get(pending_, {}) &&
                      shelf.error(pending_).empty();
    if (busy) return shown_;
    pending_ = wanted;
    const auto make = [matte, edge]() -> Expected<Matte> { return with_edge(*matte, edge); };
    if (MattePtr made = shelf.get(wanted, make)) shown_ = std::move(made);
    return shown_;
}

}  // namespace weft
