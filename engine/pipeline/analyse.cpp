#include "engine/pipeline/analyse.h"

#include "engine/pipeline/focus_pass.h"
#include "engine/pipeline/form_pass.h"
#include "engine/pipeline/gloss_pass.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/surface_pass.h"

namespace weft {

std::int64_t count_analysis_steps(const ShotPlan& plan, const AnalysisStore& store) {
    return count_matte_steps(plan, store) + count_surface_steps(plan, store) +
           count_form_steps(plan, store) + count_gloss_steps(plan, store) +
           count_focus_steps(plan, store);
}

Status analyse_shot(const ShotSource& source, const ShotPlan& plan, AnalysisStore& store,
                    const CancelToken& cancel, const ProgressFn& progress, const Backend* backend) {
    ProgressEvent event{WorkStage::kAnalyse, 0, count_analysis_steps(plan, store), 0, 0};
    const PassContext context{source, plan, cancel,
                              [&](int frame, double seconds) {
                                  ++event.done;
                                  event.frame = frame;
                                  event.seconds = seconds;
                                  if (progress) progress(event);
                              },
                              backend};
    WEFT_CHECK_OK(propagate_mattes(context, store));
    WEFT_CHECK_OK(follow_surfaces(context, store));
    WEFT_CHECK_OK(find_forms(context, store));
    WEFT_CHECK_OK(find_still_surfaces(context, store));
    return read_focus(context, store);
}

}  // namespace weft
