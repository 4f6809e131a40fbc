#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace weft {

/// One step of a longer work. `done` never falls and never exceeds `total`, in units of the work.
struct ProgressEvent {
    std::string stage;  ///< "analyse", "synthesise", "render", …
    std::int64_t done = 0;
    std::int64_t total = 0;
    int frame = 0;       ///< The frame that was just finished, where the stage has frames.
    double seconds = 0;  ///< What that frame took.
};

/// Called from the thread that finishes a step, one call at a time.
using ProgressFn = std::function<void(const ProgressEvent&)>;

}  // namespace weft
