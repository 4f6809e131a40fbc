#include "app/jobs/job_worker.h"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "app/base/background.h"
#include "app/base/detached_process.h"
#include "app/base/job_messages.h"
#include "app/jobs/job_answer.h"
#include "app/project/codec/project_file.h"
#include "engine/core/frame_range.h"
#include "engine/media/atomic_file.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbnailPx = 192;
constexpr auto kFollow = std::chrono::milliseconds(80), kIdle = std::chrono::milliseconds(500),
               kReadAnew = std::chrono::milliseconds(1000),
               kPictures = std::chrono::milliseconds(800);
// A parent that is alive asks for its child's status sooner.
constexpr auto kNobodyAsks = std::chrono::seconds(2);
// Of jobs that were over when the window was opened.
constexpr std::size_t kMostPictures = 12;

bool active(JobState state) {
    return state == JobState::kRunning || state == JobState::kPaused;
}

PicturePtr thumbnail_of(const std::string& path) {
    const auto image = read_image(path);
    if (!image) return nullptr;
    const PicturePtr whole =
        make_picture(image->rgb, image->depth == PixelDepth::kU8, nullptr, nullptr);
    return make_picture(shrink(*whole, kThumbnailPx));
}

double elapsed_of(const JobRecord& record) {
    if (is_over(record.state) || record.begun_s <= 0) return record.elapsed_s;
    const double until = record.state == JobState::kPaused ? record.paused_at_s : unix_time_s();
    return std::max(0.0, until - record.begun_s - record.paused_s);
}

std::string last_line(const std::string& path) {
    const auto log = read_file(path, {});
    std::istringstream lines(log.value_or(std::string()));
    std::string line, last;
    while (std::getline(lines, line)) {
        if (!line.empty() && line.find("warning:") == std::string::npos &&
            line.find("passed over") == std::string::npos)
            last = line;
    }
    constexpr std::string_view kPrefix = "weft: ";
    return last.starts_with(kPrefix) ? last.substr(kPrefix.size()) : last;
}

// What went wrong, in this program's words, and what it is about.
void explain(JobRecord& record, const JobFiles& files, const std::optional<JobAnswer>& answer) {
    JobAnswer said = answer.value_or(JobAnswer{});
    if (said.message.empty()) said.message = last_line(files.log);
    if (const auto project = load_project(files.snapshot)) {
        const auto frames = parse_frame_list(project->settings.frames);
        record.problem = problem_of(said, *project, frames.value_or(std::vector<int>()));
    }
    record.error = with_setting_names(said.message);
    if (record.error.empty())
        record.error = "The renderer ended unexpectedly. Its log may say more; try again.";
}

}  // namespace

void show_record(const JobRecord& record, const JobFiles& files, JobView& view) {
    view.state = record.state;
    view.label = record.label;
    view.output = record.output;
    view.movie = record.movie;
    view.plate = record.plate;
    view.project = record.project;
    view.error = record.error;
    view.problem = record.problem;
    view.log_path = files.log;
    view.estimated_s = record.estimated_s;
    if (record.state == JobState::kWaiting) {
        view.stage.reset();
        view.done = 0;
        view.total = record.total;
        view.elapsed_s = view.left_s = view.frames_per_minute = 0;
    }
    if (!is_over(record.state)) return;
    view.left_s = 0;
    view.elapsed_s = record.elapsed_s;
    view.has_frame = record.has_frame;
    view.newest_frame = record.newest_frame;
    if (record.state != JobState::kDone) return;
    view.done = view.total = record.total;
    // Of a finished job the rate is that of the whole time, as the line beside it says.
    if (view.elapsed_s > 0) view.frames_per_minute = 60.0 * view.total / view.elapsed_s;
}

double unix_time_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

Expected<FileLock> lock_queue(const std::string& folder) {
    const std::string path = (fs::path(folder) / "queue.lock").string();
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::exists(path, error))
        WEFT_CHECK_OK(write_file_atomically(path, std::string_view(), WriteRule::own()));
    return FileLock::take(path, std::chrono::seconds(2));
}

std::vector<std::shared_ptr<KnownJob>> JobWorker::jobs() const {
    const std::lock_guard lock(shared_.mutex);
    return shared_.jobs;
}

void JobWorker::run() {
    lower_thread_priority();
    for (bool busy = true;;) {
        bool closing = false;
        {
            std::unique_lock lock(shared_.mutex);
            shared_.wake.wait_for(lock, busy ? kFollow : kIdle,
                                  [&] { return shared_.closing || !shared_.commands.empty(); });
            closing = shared_.closing;
        }
        carry_out();
        if (closing) return;
        read_folder();
        busy = follow_all() || start_next();
        picture_one();
    }
}

void JobWorker::carry_out() {
    std::deque<JobCommandFn> commands;
    {
        const std::lock_guard lock(shared_.mutex);
        commands.swap(shared_.commands);
    }
    if (commands.empty()) return;
    const auto queue = lock_queue(shared_.folder);
    if (!queue) {
        const std::lock_guard lock(shared_.mutex);
        shared_.commands.insert(shared_.commands.begin(), commands.begin(), commands.end());
        return;
    }
    const std::vector<JobRecord> before = read_jobs(shared_.folder);
    std::vector<JobRecord> after = before;
    for (const JobCommandFn& command : commands)
        command(after);
    for (std::size_t k = 0; k < after.size(); ++k) {
        if (after[k].name.empty())
            JobFiles(shared_.folder, before[k].name).remove();
        else if (!(after[k] == before[k]))
            static_cast<void>(write_job(shared_.folder, after[k]));
    }
    take(read_jobs(shared_.folder));
}

// A change within the folder's clock tick would be missed, so it is read now and then anyway.
void JobWorker::read_folder() {
    std::error_code error;
    const auto changed = fs::last_write_time(shared_.folder, error);
    const auto now = Clock::now();
    if (error || (folder_changed_ == changed && now - read_at_ < kReadAnew)) return;
    folder_changed_ = changed;
    read_at_ = now;
    take(read_jobs(shared_.folder));
}

std::shared_ptr<KnownJob> JobWorker::known(const JobRecord& record) {
    for (const auto& job : shared_.jobs)
        if (job->record.name == record.name) return job;
    auto job = std::make_shared<KnownJob>();
    job->view.id = ++shared_.last_id;
    job->view.mine = shared_.mine.contains(record.name);
    job->view.earlier = is_over(record.state) && !job->view.mine;
    return job;
}

void JobWorker::take(const std::vector<JobRecord>& records) {
    const std::lock_guard lock(shared_.mutex);
    std::vector<std::shared_ptr<KnownJob>> now;
    bool changed = records.size() != shared_.jobs.size();
    for (const JobRecord& record : records) {
        now.push_back(known(record));
        KnownJob& job = *now.back();
        changed |= now.size() > shared_.jobs.size() || shared_.jobs[now.size() - 1] != now.back();
        if (job.record == record) continue;
        changed = true;
        if (job.record.begun_s != record.begun_s) {
            job.progress.reset();
            job.ended_at.reset();
            job.view.has_frame = false;
        }
        job.record = record;
        show_record(record, JobFiles(shared_.folder, record.name), job.view);
    }
    shared_.jobs = std::move(now);
    if (changed) ++shared_.changes;
}

bool JobWorker::follow_all() {
    bool some = false;
    for (const auto& job : jobs()) {
        if (!active(job->record.state)) continue;
        follow(*job);
        some |= active(job->record.state);
    }
    return some;
}

void JobWorker::follow(KnownJob& job) {
    std::optional<bool> good;
    // Before its last lines are read.
    const bool over = has_ended(job, good);
    const double elapsed_s = elapsed_of(job.record);
    if (!job.progress)
        job.progress.emplace(JobFiles(shared_.folder, job.record.name).progress, job.child > 0);
    bool pictured = false;
    {
        const std::lock_guard lock(shared_.mutex);
        if (job.progress->read(job.view, elapsed_s)) ++shared_.changes;
        pictured = job.view.has_frame && job.view.stage == WorkStage::kRender;
    }
    if (pictured && Clock::now() - job.pictured_at > kPictures) picture(job);
    if (over) finish(job, good);
}

bool JobWorker::has_ended(KnownJob& job, std::optional<bool>& good) const {
    if (job.child > 0) {
        int status = 0;
        if (waitpid(job.child, &status, WNOHANG) != job.child) return false;
        job.child = -1;
        good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        return true;
    }
    const ProcessState state = state_of(job.record.process);
    if (state == ProcessState::kGone) return true;
    if (state != ProcessState::kEnded) return false;
    if (!job.ended_at) job.ended_at = Clock::now();
    return Clock::now() - *job.ended_at > kNobodyAsks;
}

void JobWorker::finish(KnownJob& job, std::optional<bool> good) {
    const auto queue = lock_queue(shared_.folder);
    const JobFiles files(shared_.folder, job.record.name);
    auto record = read_job(shared_.folder, job.record.name);
    if (!record) return;  // removed by hand: nothing to say any more
    // Another process may have said so, or begun it again.
    if (!active(record->state) || record->begun_s != job.record.begun_s) return read_folder();
    const auto answer = read_answer(files.answer);
    if (!good) good = answer && answer->exit_code == 0;
    record->elapsed_s = elapsed_of(*record);
    record->has_frame = job.view.has_frame;
    record->newest_frame = job.view.newest_frame;
    record->state = record->cancelled ? JobState::kCancelled
                    : *good           ? JobState::kDone
                                      : JobState::kFailed;
    if (record->state == JobState::kFailed) explain(*record, files, answer);
    if (record->state == JobState::kDone) picture(job);
    // Where the disk is full the job is over all the same, here.
    static_cast<void>(write_job(shared_.folder, *record));
    const std::lock_guard lock(shared_.mutex);
    job.record = *record;
    show_record(*record, files, job.view);
    ++shared_.changes;
}

bool JobWorker::start_next() {
    const auto waits = [](const JobRecord& job) { return job.state == JobState::kWaiting; };
    const auto some = jobs();
    if (std::none_of(some.begin(), some.end(), [&](const auto& job) { return waits(job->record); }))
        return false;
    const auto queue = lock_queue(shared_.folder);
    if (!queue) return true;
    std::vector<JobRecord> records = read_jobs(shared_.folder);
    const bool free = std::none_of(records.begin(), records.end(),
                                   [](const JobRecord& job) { return active(job.state); });
    const auto next = std::find_if(records.begin(), records.end(), waits);
    if (!free || next == records.end()) {
        take(records);
        return !free;
    }
    JobFiles(shared_.folder, next->name).remove_results();
    next->begun_s = unix_time_s();
    const pid_t child = start(*next);
    next->state = child > 0 ? JobState::kRunning : JobState::kFailed;
    next->process = child > 0 ? process_of(child) : JobProcess{};
    if (child <= 0) next->error = "The renderer could not be started: " + shared_.program;
    // A job that no record tells of would be begun a second time.
    if (!write_job(shared_.folder, *next) && child > 0) signal_to(next->process, SIGTERM);
    take(records);
    for (const auto& job : jobs())
        if (job->record.name == next->name) job->child = child;
    return true;
}

pid_t JobWorker::start(const JobRecord& record) const {
    const JobFiles files(shared_.folder, record.name);
    std::vector<std::string> arguments{
        shared_.program, "render", files.snapshot, "--progress", "json", "--backend",
        record.backend,
        // The snapshot is outside the project's folder; the session has checked its outputs.
        "--trust"};
    if (record.skip_existing) {
        arguments.emplace_back("--skip-existing");
    } else if (record.overwrite) {
        arguments.emplace_back("--overwrite");
    }
    // The job names settings by key, so that its messages speak of the editor's labels.
    return start_detached(
        arguments, {kSettingNamesVariable, std::string(kAnswerFileVariable) + "=" + files.answer},
        files.progress, files.log);
}

// Of the newest jobs that were over before, one at a time.
void JobWorker::picture_one() {
    std::vector<std::shared_ptr<KnownJob>> newest = jobs();
    std::reverse(newest.begin(), newest.end());
    newest.resize(std::min(newest.size(), kMostPictures));
    for (const auto& job : newest) {
        if (!is_over(job->record.state) || !job->view.has_frame || job->view.thumbnail ||
            job->thumbnail_tried)
            continue;
        job->thumbnail_tried = true;
        return picture(*job);
    }
}

// The file is read before taking the lock, because the window reads the jobs in every frame.
void JobWorker::picture(KnownJob& job) {
    job.pictured_at = Clock::now();
    const auto pattern = SequencePattern::parse(job.record.output);
    if (!pattern || !job.view.has_frame) return;
    PicturePtr picture = thumbnail_of(pattern->path_for(job.view.newest_frame));
    if (!picture) return;
    const std::lock_guard lock(shared_.mutex);
    job.view.thumbnail = std::move(picture);
    ++shared_.changes;
}

}  // namespace weft
