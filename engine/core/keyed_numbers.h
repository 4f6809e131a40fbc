#pragma once
// Numbers over time: what a slider with keyframes holds.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// The way from a key to the next one.
enum class KeyInterpolation : std::uint8_t {
    kLinear,
    kSmooth,  ///< A cubic that stays between its two keys: no overshoot.
    kHold     ///< The key's numbers up to the next key.
};
inline constexpr std::array<std::pair<KeyInterpolation, std::string_view>, 3> kKeyInterpolations{
    {{KeyInterpolation::kLinear, "linear"},
     {KeyInterpolation::kSmooth, "smooth"},
     {KeyInterpolation::kHold, "hold"}}};
[[nodiscard]] std::string_view name_of(KeyInterpolation interpolation);
/// Errors: Usage with the names there are.
[[nodiscard]] Expected<KeyInterpolation> parse_interpolation(std::string_view name);

struct NumberKey {
    int frame = 0;
    std::vector<double> numbers;
    KeyInterpolation after = KeyInterpolation::kLinear;  ///< Up to the next key.
    bool operator==(const NumberKey&) const = default;
};

/// Keyframes of one or more numbers: constant outside of them.
struct KeyedNumbers {
    /// By frame, ascending, each frame once; all keys have the same count of numbers.
    std::vector<NumberKey> keys;

    [[nodiscard]] bool empty() const { return keys.empty(); }
    [[nodiscard]] bool has(int frame) const;
    /// The numbers on a frame; none where there are no keys.
    [[nodiscard]] std::vector<double> at(int frame) const;
    /// The same, rounded to float first and interpolated in float: what pictures are computed with.
    [[nodiscard]] std::vector<float> float_at(int frame) const;
    /// The key on a frame; null where there is none.
    [[nodiscard]] const NumberKey* key(int frame) const;
    /// Adds a key or replaces the numbers of the one on `frame`. A new one interpolates as the
    /// stretch does in which it lies.
    void set(int frame, std::vector<double> numbers);
    void erase(int frame);

    bool operator==(const KeyedNumbers&) const = default;
};

/// From "1:1 24:0.3" or, with two numbers a key, "1:0,0 24:10,5"; a single key may leave out its
/// frame (frame 0 then). A key may end in ":smooth", ":hold" or ":linear" for the way to the next
/// one: "1:1:smooth 24:0.3". Errors: Usage with what is wrong.
[[nodiscard]] Expected<KeyedNumbers> parse_keyed_numbers(std::string_view text,
                                                         std::size_t count = 1);
/// One key: "FRAME: numbers" or "FRAME: numbers: smooth", or only "numbers" where `only` says that
/// there is no other. The numbers stand between commas or spaces. Errors: Usage.
[[nodiscard]] Expected<NumberKey> parse_key(std::string_view text, bool only, std::size_t count);
/// Sorts keys by frame. Errors: Usage when a frame has two.
[[nodiscard]] Expected<KeyedNumbers> sorted_keys(std::vector<NumberKey> keys);
/// The text that parse_keyed_numbers() reads back to the same keys.
[[nodiscard]] std::string keyed_text(const KeyedNumbers& keys);

}  // namespace weft
