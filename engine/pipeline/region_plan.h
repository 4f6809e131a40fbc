#pragma once
// What the pipeline needs to know of one region: plain settings, all paths and names resolved.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/compute/backend.h"
#include "engine/core/image.h"
#include "engine/lighting/light_source.h"
#include "engine/lighting/shading.h"
#include "engine/motion/optical_flow.h"
#include "engine/seam/seam.h"
#include "engine/temporal/placement.h"
#include "engine/temporal/temporal_mode.h"

namespace weft {

/// A texture as it was read: exactly one of `sample` (to be grown) and `plane` (used as it is).
struct TexturePicture {
    ImageF3 pixels;  ///< In the texture's own space.
    bool is_plane = false;
    WrapMode wrap = WrapMode::kRepeat;  ///< Beyond a given plane; grown planes repeat.
};

struct RegionPlan {
    std::uint64_t random_key = 0;  ///< Stable id of the region; enters the keys of random numbers.
    // Mattes: frame by frame, or painted on these frames (ascending) and propagated.
    std::vector<int> matte_keys;
    [[nodiscard]] bool propagated() const { return !matte_keys.empty(); }
    bool has_holdout = false;
    // Motion and placement.
    std::vector<int> reference_frames;  ///< The first holds the placement; at least one.
    bool true_motion = false;
    bool motion_forward = true;  ///< A file of true motion points to the next frame, else back.
    PlanePlacement placement;
    // Texture.
    std::shared_ptr<const TexturePicture> texture;
    std::shared_ptr<const ColorTransform> working_from_texture, display_from_texture,
        working_from_display;
    SeamMethod seam = SeamMethod::kGraphCut;
    int overlap_px = 36;
    int feather_px = 0;
    // Time.
    TemporalMode temporal = TemporalMode::kLocked;
    float blend = 0.2f;   ///< α of the paper mode.
    float weight = 1.0f;  ///< λ_t of the paper mode.
    // Light.
    LightSource light_source = LightSource::kPlate;
    std::shared_ptr<const ImageF3> light_picture;  ///< Linear light; for kImage.
    LightOptions light;
    // Ink on top: from a pass, or found in the plate.
    bool has_lines = false, extract_lines = false;
    float line_width_px = 4;
};

/// What holds for the whole shot.
struct ShotPlan {
    std::vector<int> frames;              ///< To be rendered, ascending.
    FlowQuality quality = FlowQuality::kFinal;
    std::uint64_t seed = 1;
    bool display_referred = true;  ///< The output rolls off above 1.
    std::shared_ptr<const ColorTransform> working_from_plate, display_from_plate, out_from_working,
        out_from_plate;
    std::vector<RegionPlan> regions;  ///< Lowest layer first.
};

}  // namespace weft
