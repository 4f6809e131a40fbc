#include "app/farm/farm.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/base/trust.h"
#include "app/farm/farm_engines.h"
#include "app/project/codec/project_json.h"
#include "app/render/input_hashes.h"
#include "app/render/recipe.h"
#include "app/render/report.h"
#include "engine/core/frame_range.h"
#include "engine/core/hash.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "weft.farm/3";

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

// All frames that the analysis of some region needs.
std::vector<int> analysed_frames(const Shot& shot) {
    std::vector<int> out;
    if (shot.plan.regions.empty()) return out;
    FrameSpan all = analysed_span(shot.plan, shot.plan.regions.front());
    for (const RegionPlan& region : shot.plan.regions) {
        const FrameSpan span = analysed_span(shot.plan, region);
        all = {std::min(all.first, span.first), std::max(all.last, span.last)};
    }
    for (int frame = all.first; frame <= all.last; ++frame)
        out.push_back(frame);
    return out;
}

bool estimates_motion(const Shot& shot) {
    return std::any_of(
        shot.plan.regions.begin(), shot.plan.regions.end(), [](const RegionPlan& region) {
            const auto propagated = [](const ZonePlan& zone) { return zone.propagated(); };
            return region.propagated() || !region.painted_holdouts.empty() ||
                   std::any_of(region.zones.begin(), region.zones.end(), propagated) ||
                   (!region.true_motion && region.track.empty());
        });
}

std::string hash_of(const std::string& text) {
    Hasher hasher;
    return hasher.text(text).finish().hex();
}

const char* name_of(ExistingFrames existing) {
    switch (existing) {
        case ExistingFrames::kOverwrite:
            return "overwrite";
        case ExistingFrames::kSkip:
            return "skip";
        case ExistingFrames::kRefuse:
        case ExistingFrames::kResume:
            break;
    }
    return "resume";
}

ExistingFrames existing_of(const std::string& name) {
    return name == "overwrite" ? ExistingFrames::kOverwrite
           : name == "skip"    ? ExistingFrames::kSkip
                               : ExistingFrames::kResume;
}

// Two farms put the job's path on a command line without quoting, so it must be plain.
Status check_plain_folder(FarmEngine engine, const std::string& folder) {
    const bool named_in_scripts = engine == FarmEngine::kDeadline || engine == FarmEngine::kOpenCue;
    if (!named_in_scripts || folder.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                      "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                      "0123456789/._-+ ") == std::string::npos)
        return {};
    return fail(ErrorCode::kUsage, folder + " would stand in a command line of the farm.",
                "Choose a folder whose name has letters, digits and . _ - + only (-o).");
}

using TextFiles = std::vector<std::pair<std::string, std::string>>;  // path, text

// Queued tasks of an older job in the folder would render the new one.
Status check_no_other_job(const std::string& job, const WriteRule& rule) {
    std::error_code ignored;
    if (rule.existing == Existing::kReplace || !fs::exists(fs::symlink_status(job, ignored)))
        return {};
    return fail(ErrorCode::kUsage, job + " exists already.",
                "Choose another folder" + by({{setting::kOutput}}) +
                    ", or cancel that job and replace it" +
                    by({{setting::kResume}, {setting::kOverwrite}}) + ".");
}

// The 2023-09 schema limits the number of values in a range.
Status check_openjd(const FarmJob& job, int chunk) {
    constexpr std::size_t kMostTasks = 1024;
    for (const FarmStage& stage : job.stages) {
        if (stage.frames.size() <= kMostTasks) continue;
        const std::size_t wanted =
            (stage.frames.size() * static_cast<std::size_t>(std::max(1, chunk)) + kMostTasks - 1) /
            kMostTasks;
        return fail(
            ErrorCode::kUsage,
            "Open Job Description allows at most 1024 tasks per step, and " + stage.name + " has " +
                std::to_string(stage.frames.size()) + ".",
            "Put more frames into a task" + by({{setting::kChunk, std::to_string(wanted)}}) + ".");
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

Project frozen_project(const Project& project, const Shot& shot) {
    std::error_code ignored;
    Project out = map_paths(project, [&](const std::string& path) {
        return path.empty() || names_library_texture(path) ? path
                                                           : fs::absolute(path, ignored).string();
    });
    out.settings.frames = format_frame_list(shot.plan.frames);
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        Leaf<Region>& region = out.regions[shot.region_index[k]];
        region = region.with(
            [&](Region& r) { r.reference_frames = shot.plan.regions[k].reference_frames; });
    }
    return out;
}

Expected<std::vector<std::string>> write_farm_job(const FarmOptions& options,
                                                  const std::shared_ptr<const Shot>& opened) {
    const Shot& shot = *opened;
    std::error_code error;
    const fs::path folder = fs::absolute(options.folder, error);
    WEFT_CHECK_OK(check_plain_folder(options.engine, folder.string()));
    WEFT_CHECK_OK(make_folder(folder.string(), options.rule));
    FarmJob job;
    job.name = fs::path(options.project_file).stem().string();
    job.file = (folder / "job.json").string();
    job.stages = farm_stages(shot, options.chunk);
    if (options.engine == FarmEngine::kOpenJd) WEFT_CHECK_OK(check_openjd(job, options.chunk));
    Json stages = Json::array();
    for (const FarmStage& stage : job.stages)
        stages.push_back({{"name", stage.name}, {"frames", stage.frames}});
    WEFT_TRY(snapshot, project_to_json(frozen_project(options.project, shot)));
    const InputHashes inputs(opened, shot.plan.frames);
    const std::string hash = hash_of(snapshot);
    // Named by its content, so that no job replaces the snapshot of another.
    const std::string snapshot_name = "project-" + hash + ".weft";
    const auto absolute = [&](const std::string& path) {
        return path.empty() ? path : fs::absolute(path, error).string();
    };
    const Json json{
        {"schema", kSchema},
        {"version", kVersion},
        {"project", absolute(options.project_file)},
        {"snapshot", {{"file", snapshot_name}, {"hash", hash}}},
        {"settings", settings_hash(shot)},
        {"inputs", inputs.text(shot.plan.frames)},
        {"cache", options.cache.empty() ? (folder / "cache").string() : absolute(options.cache)},
        {"library", absolute(options.library)},
        {"threads", options.threads},
        {"existing", name_of(options.existing)},
        {"output_roots", options.roots.empty() ? output_folders(options.project) : options.roots},
        {"stages", stages}};
    TextFiles files{{job.file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"}};
    for (auto& [name, text] : engine_files(options.engine, job))
        files.emplace_back((folder / name).string(), std::move(text));
    WEFT_CHECK_OK(check_no_other_job(job.file, options.rule));
    // Written first, because job.json refers to it.
    files.insert(files.begin(), {(folder / snapshot_name).string(), snapshot});
    std::vector<std::string> written;
    // Check all files before writing any, to avoid a mix of two jobs.
    for (const auto& [path, text] : files)
        WEFT_CHECK_OK(check_output(path, options.rule));
    for (const auto& [path, text] : files) {
        WEFT_CHECK_OK(write_file_atomically(path, text, options.rule));
        written.push_back(path);
    }
    // So that not every task reads all inputs to compare them.
    shot.files->save_to(fingerprint_folder(json.at("cache").get<std::string>()));
    return written;
}

namespace {

Expected<Project> read_snapshot(const fs::path& folder, const Json& snapshot) {
    // Relative to the job, wherever it is mounted on this machine.
    const std::string path =
        (folder / fs::path(snapshot.at("file").get<std::string>()).filename()).string();
    const auto text = read_file(path, "The job's project", kTextFileLimit_bytes);
    if (!text) {
        return fail(ErrorCode::kUnreadable, text.error().sentence(),
                    "Submit again, and keep the job's folder as it is.");
    }
    if (hash_of(*text) != snapshot.at("hash").get<std::string>()) {
        return fail(ErrorCode::kUnreadable, path + " is not the project that was submitted.",
                    "Submit again.");
    }
    return project_from_json(*text);
}

// Selects the stage and the frames of a task.
Status choose_task(const Json& stages, const std::string& stage, int index, FarmTask& task) {
    std::string names;
    for (const Json& entry : stages) {
        const auto name = entry.at("name").get<std::string>();
        names += (names.empty() ? "" : ", ") + name;
        if (name != stage) continue;
        const auto frames = entry.at("frames").get<std::vector<std::string>>();
        if (index < 0 || static_cast<std::size_t>(index) >= frames.size()) {
            return fail(ErrorCode::kUsage,
                        "The stage " + stage + " has no task " + std::to_string(index) + ".",
                        "Give one from 0 to " + std::to_string(frames.size() - 1) + ".");
        }
        // An empty list means the whole shot.
        const std::string& chosen = frames[static_cast<std::size_t>(index)];
        if (!chosen.empty()) task.project.settings.frames = chosen;
        WEFT_TRY(known, parse_job_stage(name));
        task.stage = known;
        return {};
    }
    return fail(ErrorCode::kUsage, "The job has no stage '" + stage + "'.",
                "Give one of " + names + ".");
}

}  // namespace

bool is_farm_job(const std::string& path) {
    const auto text = read_file(path, "The job");
    if (!text) return false;
    const Json json = Json::parse(*text, nullptr, false);
    const Json schema = json.is_object() ? json.value("schema", Json()) : Json();
    return schema.is_string() && schema.get<std::string>().starts_with("weft.farm/");
}

Expected<FarmTask> read_farm_task(const std::string& path, const std::string& stage, int index) {
    const auto bad = [&](const std::string& why) {
        return fail(ErrorCode::kUnreadable, path + " is not a job: " + why + ".",
                    "Give the job.json that 'weft submit' wrote.");
    };
    WEFT_TRY(text, read_file(path, "The job"));
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || json.value("schema", Json()) != kSchema)
        return bad(std::string("it is not of the schema ") + kSchema);
    try {
        if (const auto version = json.at("version").get<std::string>(); version != kVersion) {
            return fail(
                ErrorCode::kUnreadable,
                "The job was submitted by weft " + version + ", and this is weft " + kVersion + ".",
                "Install one version on all machines, and submit again.");
        }
        FarmTask task;
        WEFT_TRY(project, read_snapshot(fs::path(path).parent_path(), json.at("snapshot")));
        task.project = std::move(project);
        task.settings = json.at("settings").get<std::string>();
        task.inputs = json.at("inputs").get<std::string>();
        WEFT_TRY(frames, parse_frame_list(task.project.settings.frames));
        task.inputs_of = std::move(frames);
        task.cache = json.at("cache").get<std::string>();
        task.library = json.at("library").get<std::string>();
        task.threads = json.at("threads").get<int>();
        task.existing = existing_of(json.at("existing").get<std::string>());
        task.output_roots = json.at("output_roots").get<std::vector<std::string>>();
        if (task.output_roots.empty()) return bad("it names no folder to write to");
        WEFT_CHECK_OK(choose_task(json.at("stages"), stage, index, task));
        return task;
    } catch (const nlohmann::json::exception&) {
        return bad("a field is missing or of another type");
    }
}

}  // namespace weft
