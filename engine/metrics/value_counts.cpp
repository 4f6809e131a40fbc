#include "engine/metrics/value_counts.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr double kPerUnit = 8192, kReach = 40;
constexpr auto kBins = static_cast<std::size_t>(2 * kReach * kPerUnit);

// How many lie below a value, from the counts below each bin.
double below(const std::vector<std::int64_t>& sums, double value) {
    const double at = std::clamp((value + kReach) * kPerUnit, 0.0, static_cast<double>(kBins));
    const auto bin = std::min(static_cast<std::size_t>(at), kBins - 1);
    const auto before = static_cast<double>(sums[bin]);
    return before + (at - static_cast<double>(bin)) * (static_cast<double>(sums[bin + 1]) - before);
}

std::vector<std::int64_t> sums_of(const std::vector<std::int64_t>& bins) {
    std::vector<std::int64_t> sums(kBins + 1, 0);
    for (std::size_t i = 0; i < kBins; ++i)
        sums[i + 1] = sums[i] + bins[i];
    return sums;
}

// The least x at which a rising function reaches `wanted`.
template <class F>
double reached(double low, double high, double wanted, const F& rising) {
    constexpr int kSteps = 50;
    for (int i = 0; i < kSteps; ++i) {
        const double middle = 0.5 * (low + high);
        (rising(middle) < wanted ? low : high) = middle;
    }
    return high;
}

}  // namespace

ValueCounts::ValueCounts() : bins_(kBins, 0) {}

void ValueCounts::add(double value) {
    const double at = std::clamp((value + kReach) * kPerUnit, 0.0, static_cast<double>(kBins - 1));
    ++bins_[static_cast<std::size_t>(at)];
    ++count_;
}

double ValueCounts::quantile(double share) const {
    const std::vector<std::int64_t> sums = sums_of(bins_);
    return reached(-kReach, kReach, share * static_cast<double>(count_),
                   [&](double x) { return below(sums, x); });
}

double ValueCounts::distance_quantile(double middle, double share) const {
    const std::vector<std::int64_t> sums = sums_of(bins_);
    return reached(0, 2 * kReach, share * static_cast<double>(count_),
                   [&](double d) { return below(sums, middle + d) - below(sums, middle - d); });
}

}  // namespace weft
