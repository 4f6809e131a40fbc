#pragma once
// One analysis at a time of what several processes need, such as the editor and its render: the
// others take what it leaves in the cache.

#include <chrono>
#include <functional>
#include <vector>

#include "app/cache/analysis_cache.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"

namespace weft {

/// How long one that is neither paused nor hanging may leave nothing new, in a render and in the
/// editor, where somebody is waiting.
inline constexpr std::chrono::milliseconds kRenderPatience{60'000}, kEditorPatience{15'000};

/// Waits until nobody else analyses the same regions, and keeps others from it until the result is
/// destroyed. Gives up waiting, without keeping anybody from it, if `enough` says that nothing is
/// left to be done (called once before, and several times a second while waiting), if nothing new
/// has been stored for `patience`, or on cancelling: then the same is at worst done twice.
[[nodiscard]] AnalysisClaim claim_analysis(const AnalysisCache& cache,
                                           std::chrono::milliseconds patience,
                                           const CancelToken& cancel,
                                           const std::function<bool()>& enough);

/// The same for the whole analysis of a plan; `progress` is told how far another one is with it, as
/// the stage "wait".
[[nodiscard]] AnalysisClaim claim_analysis(const AnalysisCache& cache, const ShotPlan& plan,
                                           std::chrono::milliseconds patience,
                                           const CancelToken& cancel, const ProgressFn& progress);

}  // namespace weft
