#pragma once
// A region made ready to be rendered: its texture plane, its placement, the light it is relative
// to.

#include <array>
#include <memory>
#include <optional>

#include "engine/composite/texture_focus.h"
#include "engine/compute/plane_pyramid.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "engine/form/form_map.h"
#include "engine/lighting/highlights.h"
#include "engine/lighting/plate_exposure.h"
#include "engine/lighting/plate_transfer.h"
#include "engine/lighting/white_veil.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"
#include "engine/synthesis/texture_plane.h"
#include "engine/temporal/track_seam.h"

namespace weft {

struct RegionScene {
    PlanePyramid plane;      ///< Empty in the modes that make one for every frame.
    TextureMapping mapping;  ///< Of the still placement; with keys see mapping_on().
    /// The form as it was found; null: flat. The scene's frame is `smaller` times smaller.
    std::shared_ptr<const FormMap> form;
    float smaller = 1;
    float reference_shading = 1;        ///< S₀
    SurfaceLightRange reference_range;  ///< Of the frame that S₀ is from; light of the plate only.
    std::optional<Shading> picture_light;
    PlateExposure exposure;        ///< Of the reference frame.
    LightColour reference_colour;  ///< Of the plate's light on the reference frame.
    std::array<float, 3> tint{};   ///< plate_tint() or likely_tint() of the reference frame.
    SurfaceColours colours;        ///< Of the old surface there, where its highlights are kept.
    StillSurface still;            ///< What they move over; empty where that is not known.
    /// Whether reference_colour or tint changes anything.
    [[nodiscard]] bool light_has_colour() const {
        return reference_colour.known || tint != std::array<float, 3>{};
    }
    GrainModel grain;
    TextureFocus focus;  ///< Of the texture; measured where the plate's focus is matched.
    float focus_texels_per_px = 1;  ///< On the reference frame, where that was measured.
    float shutter_deg = 0;
    std::vector<TrackSeam> seams;     ///< Between the tracks from two references.
    std::optional<PlaneStats> stats;  ///< Of a grown plane.
    Matte plane_seams;                ///< Where a grown plane has seams (ShotPlan::layers).
    /// The grown plane itself, where ShotPlan::keep_planes asks for it.
    std::shared_ptr<const TexturePlane> grown;
};

/// The texture mapping of a frame: the scene's own, or that of the placement's keys. Errors: Usage,
/// as texture_mapping().
[[nodiscard]] Expected<TextureMapping> mapping_on(const RegionPlan& region,
                                                  const RegionScene& scene, int frame);

/// The region's grade, on the plate's exposure.
[[nodiscard]] Grade grade_on(const RegionPlan& region, const RegionScene& scene);
/// What a white texture is in the fullest light on the region, before the artist's own grade; 1
/// where the exposure is not matched.
[[nodiscard]] float fullest_white(const RegionPlan& region, const RegionScene& scene);

/// The size of the plane that a region's sample is grown to: somewhat more than the plate at the
/// placement's scale, between 512 and 4096 texels a side. It joins at its borders and repeats. It
/// depends on the plate and the placement only, so that every part of a shot gets the same plane.
[[nodiscard]] Size plane_size(const PlanePlacement& placement, Size plate);

/// How many finer levels the pyramid of a plane of that size gets: two for one that covers a plate
/// of 1920×1080 about four times enlarged, one down to 1.3 times, as long as the finest has at most
/// 8 million texels (128 MB).
[[nodiscard]] int finer_levels(Size plane);

/// A region's texture, ready to be looked up.
struct RegionPlane {
    PlanePyramid pyramid;
    std::optional<PlaneStats> stats;            ///< If it was grown.
    Matte seams;                                ///< As RegionScene::plane_seams.
    std::shared_ptr<const TexturePlane> grown;  ///< As RegionScene::grown.
};

/// Whether a region has one plane for the whole shot.
[[nodiscard]] bool has_plane(const RegionPlan& region);
/// Grows it, with the backend's search if it has one, or takes the one that is given. Needs nothing
/// of the analysis, so it may go on beside that.
[[nodiscard]] Expected<RegionPlane> make_plane(const ShotPlan& plan, const RegionPlan& region,
                                               Size plate, const CancelToken& cancel,
                                               const ProgressFn& progress,
                                               const Backend* backend = nullptr);

/// Makes the region's plane unless it is handed in as `made`, and takes S₀ from the analysis of its
/// (first) reference frame.
[[nodiscard]] Expected<RegionScene> make_scene(const ShotSource& source, const ShotPlan& plan,
                                               const AnalysisStore& store, int region,
                                               const CancelToken& cancel,
                                               const ProgressFn& progress,
                                               const Backend* backend = nullptr,
                                               std::optional<RegionPlane> made = std::nullopt);

/// A plane's pixels in the working space: each texel takes the sample's pixel that its source map
/// names, at the sample's full precision; what feathering changed in 8 bit is added.
[[nodiscard]] ImageF3 plane_in_working_space(const RegionPlan& region, const TexturePlane& plane);

}  // namespace weft
