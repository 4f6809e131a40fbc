#pragma once
// Light that the artist paints: lamps as text, whose numbers may have keys over time.

#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/lighting/shading.h"

namespace weft {

/// Numbers over time: between two keys they go in a straight line, outside of them they stay.
struct KeyedNumbers {
    std::vector<std::pair<int, std::vector<float>>> keys;  ///< By frame, ascending; equal lengths.
    [[nodiscard]] bool empty() const { return keys.empty(); }
    [[nodiscard]] std::vector<float> at(int frame) const;
};

enum class LampKind {
    kPoint,        ///< x, y, radius (px), gain: `gain` in the middle, 1 from the radius on.
    kDirectional,  ///< angle (deg, counter-clockwise from the right, where light comes from), gain:
                   ///< `gain` at that side of the plate, 1 / gain at the other.
    kGradient      ///< x0, y0, x1, y1 (px), gain0, gain1: in a straight line between two points.
};

struct Lamp {
    LampKind kind = LampKind::kPoint;
    KeyedNumbers numbers;
};

/// "1:1 24:0.3": keys by frame, each of `count` numbers ("1:0,0 24:10,5"). Errors: Usage with what
/// is wrong.
[[nodiscard]] Expected<KeyedNumbers> parse_keyed_number(std::string_view text,
                                                        std::size_t count = 1);

/// Lamps between ";", a lamp's keys between "|", each with its frame before a colon or none where
/// there is one key only: "point 1: 320,180 200 1.5 | 24: 400,180 200 1; gradient 0,0 0,480 1.2
/// 0.6". Errors: Usage with the lamp and what is wrong.
[[nodiscard]] Expected<std::vector<Lamp>> parse_lamps(std::string_view text);

/// The product of all lamps on a frame; S₀ is 1. `full`: the plate's size.
[[nodiscard]] Shading painted_shading(const std::vector<Lamp>& lamps, int frame, Size full);

}  // namespace weft
