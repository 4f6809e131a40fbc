#include "engine/media/frame_pacing.h"

#include <algorithm>

namespace weft {
namespace {

std::vector<std::int64_t> sorted_durations(const std::vector<std::int64_t>& stamps) {
    std::vector<std::int64_t> out;
    for (std::size_t i = 1; i < stamps.size(); ++i)
        out.push_back(stamps[i] - stamps[i - 1]);
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

FramePacing::Durations FramePacing::durations() const {
    const auto sorted = sorted_durations(stamps_);
    return sorted.empty() ? Durations{} : Durations{sorted.front(), sorted.back()};
}

bool FramePacing::varies() const {
    const auto sorted = sorted_durations(stamps_);
    if (!known_ || sorted.size() < 2) return false;
    const std::int64_t usual = sorted[sorted.size() / 2];
    constexpr std::int64_t kRounding = 2, kShare = 10;  // ticks; a tenth of the usual duration
    const std::int64_t tolerance = std::max(kRounding, usual / kShare);
    return usual - sorted.front() > tolerance || sorted.back() - usual > tolerance;
}

}  // namespace weft
