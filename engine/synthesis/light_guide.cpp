#include "engine/synthesis/light_guide.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {

ImageU8x3 light_guide(ViewU8x3 sample, ViewU8x1 wanted) {
    std::array<double, 3> mean{};
    for (int y = 0; y < sample.height(); ++y) {
        for (int x = 0; x < sample.width(); ++x) {
            for (std::size_t c = 0; c < 3; ++c)
                mean[c] += sample.pixel(x, y)[c];
        }
    }
    double light = 0;
    for (int y = 0; y < wanted.height(); ++y) {
        for (int x = 0; x < wanted.width(); ++x)
            light += wanted.at(x, y);
    }
    const double texels = static_cast<double>(wanted.width()) * wanted.height();
    const double scale = 1.0 / std::max(light / texels, 1.0);
    ImageU8x3 out(wanted.size());
    for (int y = 0; y < wanted.height(); ++y) {
        for (int x = 0; x < wanted.width(); ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double v = mean[c] / (static_cast<double>(sample.width()) * sample.height()) *
                                 wanted.at(x, y) * scale;
                out.pixel(x, y)[c] =
                    static_cast<std::uint8_t>(std::clamp(std::lround(v), 0l, 255l));
            }
        }
    }
    return out;
}

}  // namespace weft
