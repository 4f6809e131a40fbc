#pragma once
// What a render was made with, in a form that says the same on every machine: written into every
// frame, and, with all that is needed to make it again, into a file of its own.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

/// 32 hexadecimal digits over all that decides about a frame's pixels and its file: the settings of
/// the enabled regions and of the output, textures by their pixels, colour spaces. Folders, names,
/// the frames chosen, dates and hosts do not enter, so that parts of a shot agree.
[[nodiscard]] std::string settings_hash(const Shot& shot);

/// Names and texts for a frame's header: "weft:version", "weft:settings", "weft:backend",
/// "weft:seed", "weft:textures", "weft:licences". The same for all frames of a render.
using Metadata = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] Metadata recipe_metadata(const Shot& shot, const std::string& backend);

/// The recipe file (docs/FORMATS.md) as JSON: the project with absolute paths, every input and
/// every frame with a hash of its bytes. Errors: those of reading the files.
[[nodiscard]] Expected<std::string> recipe_json(const Shot& shot, const JobResult& result);

/// What is left to be proved of a recipe.
struct VerifyOptions {
    std::string recipe;  ///< Path of the recipe file.
    std::string frames;  ///< A list; empty: all that the recipe has.
    bool rerender = true;
    JobSpec run;  ///< How to render again: threads, cache, library.
};
struct VerifyResult {
    std::vector<std::string> differences;  ///< One line each; empty: proved.
    std::vector<std::string> warnings;
    int frames = 0, inputs = 0;
};
/// Whether inputs and frames are the very bytes that the recipe names and, with `rerender`, whether
/// rendering again gives them. Errors: those of reading the recipe and of rendering.
[[nodiscard]] Expected<VerifyResult> verify_recipe(const VerifyOptions& options,
                                                   const CancelToken& cancel,
                                                   const ProgressFn& progress);

}  // namespace weft
