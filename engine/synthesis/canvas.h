#pragma once
// A texture plane while it grows.

#include <cstdint>
#include <optional>

#include "engine/core/image.h"
#include "engine/core/wrap.h"

namespace weft {

/// Pixels, their source places, and which of them are filled. On a torus positions wrap around;
/// otherwise pixels outside are never filled. Threads may work on different pixels at the same
/// time.
class Canvas {
  public:
    Canvas(Size size, bool torus)
        : torus_(torus), pixels_(size), source_(size, -1), filled_(size, 0) {}

    [[nodiscard]] Size size() const { return filled_.size(); }
    [[nodiscard]] bool torus() const { return torus_; }

    /// The stored position of (x, y); empty outside a canvas that does not wrap.
    [[nodiscard]] std::optional<Vec2i> resolve(int x, int y) const {
        const Size s = size();
        if (torus_) return Vec2i{wrapped(x, s.width), wrapped(y, s.height)};
        if (x < 0 || y < 0 || x >= s.width || y >= s.height) return std::nullopt;
        return Vec2i{x, y};
    }
    [[nodiscard]] bool filled(int x, int y) const {
        const auto p = resolve(x, y);
        return p && filled_.at(p->x, p->y) != 0;
    }

    /// Per pixel of a stored row: 1 if filled, else 0.
    [[nodiscard]] const std::uint8_t* filled_row(int y) const { return filled_.row(y); }

    /// The same of a stored rectangle.
    [[nodiscard]] ViewU8x1 filled_part(const Recti& rect) const {
        return filled_.view().crop(rect);
    }

    /// Stores sample pixel `from` with the colour `rgb` at `p`, a stored position.
    void set(Vec2i p, const std::uint8_t* rgb, Vec2i from) {
        std::uint8_t* out = pixels_.pixel(p.x, p.y);
        out[0] = rgb[0], out[1] = rgb[1], out[2] = rgb[2];
        std::int32_t* s = source_.pixel(p.x, p.y);
        s[0] = from.x, s[1] = from.y;
        filled_.at(p.x, p.y) = 1;
    }
    /// The same for `count` neighbours from `p` on; `p` may lie outside.
    void set_run(Vec2i p, int count, const std::uint8_t* rgb, Vec2i from);

    /// Locks a stored position: no patch may change it.
    void lock(Vec2i p) {
        if (locked_.empty()) locked_ = Image<std::uint8_t, 1>(size(), 0);
        locked_.at(p.x, p.y) = 1;
    }
    [[nodiscard]] bool any_locked() const { return !locked_.empty(); }
    [[nodiscard]] bool locked(int x, int y) const {
        if (locked_.empty()) return false;
        const auto p = resolve(x, y);
        return p && locked_.at(p->x, p->y) != 0;
    }

    ImageU8x3& pixels() { return pixels_; }
    Image<std::int32_t, 2>& source() { return source_; }
    [[nodiscard]] const ImageU8x3& pixels() const { return pixels_; }
    [[nodiscard]] const Image<std::int32_t, 2>& source() const { return source_; }

  private:
    bool torus_;
    ImageU8x3 pixels_;
    Image<std::int32_t, 2> source_;
    Image<std::uint8_t, 1> filled_;
    Image<std::uint8_t, 1> locked_;  ///< Empty: none.
};

/// A copy of a rectangle of the canvas, which may reach beyond its borders.
struct Block {
    Recti rect;
    ImageU8x3 pixels;               ///< Undefined where not filled.
    Image<std::uint8_t, 1> filled;  ///< 0 or 1.
    Image<std::uint8_t, 1> inside;  ///< 1 where the canvas has this pixel.
};

[[nodiscard]] Block copy_block(const Canvas& canvas, const Recti& rect);

}  // namespace weft
