#pragma once
// Where a place of the reference frame lies on the texture.

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <utility>

#include "engine/core/geometry.h"
#include "engine/core/pixel_aspect.h"
#include "engine/core/plane_warp.h"
#include "engine/core/surface_form.h"

namespace weft {

/// The texture coordinates of the reference frame: the one function through which every stage asks
/// which texel a place of the reference frame shows. A grid warp, if there is one, is undone, the
/// place is unsqueezed, the surface is laid flat by its form, if it has one, and then a homography
/// acts, that of the artist's placement. Immutable and thread-safe.
class TextureMapping {
  public:
    /// A texel for every pixel, both from (0, 0).
    TextureMapping() = default;
    /// `texel_from_unsqueezed`: an invertible homography, in texels and unsqueezed pixels.
    explicit TextureMapping(const Mat3& texel_from_unsqueezed, PixelAspect aspect = {})
        : texel_from_unsqueezed_(texel_from_unsqueezed), aspect_(aspect) {}

    /// The texel, unwrapped, of a place in pixels of the reference frame. Not finite on the horizon
    /// of a plane in perspective.
    [[nodiscard]] Vec2 texel(Vec2 pixel) const {
        return project(texel_from_unsqueezed_, flat(pixel));
    }

    /// The same placement on a surface of this form; null: flat.
    [[nodiscard]] TextureMapping with_form(std::shared_ptr<const SurfaceForm> form) const {
        TextureMapping out = *this;
        out.form_ = std::move(form);
        return out;
    }
    [[nodiscard]] const std::shared_ptr<const SurfaceForm>& form() const { return form_; }
    /// This placement on the surface of another mapping, whose frame is of the same size.
    [[nodiscard]] TextureMapping on_surface_of(const TextureMapping& other) const {
        TextureMapping out = with_form(other.form_);
        out.smaller_ = other.smaller_;
        return out;
    }
    /// The same with a grid warp on top of the form; null: none.
    [[nodiscard]] TextureMapping with_warp(std::shared_ptr<const PlaneWarp> warp) const {
        TextureMapping out = *this;
        out.warp_ = std::move(warp);
        return out;
    }

    /// The mapping about one place, to first order.
    struct Linear {
        Vec2 texel;  ///< Of the place itself.
        Mat3 map{1};
        float depth = 1;    ///< Third homogeneous coordinate there.
        glm::mat2 form{1};  ///< Of the surface unsqueezed and laid flat, the warp undone, by pixel.
        /// Texels for a step of that many pixels on the reference frame.
        [[nodiscard]] Vec2 step(Vec2 pixels) const {
            // d(p.xy / p.z) = (dp.xy − u dp.z) / p.z
            const Vec3 dp = map * Vec3(form * pixels, 0.0f);
            return (Vec2(dp.x, dp.y) - texel * dp.z) / depth;
        }
    };
    [[nodiscard]] Linear linear_at(Vec2 pixel) const {
        const Vec3 p = texel_from_unsqueezed_ * Vec3(flat(pixel), 1.0f);
        Linear out{Vec2(p.x, p.y) / p.z, texel_from_unsqueezed_, p.z};
        if (bends()) {
            const Vec2 x(0.5f, 0), y(0, 0.5f);
            out.form = {flat(pixel + x) - flat(pixel - x), flat(pixel + y) - flat(pixel - y)};
        } else {
            out.form[0][0] = aspect_.ratio();
        }
        return out;
    }

    /// The smallest upright box of texels around what a rectangle of the reference frame shows.
    struct Bounds {
        Vec2 low{1e9f}, high{-1e9f};
    };
    [[nodiscard]] Bounds bounds_of(const Recti& pixels) const {
        // A homography takes straight edges to straight ones: the corners bound the rest. With a
        // form or a warp, so do the places of a grid, closely.
        const int steps = bends() ? 32 : 1;
        Bounds out;
        for (int j = 0; j <= steps; ++j) {
            for (int i = 0; i <= steps; ++i) {
                const auto share = [&](int from, int to, int k) {
                    return k == steps
                               ? static_cast<float>(to)
                               : static_cast<float>(from) + static_cast<float>((to - from) * k) /
                                                                static_cast<float>(steps);
                };
                const Vec2 u =
                    texel({share(pixels.x0, pixels.x1, i), share(pixels.y0, pixels.y1, j)});
                out.low = glm::min(out.low, u);
                out.high = glm::max(out.high, u);
            }
        }
        return out;
    }

    /// The way back on a surface without a form and a warp: the place in pixels of the reference
    /// frame that shows a texel.
    class Inverse {
      public:
        Inverse(const Mat3& unsqueezed_from_texel, PixelAspect aspect)
            : map_(unsqueezed_from_texel), aspect_(aspect) {}
        [[nodiscard]] Vec2 pixel(Vec2 texel) const {
            return aspect_.squeezed(project(map_, texel));
        }

      private:
        Mat3 map_;
        PixelAspect aspect_;
    };
    [[nodiscard]] Inverse inverse() const {
        return {glm::inverse(texel_from_unsqueezed_), aspect_};
    }

    /// The same texture on a reference frame that is `factor` times smaller, factor > 0.
    [[nodiscard]] TextureMapping on_smaller_frame(float factor) const {
        Mat3 enlarge(1);
        enlarge[0][0] = enlarge[1][1] = factor;
        TextureMapping out(texel_from_unsqueezed_ * enlarge, aspect_);
        out.form_ = form_;
        out.warp_ = warp_;
        out.smaller_ = smaller_ * factor;
        return out;
    }

    bool operator==(const TextureMapping&) const = default;

  private:
    [[nodiscard]] bool bends() const { return form_ != nullptr || warp_ != nullptr; }
    [[nodiscard]] Vec2 flat(Vec2 pixel) const {
        if (!bends()) return aspect_.unsqueezed(pixel);
        Vec2 at = pixel * smaller_;
        if (warp_) at = warp_->rest(at);
        at = aspect_.unsqueezed(at);
        return (form_ ? form_->flat(at) : at) / smaller_;
    }

    Mat3 texel_from_unsqueezed_{1};
    PixelAspect aspect_;
    std::shared_ptr<const SurfaceForm> form_;  // these two of the frame at full size
    std::shared_ptr<const PlaneWarp> warp_;
    float smaller_ = 1;
};

}  // namespace weft
