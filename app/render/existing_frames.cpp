#include "app/render/existing_frames.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

using Texts = std::map<std::string, std::string>;

// Errors: Usage for another backend.
Expected<bool> same_recipe(const std::string& path, Texts& wanted) {
    Texts had = read_recipe_metadata(path);
    for (const char* key : {"weft:version", "weft:settings"}) {
        if (had[key].empty() || had[key] != wanted[key]) return false;
    }
    if (had["weft:backend"] == wanted["weft:backend"]) return true;
    return fail(ErrorCode::kUsage, path + " was rendered on the backend '" + had["weft:backend"] +
                                       "', this run would use '" + wanted["weft:backend"] +
                                       "', and the two may differ by a level. Use that backend" +
                                       by({{setting::kBackend, had["weft:backend"]}}) +
                                       ", or render all frames again" + by({{setting::kRestart}}) +
                                       ".");
}

Error already_there(const std::string& first, std::size_t count) {
    return {ErrorCode::kUsage,
            first + " exists already" +
                (count > 1 ? ", and " + std::to_string(count - 1) + " more" : "") +
                ". Resume, overwrite or skip" +
                by({{setting::kResume}, {setting::kOverwrite}, {setting::kSkipExisting}}) +
                ", or use another folder.",
            {}};
}

}  // namespace

bool is_frame_of_weft(const std::string& path) {
    return !read_recipe_metadata(path)["weft:settings"].empty();
}

Error not_of_weft(const std::string& path) {
    return {ErrorCode::kUsage,
            path +
                " was not rendered by Weft and would be replaced. Move it, choose another folder, "
                "or overwrite it" +
                by({{setting::kOverwrite}}) + ".",
            {}};
}

Expected<std::vector<int>> frames_to_keep(
    const SequencePattern& pattern, const std::vector<int>& frames, Size size,
    ExistingFrames existing, const std::vector<std::pair<std::string, std::string>>& recipe) {
    std::vector<int> present, kept;
    std::error_code ignored;
    for (const int frame : frames) {
        // A dangling link also counts as an existing file.
        if (fs::exists(fs::symlink_status(pattern.path_for(frame), ignored)))
            present.push_back(frame);
    }
    if (existing == ExistingFrames::kOverwrite || present.empty()) return kept;
    if (existing == ExistingFrames::kRefuse)
        return tl::unexpected(already_there(pattern.path_for(present.front()), present.size()));
    Texts wanted(recipe.begin(), recipe.end());
    for (const int frame : present) {
        const std::string path = pattern.path_for(frame);
        if (existing == ExistingFrames::kResume) {
            if (!is_frame_of_weft(path)) return tl::unexpected(not_of_weft(path));
            WEFT_TRY(same, same_recipe(path, wanted));
            if (!same) continue;
        }
        const auto image = read_image(path);
        if (image && image->rgb.size() == size) {
            kept.push_back(frame);
        } else if (image && !is_frame_of_weft(path)) {
            return tl::unexpected(not_of_weft(path));
        }
    }
    return kept;
}

}  // namespace weft
