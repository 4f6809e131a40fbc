#include "engine/lighting/pattern_period.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kShortest = 4;
constexpr double kClearPeak = 0.12;  // of the energy
constexpr double kRise = 0.08;       // above the lowest value before it

// Normalised autocorrelation for lags 0 to `longest` along one axis.
std::vector<double> autocorrelation(const ImageF1& pattern, const ImageF1& weight, int longest,
                                    bool along_x) {
    std::vector<double> out(static_cast<std::size_t>(longest) + 1, 0.0);
    parallel_for(out.size(), [&](std::size_t index) {
        const int lag = static_cast<int>(index);
        const int dx = along_x ? lag : 0, dy = along_x ? 0 : lag;
        double cross = 0, energy = 0;
        for (int y = 0; y + dy < pattern.height(); ++y) {
            const float *a = pattern.row(y), *b = pattern.row(y + dy) + dx;
            const float *wa = weight.row(y), *wb = weight.row(y + dy) + dx;
            for (int x = 0; x + dx < pattern.width(); ++x) {
                if (wa[x] == 0 || wb[x] == 0) continue;
                cross += static_cast<double>(a[x]) * b[x];
                energy +=
                    0.5 * (static_cast<double>(a[x]) * a[x] + static_cast<double>(b[x]) * b[x]);
            }
        }
        out[index] = energy > 0 ? cross / energy : 0.0;
    });
    return out;
}

int first_peak(const std::vector<double>& correlation) {
    double lowest = 1;
    for (std::size_t k = 1; k + 1 < correlation.size(); ++k) {
        const double c = correlation[k];
        lowest = std::min(lowest, c);
        if (k >= kShortest && c > kClearPeak && c > lowest + kRise && c >= correlation[k - 1] &&
            c >= correlation[k + 1])
            return static_cast<int>(k);
    }
    return 0;
}

}  // namespace

int pattern_period_px(const ImageF1& pattern, const ImageF1& weight, int longest) {
    return std::max(first_peak(autocorrelation(pattern, weight, longest, true)),
                    first_peak(autocorrelation(pattern, weight, longest, false)));
}

}  // namespace weft
