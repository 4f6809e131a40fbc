#include "engine/metrics/illumination.h"

#include <algorithm>
#include <cmath>

#include "engine/metrics/region.h"

namespace weft {

std::optional<double> mean_value(ViewF3 encoded, ViewU8x1 matte) {
    RowSum all;
    for (int y = 0; y < encoded.height(); ++y) {
        RowSum row;
        const float* p = encoded.row(y);
        for (int x = 0; x < encoded.width(); ++x, p += 3) {
            if (matte.row(y)[x] < kInsideCoverage) continue;
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
            row.add(255.0 * static_cast<double>(std::max({p[0], p[1], p[2]})));
        }
        all.add(row);
    }
    if (all.count == 0) return std::nullopt;
    return all.mean();
}

void IlluminationVariance::add(double result_mean, double source_mean) {
    ++frames_;
    const double n = static_cast<double>(frames_);
    const double dr = result_mean - mean_r_;
    const double ds = source_mean - mean_s_;
    mean_r_ += dr / n;
    mean_s_ += ds / n;
    m_rr_ += dr * (result_mean - mean_r_);
    m_ss_ += ds * (source_mean - mean_s_);
    m_rs_ += dr * (source_mean - mean_s_);
}

double IlluminationVariance::tiv() const {
    return frames_ > 0 ? m_rr_ / static_cast<double>(frames_) : 0;
}

double IlluminationVariance::source_tiv() const {
    return frames_ > 0 ? m_ss_ / static_cast<double>(frames_) : 0;
}

double IlluminationVariance::tiv_relative() const {
    if (frames_ == 0 || mean_r_ == 0 || mean_s_ == 0) return 0;
    const double sum =
        m_rr_ / (mean_r_ * mean_r_) - 2 * m_rs_ / (mean_r_ * mean_s_) + m_ss_ / (mean_s_ * mean_s_);
    return std::max(0.0, sum / static_cast<double>(frames_));
}

}  // namespace weft
