#pragma once
// The range to which painted mattes are propagated.

#include <algorithm>
#include <limits>
#include <vector>

namespace weft {

/// The direction in which a painted matte is propagated.
enum class PropagationDirection { kBoth, kForward, kBackward };

/// Beyond its reach a matte is empty; painted keyframes hold on their own frames in any case.
struct MatteReach {
    PropagationDirection direction = PropagationDirection::kBoth;
    int first = std::numeric_limits<int>::min(), last = std::numeric_limits<int>::max();

    [[nodiscard]] bool forward() const { return direction != PropagationDirection::kBackward; }
    [[nodiscard]] bool backward() const { return direction != PropagationDirection::kForward; }
    /// Whether a frame gets a matte that was painted on `keys` (ascending, at least one).
    [[nodiscard]] bool covers(int frame, const std::vector<int>& keys) const {
        if (std::binary_search(keys.begin(), keys.end(), frame)) return true;
        if (frame < first || frame > last) return false;
        return (forward() && frame > keys.front()) || (backward() && frame < keys.back());
    }
    bool operator==(const MatteReach&) const = default;
};

}  // namespace weft
