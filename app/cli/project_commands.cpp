// weft new, region, apply, info and validate: a project file is read, changed through edits, and
// written whole.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/cli/commands.h"
#include "app/project/edit.h"
#include "app/project/project_file.h"
#include "app/project/project_json.h"
#include "app/project/validate.h"
#include "app/session/kept_textures.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

// Textures of a library are kept beside the project first.
int saved_with_textures(const std::string& path, const Expected<Project>& project,
                        const std::string& library) {
    if (!project) return report_error(project.error());
    const auto kept = keep_library_textures(*project, path, library);
    if (!kept) return report_error(kept.error());
    const Status status = save_project(path, *kept);
    return status ? 0 : report_error(status.error());
}

int saved(const std::string& path, const Expected<Project>& project) {
    if (!project) return report_error(project.error());
    const Status status = save_project(path, *project);
    return status ? 0 : report_error(status.error());
}

Expected<std::string> read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return fail(ErrorCode::kUnreadable,
                    path + " cannot be read. Check the name and its permissions.");
    return std::string(std::istreambuf_iterator<char>(file), {});
}

Error in_file(Error error, const std::string& path) {
    error.context.push_back(path);
    return error;
}

Json region_json(const Region& region) {
    Json out{{"id", region.id}, {"name", region.name}, {"enabled", region.enabled}};
    Json keys = Json::array();
    for (const auto& [frame, key] : region.matte->keyframes)
        keys.push_back(frame);
    out["matte"] = {{"files", region.matte->files}, {"keyframes", keys}};
    out["holdouts"] = region.holdouts->size();
    out["texture"] = region.texture.plane.empty() ? region.texture.sample : region.texture.plane;
    return out;
}

}  // namespace

int new_command(const std::string& path, const Project& project, bool overwrite) {
    if (!overwrite && std::filesystem::exists(path)) {
        return report_error(
            {ErrorCode::kUsage, path + " exists already. Use --overwrite, or another name.", {}});
    }
    return saved(path, project);
}

int apply_command(const std::string& path, const std::string& actions, const std::string& library,
                  bool dry_run) {
    const auto project = load_project(path);
    if (!project) return report_error(project.error());
    const auto text = read_text(actions);
    if (!text) return report_error(text.error());
    const auto edits = edits_from_json(*text);
    if (!edits) return report_error(in_file(edits.error(), actions));
    const auto changed = apply_edits(*project, *edits);
    if (!changed) return report_error(in_file(changed.error(), actions));
    return dry_run ? 0 : saved_with_textures(path, changed, library);
}

int region_add_command(const std::string& path, Region region, const std::string& library) {
    const auto project = load_project(path);
    if (!project) return report_error(project.error());
    if (region.name.empty()) region.name = "region " + std::to_string(project->next_region_id);
    return saved_with_textures(path, apply_edit(*project, AddRegion{std::move(region), {}}),
                               library);
}

int region_set_command(const std::string& path, const Project& project, std::size_t index,
                       const Region& changed, const std::string& library) {
    const auto edits = region_edits(*project.regions[index], changed);
    return saved_with_textures(path, apply_edits(project, edits), library);
}

int region_correct_command(const std::string& path, const SetCorrection& edit) {
    const auto project = load_project(path);
    if (!project) return report_error(project.error());
    return saved(path, apply_edit(*project, edit));
}

int region_list_command(const std::string& path, bool json) {
    const auto project = load_project(path);
    if (!project) return report_error(project.error());
    Json list = Json::array();
    std::string text;
    for (const auto& region : project->regions) {
        const Json entry = region_json(*region);
        list.push_back(entry);
        text += std::to_string(region->id) + "  " + region->name +
                (region->enabled ? "" : " (off)") + "  " + entry["texture"].get<std::string>() +
                "\n";
    }
    print(stdout, json ? list.dump(2) + "\n" : text);
    return 0;
}

int info_command(const std::string& path, bool json) {
    const auto project = load_project(path);
    if (!project) return report_error(project.error());
    const auto shot = open_shot(resolve_paths(*project, project_dir(path)));
    if (!shot) return report_error(shot.error());
    const CachedReader& plate = *(*shot)->plate;
    Json regions = Json::array();
    for (const auto& region : project->regions)
        regions.push_back(region_json(*region));
    const Json info{
        {"project", path},
        {"name", project->name},
        {"plate",
         {{"path", project->plate.path},
          {"size", {plate.size().width, plate.size().height}},
          {"frames", format_frame_list(plate.frames())},
          {"fps", plate.fps()},
          {"space", (*shot)->spaces.plate.name}}},
        {"render",
         {{"frames", format_frame_list((*shot)->plan.frames)}, {"output", project->output.path}}},
        {"spaces", {{"working", (*shot)->spaces.working.name}, {"out", (*shot)->spaces.out.name}}},
        {"regions", regions},
        {"warnings", (*shot)->warnings}};
    if (json) {
        print(stdout, info.dump(2) + "\n");
        return 0;
    }
    print(stdout, path + "\nplate    " + project->plate.path + "  " +
                      std::to_string(plate.size().width) + "x" +
                      std::to_string(plate.size().height) + "  frames " +
                      format_frame_list(plate.frames()) + "  " + (*shot)->spaces.plate.name +
                      "\nrender   frames " + format_frame_list((*shot)->plan.frames) + "  to " +
                      project->output.path + "\nregions  " +
                      std::to_string(project->regions.size()) + "\n");
    return region_list_command(path, false);
}

int validate_command(const std::string& path, bool files) {
    const auto project = load_project(path);
    if (!project) return report_error(project.error());
    const auto issues = validate(*project);
    for (const Issue& issue : issues) {
        print(stdout, std::string(issue.severity == Severity::kError ? "error: " : "warning: ") +
                          issue.text() + "\n");
    }
    if (has_errors(issues)) return exit_code(ErrorCode::kUsage);
    if (files) {
        const auto shot = open_shot(resolve_paths(*project, project_dir(path)));
        if (!shot) return report_error(shot.error());
        if (const Status allowed = check_texture_licences(**shot); !allowed)
            return report_error(allowed.error());
        for (const std::string& warning : (*shot)->warnings)
            print(stdout, "warning: " + warning + "\n");
    }
    print(stdout, path + " is valid.\n");
    return 0;
}

}  // namespace weft
