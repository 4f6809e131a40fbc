#include "app/shot/shot_inputs.h"

#include <filesystem>
#include <set>

#include "engine/media/sequence_pattern.h"

namespace weft {

Expected<std::vector<std::string>> input_files(const Shot& shot) {
    namespace fs = std::filesystem;
    std::set<std::string> files;
    std::error_code ignored;
    // A dangling link may be a frame that is not needed.
    const auto add = [&](const std::string& path) {
        if (fs::is_regular_file(path, ignored)) files.insert(path);
    };
    Status status;
    Project inputs = shot.project;
    inputs.output = {};
    static_cast<void>(map_paths(inputs, [&](const std::string& path) {
        if (path == shot.project.plate.path || names_library_texture(path) || !status) return path;
        if (fs::is_regular_file(path, ignored)) {
            files.insert(path);
            return path;
        }
        const auto pattern = SequencePattern::parse(path);
        if (!pattern || pattern->is_single()) return path;
        const auto frames = pattern->list_frames();
        if (!frames) {
            status = tl::unexpected(frames.error());
            return path;
        }
        for (const int frame : *frames)
            add(pattern->path_for(frame));
        return path;
    }));
    WEFT_CHECK_OK(status);
    for (const int frame : shot.plate->frames())
        add(shot.plate->path_of(frame));
    return std::vector<std::string>(files.begin(), files.end());
}

}  // namespace weft
