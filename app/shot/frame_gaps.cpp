#include "app/shot/frame_gaps.h"

#include <algorithm>

namespace weft {

std::vector<FrameSpan> gaps_in(const std::vector<int>& present, FrameSpan span) {
    std::vector<FrameSpan> gaps;
    int next = span.first;
    for (auto at = std::lower_bound(present.begin(), present.end(), span.first);
         at != present.end() && *at <= span.last; ++at) {
        if (*at > next) gaps.push_back({next, *at - 1});
        next = *at + 1;
    }
    if (next <= span.last) gaps.push_back({next, span.last});
    return gaps;
}

FrameSpan run_with(const std::vector<int>& present, int frame) {
    auto first = std::lower_bound(present.begin(), present.end(), frame);
    if (first == present.end() || *first != frame) return {1, 0};
    auto last = first;
    while (first != present.begin() && *std::prev(first) == *first - 1)
        --first;
    while (std::next(last) != present.end() && *std::next(last) == *last + 1)
        ++last;
    return {*first, *last};
}

std::string gaps_text(const std::vector<FrameSpan>& gaps) {
    constexpr std::size_t kLongest = 80;
    std::string list;
    for (const FrameSpan& gap : gaps) {
        if (list.size() > kLongest) {
            list += ",…";
            break;
        }
        if (!list.empty()) list += ',';
        list += std::to_string(gap.first);
        if (gap.last > gap.first) list += '-' + std::to_string(gap.last);
    }
    const bool one = gaps.size() == 1 && gaps[0].first == gaps[0].last;
    return (one ? "frame " : "frames ") + list;
}

}  // namespace weft
