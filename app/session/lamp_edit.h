#pragma once
// Painted lamps as handles see them: the text of the document, taken apart for one frame and put
// together again.

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// One lamp of engine/lighting/painted_light.h on one frame.
struct LampHandle {
    enum class Kind { kPoint, kDirectional, kGradient } kind = Kind::kPoint;
    /// Point: x, y, radius, gain. Directional: angle in degrees, gain. Gradient: x0, y0, x1, y1,
    /// gain0, gain1. Pixels of the plate.
    std::vector<float> numbers;
    bool keyed = false;  ///< It changes over time: a change here becomes a key of this frame.
    bool operator==(const LampHandle&) const = default;
};

/// The lamps on a frame; none where the text cannot be read.
[[nodiscard]] std::vector<LampHandle> lamps_at(std::string_view text, int frame);
/// The text with other numbers of one lamp: of all frames, or, where it is keyed or `key` asks for
/// it, of this one.
[[nodiscard]] std::string with_lamp(std::string_view text, std::size_t lamp, int frame,
                                    const std::vector<float>& numbers, bool key = false);
[[nodiscard]] std::string with_new_lamp(std::string_view text, const LampHandle& lamp);
[[nodiscard]] std::string without_lamp(std::string_view text, std::size_t lamp);

}  // namespace weft
