#include "app/session/child_jobs.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
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
#include "app/project/codec/project_file.h"
#include "engine/core/frame_range.h"
#include "engine/core/input_file.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

extern char** environ;

namespace weft {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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

std::string last_line(const std::string& path) {
    std::istringstream file(tail_of(path, kTail_bytes));
    std::string line, last;
    while (std::getline(file, line)) {
        if (!line.empty() && line.find("warning:") == std::string::npos &&
            line.find("passed over") == std::string::npos)
            last = line;
    }
    constexpr std::string_view kPrefix = "weft: ";
    return last.starts_with(kPrefix) ? last.substr(kPrefix.size()) : last;
}

}  // namespace

struct ChildJobs::Job {
    JobView view;
    RenderRequest request;
    std::string snapshot;
    bool skip_existing = false;
    pid_t pid = -1;
    bool cancelled = false;
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

namespace {

// Progress goes to a file, not to a pipe, so that the job continues when the editor is closed.
pid_t spawn(const std::vector<std::string>& arguments, const std::string& progress,
            const std::string& log) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, progress.c_str(), kNew, 0644);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), kNew, 0644);
    // Its own process group, so that an interrupt in the editor's terminal does not stop it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t pid = -1;
    if (posix_spawn(&pid, argv[0], &actions, &attributes, argv.data(), environ) != 0) pid = -1;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return pid;
}

// Calls `line` for every line of the child's progress until it ends; returns its exit status.
template <class F>
int follow(pid_t pid, const std::string& path, F&& line) {
    std::optional<InputFile> file;
    std::string pending;
    std::uint64_t offset = 0;
    for (int status = 0;;) {
        const bool over = waitpid(pid, &status, WNOHANG) == pid;
        if (!file) {
            if (auto opened = InputFile::open(path)) file = std::move(*opened);
        }
        char buffer[4096];
        while (file) {
            const std::size_t got = file->read_at(offset, buffer, sizeof buffer).value_or(0);
            if (got == 0) break;
            pending.append(buffer, got);
            offset += got;
        }
        for (std::size_t end = pending.find('\n'); end != std::string::npos;
             end = pending.find('\n')) {
            line(pending.substr(0, end));
            pending.erase(0, end + 1);
        }
        if (over) return status;
        std::this_thread::sleep_for(std::chrono::milliseconds(80));
    }
}

}  // namespace

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
    auto stage_start = start;
    std::string stage;
    const std::string progress = job->snapshot + ".progress";
    const pid_t child = spawn(arguments, progress, job->view.log_path);
    {
        const std::lock_guard lock(shared->mutex);
        job->pid = child;
        if (job->cancelled && child > 0) ::kill(child, SIGTERM);
    }
    int status = -1;
    if (child > 0) {
        status = follow(child, progress, [&](const std::string& text) {
            const auto event = nlohmann::json::parse(text, nullptr, false);
            if (!event.is_object()) return;
            const auto now = Clock::now();
            const std::string name = event.value("stage", "");
            if (name != stage) {
                stage = name;
                stage_start = now;
            }
            PicturePtr thumbnail;
            const int frame = event.value("frame", 0);
            const bool rendered = stage == "render";
            if (rendered && pattern && now - last_thumbnail > std::chrono::milliseconds(800)) {
                thumbnail = thumbnail_of(pattern->path_for(frame));
                last_thumbnail = now;
            }
            const std::lock_guard lock(shared->mutex);
            JobView& view = job->view;
            view.stage = stage;
            view.done = event.value("done", 0);
            view.total = event.value("total", 0);
            view.elapsed_s = std::chrono::duration<double>(now - start).count();
            const double in_stage = std::chrono::duration<double>(now - stage_start).count();
            if (rendered) {
                view.newest_frame = frame;
                view.has_frame = true;
                if (in_stage > 0.5) view.frames_per_minute = 60.0 * view.done / in_stage;
            }
            view.left_s = view.done > 1 ? in_stage / view.done * (view.total - view.done) : 0;
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
        view.elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
        view.left_s = 0;
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
    return tail_of(path, most_bytes);
}

}  // namespace weft
