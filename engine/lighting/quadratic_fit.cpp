#include "engine/lighting/quadratic_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/core/linear_system.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kMostDegree = 6;
constexpr std::size_t kMostTerms = (kMostDegree + 1) * (kMostDegree + 2) / 2;
constexpr int kSamples = 40;  // along the longer side: enough, because the fit is smooth
constexpr int kRounds = 8;
constexpr double kCauchy = 0.1;  // ln units
constexpr double kRidge = 1e-5;

using Terms = std::array<double, kMostTerms>;

std::size_t terms_of_degree(int degree) {
    return static_cast<std::size_t>((degree + 1) * (degree + 2) / 2);
}

// u^(d − k) v^k by degree.
void fill_terms(int degree, double u, double v, Terms& out) {
    out[0] = 1;
    std::size_t at = 1, before = 0;
    for (int d = 1; d <= degree; ++d) {
        const auto count = static_cast<std::size_t>(d);
        for (std::size_t k = 0; k < count; ++k)
            out[at + k] = out[before + k] * u;
        out[at + count] = out[before + count - 1] * v;
        before = at, at += count + 1;
    }
}

double value_of(const std::vector<double>& c, const Terms& t) {
    double sum = 0;
    for (std::size_t k = 0; k < c.size(); ++k)
        sum += c[k] * t[k];
    return sum;
}

}  // namespace

PolynomialFit::PolynomialFit(const ImageF1& plane, const ImageF1& weight, int degree)
    : degree_(std::clamp(degree, 1, kMostDegree)),
      size_(plane.size()),
      coefficients_(terms_of_degree(degree_), 0.0) {
    const std::size_t n = coefficients_.size();
    centre_x_ = 0.5 * plane.width(), centre_y_ = 0.5 * plane.height();
    const int longer = std::max(1, std::max(plane.width(), plane.height()));
    scale_ = 2.0 / longer;
    const int step = std::max(1, longer / kSamples);
    Terms t{};
    for (int round = 0; round < kRounds; ++round) {
        std::vector<double> normal(n * (n + 1), 0.0);
        double total = 0;
        for (int y = 0; y < plane.height(); y += step) {
            for (int x = 0; x < plane.width(); x += step) {
                double w = weight.row(y)[x];
                if (w == 0) continue;
                const double value = plane.row(y)[x];
                fill_terms(degree_, (x - centre_x_) * scale_, (y - centre_y_) * scale_, t);
                if (round > 0) {
                    // The scale goes from wide to narrow, so that an edge does not fix the first
                    // fit.
                    const double scale = kCauchy * std::max(1, 1 << std::max(0, 4 - round));
                    const double away = (value - value_of(coefficients_, t)) / scale;
                    w /= 1.0 + away * away;
                }
                total += w;
                for (std::size_t i = 0; i < n; ++i) {
                    for (std::size_t j = i; j < n; ++j)
                        normal[i * (n + 1) + j] += w * t[i] * t[j];
                    normal[i * (n + 1) + n] += w * t[i] * value;
                }
            }
        }
        if (!(total > 0)) return;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < i; ++j)
                normal[i * (n + 1) + j] = normal[j * (n + 1) + i];
            if (i > 0) normal[i * (n + 1) + i] += kRidge * total;
        }
        // The ridge keeps the matrix positive definite.
        coefficients_ = solve(std::move(normal), n);
    }
}

// Along a row it is a polynomial in u alone, whose coefficients are gathered once.
ImageF1 PolynomialFit::surface() const {
    ImageF1 out(size_);
    parallel_rows(size_.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const double v = (y - centre_y_) * scale_;
            std::array<double, kMostDegree + 1> along{};
            std::size_t term = 0;
            for (int d = 0; d <= degree_; ++d) {
                double power = 1;
                for (int k = 0; k <= d; ++k, ++term, power *= v)
                    along[static_cast<std::size_t>(d - k)] += power * coefficients_[term];
            }
            float* row = out.row(y);
            for (int x = 0; x < size_.width; ++x) {
                const double u = (x - centre_x_) * scale_;
                double sum = 0;
                for (auto d = static_cast<std::size_t>(degree_) + 1; d-- > 0;)
                    sum = sum * u + along[d];
                row[x] = static_cast<float>(sum);
            }
        }
    });
    return out;
}

}  // namespace weft
