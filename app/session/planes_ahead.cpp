#include "app/session/planes_ahead.h"

namespace weft {

PlanesAhead::PlanesAhead(const ShotPlan& plan, Size plate, const CancelToken& cancel,
                         const Backend* backend)
    : made_(plan.regions.size()) {
    for (auto& promise : made_)
        waiting_.push_back(promise.get_future());
    thread_ = std::thread([this, &plan, plate, cancel, backend] {
        for (std::size_t k = 0; k < made_.size(); ++k) {
            const RegionPlan& region = plan.regions[k];
            try {
                if (unwanted_ || !has_plane(region)) {
                    made_[k].set_value(std::optional<RegionPlane>());
                    continue;
                }
                auto plane = make_plane(plan, region, plate, cancel, {}, backend);
                made_[k].set_value(plane ? Made(std::move(*plane))
                                         : Made(tl::unexpected(std::move(plane).error())));
            } catch (...) {
                made_[k].set_exception(std::current_exception());
            }
        }
    });
}

PlanesAhead::~PlanesAhead() {
    unwanted_ = true;
    thread_.join();
}

Expected<std::optional<RegionPlane>> PlanesAhead::take(std::size_t region) {
    return waiting_[region].get();
}

}  // namespace weft
