#include "engine/synthesis/autocovariance.h"

#include <cstdlib>
#include <vector>

#include "engine/core/luma.h"
#include "engine/synthesis/plane_fft.h"

namespace weft {

Image<double, 1> autocovariance(ViewU8x3 picture, Vec2i reach) {
    const int w = picture.width(), h = picture.height();
    const PlaneFft fft({fast_fft_size(w + reach.x + 1), fast_fft_size(h + reach.y + 1)});
    double sum = 0;
    const auto luma = [&](int x, int y) {
        const std::uint8_t* p = picture.pixel(x, y);
        return luma_709(static_cast<float>(p[0]), static_cast<float>(p[1]),
                        static_cast<float>(p[2]));
    };
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x)
            sum += static_cast<double>(luma(x, y));
    }
    const auto mean = static_cast<float>(sum / (static_cast<double>(w) * h));
    std::vector<float> plane;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x)
            plane.push_back(luma(x, y) - mean);
    }
    std::vector<FftLanes> rows(fft.spectrum_size());
    fft.forward_rows(plane.data(), picture.size(), rows.data());
    std::vector<FftLanes> spectrum = rows;
    fft.forward_columns(spectrum.data());
    const PlaneFft::Product itself{rows.data(), spectrum.data(), 1.0f};
    fft.correlate({&itself, 1}, rows.data());
    std::vector<float> data(fft.row_stride() * static_cast<std::size_t>(fft.padded_height()));
    fft.backward_rows(rows.data(), 0, reach.y + 1, data.data());
    Image<double, 1> out(2 * reach.x + 1, reach.y + 1);
    const double scale = 1.0 / (4.0 * fft.size().width * fft.size().height);
    for (int dy = 0; dy <= reach.y; ++dy) {
        for (int dx = -reach.x; dx <= reach.x; ++dx) {
            const std::size_t at = static_cast<std::size_t>(dy) * fft.row_stride() +
                                   static_cast<std::size_t>(dx < 0 ? dx + fft.size().width : dx);
            const double pairs = static_cast<double>(w - std::abs(dx)) * (h - dy);
            out.at(dx + reach.x, dy) = static_cast<double>(data[at]) * scale / pairs;
        }
    }
    return out;
}

}  // namespace weft
