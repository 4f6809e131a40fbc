#include "engine/pipeline/matte_stretch.h"

#include <iterator>
#include <utility>

namespace weft {

std::optional<int> MatteStretch::key_before() const {
    return is_key(own.first) ? std::optional(own.first) : std::nullopt;
}

std::optional<int> MatteStretch::key_after() const {
    return keys.back() > own.last ? std::optional(keys.back()) : std::nullopt;
}

bool MatteStretch::merged(int frame) const {
    return !is_key(frame) && holds(forward(), frame) && holds(backward(), frame);
}

FrameSpan MatteStretch::forward() const {
    if (const auto key = key_before()) {
        const int last = reach.forward() ? std::min(own.last, reach.last) : *key;
        return {*key, std::max(*key, last)};
    }
    const int last = std::min(own.last, reach.last);
    const bool any = reach.forward() && !confirmed.empty() && confirmed.front() < last;
    return any ? FrameSpan{confirmed.front(), last} : kNone;
}

FrameSpan MatteStretch::backward() const {
    if (!reach.backward()) return kNone;
    const int first = std::max(key_before() ? own.first + 1 : own.first, reach.first);
    std::optional<int> last = key_after();
    if (!last && !confirmed.empty()) last = confirmed.back();
    return last && first < *last ? FrameSpan{first, *last} : kNone;
}

FrameSpan MatteStretch::merging() const {
    const FrameSpan there = forward(), back = backward();
    if (length(there) <= 0 || length(back) <= 0) return kNone;
    const FrameSpan both{std::max(there.first, back.first), std::min(there.last, back.last)};
    return length(both) > 0 ? both : kNone;
}

FrameSpan MatteStretch::collecting() const {
    const FrameSpan back = backward();
    if (length(merging()) == 0 || key_before() != back.first - 1) return back;
    return {back.first - 1, back.last};
}

FrameSpan visited(const std::vector<MatteStretch>& jobs, FrameSpan (MatteStretch::*of)() const) {
    FrameSpan all = MatteStretch::kNone;
    for (const MatteStretch& job : jobs) {
        const FrameSpan one = (job.*of)();
        if (one.first > one.last) continue;
        const bool first = all.first > all.last;
        all.first = first ? one.first : std::min(all.first, one.first);
        all.last = first ? one.last : std::max(all.last, one.last);
    }
    return all;
}

std::vector<MatteStretch> stretches(int region, int layer, const PaintedMatte& painted,
                                    FrameSpan span) {
    std::vector<MatteStretch> out;
    const std::vector<int>& keys = painted.keys;
    const auto add = [&](std::vector<int> ends, int first, int last) {
        if (first > last) return;
        const bool two_ends = ends.size() == 2;
        MatteStretch one{region,
                         layer,
                         std::move(ends),
                         {},
                         painted.reach,
                         {first, last},
                         {painted.steadiness, false, two_ends}};
        std::copy_if(painted.confirmed.begin(), painted.confirmed.end(),
                     std::back_inserter(one.confirmed), [&](int frame) {
                         return holds(one.own, frame) && !one.is_key(frame) &&
                                painted.reach.covers(frame, keys);
                     });
        out.push_back(std::move(one));
    };
    add({keys.front()}, span.first, keys.front() - 1);
    for (std::size_t k = 0; k + 1 < keys.size(); ++k)
        add({keys[k], keys[k + 1]}, keys[k], keys[k + 1] - 1);
    add({keys.back()}, keys.back(), span.last);
    return out;
}

}  // namespace weft
