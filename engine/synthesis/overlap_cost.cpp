#include "engine/synthesis/overlap_cost.h"

#include <algorithm>

#include "engine/core/isa.h"

namespace weft {
namespace {

// A run has at most 2^14 pixels of 3 channels, and its sum may exceed 32 bits; a chunk's does not.
constexpr int kChunk = 4096;

// The compiler turns this into widening multiply-adds. Forced inline so that each caller compiles
// it for its own instruction set. Integer sums do not depend on the vector width.
[[gnu::always_inline]] inline std::uint64_t squared_differences(const std::uint8_t* a,
                                                                const std::uint8_t* b, int n) {
    std::uint64_t total = 0;
    for (int start = 0; start < n; start += kChunk) {
        const int end = std::min(n, start + kChunk);
        std::int32_t part = 0;
        for (int i = start; i < end; ++i) {
            const auto d = static_cast<std::int16_t>(a[i] - b[i]);
            part += d * d;
        }
        total += static_cast<std::uint64_t>(part);
    }
    return total;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] std::uint64_t squared_differences_avx2(const std::uint8_t* a,
                                                               const std::uint8_t* b, int n) {
    return squared_differences(a, b, n);
}
#endif

std::uint64_t squared_differences_any(const std::uint8_t* a, const std::uint8_t* b, int n) {
    return squared_differences(a, b, n);
}

using SumFn = std::uint64_t (*)(const std::uint8_t*, const std::uint8_t*, int);

SumFn sum_for(Isa isa) {
#if defined(__x86_64__)
    if (isa != Isa::kScalar) return squared_differences_avx2;
#endif
    (void)isa;
    return squared_differences_any;
}

}  // namespace

bool at_most(const OverlapCost& a, const OverlapCost& b, std::uint32_t numerator,
             std::uint32_t denominator) {
    using Wide = unsigned __int128;
    const std::uint64_t wa = std::max<std::uint64_t>(a.weight, 1);
    const std::uint64_t wb = std::max<std::uint64_t>(b.weight, 1);
    return Wide{a.ssd} * wb * denominator <= Wide{b.ssd} * wa * numerator;
}

OverlapScorer::OverlapScorer(const MatchTarget& target, ViewU8x3 sample)
    : target_(target), sample_(sample), filled_(runs_of(target.filled)) {
    if (!target.guide.empty()) guided_ = runs_of(target.guide_known);
    for (const auto* runs : {&filled_, &guided_}) {
        for (const Run& r : *runs)
            pixels_ += r.x1 - r.x0;
    }
}

std::vector<OverlapScorer::Run> OverlapScorer::runs_of(ViewU8x1 mask) {
    std::vector<Run> runs;
    for (int y = 0; y < mask.height(); ++y) {
        const std::uint8_t* row = mask.row(y);
        for (int x = 0; x < mask.width();) {
            if (!row[x]) {
                ++x;
                continue;
            }
            const int start = x;
            while (x < mask.width() && row[x])
                ++x;
            runs.push_back({y, start, x});
        }
    }
    return runs;
}

OverlapCost OverlapScorer::sum(const std::vector<Run>& runs, ViewU8x3 picture, Vec2i t) const {
    const SumFn sum_of = sum_for(current_isa());
    OverlapCost cost;
    for (const Run& r : runs) {
        if (r.y < t.y || r.y >= t.y + sample_.height()) continue;
        const int x0 = std::max(r.x0, t.x), x1 = std::min(r.x1, t.x + sample_.width());
        if (x1 <= x0) continue;
        cost.ssd +=
            sum_of(picture.pixel(x0, r.y), sample_.pixel(x0 - t.x, r.y - t.y), 3 * (x1 - x0));
        cost.weight += static_cast<std::uint64_t>(x1 - x0);
    }
    return cost;
}

OverlapCost OverlapScorer::cost(Vec2i t) const {
    const OverlapCost fill = sum(filled_, target_.pixels, t);
    const OverlapCost guide = sum(guided_, target_.guide, t);
    return {fill.ssd * target_.fill_weight + guide.ssd * target_.guide_weight,
            fill.weight * target_.fill_weight + guide.weight * target_.guide_weight};
}

}  // namespace weft
