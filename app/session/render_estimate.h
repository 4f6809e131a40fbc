#pragma once
// What a render will take, before it is begun.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/project/project.h"
#include "engine/core/geometry.h"

namespace weft {

struct RenderOutlook {
    double seconds = 0;
    std::int64_t memory_bytes = 0, disk_bytes = 0;
};

struct OutlookInputs {
    Size size;                    ///< Of the plate.
    std::size_t frames = 0;       ///< To be rendered.
    std::size_t analysed = 0;     ///< To be analysed for them; 0: that is done.
    std::size_t regions = 0;      ///< That are enabled.
    bool motion_given = false;    ///< Of all of them, by files; else it is estimated.
    bool mattes_painted = false;  ///< Of any of them, so that they are propagated.
    Quality quality = Quality::kFinal;
    std::string_view extension;  ///< Of the pictures: "png", "exr", …
    unsigned threads = 2;
    double speed = 1;  ///< Of this machine against the one that was measured, as learnt_speed().
};

/// How many frames the analysis for frames `first` to `last` goes through: on to the references,
/// corrections and painted mattes of the regions that are enabled.
[[nodiscard]] std::size_t analysed_frames(const Project& project, int first, int last);
/// Fills in what the regions that are enabled have.
void count_regions(const Project& project, OutlookInputs& in);

/// Time and disk to a factor of about two, memory to about a quarter; on the CPU. From clips that
/// were timed on two cores (docs/BENCHMARKS.md). Pure.
[[nodiscard]] RenderOutlook render_outlook(const OutlookInputs& in);

/// `speed` after a render that was to take `foreseen_s` took `took_s`: halfway to what would have
/// been right, between 1/20 and 20. Pure.
[[nodiscard]] double learnt_speed(double speed, double foreseen_s, double took_s);

}  // namespace weft
