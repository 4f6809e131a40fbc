#include "app/cli/motion/motion_command.h"

#include "engine/core/printable.h"

namespace weft {

CommandResult motion_command(const MotionJobSpec& spec, ProgressStyle progress) {
    WEFT_TRY(result, run_motion_job(spec, cancel_on_signals(), progress_printer(progress)));
    for (const std::string& note : result.notes)
        print(stderr, "weft: " + note + "\n");
    for (const std::string& warning : result.warnings)
        print_warning(warning);
    Answer answer;
    answer.json = nlohmann::ordered_json::parse(result.manifest);
    answer.json["path"] = absolute_path(spec.folder);
    answer.json["pictures_written"] = result.written;
    answer.json["pictures_kept"] = result.kept;
    answer.json["warnings"] = result.warnings;
    for (const auto& region : answer.json["regions"]) {
        answer.text += printable(region["name"].get<std::string>()) + ": reference frame " +
                       std::to_string(region["reference_frame"].get<int>());
        if (region.contains("corner_pin")) {
            char line[96];
            const auto& off = region["corner_pin"]["off_plane_px"];
            std::snprintf(line, sizeof line, ", off a plane's motion %.2f px (median), %.2f (p90)",
                          off["median"].get<double>(), off["p90"].get<double>());
            answer.text += line;
        }
        if (region.contains("mesh"))
            answer.text += region["mesh"]["depth"] ? ", a mesh with depth" : ", a flat mesh";
        if (region.contains("roto")) {
            char line[96];
            const auto& roto = region["roto"];
            std::snprintf(line, sizeof line, ", %zu roto shapes, off the matte %.2f px (mean)",
                          roto["shapes"].size(), roto["off_matte_px"]["mean"].get<double>());
            answer.text += line;
        }
        answer.text += "\n";
    }
    return answer;
}

}  // namespace weft
