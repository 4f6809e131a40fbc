#include "engine/synthesis/device_search.h"

namespace weft {

DeviceSearch::DeviceSearch(const SampleAtlas& atlas, const PlaneOptions& options,
                           const Canvas& canvas) {
    if (options.backend == nullptr) return;
    PlaneSearchSetup setup;
    setup.canvas = canvas.size();
    setup.torus = canvas.torus();
    setup.samples = {atlas.pixels()};
    if (options.guide) {
        setup.guide = options.guide->target;
        setup.guide_known = options.guide->known;
        setup.fill_weight = PlaneGuide::kFillWeight;
        setup.guide_weight = options.guide->guide_weight();
    }
    search_ = options.backend->open_plane_search(setup);
    // Before the sweep the canvas holds only locked texels.
    if (canvas.any_locked()) show(canvas, rect_of(canvas.size()));
}

bool DeviceSearch::usable() {
    const std::lock_guard lock(mutex_);
    return search_ != nullptr;
}

void DeviceSearch::show(const Canvas& canvas, const Recti& rect) {
    const std::lock_guard lock(mutex_);
    if (!search_) return;
    const Size plane = canvas.size();
    const int turns = canvas.torus() ? 1 : 0;
    for (int ky = -turns; ky <= turns; ++ky) {
        for (int kx = -turns; kx <= turns; ++kx) {
            const Vec2i d{kx * plane.width, ky * plane.height};
            const Recti part =
                Recti{rect.x0 + d.x, rect.y0 + d.y, rect.x1 + d.x, rect.y1 + d.y}.intersected(
                    rect_of(plane));
            if (part.empty()) continue;
            if (search_->update(part, canvas.pixels().view().crop(part),
                                canvas.filled_part(part))) {
                continue;
            }
            search_.reset();
            return;
        }
    }
}

std::optional<Shortlist> DeviceSearch::find(const Recti& block, const Recti& window, Vec2i lo,
                                            Vec2i hi, const std::vector<Vec2i>& forbidden) {
    const std::lock_guard lock(mutex_);
    if (!search_) return std::nullopt;
    const std::vector<std::uint8_t> allowed = allowed_translations(lo, hi, forbidden);
    PlaneSearchRequest request;
    request.block = block;
    request.window = window;
    request.lo = lo;
    request.hi = hi;
    request.allowed = allowed;
    request.good_numerator = kGoodNumerator;
    request.good_denominator = kGoodDenominator;
    const Expected<PlaneSearchResult> found = search_->find(request);
    if (!found) {
        search_.reset();
        return std::nullopt;
    }
    Shortlist list{
        {}, translation_at(lo, hi, found->best), {found->best_cost.ssd, found->best_cost.weight}};
    list.good.reserve(found->good.size());
    for (const std::uint32_t index : found->good)
        list.good.push_back(translation_at(lo, hi, index));
    return list;
}

}  // namespace weft
