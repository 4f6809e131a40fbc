#include "app/preview/matte_propagator.h"

#include <algorithm>

#include "app/preview/preview.h"
#include "app/preview/preview_impl.h"
#include "engine/pipeline/matte_pass.h"

namespace weft {
namespace {

constexpr std::size_t kCacheBytes = std::size_t{64} << 20;

}  // namespace

void MattePropagator::propagate(const Project& project, const PaintedMattes& painted, int frame) {
    const bool any = std::any_of(project.regions.begin(), project.regions.end(),
                                 [](const Leaf<Region>& region) { return region->enabled; });
    if (!any) return clear();
    // Once a matte has been written, its file names what was propagated.
    std::string key = analysis_key(project);
    for (const auto& [path, matte] : painted)
        key += "\n" + path;
    if (asked_ && asked_->key == key) return;
    asked_ = std::make_shared<const Asked>(
        Asked{document_.load(), std::move(key), project, painted, frame});
    start();
}

void MattePropagator::start() {
    if (paused_ || !asked_) return;
    (void)worker_.ask(asked_->key, [this, asked = asked_](const CancelToken& cancel) {
        work(*asked, cancel);
        return cancel.cancelled() ? std::nullopt : std::optional(true);
    });
}

void MattePropagator::pause() {
    paused_ = true;
    // An empty request cancels the one before.
    (void)worker_.ask({}, [](const CancelToken&) { return std::optional(true); });
}

void MattePropagator::resume() {
    paused_ = false;
    start();
}

void MattePropagator::clear() {
    if (!asked_) return;
    asked_.reset();
    ++document_;
    (void)worker_.ask({}, [](const CancelToken&) { return std::optional(true); });
}

void MattePropagator::work(const Asked& asked, const CancelToken& cancel) {
    const auto before = propagated_.get();
    if (before) before->store->mattes_written(*before->shot);
    OpenShotOptions options;
    options.textures = false;
    options.painted = asked.painted;
    options.cache_bytes = kCacheBytes;
    options.files = files_;
    if (before && before->shot->project.plate == asked.project.plate)
        options.plate = before->shot->plate;
    const auto shot = open_shot(asked.project, options);
    if (!shot || cancel.cancelled()) return;
    std::vector<std::string> warnings;
    const auto store = open_analysis_cache(**shot, cache_, warnings);
    if (!store) return;
    propagated_.put({*shot, *store, asked.document, asked.project});
    ShotPlan plan = (*shot)->plan;
    plan.frames = (*shot)->plate->frames();
    const PassContext context{*(*shot)->source, plan, cancel, [&](int, double) { ++changes_; },
                              nullptr};
    (void)propagate_mattes_at(context, **store, asked.frame);
    (void)propagate_mattes(context, **store);
    ++changes_;
}

std::vector<int> MattePropagator::reached(const WantedMatte& wanted) const {
    const auto propagated = propagated_.get();
    if (!propagated || propagated->document != document_.load()) return {};
    return reached_in(propagated->asked, *propagated->shot, *propagated->store, wanted);
}

Expected<Matte> MattePropagator::matte(const WantedMatte& wanted) const {
    const auto propagated = propagated_.get();
    if (propagated && propagated->document == document_.load())
        return matte_in(propagated->asked, *propagated->shot, *propagated->store, wanted);
    return fail(ErrorCode::kMissingFrames, "The matte has not been propagated to frame " +
                                               std::to_string(wanted.frame) + " yet.");
}

}  // namespace weft
