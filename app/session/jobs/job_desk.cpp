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
                                       const std::vector<int>& all,
                                       const std::string& project_file) {
    RenderRequest request;
    request.project_file = project_file;
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
        case JobCommand::kEarlier:
            return children_.move(action.id, -1);
        case JobCommand::kLater:
            return children_.move(action.id, 1);
    }
}

void JobDesk::note_times() {
    for (const JobView& job : jobs_) {
        if (job.state != JobState::kDone || job.estimated_s <= 0) continue;
        // The record follows a moment later.
        if (!compared_.insert(job.id).second) continue;
        timed_.push_back({job.estimated_s, job.elapsed_s});
        children_.forget_estimate(job.id);
    }
}

std::vector<JobDesk::Ended> JobDesk::poll(const std::string& project, const std::string& plate) {
    jobs_ = children_.views();
    note_times();
    // Those of other shots are in the way while they are not over; then they are not this one's.
    std::erase_if(jobs_, [&](const JobView& job) {
        const bool of_shot =
            (!project.empty() && job.project == project) || (!plate.empty() && job.plate == plate);
        return !job.mine && !of_shot && is_over(job.state);
    });
    std::vector<Ended> ended;
    for (const JobView& job : jobs_) {
        const auto [known, is_new] = known_.emplace(job.id, job.state);
        if (!is_new && known->second == job.state) continue;
        known->second = job.state;
        if (job.earlier && is_new) continue;
        if (job.state == JobState::kDone || job.state == JobState::kFailed)
            ended.push_back({job.state == JobState::kFailed, job.label, job.error});
    }
    return ended;
}

}  // namespace weft
