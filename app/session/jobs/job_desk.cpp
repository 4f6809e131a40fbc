#include "app/session/jobs/job_desk.h"

#include <filesystem>

#include "engine/core/frame_range.h"

namespace weft {
namespace {

std::string absolute_or_empty(const std::string& path) {
    return path.empty() ? std::string() : std::filesystem::absolute(path).string();
}

}  // namespace

Expected<RenderRequest> render_request(const SubmitJob& action, Project project,
                                       const std::vector<int>& all) {
    RenderRequest request;
    request.frames = all;
    if (!action.frames.empty()) {
        WEFT_TRY(frames, parse_frame_list(action.frames));
        request.frames = std::move(frames);
    }
    request.label = (project.name.empty() ? "Shot" : project.name) + ", frames " +
                    format_frame_list(request.frames);
    request.project = std::move(project);
    Output& output = request.project.output;
    output.path = absolute_or_empty(action.output);
    output.movie = absolute_or_empty(action.movie);
    output.layers = action.layers;
    output.layers_path = absolute_or_empty(action.layers_path);
    request.overwrite = action.overwrite;
    request.skip_existing = action.skip_existing;
    request.estimated_s = action.skip_existing ? 0 : action.estimated_s;
    return request;
}

JobDesk::JobDesk(std::string program, std::string folder)
    : children_(std::move(program), std::move(folder)) {}

Expected<int> JobDesk::submit(const RenderRequest& request) {
    return children_.submit(request);
}

void JobDesk::command(const CommandJob& action) {
    switch (action.command) {
        case JobCommand::kCancel:
            return children_.cancel(action.id);
        case JobCommand::kPause:
            return children_.pause(action.id);
        case JobCommand::kResume:
            return children_.resume(action.id);
        case JobCommand::kRetry:
            return children_.retry(action.id);
        case JobCommand::kRemove:
            return children_.remove(action.id);
    }
}

std::vector<JobDesk::Ended> JobDesk::poll() {
    jobs_ = children_.views();
    std::vector<Ended> ended;
    for (const JobView& job : jobs_) {
        JobState& known = known_[job.id];
        if (known == job.state) continue;
        known = job.state;
        if (job.state == JobState::kDone || job.state == JobState::kFailed)
            ended.push_back({job.state == JobState::kFailed, job.label, job.error});
    }
    return ended;
}

}  // namespace weft
