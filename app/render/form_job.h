#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/render/form_report.h"
#include "app/render/render_job.h"
#include "engine/core/surface_form.h"

namespace weft {

/// What `weft form` prints.
struct FormJobResult {
    std::vector<FormReport> forms;  ///< One per enabled region, lowest layer first.
    std::vector<std::string> notes, warnings;
};

/// Finds the form of every enabled region, as a render of the project would, and renders nothing.
/// Follows surfaces on the frames between the reference frame and those that show the form only,
/// without light, grain or shutter; textures and the output are not read. What is found is cached
/// for the render. Sets the process's thread count. Errors: those of opening the shot, of the
/// passes and of the drawing; Usage without a region; an input that changed meanwhile;
/// cancellation.
[[nodiscard]] Expected<FormJobResult> run_form_job(const JobSpec& spec, const CancelToken& cancel,
                                                   const ProgressFn& progress);

/// The form of the first region as a render of the project lays it; null: flat. As run_form_job()
/// otherwise.
[[nodiscard]] Expected<std::shared_ptr<const SurfaceForm>> find_laid_form(
    const JobSpec& spec, const CancelToken& cancel, std::vector<std::string>& warnings);

}  // namespace weft
