#include "app/cache/analysis_claim.h"

#include <algorithm>
#include <limits>
#include <thread>

#include "engine/core/stopwatch.h"
#include "engine/pipeline/analyse.h"

namespace weft {

AnalysisClaim claim_analysis(const AnalysisCache& cache, std::chrono::milliseconds patience,
                             const CancelToken& cancel, const std::function<std::int64_t()>& left) {
    constexpr auto kPause = std::chrono::milliseconds(400);
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    auto since = Clock::now();
    while (!cancel.cancelled()) {
        const std::int64_t now = left();
        if (now == 0) break;
        if (auto claim = cache.try_claim()) return std::move(*claim);
        if (now < least) {
            least = now;
            since = Clock::now();
        }
        if (Clock::now() - since > patience) break;
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
        return left;
    });
}

}  // namespace weft
