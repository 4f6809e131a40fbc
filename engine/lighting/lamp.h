#pragma once
// Lamps: light that the artist paints. painted_light.h renders them.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/keyed_numbers.h"

namespace weft {

enum class LampKind {
    kPoint,        ///< x, y, radius (px), gain: `gain` in the middle, 1 from the radius on.
    kDirectional,  ///< angle (deg, counter-clockwise from the right, where light comes from), gain:
                   ///< `gain` at that side of the plate, 1 / gain at the other.
    kGradient      ///< x0, y0, x1, y1 (px), gain0, gain1: in a straight line between two points.
};

struct LampKindInfo {
    LampKind kind;
    std::string_view name;
    std::size_t numbers;  ///< Numbers in each key.
    std::size_t places;   ///< How many of them, from the first on, are in plate pixels.
};
/// The kinds by their names in files and on the command line.
inline constexpr std::array<LampKindInfo, 3> kLampKinds{
    {{LampKind::kPoint, "point", 4, 3},
     {LampKind::kDirectional, "directional", 2, 0},
     {LampKind::kGradient, "gradient", 6, 4}}};
[[nodiscard]] constexpr const LampKindInfo& info_of(LampKind kind) {
    return kLampKinds[static_cast<std::size_t>(kind)];
}

struct Lamp {
    LampKind kind = LampKind::kPoint;
    KeyedNumbers numbers;  ///< At least one key; info_of(kind).numbers in each.
    bool operator==(const Lamp&) const = default;
};

/// Changes a lamp on one frame: the key of this frame if the lamp has several keys, else all
/// frames.
void set_numbers(Lamp& lamp, int frame, std::vector<double> numbers);

/// Lamps as text. Lamps are separated by ";" and the keys of a lamp by "|". A key starts with its
/// frame and a colon; a single key may omit them: "point 1: 320,180 200 1.5 | 24: 400,180 200 1;
/// gradient 0,0 0,480 1.2 0.6". Errors: Usage with the lamp and what is wrong.
[[nodiscard]] Expected<std::vector<Lamp>> parse_lamps(std::string_view text);
/// The text that parse_lamps() reads back to the same lamps.
[[nodiscard]] std::string lamps_text(const std::vector<Lamp>& lamps);

}  // namespace weft
