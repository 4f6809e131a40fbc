#include "engine/compute/plane_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/core/parallel.h"

namespace weft {
namespace {

using F4 = float __attribute__((vector_size(16)));

F4 load(const float* p) {
    F4 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

F4 spread(float v) {
    return F4{v, v, v, v};
}

// Cells per texel along one axis of the pixel, from the footprint's length in texels.
struct Density {
    int fewest, most;
    [[nodiscard]] int cells(float texels) const {
        return std::clamp(static_cast<int>(std::ceil(2 * texels)), fewest, most);
    }
};

Density density(SampleQuality quality) {
    return quality == SampleQuality::kFinal ? Density{3, 8} : Density{2, 4};
}

// One level and the factors from plane texels to its own.
struct LevelView {
    const PlanePyramid::Level* texels;
    float scale_x, scale_y;
};

// Cubic convolution (Keys 1981) with a = −0.5, Catmull–Rom: averaged over the pixel it keeps the
// plane's sharpness; steeper kernels overshoot it (docs/decisions/0005-sampling-filter.md).
constexpr float kA = -0.5f;

F4 cubic_weights(float f) {
    const float g = 1 - f;
    const float near = ((kA + 2) * f - (kA + 3)) * f * f + 1;
    const float far = ((kA + 2) * g - (kA + 3)) * g * g + 1;
    // a (d³ − 5d² + 8d − 4) at d = 1 + f and at d = 1 + g.
    return F4{kA * f * g * g, near, far, kA * g * f * f};
}

F4 row_sum(const float* t0, const float* t1, const float* t2, const float* t3, F4 w) {
    return spread(w[0]) * load(t0) + spread(w[1]) * load(t1) + spread(w[2]) * load(t2) +
           spread(w[3]) * load(t3);
}

// Cubic lookup at level coordinates anywhere; W is the wrap mode.
template <WrapMode W>
F4 lookup(const PlanePyramid::Level& level, float u, float v) {
    const float gx = u - 0.5f, gy = v - 0.5f;
    const float bx = std::floor(gx), by = std::floor(gy);
    const F4 wx = cubic_weights(gx - bx), wy = cubic_weights(gy - by);
    std::array<int, 4> column{};
    for (int k = 0; k < 4; ++k) {
        column[static_cast<std::size_t>(k)] =
            4 * wrapped_index(static_cast<int>(bx) + k - 1, level.width(), W);
    }
    F4 sum{};
    for (int k = 0; k < 4; ++k) {
        const float* row =
            level.row(wrapped_index(static_cast<int>(by) + k - 1, level.height(), W));
        sum += spread(wy[k]) *
               row_sum(row + column[0], row + column[1], row + column[2], row + column[3], wx);
    }
    return sum;
}

// The same if all sixteen texels lie inside: no wrapping.
F4 lookup_inside(const PlanePyramid::Level& level, float u, float v) {
    const float gx = u - 0.5f, gy = v - 0.5f;
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    const F4 wx = cubic_weights(gx - static_cast<float>(x)),
             wy = cubic_weights(gy - static_cast<float>(y));
    const float* row = level.pixel(x - 1, y - 1);
    F4 sum{};
    for (int k = 0; k < 4; ++k, row += level.stride()) {
        sum += spread(wy[k]) * row_sum(row, row + 4, row + 8, row + 12, wx);
    }
    return sum;
}

// The coordinate reduced to one period of the plane, to keep its precision.
float folded(float u, int n, WrapMode wrap) {
    if (wrap == WrapMode::kClamp) return std::clamp(u, -1.0f, static_cast<float>(n) + 1);
    const auto period = static_cast<float>(wrap == WrapMode::kMirror ? 2 * n : n);
    return u - period * std::floor(u / period);
}

template <WrapMode W>
class Sampler {
  public:
    Sampler(const SampleRequest& request, ImageView<float, 3> out)
        : request_(request), out_(out), density_(density(request.quality)) {
        for (const auto& level : request.plane->levels()) {
            levels_.push_back({&level,
                               static_cast<float>(level.width()) /
                                   static_cast<float>(request.plane->size().width),
                               static_cast<float>(level.height()) /
                                   static_cast<float>(request.plane->size().height)});
        }
    }

    void row(int y) const {
        const ViewU8x1& matte = request_.matte;
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.at(x, y) == 0) continue;
            const F4 colour = pixel(x, y);
            float* o = out_.pixel(x, y);
            // The cubic may undershoot next to a highlight.
            for (int c = 0; c < 3; ++c)
                o[c] = std::max(0.0f, colour[c]);
        }
    }

  private:
    // Half of the difference between the neighbours, one-sided at the border.
    [[nodiscard]] Vec2 slope(int xa, int ya, int xb, int yb) const {
        const float *a = request_.coords.pixel(xa, ya), *b = request_.coords.pixel(xb, yb);
        const int steps = std::max(1, (xb - xa) + (yb - ya));
        return {(b[0] - a[0]) / static_cast<float>(steps),
                (b[1] - a[1]) / static_cast<float>(steps)};
    }

    [[nodiscard]] F4 pixel(int x, int y) const {
        const ViewF2& uv = request_.coords;
        const Vec2 jx = slope(std::max(0, x - 1), y, std::min(uv.width() - 1, x + 1), y);
        const Vec2 jy = slope(x, std::max(0, y - 1), x, std::min(uv.height() - 1, y + 1));
        const float lx = std::sqrt(jx.x * jx.x + jx.y * jx.y);
        const float ly = std::sqrt(jy.x * jy.x + jy.y * jy.y);
        const float* centre = uv.pixel(x, y);
        // False where the coordinates are unknown or too large to be meaningful.
        const bool known = std::abs(centre[0]) < 1e9f && std::abs(centre[1]) < 1e9f;
        if (!(known && lx < 1e6f && ly < 1e6f)) return F4{};
        const int nx = density_.cells(lx), ny = density_.cells(ly);
        // A level's texel spans 2^level texels of the plane; a cell should not span more than about
        // one.
        const float cell = std::max(lx / static_cast<float>(nx), ly / static_cast<float>(ny));
        std::size_t level = 0;
        for (float span = 1.0f; cell > span && level + 1 < levels_.size(); span *= 2)
            ++level;
        const LevelView& view = levels_[level];

        const Vec2 scale(view.scale_x, view.scale_y);
        const Size size = request_.plane->size();
        const Vec2 at =
            Vec2(folded(centre[0], size.width, W), folded(centre[1], size.height, W)) * scale;
        const Vec2 step_x = jx * scale / static_cast<float>(nx);
        const Vec2 step_y = jy * scale / static_cast<float>(ny);
        const Vec2 first = at - step_x * (0.5f * static_cast<float>(nx - 1)) -
                           step_y * (0.5f * static_cast<float>(ny - 1));
        return sum(*view.texels, at, first, step_x, step_y, nx, ny) *
               spread(1.0f / static_cast<float>(nx * ny));
    }

    [[nodiscard]] static F4 sum(const PlanePyramid::Level& level, Vec2 at, Vec2 first, Vec2 step_x,
                                Vec2 step_y, int nx, int ny) {
        const float reach_x = std::abs(at.x - first.x) +
                              std::abs(step_x.x) * static_cast<float>(nx) +
                              std::abs(step_y.x) * static_cast<float>(ny) + 2;
        const float reach_y = std::abs(at.y - first.y) +
                              std::abs(step_x.y) * static_cast<float>(nx) +
                              std::abs(step_y.y) * static_cast<float>(ny) + 2;
        const bool inside = at.x - reach_x >= 0 && at.y - reach_y >= 0 &&
                            at.x + reach_x < static_cast<float>(level.width()) &&
                            at.y + reach_y < static_cast<float>(level.height());
        F4 total{};
        for (int j = 0; j < ny; ++j) {
            Vec2 p = first + step_y * static_cast<float>(j);
            for (int i = 0; i < nx; ++i, p += step_x) {
                total += inside ? lookup_inside(level, p.x, p.y) : lookup<W>(level, p.x, p.y);
            }
        }
        return total;
    }

    SampleRequest request_;
    ImageView<float, 3> out_;
    Density density_;
    std::vector<LevelView> levels_;
};

template <WrapMode W>
void run(const SampleRequest& request, ImageView<float, 3> out) {
    const Sampler<W> sampler(request, out);
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            sampler.row(y);
    });
}

}  // namespace

void sample_plane_cpu(const SampleRequest& request, ImageView<float, 3> out) {
    switch (request.plane->wrap()) {
        case WrapMode::kRepeat:
            return run<WrapMode::kRepeat>(request, out);
        case WrapMode::kMirror:
            return run<WrapMode::kMirror>(request, out);
        case WrapMode::kClamp:
            return run<WrapMode::kClamp>(request, out);
    }
}

}  // namespace weft
