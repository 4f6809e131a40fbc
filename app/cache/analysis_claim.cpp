#include "app/cache/analysis_claim.h"

#include <algorithm>
#include <thread>

#include "engine/core/stopwatch.h"
#include "engine/pipeline/analyse.h"

namespace weft {

AnalysisClaim claim_analysis(const AnalysisCache& cache, std::chrono::milliseconds patience,
                             const CancelToken& cancel, const std::function<bool()>& enough) {
    constexpr auto kPause = std::chrono::milliseconds(400);
    auto changed = cache.last_change();
    auto changed_at = Clock::now();
    while (!enough() && !cancel.cancelled()) {
        if (auto claim = cache.try_claim()) return std::move(*claim);
        if (const auto now = cache.last_change(); now != changed) {
            changed = now;
            changed_at = Clock::now();
        }
        if (Clock::now() - changed_at > patience) break;
        std::this_thread::sleep_for(kPause);
    }
    return {};
}

AnalysisClaim claim_analysis(const AnalysisCache& cache, const ShotPlan& plan,
                             std::chrono::milliseconds patience, const CancelToken& cancel,
                             const ProgressFn& progress) {
    std::int64_t total = -1, done = 0;
    return claim_analysis(cache, patience, cancel, [&] {
        const std::int64_t left = count_analysis_steps(plan, cache);
        if (total < 0) {
            total = left;
        } else if (progress) {
            done = std::max(done, total - left);
            progress({WorkStage::kWait, done, total, 0, 0});
        }
        return left == 0;
    });
}

}  // namespace weft
