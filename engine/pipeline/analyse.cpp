#include "engine/pipeline/analyse.h"

#include <future>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/work_thread.h"
#include "engine/pipeline/focus_pass.h"
#include "engine/pipeline/form_pass.h"
#include "engine/pipeline/gloss_pass.h"
#include "engine/pipeline/matte_feed.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/surface_pass.h"

namespace weft {
namespace {

// Ends a feed whatever happens, an exception too.
struct Making {
    MatteFeed& feed;
    Status made = fail(ErrorCode::kRenderFailed, "The mattes were not made.");
    ~Making() { feed.end(std::move(made)); }
};
struct Taking {
    MatteFeed& feed;
    Status done = fail(ErrorCode::kRenderFailed, "The surfaces were not followed.");
    ~Taking() { feed.release(!done.has_value()); }
};

// Both walks are mostly one thread's work, so they go side by side: a surface is followed as soon
// as there is its matte.
Status follow_beside_mattes(const PassContext& shared, AnalysisStore& store) {
    PassContext context = shared;
    context.motions = std::make_shared<RecentMotions>();
    MatteFeed feed(store);
    WorkThread maker;
    std::future<void> made = maker.run([&] {
        Making making{feed};
        making.made = propagate_mattes(context, feed.maker());
    });
    Status followed;
    {
        Taking taking{feed};
        followed = taking.done = follow_surfaces(context, feed.taker());
    }
    made.get();
    WEFT_CHECK_OK(feed.made());
    return followed;
}

Status make_mattes_and_tracks(const PassContext& context, AnalysisStore& store) {
    const bool beside = thread_count() > 1 && !context.plan.spare_memory &&
                        count_matte_steps(context.plan, store) > 0 &&
                        count_surface_steps(context.plan, store) > 0;
    if (beside) return follow_beside_mattes(context, store);
    WEFT_CHECK_OK(propagate_mattes(context, store));
    return follow_surfaces(context, store);
}

}  // namespace

std::int64_t count_analysis_steps(const ShotPlan& plan, const AnalysisStore& store) {
    return count_matte_steps(plan, store) + count_surface_steps(plan, store) +
           count_form_steps(plan, store) + count_gloss_steps(plan, store) +
           count_focus_steps(plan, store);
}

Status analyse_shot(const ShotSource& source, const ShotPlan& plan, AnalysisStore& store,
                    const CancelToken& cancel, const ProgressFn& progress, const Backend* backend) {
    ProgressEvent event{WorkStage::kAnalyse, 0, count_analysis_steps(plan, store), 0, 0};
    std::mutex stepping;
    const PassContext context{source, plan, cancel,
                              [&](int frame, double seconds) {
                                  const std::lock_guard lock(stepping);
                                  ++event.done;
                                  event.frame = frame;
                                  event.seconds = seconds;
                                  if (progress) progress(event);
                              },
                              backend};
    WEFT_CHECK_OK(make_mattes_and_tracks(context, store));
    WEFT_CHECK_OK(find_forms(context, store));
    WEFT_CHECK_OK(find_still_surfaces(context, store));
    return read_focus(context, store);
}

}  // namespace weft
