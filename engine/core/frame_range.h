#pragma once
// Frame numbers as artists write them: "1-40", "1-100x2", "-5--1", "1,4,9-12".

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// Frame numbers go from −kMaxFrameNumber to kMaxFrameNumber, so that sums and differences of two
/// of them fit into an int.
inline constexpr int kMaxFrameNumber = 100'000'000;
[[nodiscard]] constexpr bool is_frame_number(long long number) {
    return number >= -kMaxFrameNumber && number <= kMaxFrameNumber;
}

/// Half-open range of frame numbers [first, last_plus_one). Numbers may be negative.
struct FrameRange {
    int begin = 0;
    int end = 0;
    bool operator==(const FrameRange&) const = default;
    [[nodiscard]] bool empty() const { return end <= begin; }
    [[nodiscard]] int count() const { return empty() ? 0 : end - begin; }
    [[nodiscard]] bool contains(int frame) const { return frame >= begin && frame < end; }
};

/// Parses a frame list into ascending, distinct numbers. Accepts single numbers, `a-b` (inclusive)
/// and `a-bxN` (every Nth), joined by commas. Errors: Usage on anything else, on b < a, on N < 1,
/// on numbers beyond kMaxFrameNumber and on more than a million frames.
[[nodiscard]] Expected<std::vector<int>> parse_frame_list(std::string_view text);

/// The shortest text that parse_frame_list() turns back into `frames` (ascending, distinct).
[[nodiscard]] std::string format_frame_list(const std::vector<int>& frames);

}  // namespace weft
