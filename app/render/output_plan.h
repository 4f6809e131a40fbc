#pragma once
// Checks all outputs of a job against its inputs, existing files and each other before any work.

#include <optional>
#include <string>
#include <vector>

#include "app/render/render_job.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

struct OutputPlan {
    SequencePattern frames;
    std::optional<SequencePattern> layers;  ///< Pattern of separate layer files.
    std::vector<int> numbers;
    Size size;                          ///< Size of the images.
    std::string movie, report, recipe;  ///< Empty: none.
    std::optional<SequencePattern> st_maps = {};
    std::string plane = {};                    ///< Picture of the texture plane; empty: none.
    std::vector<std::string> composites = {};  ///< composite_outputs().
};

/// Write rules of the files other than frames.
struct OutputRules {
    WriteRule movie, report, recipe, plane;
    std::vector<WriteRule> composites = {};
};

/// How output folders are treated before any work.
enum class OutputFolders {
    kMake,
    kLeave  ///< Create nothing, because another run will.
};

/// Creates the folders of all outputs and deletes temporary files of killed runs. `frames`: the
/// write rule of the frames. With --resume and --skip-existing, only reports, recipes, movies,
/// layers, ST-maps, planes and composites written by Weft may be replaced; frames_to_keep() decides
/// about frames. Errors: Usage (an output is an input, lies outside the root, equals another
/// output, or exists), Unreadable, NoSpace.
[[nodiscard]] Expected<OutputRules> check_outputs(const OutputPlan& plan, ExistingFrames existing,
                                                  const WriteRule& frames, OutputFolders folders);

}  // namespace weft
