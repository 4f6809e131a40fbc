#pragma once
// The pipeline's source of pictures. The pipeline itself opens no file.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/alpha.h"
#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/form/view_camera.h"
#include "engine/mask/confirmed_part.h"

namespace weft {

/// What a renderer's normal pass shows of a frame, with its camera.
struct NormalPass {
    ImageF3 normals;    ///< H×W×3, of any length; zero or not finite: unknown.
    ViewCamera camera;  ///< Of the picture unsqueezed.
    std::array<double, 9> camera_from_world{};  ///< As view_normals() takes it.
};

/// The pictures of a shot. All functions may be called from several threads.
class ShotSource {
  public:
    virtual ~ShotSource() = default;
    [[nodiscard]] virtual Size size() const = 0;
    /// The decoded plate, H×W×3, in the plate's own space; NaN and infinity as they stand.
    [[nodiscard]] virtual Expected<std::shared_ptr<const ImageF3>> plate(int frame) const = 0;
    /// The alpha of the plate's frame, of its size. A source of opaque plates need not override it.
    [[nodiscard]] virtual Expected<PlateAlpha> alpha(int /*frame*/) const { return PlateAlpha(); }
    /// The full matte of a region, if mattes are given frame by frame.
    [[nodiscard]] virtual Expected<Matte> matte(int region, int frame) const = 0;
    /// A painted matte keyframe (RegionPlan::matte_keys names the frames).
    [[nodiscard]] virtual Expected<Matte> matte_key(int region, int frame) const = 0;
    /// A painted key of a holdout (RegionPlan::painted_holdouts). A source without any need not
    /// override it.
    [[nodiscard]] virtual Expected<Matte> holdout_key(int region, int painted, int frame) const;
    /// What is confirmed of a painted matte (PaintedMatte::confirmed; `layer` as in AnalysisKey). A
    /// source without any need not override it.
    [[nodiscard]] virtual Expected<ConfirmedPart> confirmed_part(int region, int layer,
                                                                 int frame) const;
    /// The maximum of the region's holdouts that come from files; empty if it has none.
    [[nodiscard]] virtual Expected<std::optional<Matte>> holdout(int region, int frame) const = 0;
    /// One of them (RegionPlan::given_holdout_edges). A source whose holdouts have no edge tools
    /// need not override it.
    [[nodiscard]] virtual Expected<Matte> given_holdout(int region, int given, int frame) const;
    /// The matte of a region's zone (RegionPlan::zones) from its files, and a painted key of it. A
    /// source that has none need not override them.
    [[nodiscard]] virtual Expected<Matte> zone(int region, int zone, int frame) const;
    [[nodiscard]] virtual Expected<Matte> zone_key(int region, int zone, int frame) const;
    /// The ink's coverage from the region's line pass (RegionPlan::has_lines); empty without one.
    [[nodiscard]] virtual Expected<Matte> lines(int /*region*/, int /*frame*/) const {
        return Matte();
    }
    /// The true motion of this frame in pixels, to the next or the previous one as
    /// RegionPlan::motion_forward says.
    [[nodiscard]] virtual Expected<FlowField> motion(int region, int frame) const = 0;
    /// The region's UV pass (RegionPlan::has_uv): H×W×2 of the plate's size, 0–1, origin bottom
    /// left.
    [[nodiscard]] virtual Expected<ImageF2> uv(int region, int frame) const;
    /// The region's places (RegionPlan::FormFrom::kPositions): H×W×3 of the plate's size, the place
    /// of the surface at each pixel in one unit of length; what is unknown is not finite. A source
    /// that has none need not override it.
    [[nodiscard]] virtual Expected<ImageF3> positions(int region, int frame) const;
    /// The region's normal pass (RegionPlan::FormFrom::kNormals).
    [[nodiscard]] virtual Expected<NormalPass> normals(int region, int frame) const;
    /// The region's depth pass (RegionPlan::has_depth) as nearness, of the plate's size: the
    /// reciprocal of a distance, or a coded picture's value as it is. Empty without one.
    [[nodiscard]] virtual Expected<ImageF1> depth(int /*region*/, int /*frame*/) const {
        return ImageF1();
    }
    /// The artist's albedo or lighting pass (RegionPlan::light_pass) in linear light, of the
    /// plate's size. A source without one need not override it.
    [[nodiscard]] virtual Expected<ImageF3> light_pass(int region, int frame) const;
};

}  // namespace weft
