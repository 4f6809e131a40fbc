#pragma once
// One analysis at a time of what several processes need, such as the editor and its render: the
// others take what it leaves in the cache.

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "app/cache/analysis_cache.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"

namespace weft {

/// How long another one may store nothing that is needed, in a render and in the editor, where
/// somebody is waiting. It may be paused or hang, or do other frames or another quality first.
inline constexpr std::chrono::milliseconds kRenderPatience{30'000}, kEditorPatience{15'000};

/// Waits until nobody else analyses the same regions, and keeps others from it until the result is
/// destroyed. Gives up waiting, without keeping anybody from it, if nothing is `left` to be done
/// (the steps; called once before, and several times a second while waiting), if that has not
/// become less for `patience`, or on cancelling: then the same is at worst done twice.
[[nodiscard]] AnalysisClaim claim_analysis(const AnalysisCache& cache,
                                           std::chrono::milliseconds patience,
                                           const CancelToken& cancel,
                                           const std::function<std::int64_t()>& left);

/// The same for the whole analysis of a plan; `progress` is told how far another one is with it, as
/// the stage "wait".
[[nodiscard]] AnalysisClaim claim_analysis(const AnalysisCache& cache, const ShotPlan& plan,
                                           std::chrono::milliseconds patience,
                                           const CancelToken& cancel, const ProgressFn& progress);

}  // namespace weft
