#pragma once
// All that a job will write, checked against its inputs, what exists, and each other, before any
// work is done.

#include <optional>
#include <string>
#include <vector>

#include "app/render/render_job.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

struct OutputPlan {
    SequencePattern frames;
    std::optional<SequencePattern> layers;  ///< Of files of their own.
    std::vector<int> numbers;
    Size size;                          ///< Of the pictures.
    std::string movie, report, recipe;  ///< Empty: none.
};

/// By which the files beside the frames are written.
struct OutputRules {
    WriteRule movie, report, recipe;
};

/// What happens to the folders of outputs before any work is done.
enum class OutputFolders {
    kMake,
    kLeave  ///< Nothing is made: another run will do the work.
};

/// Makes the folders of all outputs, and clears away what killed runs left there.
/// `frames`: the rule of the frames. With --resume and --skip-existing only reports, recipes,
/// movies and layers that Weft wrote may be replaced. What becomes of frames that exist is for
/// frames_to_keep(). Errors: Usage (an input, a place outside of the root, two outputs in one file,
/// a file that is there), Unreadable, NoSpace.
[[nodiscard]] Expected<OutputRules> check_outputs(const OutputPlan& plan, ExistingFrames existing,
                                                  const WriteRule& frames, OutputFolders folders);

}  // namespace weft
