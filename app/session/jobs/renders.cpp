#include "app/session/jobs/renders.h"

#include <filesystem>
#include <utility>

#include "app/base/render_speed.h"
#include "app/project/codec/project_file.h"
#include "app/project/validate.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

}  // namespace

Renders::Renders(Uses uses)
    : use_(std::move(uses)), jobs_(use_.program, (fs::path(use_.state_folder) / "jobs").string()) {}

void Renders::submit(const SubmitJob& action) {
    const Document& document = use_.document;
    if (!document.is_open() || !use_.plate.reader()) {
        use_.notices.add(NoticeKind::kWarning, "Open a plate before rendering.");
        return;
    }
    if (const auto issues = validate(document.project()); has_errors(issues)) {
        use_.notices.add(NoticeKind::kError, issues.front().text());
        return;
    }
    use_.end_stroke();
    Project project = resolve_paths(document.committed(), document.folder());
    if (!document.path().empty()) project.name = fs::path(document.path()).stem().string();
    auto request =
        render_request(action, std::move(project), use_.plate.reader()->frames(), project_file());
    if (!request) {
        use_.notices.add(NoticeKind::kError, request.error().text());
        return;
    }
    if (!use_.trust.may_render_to(request->project)) return;
    use_.tasks.start([this, request = std::move(*request)]() -> DocumentTasks::Finish {
        // Painted mattes must be on disk before the renderer reads them.
        use_.shelf.flush();
        const auto id = jobs_.submit(request);
        return [this, request, id] {
            if (!id) {
                use_.notices.add(NoticeKind::kError, id.error().text());
                return;
            }
            use_.notices.add(
                NoticeKind::kInfo,
                "Rendering " + std::to_string(request.frames.size()) + " frames to " +
                    fs::path(request.project.output.path).parent_path().filename().string() + ".");
        };
    });
}

std::string Renders::project_file() const {
    const std::string& path = use_.document.path();
    return path.empty() ? path : fs::absolute(path).lexically_normal().string();
}

void Renders::watch() {
    const Document& document = use_.document;
    const std::string plate =
        document.is_open() ? resolve_path(document.folder(), document.project().plate.path) : "";
    for (const JobDesk::Ended& job : jobs_.poll(project_file(), plate)) {
        if (job.failed)
            use_.notices.add(NoticeKind::kError, "Render failed. " + job.error);
        else
            use_.notices.add(NoticeKind::kGood, "Rendered: " + job.label + ".");
    }
    for (const JobDesk::Timed& job : jobs_.take_timed())
        use_.settings.render_speed =
            calibrated_speed(use_.settings.render_speed, job.estimated_s, job.took_s);
}

}  // namespace weft
