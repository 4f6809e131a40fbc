// weft new, region, apply, info and validate. A project file is read, changed by edits, and written
// atomically.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

#include "app/base/trust.h"
#include "app/cli/commands.h"
#include "app/exchange/kept_textures.h"
#include "app/project/codec/edit_json.h"
#include "app/project/codec/project_file.h"
#include "app/project/codec/project_json.h"
#include "app/project/codec/update_project.h"
#include "app/project/region_names.h"
#include "engine/core/frame_range.h"
#include "engine/core/input_file.h"
#include "engine/core/printable.h"
#include "engine/core/short_number.h"
#include "engine/core/text.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

// The answer after saving a project: its path and number of regions.
Answer saved_answer(const std::string& path, const Project& project) {
    return {Json{{"project", absolute_path(path)}, {"regions", project.regions.size()}}};
}

// Changes a project file, with textures of a library copied beside it.
Expected<Project> updated(const std::string& path, const std::string& library,
                          const ProjectEdit& edit) {
    return update_project(path, [&](const Project& before) -> Expected<Project> {
        WEFT_TRY(after, edit(before));
        return keep_library_textures(after, path, library);
    });
}

Json region_json(const Region& region) {
    Json out{{"id", region.id}, {"name", region.name}, {"enabled", region.enabled}};
    Json keys = Json::array();
    for (const auto& [frame, key] : region.matte->keyframes)
        keys.push_back(frame);
    Json confirmed = Json::array();
    for (const auto& [frame, edge] : region.matte->confirmed)
        confirmed.push_back(frame);
    out["matte"] = {{"files", region.matte->files}, {"keyframes", keys}, {"confirmed", confirmed}};
    out["holdouts"] = region.holdouts->size();
    out["zones"] = region.zones->size();
    out["texture"] = region.texture.plane.empty() ? region.texture.sample : region.texture.plane;
    return out;
}

Json regions_json(const Project& project) {
    Json list = Json::array();
    for (const auto& region : project.regions)
        list.push_back(region_json(*region));
    return list;
}

std::string regions_text(const Project& project) {
    std::string text;
    for (const auto& region : project.regions) {
        const TextureSource& texture = region->texture;
        text += std::to_string(region->id) + "  " + printable(region->name) +
                (region->enabled ? "" : " (off)") + "  " +
                printable(texture.plane.empty() ? texture.sample : texture.plane) + "\n";
    }
    return text;
}

// --overwrite replaces a project, and nothing that only has its name.
Status check_replaces_project(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored) || load_project(path)) return {};
    return fail(ErrorCode::kUsage, path + " is not a Weft project.",
                "Choose another name, or remove it.");
}

}  // namespace

CommandResult new_command(const std::string& path, const Project& project,
                          const WriteFlags& write) {
    const Project whole = resolve_paths(project, project_dir(path));
    // The plate is relative to the project's folder, but a slip might mean it from here.
    WEFT_TRY(rule, write_rule(write, {project.plate.path}, whole));
    WEFT_TRY(lock, lock_project(path));
    WEFT_CHECK_OK(check_replaces_project(path));
    WEFT_CHECK_OK(make_folder_of(path, rule));
    WEFT_CHECK_OK(save_project(path, project, rule));
    // A project created here is trusted.
    if (!outputs_outside(whole, path).empty()) {
        std::string folder = project_dir(path);
        if (folder.empty()) folder = ".";
        if (const auto trusted = TrustList::of_user().add(folder, false); !trusted)
            print_warning(trusted.error().text());
    }
    return saved_answer(path, project);
}

CommandResult apply_command(const std::string& path, const std::string& actions,
                            const std::string& library, bool dry_run) {
    // A wrong project is named before standard input is waited for.
    WEFT_TRY(project, load_project(path));
    const bool piped = actions == "-";
    WEFT_TRY(text, piped ? read_standard_input("The list of actions")
                         : read_file(actions, "The list of actions"));
    const std::string source = piped ? "standard input" : actions;
    const auto edits = edits_from_json(text);
    if (!edits) return fail_in(edits.error(), source);
    const auto edit = [&](const Project& before) -> Expected<Project> {
        auto changed = apply_edits(before, *edits);
        if (!changed) return fail_in(std::move(changed).error(), source);
        return changed;
    };
    Answer answer;
    if (dry_run) {
        WEFT_CHECK_OK(edit(project));
    } else {
        WEFT_TRY(done, updated(path, library, edit));
        answer = saved_answer(path, done);
    }
    answer.json["project"] = absolute_path(path);
    answer.json["actions"] = edits->size();
    answer.json["dry_run"] = dry_run;
    return answer;
}

CommandResult region_add_command(const std::string& path, const Region& region,
                                 const std::string& library) {
    Json added;
    const auto edit = [&](const Project& before) -> Expected<Project> {
        Region named = region;
        if (named.name.empty())
            named.name =
                free_region_name(before, "region " + std::to_string(before.next_region_id));
        WEFT_TRY(after, apply_edit(before, AddRegion{std::move(named), {}}));
        added = region_json(*after.regions.back());
        return after;
    };
    WEFT_TRY(done, updated(path, library, edit));
    Answer answer = saved_answer(path, done);
    answer.json["region"] = added;
    return answer;
}

CommandResult region_set_command(const std::string& path, const std::string& region,
                                 const RegionChange& change, const std::string& library) {
    Json set;
    const auto edit = [&](const Project& before) -> Expected<Project> {
        WEFT_TRY(index, find_region(before, region));
        Region changed = *before.regions[index];
        WEFT_CHECK_OK(change(changed));
        WEFT_TRY(after, apply_edits(before, region_edits(*before.regions[index], changed)));
        set = region_json(*after.regions[index]);
        return after;
    };
    WEFT_TRY(done, updated(path, library, edit));
    Answer answer = saved_answer(path, done);
    answer.json["region"] = set;
    return answer;
}

CommandResult region_remove_command(const std::string& path, const std::string& region) {
    Json removed;
    const auto edit = [&](const Project& before) -> Expected<Project> {
        WEFT_TRY(index, find_region(before, region));
        removed = region_json(*before.regions[index]);
        return apply_edit(before, RemoveRegion{{before.regions[index]->id, {}}});
    };
    WEFT_TRY(done, update_project(path, edit));
    Answer answer = saved_answer(path, done);
    answer.json["removed"] = removed;
    return answer;
}

CommandResult region_correct_command(const std::string& path, const SetCorrection& edit) {
    WEFT_TRY(done,
             update_project(path, [&](const Project& before) { return apply_edit(before, edit); }));
    Answer answer = saved_answer(path, done);
    answer.json["frame"] = edit.frame;
    answer.json["pins"] = edit.pins.size();
    return answer;
}

CommandResult region_list_command(const std::string& path) {
    WEFT_TRY(project, load_project(path));
    return Answer{Json{{"schema", "weft.regions/1"},
                       {"project", absolute_path(path)},
                       {"regions", regions_json(project)}},
                  regions_text(project)};
}

namespace {

// Adds each planned region's reference frame to its JSON entry and returns them as text lines.
std::string add_references(const Project& project, const Shot& shot, Json& regions) {
    std::string text;
    for (std::size_t k = 0; k < shot.references.size(); ++k) {
        const ShotReference& reference = shot.references[k];
        const std::size_t at = shot.region_index[k];
        regions[at]["reference_frame"] = reference.frame;
        regions[at]["reference_frame_chosen"] = reference.by_default;
        text += "reference  " + printable(project.regions[at]->name) + ": frame " +
                std::to_string(reference.frame) + (reference.by_default ? " (default)" : "") + "\n";
    }
    return text;
}

}  // namespace

CommandResult info_command(const std::string& path) {
    WEFT_TRY(written, load_project(path));
    const Project project = resolve_paths(written, absolute_path(project_dir(path)));
    WEFT_TRY(shot, open_shot(project));
    const CachedReader& plate = *shot->plate;
    const std::string frames = format_frame_list(plate.frames()),
                      wanted = format_frame_list(shot->plan.frames);
    Json regions = regions_json(project);
    const std::string references = add_references(project, *shot, regions);
    Answer answer;
    answer.json = {
        {"project", absolute_path(path)},
        {"name", project.name},
        {"plate",
         {{"path", project.plate.path},
          {"size", {plate.size().width, plate.size().height}},
          {"frames", frames},
          {"fps", plate.fps()},
          {"pixel_aspect", plate.pixel_aspect()},
          {"space", shot->spaces.plate.name}}},
        {"render", {{"frames", wanted}, {"output", project.output.path}}},
        {"spaces", {{"working", shot->spaces.working.name}, {"out", shot->spaces.out.name}}},
        {"regions", regions},
        {"warnings", shot->warnings}};
    const double aspect = plate.pixel_aspect();
    const std::string shape = aspect == 1 ? "" : "  pixel aspect " + short_number(aspect, 4);
    answer.text = path + "\nplate    " + written.plate.path + "  " + size_text(plate.size()) +
                  shape + "  frames " + frames + "  " + shot->spaces.plate.name +
                  "\nrender   frames " + wanted + "  to " + written.output.path + "\n" +
                  references + "regions  " + std::to_string(written.regions.size()) + "\n" +
                  regions_text(written);
    return answer;
}

namespace {

// Adds an issue to the text and the JSON of the answer.
void tell(const Issue& issue, Answer& answer) {
    const bool wrong = issue.severity == Severity::kError;
    answer.text += (wrong ? "error: " : "warning: ") + issue.text() + "\n";
    answer.json["issues"].push_back({{"severity", wrong ? "error" : "warning"},
                                     {"field", issue.where},
                                     {"message", issue.what},
                                     {"remedy", issue.what_to_do}});
}

// Mattes and holdouts that are damaged or of another size than the plate are found by reading them:
// painted ones all, of those by frame some.
Status read_some_mattes(const Shot& shot) {
    constexpr std::size_t kMost = 12;
    const std::vector<int>& frames = shot.plan.frames;
    const std::size_t count = std::min(kMost, frames.size());
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const auto read = [&]() -> Status {
            const RegionPlan& region = shot.plan.regions[k];
            const int index = static_cast<int>(k);
            for (const int key : region.matte_keys)
                WEFT_CHECK_OK(shot.source->matte_key(index, key));
            for (std::size_t i = 0; i < count; ++i) {
                const int frame =
                    count == 1 ? frames[0] : frames[i * (frames.size() - 1) / (count - 1)];
                if (!region.propagated()) WEFT_CHECK_OK(shot.source->matte(index, frame));
                WEFT_CHECK_OK(shot.source->holdout(index, frame));
            }
            return {};
        };
        if (Status done = read(); !done) {
            const std::string& name = shot.project.regions[shot.region_index[k]]->name;
            return fail_in(std::move(done).error(), "Region '" + name + "'");
        }
    }
    return {};
}

}  // namespace

Error error_of(const Issue& issue) {
    return {ErrorCode::kUsage, issue.what + ".", issue.what_to_do + ".", {issue.where}};
}

CommandResult validate_command(const std::string& path, bool files) {
    WEFT_TRY(project, load_project(path));
    const auto issues = validate(project);
    Answer answer;
    answer.json = {{"project", absolute_path(path)},
                   {"valid", !has_errors(issues)},
                   {"issues", Json::array()}};
    for (const Issue& issue : issues)
        tell(issue, answer);
    const auto wrong = std::find_if(issues.begin(), issues.end(), [](const Issue& issue) {
        return issue.severity == Severity::kError;
    });
    if (wrong != issues.end()) {
        // The list is the answer; the error stream says that there is one.
        answer.error =
            json_output()
                ? error_of(*wrong)
                : Error{ErrorCode::kUsage, path + " has errors.", "Correct those listed.", {}};
        return answer;
    }
    if (files) {
        WEFT_TRY(shot, open_shot(resolve_paths(project, project_dir(path))));
        WEFT_CHECK_OK(read_some_mattes(*shot));
        WEFT_CHECK_OK(check_texture_licences(*shot));
        for (const std::string& warning : shot->warnings) {
            answer.text += "warning: " + warning + "\n";
            answer.json["issues"].push_back({{"severity", "warning"}, {"message", warning}});
        }
    }
    answer.text += path + " is valid.\n";
    return answer;
}

}  // namespace weft
