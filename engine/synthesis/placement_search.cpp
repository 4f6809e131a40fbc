#include "engine/synthesis/placement_search.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>

#include "engine/core/isa.h"
#include "engine/synthesis/direct_search.h"
#include "engine/synthesis/fft_correlation.h"

namespace weft {
namespace {

// Measured on x86-64: seconds per byte of a direct comparison (samples of 96 to 200 px), and per
// one of the 5·n·log2 n nominal operations of a transform (planes of 120² to 500²).
struct SearchTimes {
    double direct_byte_ns, fft_operation_ns;
};
SearchTimes search_times() {
    switch (current_isa()) {
        case Isa::kAvx512:
            return {0.009, 0.025};
        case Isa::kAvx2:
            return {0.016, 0.029};
        default:
            return {0.045, 0.036};
    }
}
constexpr int kTransforms = 5;

bool better(const OverlapCost& a, const OverlapCost& b) {
    return !at_most(b, a);
}

}  // namespace

std::vector<std::uint8_t> allowed_translations(Vec2i lo, Vec2i hi,
                                               const std::vector<Vec2i>& forbidden) {
    const auto columns = static_cast<std::size_t>(hi.x - lo.x + 1);
    std::vector<std::uint8_t> ok(columns * static_cast<std::size_t>(hi.y - lo.y + 1), 1);
    for (const Vec2i t : forbidden) {
        if (t.x < lo.x || t.x > hi.x || t.y < lo.y || t.y > hi.y) continue;
        ok[static_cast<std::size_t>(t.y - lo.y) * columns + static_cast<std::size_t>(t.x - lo.x)] =
            0;
    }
    if (std::find(ok.begin(), ok.end(), 1) == ok.end()) std::fill(ok.begin(), ok.end(), 1);
    return ok;
}

struct PlacementSearch::Once {
    std::once_flag direct, fft;
};

PlacementSearch::PlacementSearch(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi)
    : sample_(sample), block_(block), lo_(lo), hi_(hi), once_(std::make_unique<Once>()) {}
PlacementSearch::~PlacementSearch() = default;
PlacementSearch::PlacementSearch(PlacementSearch&&) noexcept = default;

std::size_t PlacementSearch::count() const {
    return static_cast<std::size_t>(hi_.x - lo_.x + 1) *
           static_cast<std::size_t>(hi_.y - lo_.y + 1);
}

Shortlist PlacementSearch::find(const MatchTarget& target, const std::vector<Vec2i>& forbidden,
                                SearchMethod method) {
    const std::vector<std::uint8_t> ok = allowed_translations(lo_, hi_, forbidden);
    if (method == SearchMethod::kFastest) {
        method = direct_is_faster(target, ok) ? SearchMethod::kDirect : SearchMethod::kFft;
    }
    return method == SearchMethod::kFft ? find_fft(target, ok) : find_direct(target, ok);
}

bool PlacementSearch::direct_is_faster(const MatchTarget& target,
                                       const std::vector<std::uint8_t>& ok) const {
    double compared = 0;
    for (const TranslationGroup& group : group_translations(ok, hi_.x - lo_.x + 1))
        compared += static_cast<double>(group.columns.size()) * group.rows;
    double pixels = 0;
    for (const ViewU8x1& mask : {target.filled, target.guide_known}) {
        for (int y = 0; y < mask.height(); ++y)
            pixels +=
                static_cast<double>(std::accumulate(mask.row(y), mask.row(y) + mask.width(), 0));
    }
    const double n = static_cast<double>(sample_.width() + hi_.x) * (sample_.height() + hi_.y);
    const SearchTimes times = search_times();
    const double fft_ns = times.fft_operation_ns * kTransforms * 5 * n * std::log2(n);
    return times.direct_byte_ns * 3 * pixels * compared < fft_ns;
}

Shortlist PlacementSearch::find_direct(const MatchTarget& target,
                                       const std::vector<std::uint8_t>& ok) {
    std::call_once(once_->direct,
                   [&] { direct_ = std::make_unique<DirectSearch>(sample_, block_, lo_, hi_); });
    const std::vector<OverlapCost> costs = direct_->costs(target, ok);
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < count(); ++i) {
        if (ok[i] && (!best || better(costs[i], costs[*best]))) best = i;
    }
    Shortlist list{{}, translation(*best), costs[*best]};
    for (std::size_t i = 0; i < count(); ++i) {
        if (ok[i] && at_most(costs[i], costs[*best], kGoodNumerator, kGoodDenominator)) {
            list.good.push_back(translation(i));
        }
    }
    return list;
}

// The estimates decide where they are certain. Candidates within their error of the best or of the
// limit are scored exactly.
Shortlist PlacementSearch::find_fft(const MatchTarget& target,
                                    const std::vector<std::uint8_t>& ok) {
    const OverlapScorer scorer(target, sample_);
    std::call_once(once_->fft,
                   [&] { fft_ = std::make_unique<FftCorrelation>(sample_, block_, lo_, hi_); });
    const FftCorrelation::Estimate estimate = fft_->estimate(target);
    const auto mean = [&](std::size_t i, double error) {
        const auto weight = static_cast<double>(std::max<std::uint64_t>(estimate.weight[i], 1));
        return (estimate.ssd[i] + error) / weight;
    };
    double ceiling = HUGE_VAL;
    for (std::size_t i = 0; i < count(); ++i) {
        if (ok[i]) ceiling = std::min(ceiling, mean(i, estimate.error));
    }
    const std::size_t too_many = count() / 4 + 16;
    std::size_t scored = 0;
    std::optional<std::size_t> best;
    OverlapCost best_cost;
    for (std::size_t i = 0; i < count(); ++i) {
        if (!ok[i] || mean(i, -estimate.error) > ceiling) continue;
        if (++scored > too_many) return find_direct(target, ok);
        const OverlapCost cost = scorer.cost(translation(i));
        if (!best || better(cost, best_cost)) best = i, best_cost = cost;
    }

    Shortlist list{{}, translation(*best), best_cost};
    const double limit =
        static_cast<double>(best_cost.ssd) * kGoodNumerator /
        (static_cast<double>(std::max<std::uint64_t>(best_cost.weight, 1)) * kGoodDenominator);
    const double slack = 1e-9 * limit;  // rounding of these few double operations
    for (std::size_t i = 0; i < count(); ++i) {
        if (!ok[i] || mean(i, -estimate.error) > limit + slack) continue;
        if (mean(i, estimate.error) > limit - slack) {
            if (++scored > too_many) return find_direct(target, ok);
            if (!at_most(scorer.cost(translation(i)), best_cost, kGoodNumerator,
                         kGoodDenominator)) {
                continue;
            }
        }
        list.good.push_back(translation(i));
    }
    return list;
}

}  // namespace weft
