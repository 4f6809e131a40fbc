#include "engine/compute/plane_pyramid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "engine/compute/finer_level.h"
#include "engine/core/parallel.h"
#include "engine/core/wrap.h"

namespace weft {
namespace {

float usable(float v) {
    return v > 0 && std::isfinite(v) ? v : 0.0f;
}

// The input texels of one output texel along an axis: from `first`, with their `weights`.
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
    const int width = std::max(1, (in.width() + 1) / 2),
              height = std::max(1, (in.height() + 1) / 2);
    PlanePyramid::Level out(width, height);
    const auto columns = area_taps(in.width(), width), rows = area_taps(in.height(), height);
    parallel_rows(height, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const AreaTap& ty = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < width; ++x) {
                const AreaTap& tx = columns[static_cast<std::size_t>(x)];
                std::array<float, 3> sum{};
                for (std::size_t j = 0; j < ty.weights.size(); ++j) {
                    const float* p = in.pixel(tx.first, ty.first + static_cast<int>(j));
                    for (const float w : tx.weights) {
                        for (std::size_t c = 0; c < 3; ++c) {
                            sum[c] += ty.weights[j] * w * p[c];
                        }
                        p += 4;
                    }
                }
                for (std::size_t c = 0; c < 3; ++c)
                    out.pixel(x, y)[c] = sum[c];
            }
        }
    });
    return out;
}

}  // namespace

int wrapped_index(int i, int n, WrapMode wrap) {
    if (wrap == WrapMode::kClamp) return std::clamp(i, 0, n - 1);
    const int period = wrap == WrapMode::kMirror ? 2 * n : n;
    i = wrapped(i, period);
    return i < n ? i : 2 * n - 1 - i;
}

PlanePyramid::PlanePyramid(ViewF3 linear, WrapMode wrap, int finer)
    : size_(linear.size()), wrap_(wrap) {
    if (linear.empty()) return;
    static std::atomic<std::uint64_t> identities{0};
    identity_ = ++identities;
    Level plane(size_);
    for (int y = 0; y < linear.height(); ++y) {
        for (int x = 0; x < linear.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                plane.pixel(x, y)[c] = usable(linear.pixel(x, y)[c]);
        }
    }
    std::vector<Level> levels;
    levels.push_back(std::move(plane));
    for (plane_level_ = 0; plane_level_ < finer; ++plane_level_)
        levels.insert(levels.begin(), finer_level(levels.front(), wrap));
    while (levels.back().width() > 1 || levels.back().height() > 1)
        levels.push_back(halve(levels.back()));
    levels_ = std::make_shared<const std::vector<Level>>(std::move(levels));
}

}  // namespace weft
