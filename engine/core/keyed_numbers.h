#pragma once
// Numbers over time: what a slider with keyframes holds.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// Keyframes of one or more numbers: linear between two keys, constant outside of them.
struct KeyedNumbers {
    /// By frame, ascending, each frame once; all keys have the same count of numbers.
    std::vector<std::pair<int, std::vector<double>>> keys;

    [[nodiscard]] bool empty() const { return keys.empty(); }
    [[nodiscard]] bool has(int frame) const;
    /// The numbers on a frame; none where there are no keys.
    [[nodiscard]] std::vector<double> at(int frame) const;
    /// The same, rounded to float first and interpolated in float: what pictures are computed with.
    [[nodiscard]] std::vector<float> float_at(int frame) const;
    /// Adds a key or replaces the one on `frame`.
    void set(int frame, std::vector<double> numbers);
    void erase(int frame);

    bool operator==(const KeyedNumbers&) const = default;
};

/// From "1:1 24:0.3" or, with two numbers a key, "1:0,0 24:10,5"; a single key may leave out its
/// frame (frame 0 then). Errors: Usage with what is wrong.
[[nodiscard]] Expected<KeyedNumbers> parse_keyed_numbers(std::string_view text,
                                                         std::size_t count = 1);
/// One key: "FRAME: numbers", or only "numbers" where `only` says that there is no other. The
/// numbers stand between commas or spaces. Errors: Usage.
[[nodiscard]] Expected<std::pair<int, std::vector<double>>> parse_key(std::string_view text,
                                                                      bool only, std::size_t count);
/// Sorts keys by frame. Errors: Usage when a frame has two.
[[nodiscard]] Expected<KeyedNumbers> sorted_keys(
    std::vector<std::pair<int, std::vector<double>>> keys);
/// The text that parse_keyed_numbers() reads back to the same numbers.
[[nodiscard]] std::string keyed_text(const KeyedNumbers& keys);

}  // namespace weft
