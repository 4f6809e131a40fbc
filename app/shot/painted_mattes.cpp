#include "app/shot/painted_mattes.h"

#include <algorithm>

namespace weft {

Expected<Matte> read_matte(const std::string& path, const MatteSelect& select, Size expected,
                           const PaintedMattes& painted) {
    const auto found = painted.find(path);
    if (found == painted.end()) return read_matte(path, select, expected);
    Matte out = *found->second;
    if (out.size() != expected) {
        return fail(ErrorCode::kUnreadable,
                    "The painted matte " + path + " is not of the plate's size.",
                    "Paint it again.");
    }
    const auto change = [&](auto&& code) {
        std::transform(out.data(), out.data() + out.size_bytes(), out.data(), code);
    };
    if (select.value)
        change([value = *select.value](std::uint8_t v) -> std::uint8_t {
            return v == value ? 255 : 0;
        });
    if (select.invert) change([](std::uint8_t v) { return static_cast<std::uint8_t>(255 - v); });
    return out;
}

}  // namespace weft
