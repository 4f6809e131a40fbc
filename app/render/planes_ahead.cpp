#include "app/render/planes_ahead.h"

#include "engine/core/parallel.h"

namespace weft {

PlanesAhead::PlanesAhead(const ShotPlan& plan, Size plate, const CancelToken& cancel,
                         const Backend* backend)
    : made_(plan.regions.size()) {
    for (auto& promise : made_)
        waiting_.push_back(promise.get_future());
    thread_ = std::thread([this, &plan, plate, cancel, backend] {
        const auto make = [&](std::size_t k) {
            const RegionPlan& region = plan.regions[k];
            try {
                if (unwanted_ || !has_plane(region)) {
                    made_[k].set_value(std::optional<RegionPlane>());
                    return;
                }
                auto plane = make_plane(plan, region, plate, cancel, {}, backend);
                made_[k].set_value(plane ? Made(std::move(*plane))
                                         : Made(tl::unexpected(std::move(plane).error())));
            } catch (...) {
                made_[k].set_exception(std::current_exception());
            }
        };
        // Many planes are synthesized in parallel, one thread each, which uses all threads. A few
        // planes are synthesized one after another by all threads.
        if (made_.size() >= 2 * static_cast<std::size_t>(thread_count())) {
            parallel_for(made_.size(), make);
            return;
        }
        for (std::size_t k = 0; k < made_.size(); ++k)
            make(k);
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
