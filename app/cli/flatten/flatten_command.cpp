#include "app/cli/flatten/flatten_command.h"

#include <filesystem>

#include "app/exchange/flat_picture.h"
#include "app/exchange/move_project.h"
#include "app/project/codec/project_file.h"
#include "app/project/codec/update_project.h"
#include "app/project/edit.h"
#include "engine/core/printable.h"
#include "engine/media/image_files.h"
#include "engine/media/plates.h"

namespace weft {
namespace {

nlohmann::ordered_json layout_json(const FlatLayout& layout) {
    return {{"width", layout.size().width},
            {"height", layout.size().height},
            {"scale", layout.texels_per_px},
            {"margin_px", layout.margin_px}};
}

std::string layout_text(const FlatLayout& layout) {
    return std::to_string(layout.size().width) + "x" + std::to_string(layout.size().height) +
           " texels, " + std::to_string(layout.texels_per_px) + " a plate pixel, margin " +
           std::to_string(layout.margin_px) + " px";
}

// As the project names a file that the user named from the current folder.
std::string name_in_project(const std::string& project, const std::string& picture) {
    return relative_to(absolute_path(project_dir(project).empty() ? "." : project_dir(project)),
                       absolute_path(picture));
}

}  // namespace

CommandResult flatten_command(const FlattenSpec& spec, ProgressStyle progress) {
    WEFT_TRY(result, run_flatten(spec, cancel_on_signals(), progress_printer(progress)));
    for (const std::string& note : result.notes)
        print(stderr, "weft: " + note + "\n");
    for (const std::string& warning : result.warnings)
        print_warning(warning);
    Answer answer;
    answer.json["path"] = absolute_path(spec.path);
    answer.json["region"] = result.region;
    answer.json["reference_frame"] = result.reference;
    answer.json["picture"] = layout_json(result.layout);
    answer.json["frames"] = result.frames;
    answer.json["covered"] = result.covered;
    answer.json["few_frames"] = result.few_frames;
    answer.json["layers"] = result.layers;
    answer.json["warnings"] = result.warnings;
    char line[160];
    std::snprintf(line, sizeof line,
                  ", from %zu frames; %.1f %% of it covered, %.1f %% of that by one or two frames",
                  result.frames.size(), 100 * result.covered, 100 * result.few_frames);
    answer.text = printable(result.region) + ": " + layout_text(result.layout) + line + "\n";
    return answer;
}

CommandResult flatten_back_command(const std::string& project, const std::string& region,
                                   const std::string& picture) {
    WEFT_TRY(painted, read_image(picture));
    FlatLayout layout;
    std::string name;
    const auto edit = [&](const Project& before) -> Expected<Project> {
        WEFT_TRY(index, find_region(before, region));
        const Region& old = *before.regions[index];
        name = old.name;
        const Project resolved = resolve_paths(before, project_dir(project));
        ReadOptions options;
        options.layer = resolved.plate.layer;
        options.movie_start = resolved.plate.movie_start;
        WEFT_TRY(plate, open_plate(resolved.plate.path, options));
        auto found = flat_layout_of(painted.rgb.size(), plate->size());
        if (!found) return fail_in(std::move(found).error(), picture);
        layout = *found;
        // What the project says of its textures does not hold for this file.
        const std::string space = before.color.texture_space.empty() ? "" : painted.color.space;
        const Region after =
            with_flat_picture(old, name_in_project(project, picture), layout, space);
        return apply_edits(before, region_edits(old, after));
    };
    WEFT_CHECK_OK(update_project(project, edit));
    Answer answer;
    answer.json["path"] = absolute_path(project);
    answer.json["region"] = name;
    answer.json["texture"] = absolute_path(picture);
    answer.json["picture"] = layout_json(layout);
    answer.text =
        printable(name) + " shows " + printable(picture) + " (" + layout_text(layout) + ")\n";
    return answer;
}

}  // namespace weft
