#pragma once
// Local colour classifiers along a matte's boundary (Video SnapCut, Bai et al. 2009, section 3.2):
// overlapping windows, each with a mixture of Gaussians for the inside and one for the outside.

#include <array>
#include <utility>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// A mixture of Gaussians over 8-bit RGB.
class ColorMixture {
  public:
    /// Fits to `samples` (RGB) with `weights`; deterministic. Too few samples leave it empty.
    void fit(const std::vector<Vec3>& samples, const std::vector<float>& weights);
    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// Density at a colour, up to a constant common to all mixtures; 0 when empty.
    [[nodiscard]] float density(Vec3 color) const;

  private:
    struct Component {
        Vec3 mean{0};
        std::array<float, 6> inverse{};  ///< xx, xy, xz, yy, yz, zz of the inverse covariance.
        float scale = 0;                 ///< Weight over the root of the determinant.
    };
    static constexpr int kComponents = 4;
    std::array<Component, kComponents> components_;
    int count_ = 0;
};

/// Where a window takes its samples from: a frame with the signed distance of its matte (same
/// size).
struct ColorSource {
    ViewU8x3 frame;
    ViewF1 phi;
    float clearance_px = 1.5f;  ///< Nearer to the boundary, colours are mixed and not used.
    float inside_weight = 1;
    float outside_weight = 1;
};

/// One window: a square around `center`, with one centre per source (where the surface lay there).
struct ColorWindow {
    Vec2i center{0, 0};
    std::vector<Vec2i> source_centers;
    ColorMixture inside, outside;
    float separability = 0;  ///< 0–1; 1 if colours separate inside from outside (SnapCut eq. 2).
};

struct ColorProbability {
    float inside = 0.5f;     ///< Probability of being inside, by colour alone.
    float separability = 0;  ///< 0–1: how reliable that is.
    /// How far it counts, 0–1: colours that hardly separate say nothing.
    [[nodiscard]] float confidence() const;
};

class LocalColorField {
  public:
    /// Fits all windows. `half_px` is half a window's side, `stride` skips pixels in both
    /// directions.
    LocalColorField(std::vector<ColorWindow> windows, const std::vector<ColorSource>& sources,
                    int half_px, int stride, Size size);

    /// Colours say nothing about the pixels of this size that are not 0.
    void leave_out(Matte pixels) { left_out_ = std::move(pixels); }

    /// Blend of the nearest windows that cover (x, y), by inverse distance (SnapCut eq. 6).
    [[nodiscard]] ColorProbability at(int x, int y, Vec3 color) const;

  private:
    static constexpr int kCell = 8;
    void index_windows(Size size);

    std::vector<ColorWindow> windows_;
    Matte left_out_;
    int half_px_;
    int cells_wide_ = 0;
    std::vector<std::array<int, 4>>
        nearest_;  ///< Per cell of 8×8 px: the nearest windows, −1: none.
};

}  // namespace weft
