#include "app/jobs/child_jobs.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/base/background.h"
#include "app/base/detached_process.h"
#include "app/base/job_messages.h"
#include "app/project/codec/project_file.h"
#include "engine/core/frame_range.h"
#include "engine/core/input_file.h"
#include "engine/core/stopwatch.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbnailPx = 192;

bool ended(JobState state) {
    return state == JobState::kDone || state == JobState::kCancelled || state == JobState::kFailed;
}

PicturePtr thumbnail_of(const std::string& path) {
    const auto image = read_image(path);
    if (!image) return nullptr;
    const PicturePtr whole =
        make_picture(image->rgb, image->depth == PixelDepth::kU8, nullptr, nullptr);
    return make_picture(shrink(*whole, kThumbnailPx));
}

constexpr std::size_t kTail_bytes = std::size_t{64} << 10;

// Reads the end of a file that another process may still write; empty if it cannot be read.
std::string tail_of(const std::string& path, std::size_t most_bytes) {
    const auto file = InputFile::open(path);
    if (!file) return {};
    std::string text(std::min<std::size_t>(file->bytes(), most_bytes), '\0');
    const auto got = file->read_at(file->bytes() - text.size(), text.data(), text.size());
    text.resize(got.value_or(0));
    return text;
}

// The rate, the time left and the time elapsed agree: all leave pauses out, and the rate counts
// what was done in this stage, without the frames that were there before.
class StageRate {
  public:
    void note(JobView& view, const std::string& stage, double elapsed_s) {
        if (stage != view.stage) {
            start_s_ = view.elapsed_s;
            before_ = std::max(0, view.done - 1);
        }
        view.stage = stage;
        view.elapsed_s = elapsed_s;
        const double in_stage_s = elapsed_s - start_s_;
        const int done = view.done - before_;
        constexpr double kLeast_s = 0.5;
        if (stage == "render" && in_stage_s > kLeast_s)
            view.frames_per_minute = 60.0 * done / in_stage_s;
        view.left_s = done > 1 ? in_stage_s / done * (view.total - view.done) : 0;
    }

  private:
    double start_s_ = 0;
    int before_ = 0;
};

std::string last_line(const std::string& path) {
    std::istringstream file(tail_of(path, kTail_bytes));
    std::string line, last;
    while (std::getline(file, line)) {
        if (!line.empty() && line.find("warning:") == std::string::npos &&
            line.find("passed over") == std::string::npos)
            last = line;
    }
    constexpr std::string_view kPrefix = "weft: ";
    return with_setting_names(last.starts_with(kPrefix) ? last.substr(kPrefix.size()) : last);
}

}  // namespace

struct ChildJobs::Job {
    JobView view;
    RenderRequest request;
    std::string snapshot;
    bool skip_existing = false;
    pid_t pid = -1;
    bool cancelled = false;
    double paused_s = 0;  // all pauses that have ended
    Clock::time_point paused_at;
};

struct ChildJobs::Shared {
    std::string program, folder;
    mutable std::mutex mutex;
    std::vector<std::shared_ptr<Job>> jobs;
    std::atomic<std::uint64_t> changes = 0;
    int last_id = 0;
    bool closing = false;
};

ChildJobs::ChildJobs(std::string program, std::string folder)
    : shared_(std::make_shared<Shared>()) {
    shared_->program = std::move(program);
    shared_->folder = std::move(folder);
}

ChildJobs::~ChildJobs() {
    const std::lock_guard lock(shared_->mutex);
    shared_->closing = true;
}

Expected<int> ChildJobs::submit(const RenderRequest& request) {
    std::error_code error;
    fs::create_directories(shared_->folder, error);
    auto job = std::make_shared<Job>();
    job->request = request;
    job->request.project.settings.frames = format_frame_list(request.frames);
    {
        const std::lock_guard lock(shared_->mutex);
        job->view.id = ++shared_->last_id;
    }
    const std::string stem = (fs::path(shared_->folder) / ("job-" + std::to_string(getpid()) + "-" +
                                                           std::to_string(job->view.id)))
                                 .string();
    job->snapshot = stem + ".weft";
    WEFT_CHECK_OK(save_project(job->snapshot, job->request.project, WriteRule::own()));
    job->skip_existing = request.skip_existing;
    job->view.label = request.label;
    job->view.estimated_s = request.estimated_s;
    job->view.output = request.project.output.path;
    job->view.plate = request.project.plate.path;
    job->view.movie = request.project.output.movie;
    job->view.total = static_cast<int>(request.frames.size());
    job->view.log_path = stem + ".log";
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->jobs.push_back(job);
        ++shared_->changes;
    }
    start_next(shared_);
    return job->view.id;
}

void ChildJobs::start_next(const std::shared_ptr<Shared>& shared) {
    std::shared_ptr<Job> next;
    {
        const std::lock_guard lock(shared->mutex);
        for (const auto& job : shared->jobs) {
            if (job->view.state == JobState::kRunning || job->view.state == JobState::kPaused)
                return;
            if (!next && job->view.state == JobState::kWaiting) next = job;
        }
        if (!next || shared->closing) return;
        next->view.state = JobState::kRunning;
        ++shared->changes;
    }
    std::thread([shared, next] { run(shared, next); }).detach();
}

void ChildJobs::run(const std::shared_ptr<Shared>& shared, const std::shared_ptr<Job>& job) {
    lower_thread_priority();
    std::vector<std::string> arguments{shared->program, "render", job->snapshot, "--progress",
                                       "json", "--backend", job->request.backend,
                                       // The snapshot is outside the project's folder; the session
                                       // has checked its outputs.
                                       "--trust"};
    if (job->skip_existing) {
        arguments.emplace_back("--skip-existing");
    } else if (job->request.overwrite) {
        arguments.emplace_back("--overwrite");
    }
    const auto pattern = SequencePattern::parse(job->request.project.output.path);
    const auto start = Clock::now();
    auto last_thumbnail = start - std::chrono::hours(1);
    StageRate rate;
    const std::string progress = job->snapshot + ".progress";
    // The job names settings by key, so that its messages speak of the editor's labels.
    const pid_t child =
        start_detached(arguments, kSettingNamesVariable, progress, job->view.log_path);
    {
        const std::lock_guard lock(shared->mutex);
        job->pid = child;
        if (job->cancelled && child > 0) ::kill(child, SIGTERM);
    }
    int status = -1;
    if (child > 0) {
        status = follow_detached(child, progress, [&](const std::string& text) {
            const auto event = nlohmann::json::parse(text, nullptr, false);
            if (!event.is_object()) return;
            const auto now = Clock::now();
            PicturePtr thumbnail;
            const int frame = event.value("frame", 0);
            const std::string stage = event.value("stage", "");
            const bool rendered = stage == "render";
            if (rendered && pattern && now - last_thumbnail > std::chrono::milliseconds(800)) {
                thumbnail = thumbnail_of(pattern->path_for(frame));
                last_thumbnail = now;
            }
            const std::lock_guard lock(shared->mutex);
            JobView& view = job->view;
            if (rendered) {
                view.newest_frame = frame;
                view.has_frame = true;
            }
            view.done = event.value("done", 0);
            view.total = event.value("total", 0);
            rate.note(view, stage,
                      std::chrono::duration<double>(now - start).count() - job->paused_s);
            if (thumbnail) view.thumbnail = thumbnail;
            ++shared->changes;
        });
    }
    // Files are read before taking the lock, because the window reads the jobs in every frame.
    const bool good = child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    const JobView so_far = [&] {
        const std::lock_guard lock(shared->mutex);
        return job->view;
    }();
    std::string error = child > 0 ? last_line(so_far.log_path)
                                  : "The renderer could not be started: " + shared->program;
    if (error.empty()) error = "The renderer ended unexpectedly. Its log may say more; try again.";
    PicturePtr last;
    if (so_far.has_frame && pattern && good)
        last = thumbnail_of(pattern->path_for(so_far.newest_frame));
    {
        const std::lock_guard lock(shared->mutex);
        JobView& view = job->view;
        job->pid = -1;
        view.elapsed_s = seconds_since(start) - job->paused_s;
        view.left_s = 0;
        // Of a finished job the rate is that of the whole time, as the line beside it says.
        if (good && view.elapsed_s > 0) view.frames_per_minute = 60.0 * view.total / view.elapsed_s;
        if (job->cancelled) {
            view.state = JobState::kCancelled;
        } else if (good) {
            view.state = JobState::kDone;
            view.done = view.total;
        } else {
            view.state = JobState::kFailed;
            view.error = std::move(error);
        }
        if (last) view.thumbnail = last;
        ++shared->changes;
    }
    start_next(shared);
}

void ChildJobs::cancel(int id) {
    const std::lock_guard lock(shared_->mutex);
    for (const auto& job : shared_->jobs) {
        if (job->view.id != id || ended(job->view.state)) continue;
        job->cancelled = true;
        if (job->pid > 0) {
            ::kill(job->pid, SIGCONT);
            ::kill(job->pid, SIGTERM);
        } else if (job->view.state == JobState::kWaiting) {
            job->view.state = JobState::kCancelled;
        }
        ++shared_->changes;
    }
}

void ChildJobs::pause(int id) {
    const std::lock_guard lock(shared_->mutex);
    for (const auto& job : shared_->jobs) {
        if (job->view.id != id || job->view.state != JobState::kRunning || job->pid <= 0) continue;
        ::kill(job->pid, SIGSTOP);
        job->view.state = JobState::kPaused;
        job->paused_at = Clock::now();
        job->view.estimated_s = 0;
        ++shared_->changes;
    }
}

void ChildJobs::resume(int id) {
    const std::lock_guard lock(shared_->mutex);
    for (const auto& job : shared_->jobs) {
        if (job->view.id != id || job->view.state != JobState::kPaused || job->pid <= 0) continue;
        ::kill(job->pid, SIGCONT);
        job->view.state = JobState::kRunning;
        job->paused_s += seconds_since(job->paused_at);
        ++shared_->changes;
    }
}

void ChildJobs::retry(int id) {
    {
        const std::lock_guard lock(shared_->mutex);
        for (const auto& job : shared_->jobs) {
            if (job->view.id != id || !ended(job->view.state)) continue;
            job->cancelled = false;
            job->skip_existing = true;
            job->view.state = JobState::kWaiting;
            job->view.error.clear();
            job->view.done = 0;
            job->view.elapsed_s = job->view.left_s = job->view.frames_per_minute = 0;
            job->paused_s = 0;
            job->view.estimated_s = 0;
            job->view.stage.clear();
            ++shared_->changes;
        }
    }
    start_next(shared_);
}

void ChildJobs::remove(int id) {
    const std::lock_guard lock(shared_->mutex);
    std::erase_if(shared_->jobs,
                  [&](const auto& job) { return job->view.id == id && ended(job->view.state); });
    ++shared_->changes;
}

void ChildJobs::cancel_all() {
    for (const JobView& view : views())
        cancel(view.id);
}

std::vector<JobView> ChildJobs::views() const {
    const std::lock_guard lock(shared_->mutex);
    std::vector<JobView> out;
    for (const auto& job : shared_->jobs)
        out.push_back(job->view);
    return out;
}

bool ChildJobs::busy() const {
    const std::lock_guard lock(shared_->mutex);
    return std::any_of(shared_->jobs.begin(), shared_->jobs.end(),
                       [](const auto& job) { return !ended(job->view.state); });
}

std::uint64_t ChildJobs::changes() const {
    return shared_->changes.load();
}

std::string ChildJobs::log_tail(int id, std::size_t most_bytes) const {
    std::string path;
    {
        const std::lock_guard lock(shared_->mutex);
        for (const auto& job : shared_->jobs)
            if (job->view.id == id) path = job->view.log_path;
    }
    return with_setting_names(tail_of(path, most_bytes));
}

}  // namespace weft
