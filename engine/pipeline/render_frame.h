#pragma once
#include <optional>
#include <vector>

#include "engine/compute/backend.h"
#include "engine/pipeline/frame_layers.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

struct RenderedFrame {
    ImageF3 pixels;              ///< In the output space, as associated as the plate; where no
                                 ///< matte reaches, the plate's own values (through
                                 ///< out_from_plate, if that is not the identity).
    Matte touched;               ///< The union of all mattes.
    std::int64_t above_one = 0;  ///< Pixels that would have clipped and were rolled off.
    std::optional<FrameLayers> layers;  ///< Where ShotPlan::layers asks for them.
    std::int64_t filled = 0;            ///< NaN or infinite plate pixels that a region filled.
    bool burnt_out = false;             ///< A region shows nothing but white, as the plate does.
};

/// Renders one frame. A pure function of its arguments: frames may be rendered in any order, from
/// several threads, on several machines.
[[nodiscard]] Expected<RenderedFrame> render_frame(const ShotSource& source, const ShotPlan& plan,
                                                   const std::vector<RegionScene>& scenes,
                                                   const AnalysisStore& store,
                                                   const Backend& backend, int frame);

}  // namespace weft
