#include "app/jobs/job_record.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/core/input_file.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kSchema = "weft.queued_job/1", kEnding = ".job.json";
constexpr std::array<std::string_view, 6> kStates{"waiting", "running",   "paused",
                                                  "done",    "cancelled", "failed"};
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 20;

tl::unexpected<Error> unreadable(const std::string& path) {
    return fail(ErrorCode::kUnreadable, path + " is no job of this version.");
}

Json problem_json(const JobProblem& problem) {
    Json out{{"region", problem.region}, {"setting", problem.setting}};
    if (problem.frame) out["frame"] = *problem.frame;
    return out;
}

JobProblem problem_from(const Json& json) {
    JobProblem out;
    if (!json.is_object()) return out;
    out.region = json.value("region", "");
    out.setting = json.value("setting", "");
    if (json.contains("frame")) out.frame = json.at("frame").get<int>();
    return out;
}

Json to_json(const JobRecord& r) {
    return {
        {"schema", kSchema},
        {"state", kStates[static_cast<std::size_t>(r.state)]},
        {"place", r.place},
        {"label", r.label},
        {"project", r.project},
        {"plate", r.plate},
        {"output", r.output},
        {"movie", r.movie},
        {"backend", r.backend},
        {"overwrite", r.overwrite},
        {"skip_existing", r.skip_existing},
        {"cancelled", r.cancelled},
        {"total", r.total},
        {"estimated_s", r.estimated_s},
        {"process",
         {{"id", r.process.id}, {"started", r.process.started}, {"machine", r.process.machine}}},
        {"begun_s", r.begun_s},
        {"paused_at_s", r.paused_at_s},
        {"paused_s", r.paused_s},
        {"elapsed_s", r.elapsed_s},
        {"newest_frame", r.newest_frame},
        {"has_frame", r.has_frame},
        {"error", r.error},
        {"problem", problem_json(r.problem)}};
}

// Throws where a value is of another kind.
JobRecord from_json(const Json& json, JobState state) {
    JobRecord r;
    r.state = state;
    r.place = json.value("place", 0.0);
    r.label = json.value("label", "");
    r.project = json.value("project", "");
    r.plate = json.value("plate", "");
    r.output = json.value("output", "");
    r.movie = json.value("movie", "");
    r.backend = json.value("backend", "auto");
    r.overwrite = json.value("overwrite", false);
    r.skip_existing = json.value("skip_existing", false);
    r.cancelled = json.value("cancelled", false);
    r.total = json.value("total", 0);
    r.estimated_s = json.value("estimated_s", 0.0);
    const Json process = json.value("process", Json::object());
    r.process.id = process.value("id", -1);
    r.process.started = process.value("started", std::uint64_t{0});
    r.process.machine = process.value("machine", "");
    r.begun_s = json.value("begun_s", 0.0);
    r.paused_at_s = json.value("paused_at_s", 0.0);
    r.paused_s = json.value("paused_s", 0.0);
    r.elapsed_s = json.value("elapsed_s", 0.0);
    r.newest_frame = json.value("newest_frame", 0);
    r.has_frame = json.value("has_frame", false);
    r.error = json.value("error", "");
    r.problem = problem_from(json.value("problem", Json::object()));
    return r;
}

}  // namespace

JobFiles::JobFiles(const std::string& folder, const std::string& name) {
    const std::string stem = (fs::path(folder) / name).string();
    record = stem + std::string(kEnding);
    snapshot = stem + ".weft";
    log = stem + ".log";
    progress = snapshot + ".progress";
    answer = stem + ".answer.json";
}

void JobFiles::remove() const {
    std::error_code error;
    // The record last: without it the others would be nobody's.
    for (const std::string* file : {&snapshot, &log, &progress, &answer, &record})
        fs::remove(*file, error);
}

void JobFiles::remove_results() const {
    std::error_code error;
    for (const std::string* file : {&progress, &answer})
        fs::remove(*file, error);
}

Expected<JobRecord> read_job(const std::string& folder, const std::string& name) {
    const std::string path = JobFiles(folder, name).record;
    WEFT_TRY(text, read_file(path, {}, kMostBytes));
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return unreadable(path);
    try {
        const auto state = std::find(kStates.begin(), kStates.end(), json.value("state", ""));
        if (json.value("schema", "") != kSchema || state == kStates.end()) return unreadable(path);
        JobRecord record = from_json(json, static_cast<JobState>(state - kStates.begin()));
        record.name = name;
        return record;
    } catch (const nlohmann::json::exception&) {
        return unreadable(path);
    }
}

Status write_job(const std::string& folder, const JobRecord& record) {
    const std::string text =
        to_json(record).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    return write_file_atomically(JobFiles(folder, record.name).record, text, WriteRule::own());
}

std::vector<JobRecord> read_jobs(const std::string& folder) {
    std::vector<JobRecord> out;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::string name = it->path().filename().string();
        if (!name.ends_with(kEnding) || name.starts_with('.')) continue;
        name.resize(name.size() - kEnding.size());
        if (auto record = read_job(folder, name)) out.push_back(std::move(*record));
    }
    std::sort(out.begin(), out.end(), [](const JobRecord& a, const JobRecord& b) {
        return a.place != b.place ? a.place < b.place : a.name < b.name;
    });
    return out;
}

}  // namespace weft
