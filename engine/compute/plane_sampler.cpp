#include "engine/compute/plane_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/parallel.h"

namespace weft {
namespace {

using F4 = float __attribute__((vector_size(16)));
using U4 = std::uint16_t __attribute__((vector_size(8)));

F4 load(const std::uint16_t* p) {
    U4 v;
    std::memcpy(&v, p, sizeof v);
    return __builtin_convertvector(v, F4);
}

F4 spread(float v) { return F4{v, v, v, v}; }

// Cells along one axis of the pixel, from the footprint's length in texels.
struct Density {
    int fewest, most;
    [[nodiscard]] int cells(float texels) const {
        return std::clamp(static_cast<int>(std::ceil(2 * texels)), fewest, most);
    }
};

Density density(SampleQuality quality) {
    return quality == SampleQuality::kFinal ? Density{3, 8} : Density{2, 4};
}

// One level and the factors that take plane texels to its own.
struct LevelView {
    const PlanePyramid::Level* texels;
    float scale_x, scale_y;
};

// Bilinear lookup at level coordinates that may lie a little outside; W is the wrap mode.
template <WrapMode W>
F4 bilinear(const PlanePyramid::Level& level, float u, float v) {
    const float gx = u - 0.5f, gy = v - 0.5f;
    const float bx = std::floor(gx), by = std::floor(gy);
    const int x0 = wrapped_index(static_cast<int>(bx), level.width(), W);
    const int y0 = wrapped_index(static_cast<int>(by), level.height(), W);
    const int x1 = wrapped_index(static_cast<int>(bx) + 1, level.width(), W);
    const int y1 = wrapped_index(static_cast<int>(by) + 1, level.height(), W);
    const F4 fx = spread(gx - bx), fy = spread(gy - by);
    const std::uint16_t *top = level.row(y0), *low = level.row(y1);
    const F4 a = load(top + 4 * x0), b = load(top + 4 * x1);
    const F4 c = load(low + 4 * x0), d = load(low + 4 * x1);
    const F4 t = a + fx * (b - a), l = c + fx * (d - c);
    return t + fy * (l - t);
}

// The same where all four texels are known to lie inside: no wrapping.
F4 bilinear_inside(const PlanePyramid::Level& level, float u, float v) {
    const float gx = u - 0.5f, gy = v - 0.5f;
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    const F4 fx = spread(gx - static_cast<float>(x)), fy = spread(gy - static_cast<float>(y));
    const std::uint16_t* top = level.pixel(x, y);
    const std::uint16_t* low = top + level.stride();
    const F4 a = load(top), b = load(top + 4), c = load(low), d = load(low + 4);
    const F4 t = a + fx * (b - a), l = c + fx * (d - c);
    return t + fy * (l - t);
}

// The coordinate folded to within one period of the plane, so that it keeps its precision.
float folded(float u, int n, WrapMode wrap) {
    if (wrap == WrapMode::kClamp) return std::clamp(u, -1.0f, static_cast<float>(n) + 1);
    const auto period = static_cast<float>(wrap == WrapMode::kMirror ? 2 * n : n);
    return u - period * std::floor(u / period);
}

template <WrapMode W>
class Sampler {
  public:
    Sampler(const SampleRequest& request, ImageView<float, 3> out)
        : request_(request), out_(out), density_(density(request.quality)),
          unit_(request.plane->range() / 65535.0f) {
        for (const auto& level : request.plane->levels()) {
            levels_.push_back(
                {&level,
                 static_cast<float>(level.width()) / static_cast<float>(request.plane->size().width),
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
            for (int c = 0; c < 3; ++c) o[c] = colour[c] * unit_;
        }
    }

  private:
    // Half of the difference between the neighbours, one-sided at the border.
    [[nodiscard]] Vec2 slope(int xa, int ya, int xb, int yb) const {
        const float *a = request_.coords.pixel(xa, ya), *b = request_.coords.pixel(xb, yb);
        const int steps = std::max(1, (xb - xa) + (yb - ya));
        return {(b[0] - a[0]) / static_cast<float>(steps), (b[1] - a[1]) / static_cast<float>(steps)};
    }

    [[nodiscard]] F4 pixel(int x, int y) const {
        const ViewF2& uv = request_.coords;
        const Vec2 jx = slope(std::max(0, x - 1), y, std::min(uv.width() - 1, x + 1), y);
        const Vec2 jy = slope(x, std::max(0, y - 1), x, std::min(uv.height() - 1, y + 1));
        const float lx = std::sqrt(jx.x * jx.x + jx.y * jx.y);
        const float ly = std::sqrt(jy.x * jy.x + jy.y * jy.y);
        if (!(lx < 1e6f && ly < 1e6f)) return F4{};
        const int nx = density_.cells(lx), ny = density_.cells(ly);
        // A level's texel spans 2^(level−1) texels of the plane; a cell shall not span more than
        // about one of them.
        const float cell = std::max(lx / static_cast<float>(nx), ly / static_cast<float>(ny));
        std::size_t level = 0;
        for (float span = 1.0f; cell > span && level + 1 < levels_.size(); span *= 2) ++level;
        const LevelView& view = levels_[level];

        const Vec2 scale(view.scale_x, view.scale_y);
        const Size size = request_.plane->size();
        const float* centre = uv.pixel(x, y);
        const Vec2 at = Vec2(folded(centre[0], size.width, W), folded(centre[1], size.height, W)) * scale;
        const Vec2 step_x = jx * scale / static_cast<float>(nx);
        const Vec2 step_y = jy * scale / static_cast<float>(ny);
        const Vec2 first = at - step_x * (0.5f * static_cast<float>(nx - 1)) -
                           step_y * (0.5f * static_cast<float>(ny - 1));
        return sum(*view.texels, at, first, step_x, step_y, nx, ny) * spread(1.0f / static_cast<float>(nx * ny));
    }

    [[nodiscard]] static F4 sum(const PlanePyramid::Level& level, Vec2 at, Vec2 first, Vec2 step_x,
                                Vec2 step_y, int nx, int ny) {
        const float reach_x = std::abs(at.x - first.x) + std::abs(step_x.x) * static_cast<float>(nx) +
                              std::abs(step_y.x) * static_cast<float>(ny) + 1;
        const float reach_y = std::abs(at.y - first.y) + std::abs(step_x.y) * static_cast<float>(nx) +
                              std::abs(step_y.y) * static_cast<float>(ny) + 1;
        const bool inside = at.x - reach_x >= 0 && at.y - reach_y >= 0 &&
                            at.x + reach_x < static_cast<float>(level.width() - 1) &&
                            at.y + reach_y < static_cast<float>(level.height() - 1);
        F4 total{};
        for (int j = 0; j < ny; ++j) {
            Vec2 p = first + step_y * static_cast<float>(j);
            for (int i = 0; i < nx; ++i, p += step_x) {
                total += inside ? bilinear_inside(level, p.x, p.y) : bilinear<W>(level, p.x, p.y);
            }
        }
        return total;
    }

    SampleRequest request_;
    ImageView<float, 3> out_;
    Density density_;
    float unit_;
    std::vector<LevelView> levels_;
};

template <WrapMode W>
void run(const SampleRequest& request, ImageView<float, 3> out) {
    const Sampler<W> sampler(request, out);
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) sampler.row(y);
    });
}

}  // namespace

void sample_plane_cpu(const SampleRequest& request, ImageView<float, 3> out) {
    switch (request.plane->wrap()) {
        case WrapMode::kRepeat: return run<WrapMode::kRepeat>(request, out);
        case WrapMode::kMirror: return run<WrapMode::kMirror>(request, out);
        case WrapMode::kClamp: return run<WrapMode::kClamp>(request, out);
    }
}

}  // namespace weft
