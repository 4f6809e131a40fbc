#pragma once
// Where a place of the reference frame lies on the texture.

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "engine/core/geometry.h"

namespace weft {

/// The texture coordinates of the reference frame: the one function through which every stage asks
/// which texel a place of the reference frame shows. Today it is a homography, that of the
/// artist's placement. Immutable and thread-safe.
class TextureMapping {
  public:
    /// A texel for every pixel, both from (0, 0).
    TextureMapping() = default;
    /// `texel_from_reference`: an invertible homography, in texels and pixels.
    explicit TextureMapping(const Mat3& texel_from_reference)
        : texel_from_reference_(texel_from_reference) {}

    /// The texel, unwrapped, of a place in pixels of the reference frame. Not finite on the horizon
    /// of a plane in perspective.
    [[nodiscard]] Vec2 texel(Vec2 pixel) const { return project(texel_from_reference_, pixel); }

    /// The mapping about one place, to first order.
    struct Linear {
        Vec2 texel;  ///< Of the place itself.
        Mat3 map{1};
        float depth = 1;  ///< Third homogeneous coordinate there.
        /// Texels for a step of that many pixels on the reference frame.
        [[nodiscard]] Vec2 step(Vec2 pixels) const {
            // d(p.xy / p.z) = (dp.xy − u dp.z) / p.z
            const Vec3 dp = map * Vec3(pixels, 0.0f);
            return (Vec2(dp.x, dp.y) - texel * dp.z) / depth;
        }
    };
    [[nodiscard]] Linear linear_at(Vec2 pixel) const {
        const Vec3 p = texel_from_reference_ * Vec3(pixel, 1.0f);
        return {Vec2(p.x, p.y) / p.z, texel_from_reference_, p.z};
    }

    /// The smallest upright box of texels around what a rectangle of the reference frame shows.
    struct Bounds {
        Vec2 low{1e9f}, high{-1e9f};
    };
    [[nodiscard]] Bounds bounds_of(const Recti& pixels) const {
        // A homography takes straight edges to straight ones: the corners bound the rest.
        Bounds out;
        for (int k = 0; k < 4; ++k) {
            const Vec2 u = texel({static_cast<float>((k & 1) != 0 ? pixels.x1 : pixels.x0),
                                  static_cast<float>((k >> 1) != 0 ? pixels.y1 : pixels.y0)});
            out.low = glm::min(out.low, u);
            out.high = glm::max(out.high, u);
        }
        return out;
    }

    /// The way back: the place in pixels of the reference frame that shows a texel.
    class Inverse {
      public:
        explicit Inverse(const Mat3& reference_from_texel) : map_(reference_from_texel) {}
        [[nodiscard]] Vec2 pixel(Vec2 texel) const { return project(map_, texel); }

      private:
        Mat3 map_;
    };
    [[nodiscard]] Inverse inverse() const { return Inverse(glm::inverse(texel_from_reference_)); }

    /// The same texture on a reference frame that is `factor` times smaller, factor > 0.
    [[nodiscard]] TextureMapping on_smaller_frame(float factor) const {
        Mat3 enlarge(1);
        enlarge[0][0] = enlarge[1][1] = factor;
        return TextureMapping(texel_from_reference_ * enlarge);
    }

    bool operator==(const TextureMapping&) const = default;

  private:
    Mat3 texel_from_reference_{1};
};

}  // namespace weft
