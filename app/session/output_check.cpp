#include "app/session/output_check.h"

#include <filesystem>
#include <vector>

#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

void add_pattern(std::vector<std::string>& paths, const std::string& text, int frame) {
    if (text.empty()) return;
    if (const auto pattern = SequencePattern::parse(text))
        paths.push_back(pattern->path_for(frame));
}

void add_matte(std::vector<std::string>& paths, const MatteSource& matte, int frame) {
    add_pattern(paths, matte.files, frame);
    for (const auto& [key_frame, key] : matte.keyframes)
        paths.push_back(key.path);
}

std::vector<std::string> inputs_of(const Shot& shot, int frame) {
    std::vector<std::string> paths{shot.plate->path_of(frame)};
    for (const auto& region : shot.project.regions) {
        add_matte(paths, *region->matte, frame);
        for (const MatteSource& holdout : *region->holdouts)
            add_matte(paths, holdout, frame);
        add_pattern(paths, region->motion.files, frame);
        add_pattern(paths, region->lines.files, frame);
    }
    return paths;
}

}  // namespace

Status check_no_input(const Shot& shot, int frame, const std::string& output) {
    std::error_code error;
    if (!fs::exists(output, error)) return {};
    for (const std::string& input : inputs_of(shot, frame)) {
        if (!fs::equivalent(input, output, error)) continue;
        return fail(ErrorCode::kUsage, "The output " + output +
                                           " would overwrite an input of the shot. Choose another "
                                           "folder with -o.");
    }
    return {};
}

Status make_output_folder(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::error_code error;
    if (!folder.empty()) std::filesystem::create_directories(folder, error);
    if (!error) return {};
    return fail(ErrorCode::kUnreadable, "The output folder " + folder.string() +
                                            " cannot be made: " + error.message() +
                                            ". Choose another with -o.");
}

}  // namespace weft
