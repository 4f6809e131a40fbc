#include "app/render/output_plan.h"

#include <filesystem>

#include "app/render/composite_files.h"
#include "app/render/existing_frames.h"
#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"
#include "engine/media/read_back.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::vector<PlannedFile> planned_files(const OutputPlan& plan) {
    std::vector<PlannedFile> files;
    for (const int frame : plan.numbers) {
        const std::string number = std::to_string(frame);
        files.push_back({"Frame " + number, plan.frames.path_for(frame)});
        if (plan.layers)
            files.push_back({"The layers of frame " + number, plan.layers->path_for(frame)});
        if (plan.st_maps)
            files.push_back({"The ST-maps of frame " + number, plan.st_maps->path_for(frame)});
    }
    if (!plan.plane.empty()) files.push_back({"The texture plane", plan.plane});
    for (const std::string& path : plan.composites)
        files.push_back({"The composite", path});
    if (!plan.movie.empty()) files.push_back({"The movie", plan.movie});
    if (!plan.report.empty()) files.push_back({"The report", plan.report});
    if (!plan.recipe.empty()) files.push_back({"The recipe", plan.recipe});
    return files;
}

// Returns true for a regular JSON file whose first key names this schema.
bool is_of_schema(const std::string& path, const std::string& schema) {
    const auto file = InputFile::open(path);
    if (!file) return false;
    std::string head(256, '\0');
    head.resize(file->read_at(0, head.data(), head.size()).value_or(0));
    const std::size_t brace = head.find_first_not_of(" \n\r\t");
    const std::size_t key = head.find("\"schema\": \"" + schema + "\"");
    return brace != std::string::npos && head[brace] == '{' && key != std::string::npos &&
           head.find_first_not_of(" \n\r\t", brace + 1) == key;
}

// A resumed run may replace files of the earlier run, but no others. `own`: the file is Weft's.
WriteRule rule_beside(const WriteRule& frames, ExistingFrames existing, bool own, bool device) {
    WriteRule rule = frames;
    rule.device = device;
    rule.existing = existing_by(existing == ExistingFrames::kOverwrite ||
                                (existing != ExistingFrames::kRefuse && own));
    return rule;
}

// Checks files one by one; nothing is created yet.
Status check_fence(const SequencePattern& pattern, const std::vector<int>& frames,
                   const WriteRule& rule) {
    for (const int frame : frames) {
        const std::string path = pattern.path_for(frame);
        if (rule.fence) WEFT_CHECK_OK(rule.fence->check(path, real_path(path)));
        if (is_device(path))
            return fail(ErrorCode::kUsage, path + " is a device or a pipe.",
                        "Give names of files" + by({{setting::kOutput}}) + ".");
    }
    return {};
}

Status prepare(const std::string& path, const WriteRule& rule, OutputFolders folders) {
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    const bool missing = !folder.empty() && !fs::is_directory(folder, ignored);
    if (missing && folders == OutputFolders::kLeave) return {};
    if (missing) WEFT_CHECK_OK(make_folder(folder.string(), rule));
    remove_stale_temporaries(path);
    return check_output(path, rule);
}

// Checks existing files one by one.
Status prepare_frames(const SequencePattern& pattern, int first, WriteRule rule,
                      OutputFolders folders) {
    rule.existing = Existing::kReplace;
    return prepare(pattern.path_for(first), rule, folders);
}

// Of files beside the frames, one for each.
Status check_beside(const SequencePattern& layers, const std::vector<int>& frames,
                    ExistingFrames existing) {
    std::error_code ignored;
    for (const int frame : frames) {
        const std::string path = layers.path_for(frame);
        if (existing == ExistingFrames::kOverwrite ||
            !fs::exists(fs::symlink_status(path, ignored)))
            continue;
        if (existing == ExistingFrames::kRefuse) return tl::unexpected(exists_already(path));
        if (!is_frame_of_weft(path)) return tl::unexpected(not_of_weft(path));
    }
    return {};
}

}  // namespace

Expected<OutputRules> check_outputs(const OutputPlan& plan, ExistingFrames existing,
                                    const WriteRule& frames, OutputFolders folders) {
    // Everything is checked before the first folder is created.
    if (folders == OutputFolders::kMake)
        WEFT_CHECK_OK(check_outputs(plan, existing, frames, OutputFolders::kLeave));
    WEFT_CHECK_OK(check_apart(planned_files(plan)));
    WEFT_CHECK_OK(check_fence(plan.frames, plan.numbers, frames));
    for (const auto& pattern : {plan.layers, plan.st_maps})
        if (pattern) WEFT_CHECK_OK(check_fence(*pattern, plan.numbers, frames));
    std::vector<std::string> others{plan.movie, plan.report, plan.recipe, plan.plane};
    others.insert(others.end(), plan.composites.begin(), plan.composites.end());
    for (const std::string& path : others) {
        if (!path.empty() && frames.fence && !is_device(path))
            WEFT_CHECK_OK(frames.fence->check(path, real_path(path)));
    }
    const int first = plan.numbers.front();
    WEFT_CHECK_OK(prepare_frames(plan.frames, first, frames, folders));
    for (const auto& pattern : {plan.layers, plan.st_maps}) {
        if (!pattern) continue;
        WEFT_CHECK_OK(prepare_frames(*pattern, first, frames, folders));
        WEFT_CHECK_OK(check_beside(*pattern, plan.numbers, existing));
    }
    OutputRules rules{
        rule_beside(frames, existing, is_review_movie(plan.movie, plan.size), false),
        rule_beside(frames, existing, is_of_schema(plan.report, "weft.report/1"), true),
        rule_beside(frames, existing, is_of_schema(plan.recipe, "weft.recipe/1"), true),
        rule_beside(frames, existing, !plan.plane.empty() && is_frame_of_weft(plan.plane), false)};
    const std::pair<const std::string&, const WriteRule&> beside[]{{plan.movie, rules.movie},
                                                                   {plan.report, rules.report},
                                                                   {plan.recipe, rules.recipe},
                                                                   {plan.plane, rules.plane}};
    for (const auto& [path, rule] : beside)
        if (!path.empty()) WEFT_CHECK_OK(prepare(path, rule, folders));
    for (const std::string& path : plan.composites) {
        const bool own = is_composite_of_weft(path) || is_frame_of_weft(path);
        rules.composites.push_back(rule_beside(frames, existing, own, false));
        WEFT_CHECK_OK(prepare(path, rules.composites.back(), folders));
    }
    return rules;
}

}  // namespace weft
