#include "app/cache/analysis_claim.h"

#include <thread>

#include "engine/core/stopwatch.h"

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

}  // namespace weft
