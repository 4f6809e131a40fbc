#include "engine/composite/grain_levels.h"

#include "engine/core/linear_system.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

constexpr std::size_t kLumaBins = GrainModel::kBins;
constexpr std::size_t kLevelTerms = kLumaBins + 1;  // variances and the share of detail
constexpr int kFitRounds = 24;
constexpr double kFirst = 0.15;  // quantile of the places where the fit begins
// Spreads from the fit at which a place counts half. Above, more than chance is not grain; below,
// places that were denoised or compressed flat are ignored too.
constexpr double kAbove = 0.6, kBelow = 4;
constexpr double kLeastOfUsual = 0.02;  // of the first guess: the least prediction
// The line over luma is stiff: weights of its bends and slopes against all places.
constexpr double kBend = 0.3, kSlope = 0.0005;

using Row = std::array<double, kLevelTerms>;

Row row_of(const GrainPlace& p) {
    Row row{};
    const double at =
        std::clamp(static_cast<double>(p.luma) * kLumaBins - 0.5, 0.0, kLumaBins - 1.0);
    const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), kLumaBins - 2);
    const double t = at - static_cast<double>(below);
    row[below] = 1 - t, row[below + 1] = t;
    row[kLumaBins] = std::max(0.0f, p.detail);
    return row;
}

double dot(const Row& a, const Row& b) {
    double sum = 0;
    for (std::size_t k = 0; k < kLevelTerms; ++k)
        sum += a[k] * b[k];
    return sum;
}

// Normal equations under a penalty for bends and slopes; without detail where `flat`.
struct Equations {
    LinearSystem<kLevelTerms> m{};

    void add(const Row& row, double value, double weight) {
        for (std::size_t i = 0; i < kLevelTerms; ++i) {
            if (row[i] == 0) continue;
            for (std::size_t j = 0; j < kLevelTerms; ++j)
                m[i][j] += weight * row[i] * row[j];
            m[i][kLevelTerms] += weight * row[i] * value;
        }
    }
};

Row fitted_levels(const std::vector<GrainPlace>& places, const std::vector<double>& weights,
                  bool detail) {
    Equations e;
    double total = 0, energy = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Row row = row_of(places[i]);
        energy += weights[i] * row[kLumaBins] * row[kLumaBins];
        if (!detail) row[kLumaBins] = 0;
        e.add(row, places[i].variance, weights[i]);
        total += weights[i];
    }
    for (std::size_t k = 0; k + 1 < kLumaBins; ++k) {
        Row row{};
        row[k] = -1, row[k + 1] = 1;
        e.add(row, 0, kSlope * total);
        if (k + 2 == kLumaBins) continue;
        row[k] = 1, row[k + 1] = -2, row[k + 2] = 1;
        e.add(row, 0, kBend * total);
    }
    e.m[kLumaBins][kLumaBins] += 1e-6 * energy + 1e-30;
    for (std::size_t k = 0; k < kLumaBins; ++k)
        e.m[k][k] += 1e-9 * total;
    return solve(e.m);
}

}  // namespace

GrainLevels grain_levels(const std::vector<GrainPlace>& places) {
    GrainLevels out;
    out.confidence.assign(places.size(), 0.0f);
    if (places.empty()) return out;
    std::vector<float> sorted;
    for (const GrainPlace& p : places)
        sorted.push_back(p.variance);
    const auto first =
        sorted.begin() + static_cast<std::ptrdiff_t>(kFirst * static_cast<double>(sorted.size()));
    std::nth_element(sorted.begin(), first, sorted.end());
    const double usual = std::max(1e-12, static_cast<double>(*first));

    std::vector<double> expected(places.size(), usual), weights(places.size());
    Row fit{};
    for (int round = 0; round < kFitRounds; ++round) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double spread = places[i].spread * expected[i];
            const double away = (places[i].variance - expected[i]) / spread;
            const double limit = away > 0 ? kAbove : kBelow;
            const double confidence = 1 / (1 + away * away / (limit * limit));
            out.confidence[i] = static_cast<float>(confidence);
            weights[i] = confidence / (spread * spread);
        }
        fit = fitted_levels(places, weights, true);
        if (fit[kLumaBins] < 0) fit = fitted_levels(places, weights, false), fit[kLumaBins] = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
            expected[i] = std::max(kLeastOfUsual * usual, dot(fit, row_of(places[i])));
    }
    for (std::size_t k = 0; k < kLumaBins; ++k)
        out.variance[k] = std::max(0.0, fit[k]);
    out.of_detail = fit[kLumaBins];
    return out;
}

}  // namespace weft
