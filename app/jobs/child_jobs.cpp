#include "app/jobs/child_jobs.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "app/base/job_messages.h"
#include "app/project/codec/project_file.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

// Older ones of the jobs that are over are forgotten, so that reading the queue stays cheap.
constexpr std::size_t kMostOver = 200;

// Reads the end of a file that another process may still write; empty if it cannot be read.
std::string tail_of(const std::string& path, std::size_t most_bytes) {
    const auto file = InputFile::open(path);
    if (!file) return {};
    std::string text(std::min<std::size_t>(file->bytes(), most_bytes), '\0');
    const auto got = file->read_at(file->bytes() - text.size(), text.data(), text.size());
    text.resize(got.value_or(0));
    return text;
}

// Not those of other queues of this process, nor of an earlier process of its number.
std::string new_name() {
    static std::atomic<int> count = 0;
    return "job-" + std::to_string(getpid()) + "-" +
           std::to_string(static_cast<std::int64_t>(unix_time_s() * 1000)) + "-" +
           std::to_string(++count);
}

void forget_old(const std::string& folder, const std::vector<JobRecord>& records) {
    auto left = static_cast<std::size_t>(
        std::count_if(records.begin(), records.end(),
                      [](const JobRecord& record) { return is_over(record.state); }));
    for (const JobRecord& record : records) {
        if (left <= kMostOver) return;
        if (!is_over(record.state)) continue;
        JobFiles(folder, record.name).remove();
        --left;
    }
}

JobRecord record_of(const RenderRequest& request) {
    JobRecord out;
    out.name = new_name();
    out.label = request.label;
    out.project = request.project_file;
    out.plate = request.project.plate.path;
    out.output = request.project.output.path;
    out.movie = request.project.output.movie;
    out.backend = request.backend;
    out.overwrite = request.overwrite;
    out.skip_existing = request.skip_existing;
    out.total = static_cast<int>(request.frames.size());
    out.estimated_s = request.estimated_s;
    return out;
}

void cancel_record(JobRecord& record) {
    if (is_over(record.state)) return;
    record.cancelled = true;
    if (record.state == JobState::kWaiting) record.state = JobState::kCancelled;
    signal_to(record.process, SIGCONT);
    signal_to(record.process, SIGTERM);
}

void retry_record(JobRecord& record) {
    if (!is_over(record.state)) return;
    record.state = JobState::kWaiting;
    record.cancelled = false;
    record.skip_existing = true;
    record.process = {};
    record.begun_s = record.paused_at_s = record.paused_s = record.elapsed_s = 0;
    record.estimated_s = 0;
    record.has_frame = false;
    record.error.clear();
    record.problem = {};
}

}  // namespace

ChildJobs::ChildJobs(std::string program, std::string folder) {
    shared_.program = std::move(program);
    shared_.folder = std::move(folder);
    thread_ = std::thread([this] { JobWorker(shared_).run(); });
}

ChildJobs::~ChildJobs() {
    {
        const std::lock_guard lock(shared_.mutex);
        shared_.closing = true;
    }
    shared_.wake.notify_all();
    thread_.join();
}

Expected<int> ChildJobs::submit(const RenderRequest& request) {
    WEFT_TRY(queue, lock_queue(shared_.folder));
    auto job = std::make_shared<KnownJob>();
    JobRecord& record = job->record;
    record = record_of(request);
    Project snapshot = request.project;
    snapshot.settings.frames = format_frame_list(request.frames);
    const JobFiles files(shared_.folder, record.name);
    WEFT_CHECK_OK(save_project(files.snapshot, snapshot, WriteRule::own()));
    const std::vector<JobRecord> before = read_jobs(shared_.folder);
    forget_old(shared_.folder, before);
    record.place = before.empty() ? 1 : before.back().place + 1;
    {
        const std::lock_guard lock(shared_.mutex);
        shared_.mine.insert(record.name);
    }
    if (const Status written = write_job(shared_.folder, record); !written) {
        files.remove();
        return tl::unexpected(written.error());
    }
    const std::lock_guard lock(shared_.mutex);
    const auto found =
        std::find_if(shared_.jobs.begin(), shared_.jobs.end(),
                     [&](const auto& known) { return known->record.name == record.name; });
    if (found != shared_.jobs.end()) return (*found)->view.id;  // the thread was faster
    const int id = job->view.id = ++shared_.last_id;
    job->view.mine = true;
    show_record(record, files, job->view);
    shared_.jobs.push_back(std::move(job));
    ++shared_.changes;
    shared_.commands.emplace_back([](std::vector<JobRecord>&) {});  // wakes the thread
    shared_.wake.notify_all();
    return id;
}

std::string ChildJobs::name_of(int id) const {
    const std::lock_guard lock(shared_.mutex);
    for (const auto& job : shared_.jobs)
        if (job->view.id == id) return job->record.name;
    return {};
}

void ChildJobs::command_all(JobCommandFn command) {
    {
        const std::lock_guard lock(shared_.mutex);
        shared_.commands.push_back(std::move(command));
    }
    shared_.wake.notify_all();
}

void ChildJobs::command(int id, std::function<void(JobRecord&)> change) {
    const std::string name = name_of(id);
    if (name.empty()) return;
    command_all([name, change = std::move(change)](std::vector<JobRecord>& records) {
        for (JobRecord& record : records)
            if (record.name == name) return change(record);
    });
}

void ChildJobs::cancel(int id) {
    command(id, cancel_record);
}

void ChildJobs::pause(int id) {
    command(id, [](JobRecord& record) {
        if (record.state != JobState::kRunning || !signal_to(record.process, SIGSTOP)) return;
        record.state = JobState::kPaused;
        record.paused_at_s = unix_time_s();
        record.estimated_s = 0;
    });
}

void ChildJobs::resume(int id) {
    command(id, [](JobRecord& record) {
        if (record.state != JobState::kPaused || !signal_to(record.process, SIGCONT)) return;
        record.state = JobState::kRunning;
        record.paused_s += unix_time_s() - record.paused_at_s;
    });
}

void ChildJobs::retry(int id) {
    const std::string name = name_of(id);
    command_all([name](std::vector<JobRecord>& records) {
        double last = 0;
        for (const JobRecord& record : records)
            last = std::max(last, record.place);
        for (JobRecord& record : records) {
            if (record.name != name || !is_over(record.state)) continue;
            retry_record(record);
            record.place = last + 1;
        }
    });
}

void ChildJobs::remove(int id) {
    command(id, [](JobRecord& record) {
        if (is_over(record.state)) record.name.clear();
    });
}

void ChildJobs::forget_estimate(int id) {
    command(id, [](JobRecord& record) { record.estimated_s = 0; });
}

void ChildJobs::move(int id, int direction) {
    const std::string name = name_of(id);
    command_all([name, direction](std::vector<JobRecord>& records) {
        std::vector<JobRecord*> waiting;
        for (JobRecord& record : records)
            if (record.state == JobState::kWaiting) waiting.push_back(&record);
        std::sort(waiting.begin(), waiting.end(),
                  [](const JobRecord* a, const JobRecord* b) { return a->place < b->place; });
        for (std::size_t k = 0; k + 1 < waiting.size(); ++k) {
            const std::size_t moved = direction < 0 ? k + 1 : k;
            if (waiting[moved]->name != name) continue;
            return std::swap(waiting[k]->place, waiting[k + 1]->place);
        }
    });
}

void ChildJobs::cancel_all() {
    command_all([](std::vector<JobRecord>& records) {
        for (JobRecord& record : records)
            cancel_record(record);
    });
}

std::vector<JobView> ChildJobs::views() const {
    const std::lock_guard lock(shared_.mutex);
    std::vector<JobView> out;
    for (const auto& job : shared_.jobs)
        out.push_back(job->view);
    return out;
}

bool ChildJobs::busy() const {
    const std::lock_guard lock(shared_.mutex);
    return std::any_of(shared_.jobs.begin(), shared_.jobs.end(),
                       [](const auto& job) { return !is_over(job->view.state); });
}

std::uint64_t ChildJobs::changes() const {
    const std::lock_guard lock(shared_.mutex);
    return shared_.changes;
}

std::string ChildJobs::log_tail(int id, std::size_t most_bytes) const {
    const std::string name = name_of(id);
    if (name.empty()) return {};
    return with_setting_names(tail_of(JobFiles(shared_.folder, name).log, most_bytes));
}

}  // namespace weft
