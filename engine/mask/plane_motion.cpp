#include "engine/mask/plane_motion.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/core.hpp>

namespace weft {
namespace {

constexpr int kRounds = 6;
constexpr float kLeastScalePx = 0.1f;
// The terms that say something of each coordinate; the others are 0.
constexpr std::array<std::array<std::size_t, 5>, 2> kTermsOf = {{{0, 1, 2, 6, 7}, {3, 4, 5, 6, 7}}};

}  // namespace

PlaneMotion::PlaneMotion(Size frame)
    : centre_x_(0.5 * frame.width), centre_y_(0.5 * frame.height), unit_(1.0 / frame.width) {}

PlaneMotion::PlaneMotion(std::vector<MotionSample> samples, Size frame) : PlaneMotion(frame) {
    constexpr std::size_t kFewest = 4 * kTerms;
    if (samples.size() < kFewest) return;
    // Begins with the median shift: a third of a frame that moves otherwise would drag a fit of
    // all.
    const auto median = [&](float Vec2::*of) {
        std::vector<float> all(samples.size());
        std::transform(samples.begin(), samples.end(), all.begin(),
                       [&](const MotionSample& s) { return s.d.*of; });
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        return static_cast<double>(*middle);
    };
    p_[0] = median(&Vec2::x);
    p_[3] = median(&Vec2::y);
    std::vector<float> misses(samples.size());
    for (int round = 0; round <= kRounds; ++round) {
        if (round > 0) fit(samples);
        for (std::size_t i = 0; i < samples.size(); ++i)
            misses[i] = glm::length(samples[i].d - at(samples[i].x, samples[i].y));
        std::vector<float> sorted = misses;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const float scale = 1.5f * std::max(*middle / 1.177f, kLeastScalePx);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const float r = misses[i] / scale;
            samples[i].weight = 1 / (1 + r * r);
        }
    }
}

std::array<PlaneMotion::Terms, 2> PlaneMotion::rows(double px, double py) const {
    const double x = (px - centre_x_) * unit_, y = (py - centre_y_) * unit_;
    return {{{1, x, y, 0, 0, 0, x * x, x * y}, {0, 0, 0, 1, x, y, x * y, y * y}}};
}

Vec2 PlaneMotion::at(double px, double py) const {
    const double x = (px - centre_x_) * unit_, y = (py - centre_y_) * unit_;
    const double u = p_[0] + p_[1] * x + p_[2] * y + p_[6] * (x * x) + p_[7] * (x * y);
    const double v = p_[3] + p_[4] * x + p_[5] * y + p_[6] * (x * y) + p_[7] * (y * y);
    return {static_cast<float>(u), static_cast<float>(v)};
}

void PlaneMotion::fit(const std::vector<MotionSample>& samples) {
    cv::Matx<double, kTerms, kTerms> a = cv::Matx<double, kTerms, kTerms>::eye() * 1e-3;
    cv::Vec<double, kTerms> b;
    for (const MotionSample& s : samples) {
        const auto of_sample = rows(s.x, s.y);
        for (std::size_t k = 0; k < 2; ++k) {
            const double d = static_cast<double>(k == 0 ? s.d.x : s.d.y);
            for (const std::size_t i : kTermsOf[k]) {
                const double w = static_cast<double>(s.weight) * of_sample[k][i];
                b[static_cast<int>(i)] += w * d;
                for (const std::size_t j : kTermsOf[k])
                    a(static_cast<int>(i), static_cast<int>(j)) += w * of_sample[k][j];
            }
        }
    }
    cv::Vec<double, kTerms> p;
    if (!cv::solve(a, b, p, cv::DECOMP_CHOLESKY)) return;
    for (std::size_t i = 0; i < kTerms; ++i)
        p_[i] = p[static_cast<int>(i)];
}

}  // namespace weft
