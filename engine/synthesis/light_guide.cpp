#include "engine/synthesis/light_guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace weft {
namespace {

// Three boxes of 25 px are nearly a Gaussian of 12.5 px.
constexpr int kRadius_px = 12;
constexpr int kPasses = 3;
// Fixed-point units per level, so that no precision is lost between passes.
constexpr int kUnit = 256;

// The mean over [i − r, i + r], as far as it lies inside.
void box(const std::int32_t* in, std::int32_t* out, int n) {
    std::int64_t sum = 0;
    int first = 0, last = 0;
    for (int i = 0; i < n; ++i) {
        for (; last < std::min(n, i + kRadius_px + 1); ++last)
            sum += in[last];
        for (; first < i - kRadius_px; ++first)
            sum -= in[first];
        out[i] = static_cast<std::int32_t>((sum + (last - first) / 2) / (last - first));
    }
}

Image<std::int32_t, 1> smoothed(ViewU8x1 wanted) {
    Image<std::int32_t, 1> out(wanted.size());
    const int w = out.width(), h = out.height();
    std::vector<std::int32_t> line(static_cast<std::size_t>(std::max(w, h))), mean(line.size());
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x)
            out.at(x, y) = kUnit * wanted.at(x, y);
    }
    for (int pass = 0; pass < kPasses; ++pass) {
        for (int y = 0; y < h; ++y) {
            std::copy_n(out.row(y), w, line.begin());
            box(line.data(), out.row(y), w);
        }
        for (int x = 0; x < w; ++x) {
            for (int y = 0; y < h; ++y)
                line[static_cast<std::size_t>(y)] = out.at(x, y);
            box(line.data(), mean.data(), h);
            for (int y = 0; y < h; ++y)
                out.at(x, y) = mean[static_cast<std::size_t>(y)];
        }
    }
    return out;
}

}  // namespace

ImageU8x3 light_guide(ViewU8x3 sample, ViewU8x1 wanted) {
    std::array<double, 3> mean{};
    for (int y = 0; y < sample.height(); ++y) {
        for (int x = 0; x < sample.width(); ++x) {
            for (std::size_t c = 0; c < 3; ++c)
                mean[c] += sample.pixel(x, y)[c];
        }
    }
    const Image<std::int32_t, 1> light = smoothed(wanted);
    double sum = 0;
    for (int y = 0; y < wanted.height(); ++y) {
        for (int x = 0; x < wanted.width(); ++x)
            sum += light.at(x, y);
    }
    const double texels = static_cast<double>(wanted.width()) * wanted.height();
    const double scale = 1.0 / std::max(sum / texels, double{kUnit});
    ImageU8x3 out(wanted.size());
    for (int y = 0; y < wanted.height(); ++y) {
        for (int x = 0; x < wanted.width(); ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double v = mean[c] / (static_cast<double>(sample.width()) * sample.height()) *
                                 light.at(x, y) * scale;
                out.pixel(x, y)[c] =
                    static_cast<std::uint8_t>(std::clamp(std::lround(v), 0l, 255l));
            }
        }
    }
    return out;
}

}  // namespace weft
