#pragma once
// The plane while it grows.

#include <cstdint>
#include <optional>

#include "engine/core/image.h"

namespace weft {

/// Pixels, where they came from, and which are there yet. On a torus positions wrap around; on a
/// plane what lies outside is never filled. Not thread-safe.
class Canvas {
  public:
    Canvas(Size size, bool torus)
        : torus_(torus), pixels_(size), source_(size, -1), filled_(size, 0) {}

    [[nodiscard]] Size size() const { return filled_.size(); }
    [[nodiscard]] bool torus() const { return torus_; }

    /// The stored position of (x, y), or nothing outside of a plane.
    [[nodiscard]] std::optional<Vec2i> resolve(int x, int y) const {
        const Size s = size();
        if (torus_) return Vec2i{wrap(x, s.width), wrap(y, s.height)};
        if (x < 0 || y < 0 || x >= s.width || y >= s.height) return std::nullopt;
        return Vec2i{x, y};
    }
    [[nodiscard]] bool filled(int x, int y) const {
        const auto p = resolve(x, y);
        return p && filled_.at(p->x, p->y) != 0;
    }

    /// 1 where a stored row is filled, else 0.
    [[nodiscard]] const std::uint8_t* filled_row(int y) const { return filled_.row(y); }

    /// The first unfilled pixel in scanline order; nothing when all are filled. Pixels never become
    /// unfilled, so the search goes on where it last ended.
    [[nodiscard]] std::optional<Vec2i> first_unfilled();

    /// Shows sample pixel `from` with the colour `rgb` at `p`, a stored position.
    void set(Vec2i p, const std::uint8_t* rgb, Vec2i from) {
        std::uint8_t* out = pixels_.pixel(p.x, p.y);
        out[0] = rgb[0], out[1] = rgb[1], out[2] = rgb[2];
        std::int32_t* s = source_.pixel(p.x, p.y);
        s[0] = from.x, s[1] = from.y;
        filled_count_ += filled_.at(p.x, p.y) == 0;
        filled_.at(p.x, p.y) = 1;
    }
    [[nodiscard]] std::int64_t filled_count() const { return filled_count_; }

    ImageU8x3& pixels() { return pixels_; }
    Image<std::int32_t, 2>& source() { return source_; }
    [[nodiscard]] const ImageU8x3& pixels() const { return pixels_; }
    [[nodiscard]] const Image<std::int32_t, 2>& source() const { return source_; }

  private:
    static int wrap(int i, int n) {
        i %= n;
        return i < 0 ? i + n : i;
    }

    bool torus_;
    ImageU8x3 pixels_;
    Image<std::int32_t, 2> source_;
    Image<std::uint8_t, 1> filled_;
    std::int64_t filled_count_ = 0;
    Vec2i scan_{0, 0};
};

/// A copy of a rectangle of the canvas, which may reach over its borders.
struct Block {
    Recti rect;
    ImageU8x3 pixels;               ///< Anything where not filled.
    Image<std::uint8_t, 1> filled;  ///< 0 or 1.
    Image<std::uint8_t, 1> inside;  ///< 1 where the canvas has such a pixel at all.
};

[[nodiscard]] Block copy_block(const Canvas& canvas, const Recti& rect);

}  // namespace weft
