#include "engine/lighting/quadratic_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

constexpr std::size_t kTerms = 6;
constexpr int kStep = 2;  // pixels: the fit is smooth
constexpr int kRounds = 3;
constexpr double kCauchy = 0.1;    // ln units
constexpr double kRidge = 1e-4;

using Terms = std::array<double, kTerms>;

Terms terms(double u, double v) {
    return {1.0, u, v, u * u, u * v, v * v};
}

double value_of(const Terms& c, const Terms& t) {
    double sum = 0;
    for (std::size_t k = 0; k < kTerms; ++k)
        sum += c[k] * t[k];
    return sum;
}

// Gaussian elimination without a pivot: the ridge keeps the matrix positive definite.
Terms solve(std::array<std::array<double, kTerms + 1>, kTerms> m) {
    for (std::size_t k = 0; k < kTerms; ++k) {
        for (std::size_t i = k + 1; i < kTerms; ++i) {
            const double f = m[i][k] / m[k][k];
            for (std::size_t j = k; j <= kTerms; ++j)
                m[i][j] -= f * m[k][j];
        }
    }
    Terms x{};
    for (std::size_t k = kTerms; k-- > 0;) {
        double rest = m[k][kTerms];
        for (std::size_t j = k + 1; j < kTerms; ++j)
            rest -= m[k][j] * x[j];
        x[k] = rest / m[k][k];
    }
    return x;
}

}  // namespace

QuadraticFit::QuadraticFit(const ImageF1& plane, const ImageF1& weight) {
    centre_x_ = 0.5 * plane.width(), centre_y_ = 0.5 * plane.height();
    scale_ = 2.0 / std::max(1, std::max(plane.width(), plane.height()));
    for (int round = 0; round < kRounds; ++round) {
        std::array<std::array<double, kTerms + 1>, kTerms> normal{};
        double total = 0;
        for (int y = 0; y < plane.height(); y += kStep) {
            for (int x = 0; x < plane.width(); x += kStep) {
                double w = weight.row(y)[x];
                if (w == 0) continue;
                const double value = plane.row(y)[x];
                const Terms t = terms((x - centre_x_) * scale_, (y - centre_y_) * scale_);
                if (round > 0) {
                    const double away = (value - value_of(coefficients_, t)) / kCauchy;
                    w /= 1.0 + away * away;
                }
                total += w;
                for (std::size_t i = 0; i < kTerms; ++i) {
                    for (std::size_t j = 0; j < kTerms; ++j)
                        normal[i][j] += w * t[i] * t[j];
                    normal[i][kTerms] += w * t[i] * value;
                }
            }
        }
        if (!(total > 0)) return;
        for (std::size_t i = 1; i < kTerms; ++i)
            normal[i][i] += kRidge * total;
        coefficients_ = solve(normal);
    }
}

float QuadraticFit::at(int x, int y) const {
    return static_cast<float>(
        value_of(coefficients_, terms((x - centre_x_) * scale_, (y - centre_y_) * scale_)));
}

}  // namespace weft
