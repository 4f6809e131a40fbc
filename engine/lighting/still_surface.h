#pragma once
// What stays at its place of a surface while the surface moves, so that what moves over it, its
// highlights and reflections, can be told apart.

#include <cstddef>
#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// The surface without what moves over it, on a reduced picture of the reference frame. `box` may
/// extend beyond that picture.
struct StillSurface {
    Recti box;           ///< In pixels of the reduced picture; empty: not enough was seen.
    float pixel_px = 1;  ///< Their side in plate pixels.
    ImageF3 colour;      ///< Paint × diffuse light, linear.
    ImageF1 known;       ///< 1 where enough frames show the place, else 0.
    /// The lower quartile of ln(frame / colour) over the surface, mean of the frames.
    float usual = 0;
    /// 0 to 1: how surely gloss is what moves over the surface. 0 where nothing moves over it, and
    /// where what does looks like moving shadows.
    float confidence = 0;
};

/// Gathers frames of a surface. The still picture is the mean of the darkest quarter of what each
/// place shows over time (the minimum composite of Szeliski et al. 2000, made robust): reflections
/// only ever add light. Not thread-safe.
class StillSurfaceGatherer {
  public:
    /// `pixel_px`: whole plate pixels to a pixel of the reduced picture.
    explicit StillSurfaceGatherer(int pixel_px) : pixel_px_(pixel_px) {}

    /// `linear`: the plate in linear light; NaN and infinity are ignored. `visible`: the region's
    /// matte without holdouts; pixels under 250 do not count. `ref_from_cur` in plate pixels.
    void add(ViewF3 linear, ViewU8x1 visible, const LatticeField& ref_from_cur);
    /// Of places that at least four frames show. `daylight`: Daylight::confidence of the shot; the
    /// light of sun and sky that moves over a plain surface looks like gloss.
    [[nodiscard]] StillSurface finish(float daylight);

    struct Part {
        Recti box;
        ImageF3 colour;
        ImageF1 weight;
        float level = 1;  ///< Light that the whole frame has beyond others, as a factor.
    };

  private:
    int pixel_px_;
    std::vector<Part> parts_;
};

/// The luminance of what a frame shows beyond the still surface, H×W as `plate` and `matte`, whose
/// pixel (0, 0) lies at `origin`; 0 where the still surface is not known. `ref_from_cur`: of the
/// whole frame, plate pixels. Thread-safe, bit-identical for any number of threads.
[[nodiscard]] ImageF1 moving_gloss(Vec2i origin, ViewF3 plate, ViewU8x1 matte,
                                   const StillSurface& still, const LatticeField& ref_from_cur);

}  // namespace weft
