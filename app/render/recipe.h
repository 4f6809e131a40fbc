#pragma once
// The recipe of a render: its settings in a machine-independent form, written into every frame, and
// with everything needed to repeat the render into a file.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/render/render_job.h"

namespace weft {

/// A hash (32 hexadecimal digits) of everything that determines a frame's pixels and file: settings
/// of enabled regions and the output, texture pixels, colour spaces. Folders, names, frame range,
/// dates and hosts are excluded, so parts of a shot have equal hashes.
[[nodiscard]] std::string settings_hash(const Shot& shot);

/// Names and values for a frame's header: "weft:version", "weft:settings", "weft:backend",
/// "weft:seed", "weft:textures", "weft:licences". Equal for all frames of a render; a frame has
/// "weft:inputs" besides (input_hashes.h).
using Metadata = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] Metadata recipe_metadata(const Shot& shot, const std::string& backend);

/// The recipe file (docs/FORMATS.md) as JSON: the project with absolute paths, and every input and
/// frame with a hash of its bytes. Errors: those of reading the files.
[[nodiscard]] Expected<std::string> recipe_json(const Shot& shot, const JobResult& result);

/// Which frames of a recipe to verify, and how.
struct VerifyOptions {
    std::string recipe;  ///< Path of the recipe file.
    std::string frames;  ///< Frame list; empty: all frames of the recipe.
    bool rerender = true;
    JobSpec run;  ///< Options for rendering again: threads, cache, library.
};
struct VerifyResult {
    std::vector<std::string> differences;  ///< One line each; empty: verified.
    std::vector<std::string> warnings;
    int frames = 0, inputs = 0;
};
/// Compares the bytes of inputs and frames with the recipe and, with `rerender`, with frames
/// rendered again. Errors: those of reading the recipe and of rendering.
[[nodiscard]] Expected<VerifyResult> verify_recipe(const VerifyOptions& options,
                                                   const CancelToken& cancel,
                                                   const ProgressFn& progress);

}  // namespace weft
