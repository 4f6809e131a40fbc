#include "app/session/farm.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/session/farm_engines.h"
#include "engine/core/frame_range.h"
#include "engine/media/atomic_file.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "weft.farm/1";

std::vector<std::string> in_chunks(const std::vector<int>& frames, int chunk) {
    std::vector<std::string> out;
    const auto size = static_cast<std::size_t>(std::max(1, chunk));
    for (std::size_t first = 0; first < frames.size(); first += size) {
        const std::size_t last = std::min(frames.size(), first + size);
        out.push_back(format_frame_list({frames.begin() + static_cast<std::ptrdiff_t>(first),
                                         frames.begin() + static_cast<std::ptrdiff_t>(last)}));
    }
    return out;
}

// All frames that some region's analysis goes through.
std::vector<int> analysed_frames(const Shot& shot) {
    std::vector<int> out;
    if (shot.plan.regions.empty()) return out;
    int first = 0, last = -1;
    for (const RegionPlan& region : shot.plan.regions) {
        const FrameSpan span = analysed_span(shot.plan, region);
        first = last < first ? span.first : std::min(first, span.first);
        last = std::max(last, span.last);
    }
    for (int frame = first; frame <= last; ++frame)
        out.push_back(frame);
    return out;
}

bool estimates_motion(const Shot& shot) {
    return std::any_of(shot.plan.regions.begin(), shot.plan.regions.end(),
                       [](const RegionPlan& region) {
                           return region.propagated() || !region.painted_holdouts.empty() ||
                                  (!region.true_motion && region.track.empty());
                       });
}

// The 2023-09 schema allows a range of at most so many values.
Status check_openjd(const FarmJob& job, int chunk) {
    constexpr std::size_t kMostTasks = 1024;
    for (const FarmStage& stage : job.stages) {
        if (stage.frames.size() <= kMostTasks) continue;
        const std::size_t wanted =
            (stage.frames.size() * static_cast<std::size_t>(std::max(1, chunk)) + kMostTasks - 1) /
            kMostTasks;
        return fail(ErrorCode::kUsage,
                    "Open Job Description takes at most 1024 tasks a step, and " + stage.name +
                        " has " + std::to_string(stage.frames.size()) + ". Give --chunk " +
                        std::to_string(wanted) + " or more.");
    }
    return {};
}

}  // namespace

std::vector<FarmStage> farm_stages(const Shot& shot, int chunk) {
    std::vector<FarmStage> out;
    if (estimates_motion(shot))
        out.push_back({JobStage::kMotion, "motion", in_chunks(analysed_frames(shot), chunk)});
    out.push_back({JobStage::kAnalyse, "analyse", {""}});
    out.push_back({JobStage::kPlanes, "planes", {""}});
    out.push_back({JobStage::kFrames, "frames", in_chunks(shot.plan.frames, chunk)});
    if (!shot.project.output.movie.empty()) out.push_back({JobStage::kEncode, "encode", {""}});
    return out;
}

Expected<std::vector<std::string>> write_farm_job(const FarmOptions& options, const Shot& shot) {
    std::error_code error;
    const fs::path folder = fs::absolute(options.folder, error);
    fs::create_directories(folder, error);
    if (error) return tl::unexpected(system_error(options.folder, "cannot be made", error.value()));
    // Two farms want the path of the job on a command line: there it must be plain.
    const bool named_in_scripts =
        options.engine == FarmEngine::kDeadline || options.engine == FarmEngine::kOpenCue;
    const std::string where = folder.string();
    if (named_in_scripts && where.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                    "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                    "0123456789/._-+ ") != std::string::npos) {
        return fail(ErrorCode::kUsage,
                    where +
                        " would stand in a command line of the farm. Choose a folder whose "
                        "name has letters, digits and . _ - + only (-o).");
    }
    FarmJob job;
    job.name = fs::path(options.project).stem().string();
    job.file = (folder / "job.json").string();
    job.stages = farm_stages(shot, options.chunk);
    if (options.engine == FarmEngine::kOpenJd) WEFT_CHECK_OK(check_openjd(job, options.chunk));
    Json stages = Json::array();
    for (const FarmStage& stage : job.stages)
        stages.push_back({{"name", stage.name}, {"frames", stage.frames}});
    const Json json{{"schema", kSchema},
                    {"project", fs::absolute(options.project, error).string()},
                    {"cache", options.cache.empty() ? (folder / "cache").string()
                                                    : fs::absolute(options.cache, error).string()},
                    {"library", options.library},
                    {"threads", options.threads},
                    {"maps", options.maps},
                    {"stages", stages}};
    std::vector<std::pair<std::string, std::string>> files{
        {job.file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"}};
    for (auto& [name, text] : engine_files(options.engine, job))
        files.emplace_back((folder / name).string(), std::move(text));
    std::vector<std::string> written;
    for (const auto& [path, text] : files) {
        WEFT_CHECK_OK(write_file_atomically(path, text));
        written.push_back(path);
    }
    return written;
}

Expected<FarmTask> read_farm_task(const std::string& path, const std::string& stage, int index) {
    const auto bad = [&](const std::string& why) {
        return fail(ErrorCode::kUnreadable,
                    path + " is no job: " + why + ". Give the job.json that 'weft submit' wrote.");
    };
    std::ifstream file(path, std::ios::binary);
    if (!file) return bad("it cannot be opened");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || json.value("schema", Json()) != kSchema)
        return bad(std::string("it is not of the schema ") + kSchema);
    try {
        FarmTask task;
        task.project = json.at("project").get<std::string>();
        task.cache = json.at("cache").get<std::string>();
        task.library = json.at("library").get<std::string>();
        task.threads = json.at("threads").get<int>();
        task.maps = json.at("maps").get<std::vector<std::string>>();
        std::string names;
        for (const Json& entry : json.at("stages")) {
            const auto name = entry.at("name").get<std::string>();
            names += (names.empty() ? "" : ", ") + name;
            if (name != stage) continue;
            const auto frames = entry.at("frames").get<std::vector<std::string>>();
            if (index < 0 || static_cast<std::size_t>(index) >= frames.size()) {
                return fail(ErrorCode::kUsage, "The stage " + stage + " has tasks 0 to " +
                                                   std::to_string(frames.size() - 1) + ".");
            }
            task.frames = frames[static_cast<std::size_t>(index)];
            const auto known = parse_job_stage(name);
            if (!known) return tl::unexpected(known.error());
            task.stage = *known;
            return task;
        }
        return fail(ErrorCode::kUsage,
                    "The job has no stage '" + stage + "'. It has " + names + ".");
    } catch (const nlohmann::json::exception& error) {
        return bad(error.what());
    }
}

}  // namespace weft
