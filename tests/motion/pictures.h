#pragma once
// Pictures whose values are known between the pixels too.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/rng.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A texture without a grid: a sum of waves in random directions, 5 to 40 px long, mostly in [0,
/// 1].
class WaveTexture {
  public:
    explicit WaveTexture(std::uint64_t seed) {
        Rng rng(seed);
        constexpr int kWaves = 20;
        for (int k = 0; k < kWaves; ++k) {
            const double length = 5.0 * std::pow(8.0, rng.uniform());
            const double angle = 2 * std::numbers::pi * rng.uniform();
            const double f = 2 * std::numbers::pi / length;
            waves_.push_back({static_cast<float>(f * std::cos(angle)),
                              static_cast<float>(f * std::sin(angle)),
                              static_cast<float>(2 * std::numbers::pi * rng.uniform())});
        }
    }

    float operator()(Vec2 p) const {
        float sum = 0;
        for (const Wave& w : waves_)
            sum += std::sin(w.x * p.x + w.y * p.y + w.phase);
        return 0.5f + 0.06f * sum;
    }

  private:
    struct Wave {
        float x, y, phase;
    };
    std::vector<Wave> waves_;
};

inline std::uint8_t code_of(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

inline Vec2 centre_of(int x, int y) {
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

/// An 8-bit picture of value(p) at the pixel centres.
template <class F>
Matte draw(Size size, const F& value) {
    Matte out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            out.at(x, y) = code_of(value(centre_of(x, y)));
    }
    return out;
}

/// The same displacement everywhere, on a lattice of 8 px.
inline LatticeField moved_by(Size size, Vec2 d) {
    LatticeField out(size, 8);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, d);
    }
    return out;
}

inline float distance(Vec2 a, Vec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace weft
