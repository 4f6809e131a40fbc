#include "engine/compute/plane_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"

namespace weft {
namespace {

float usable(float v) { return v > 0 && std::isfinite(v) ? v : 0.0f; }

std::uint16_t quantised(float v) {
    return static_cast<std::uint16_t>(std::clamp(v + 0.5f, 0.0f, 65535.0f));
}

// Cubic convolution (Keys 1981) with a = −3/4 at a quarter of the way between two texels, which is
// where the texels of a twice magnified picture stand. Catmull–Rom is a = −1/2; the steeper kernel
// makes good what the bilinear lookups between the magnified texels take away, so that a pixel comes
// out as sharp as the plane's own cubic averaged over the pixel's area (docs/METHOD.md, sampling).
constexpr std::array<float, 4> kQuarter{-0.10546875f, 0.87890625f, 0.26171875f, -0.03515625f};

// Sums the two directions of the separable cubic for one magnified texel.
PlanePyramid::Level magnify_twice(const PlanePyramid::Level& in, WrapMode wrap) {
    PlanePyramid::Level out(2 * in.width(), 2 * in.height());
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        std::vector<float> line(static_cast<std::size_t>(in.width()) * 4);
        for (int y = y0; y < y1; ++y) {
            // Even rows lie a quarter before their texel's centre, odd ones a quarter after it.
            const int towards_y = y % 2 == 0 ? -1 : 1;
            std::fill(line.begin(), line.end(), 0.0f);
            for (int k = 0; k < 4; ++k) {
                const int row = wrapped_index(y / 2 + towards_y * (k - 1), in.height(), wrap);
                const std::uint16_t* p = in.row(row);
                for (std::size_t i = 0; i < line.size(); ++i) {
                    line[i] += kQuarter[static_cast<std::size_t>(k)] * static_cast<float>(p[i]);
                }
            }
            std::uint16_t* o = out.row(y);
            for (int x = 0; x < out.width(); ++x, o += 4) {
                const int towards_x = x % 2 == 0 ? -1 : 1;
                std::array<float, 3> sum{};
                for (int k = 0; k < 4; ++k) {
                    const int column = wrapped_index(x / 2 + towards_x * (k - 1), in.width(), wrap);
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum[c] += kQuarter[static_cast<std::size_t>(k)] *
                                  line[static_cast<std::size_t>(column) * 4 + c];
                    }
                }
                for (std::size_t c = 0; c < 3; ++c) o[c] = quantised(sum[c]);
            }
        }
    });
    return out;
}

// One output texel's share of the input along an axis: from `first`, `weights` of them.
struct AreaTap {
    int first = 0;
    std::vector<float> weights;
};

std::vector<AreaTap> area_taps(int in, int out) {
    std::vector<AreaTap> taps(static_cast<std::size_t>(out));
    const double step = static_cast<double>(in) / out;
    for (int i = 0; i < out; ++i) {
        const double begin = i * step, end = std::min<double>(in, (i + 1) * step);
        AreaTap& tap = taps[static_cast<std::size_t>(i)];
        tap.first = static_cast<int>(begin);
        for (int k = tap.first; k < end - 1e-9; ++k) {
            const double share = std::min<double>(k + 1, end) - std::max<double>(k, begin);
            tap.weights.push_back(static_cast<float>(share / (end - begin)));
        }
    }
    return taps;
}

PlanePyramid::Level halve(const PlanePyramid::Level& in) {
    const int width = std::max(1, (in.width() + 1) / 2), height = std::max(1, (in.height() + 1) / 2);
    PlanePyramid::Level out(width, height);
    const auto columns = area_taps(in.width(), width), rows = area_taps(in.height(), height);
    parallel_rows(height, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const AreaTap& ty = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < width; ++x) {
                const AreaTap& tx = columns[static_cast<std::size_t>(x)];
                std::array<float, 3> sum{};
                for (std::size_t j = 0; j < ty.weights.size(); ++j) {
                    const std::uint16_t* p = in.pixel(tx.first, ty.first + static_cast<int>(j));
                    for (const float w : tx.weights) {
                        for (std::size_t c = 0; c < 3; ++c) {
                            sum[c] += ty.weights[j] * w * static_cast<float>(p[c]);
                        }
                        p += 4;
                    }
                }
                for (std::size_t c = 0; c < 3; ++c) out.pixel(x, y)[c] = quantised(sum[c]);
            }
        }
    });
    return out;
}

}  // namespace

int wrapped_index(int i, int n, WrapMode wrap) {
    if (wrap == WrapMode::kClamp) return std::clamp(i, 0, n - 1);
    const int period = wrap == WrapMode::kMirror ? 2 * n : n;
    i %= period;
    if (i < 0) i += period;
    return i < n ? i : 2 * n - 1 - i;
}

PlanePyramid::PlanePyramid(ViewF3 linear, WrapMode wrap) : size_(linear.size()), wrap_(wrap) {
    if (linear.empty()) return;
    range_ = 1e-6f;
    for (int y = 0; y < linear.height(); ++y) {
        const float* p = linear.row(y);
        for (int k = 0; k < 3 * linear.width(); ++k) range_ = std::max(range_, usable(p[k]));
    }
    Level plane(size_);
    for (int y = 0; y < linear.height(); ++y) {
        for (int x = 0; x < linear.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                plane.pixel(x, y)[c] = quantised(usable(linear.pixel(x, y)[c]) / range_ * 65535.0f);
            }
        }
    }
    levels_.push_back(magnify_twice(plane, wrap));
    levels_.push_back(std::move(plane));
    while (levels_.back().width() > 1 || levels_.back().height() > 1) {
        levels_.push_back(halve(levels_.back()));
    }
}

}  // namespace weft
