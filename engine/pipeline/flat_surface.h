#pragma once
// A still, unlit picture of a surface without grain, from the frames that show it.

#include <cstdint>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "engine/pipeline/flat_view.h"

namespace weft {

/// Of the layout's size.
struct FlatSurface {
    ImageF3 colour;  ///< Working space, of a texture; where nothing is known, what is around.
    Matte coverage;  ///< 255 where a frame shows the place, else 0.
    Image<std::uint8_t, 1> frames;  ///< How many frames agree about a place, at most 255.
};

struct FlatInputs {
    const ShotSource& source;
    const ShotPlan& plan;  ///< Analysed on `frames`, with the plate's light.
    const AnalysisStore& store;
    int region = 0;
    const RegionScene& scene;
    const Backend& backend;
    std::vector<int> frames;
};

/// The margin that holds what the frames show beyond the reference frame: 0, or whole sixteenths,
/// at most half the reference frame's smaller side. Errors: as unlit_frame(); cancellation.
[[nodiscard]] Expected<int> flat_margin(const FlatInputs& inputs, const CancelToken& cancel);

/// Gathers the frames. What differs from most of what a place shows over time (a shadow that
/// passes, gloss, an edge that a matte missed) does not count: an M-estimate about the median, as
/// mosaics are made (Szeliski 2006, "Image alignment and stitching", 5.3). What a render of the
/// picture then lacks of each frame is put back on it a few times (iterative back-projection, Irani
/// & Peleg 1991), since a pixel shows the mean of the texels under it. Takes about 16 bytes a texel
/// and frame, at most 512 MB, and as much for the frames. The same bytes for any number of threads.
/// Errors: the same; RenderFailed if no frame shows anything.
[[nodiscard]] Expected<FlatSurface> gather_flat_surface(const FlatInputs& inputs,
                                                        const FlatLayout& layout,
                                                        const CancelToken& cancel,
                                                        const ProgressFn& progress);

}  // namespace weft
