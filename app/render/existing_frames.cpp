#include "app/render/existing_frames.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "app/render/input_hashes.h"
#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

using Texts = std::map<std::string, std::string>;

// Frames of an earlier run that are rendered again, by the reason.
struct Outdated {
    std::vector<int> settings, unknown, inputs;
    std::vector<std::string> changed;  // what of `inputs` changed, in words

    [[nodiscard]] std::vector<std::string> notes() const {
        std::vector<std::string> out;
        if (!inputs.empty()) {
            std::string what;
            for (std::size_t k = 0; k < changed.size(); ++k)
                what += (k == 0 ? "" : k + 1 == changed.size() ? " and " : ", ") + changed[k];
            what[0] = 'T';  // of "the"
            out.push_back(what + " changed since " + frames_text(inputs) +
                          (inputs.size() == 1 ? " was" : " were") + " rendered: " + again(inputs));
        }
        if (!unknown.empty()) {
            out.push_back("An earlier Weft rendered " + frames_text(unknown) +
                          " and did not write down from which inputs; they may have changed: " +
                          again(unknown));
        }
        if (!settings.empty()) {
            std::string which = frames_text(settings);
            which[0] = 'F';
            out.push_back(
                which + (settings.size() == 1 ? " was" : " were") +
                " rendered with other settings or by another version of Weft: " + again(settings));
        }
        return out;
    }

  private:
    static std::string again(const std::vector<int>& frames) {
        return frames.size() == 1
                   ? "it is rendered again."
                   : "these " + std::to_string(frames.size()) + " are rendered again.";
    }
};

// Whether the frame is the one that would be rendered now; if not, adds it to `outdated`. Errors:
// Usage for another backend.
Expected<bool> is_current(const std::string& path, int frame, const WantedRecipe& recipe,
                          Outdated& outdated) {
    Texts had = read_recipe_metadata(path);
    Texts wanted(recipe.metadata.begin(), recipe.metadata.end());
    const auto at = recipe.inputs.find(frame);
    const std::string inputs = at == recipe.inputs.end() ? std::string() : at->second;
    const std::string& made_from = had["weft:inputs"];
    // First the inputs: a changed texture changes the settings too.
    const std::vector<std::string> changed = changed_inputs(made_from, inputs);
    if (!made_from.empty() && !changed.empty()) {
        outdated.inputs.push_back(frame);
        for (const std::string& what : changed)
            if (std::find(outdated.changed.begin(), outdated.changed.end(), what) ==
                outdated.changed.end())
                outdated.changed.push_back(what);
        return false;
    }
    for (const char* key : {"weft:version", "weft:settings"}) {
        if (!had[key].empty() && had[key] == wanted[key]) continue;
        outdated.settings.push_back(frame);
        return false;
    }
    if (made_from != inputs) {
        outdated.unknown.push_back(frame);
        return false;
    }
    if (had["weft:backend"] == wanted["weft:backend"]) return true;
    return fail(ErrorCode::kUsage,
                path + " was rendered on the backend '" + had["weft:backend"] +
                    "', this run would use '" + wanted["weft:backend"] +
                    "', and the two may differ by a level.",
                "Use that backend" + by({{setting::kBackend, had["weft:backend"]}}) +
                    ", or render all frames again" + by({{setting::kRestart}}) + ".");
}

Error already_there(const std::string& first, std::size_t count) {
    return {ErrorCode::kUsage,
            first + " exists already" +
                (count > 1 ? ", and " + std::to_string(count - 1) + " more" : "") + ".",
            "Resume, overwrite or skip" +
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
            path + " was not rendered by Weft and would be replaced.",
            "Move it, choose another folder, or overwrite it" + by({{setting::kOverwrite}}) + ".",
            {}};
}

Expected<KeptFrames> frames_to_keep(const SequencePattern& pattern, const std::vector<int>& frames,
                                    Size size, ExistingFrames existing,
                                    const WantedRecipe& recipe) {
    KeptFrames kept;
    std::vector<int> present;
    std::error_code ignored;
    for (const int frame : frames) {
        // A dangling link also counts as an existing file.
        if (fs::exists(fs::symlink_status(pattern.path_for(frame), ignored)))
            present.push_back(frame);
    }
    if (existing == ExistingFrames::kOverwrite || present.empty()) return kept;
    if (existing == ExistingFrames::kRefuse)
        return tl::unexpected(already_there(pattern.path_for(present.front()), present.size()));
    Outdated outdated;
    for (const int frame : present) {
        const std::string path = pattern.path_for(frame);
        if (existing == ExistingFrames::kResume) {
            if (!is_frame_of_weft(path)) return tl::unexpected(not_of_weft(path));
            WEFT_TRY(current, is_current(path, frame, recipe, outdated));
            if (!current) continue;
        }
        const auto image = read_image(path);
        if (image && image->rgb.size() == size) {
            kept.frames.push_back(frame);
        } else if (image && !is_frame_of_weft(path)) {
            return tl::unexpected(not_of_weft(path));
        }
    }
    kept.notes = outdated.notes();
    return kept;
}

}  // namespace weft
