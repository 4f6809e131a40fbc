#pragma once
// The texture as a region shows it in one frame, before light.

#include <optional>

#include "engine/compute/backend.h"
#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// A place of a plane for every pixel of a box.
struct SurfaceLookup {
    TextureCoords coords;
    const PlanePyramid* plane = nullptr;
    std::optional<PlanePyramid> own = {};  ///< A plane of this frame alone.

    [[nodiscard]] const PlanePyramid* shown() const { return own ? &*own : plane; }
};

/// Refers to what it is given, which must outlive it. Thread-safe as far as the store and the
/// backend are.
class RegionSurface {
  public:
    RegionSurface(const ShotPlan& plan, int index, const RegionScene& scene,
                  const AnalysisStore& store, const Backend& backend, int frame, Size plate)
        : plan_(plan),
          region_(plan.regions[static_cast<std::size_t>(index)]),
          index_(index),
          scene_(scene),
          store_(store),
          backend_(backend),
          frame_(frame),
          plate_(plate) {}

    /// From now on the texture is looked up at these places, whatever the analysis found: those of
    /// a UV pass. `exact` must outlive the surface.
    void use_coords(const TextureCoords& exact) { exact_ = &exact; }
    /// Whether one lookup for each pixel gives the texture: there is no motion blur, and no seam
    /// between the tracks of two references.
    [[nodiscard]] bool is_one_lookup() const;
    /// That lookup.
    [[nodiscard]] Expected<SurfaceLookup> lookup(const Recti& box) const;
    /// The texture in the working space, H×W of `box`; unspecified where `matte` (of that size) is
    /// 0.
    [[nodiscard]] Expected<ImageF3> texture(const Recti& box, const Matte& matte) const;
    [[nodiscard]] SampleQuality quality() const {
        return plan_.quality == FlowQuality::kDraft ? SampleQuality::kDraft : SampleQuality::kFinal;
    }

  private:
    [[nodiscard]] Expected<LatticeField> stored(AnalysisKind kind) const;
    [[nodiscard]] Expected<TextureMapping> mapping() const;
    // How the surface moves while the shutter is open, px a frame; empty where there is no blur.
    [[nodiscard]] Expected<LatticeField> velocity() const;
    [[nodiscard]] Expected<TextureCoords> coords(const Recti& box) const;
    // In locked mode: a track's texture, with the motion's blur.
    [[nodiscard]] Expected<ImageF3> layer(const LatticeField& ref_from_cur, const Recti& box,
                                          const Matte& matte) const;
    // The same between two references whose tracks do not agree: each on its side of the seam.
    [[nodiscard]] Expected<ImageF3> two_tracks(const TrackSeam& seam, const Recti& box,
                                               const Matte& matte) const;
    [[nodiscard]] const TrackSeam* seam() const;

    const ShotPlan& plan_;
    const RegionPlan& region_;
    int index_;
    const RegionScene& scene_;
    const AnalysisStore& store_;
    const Backend& backend_;
    int frame_;
    Size plate_;
    const TextureCoords* exact_ = nullptr;
};

}  // namespace weft
