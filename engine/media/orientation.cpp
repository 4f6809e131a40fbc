#include "engine/media/orientation.h"

#include <string_view>

namespace weft {

int orientation_of_exif(const unsigned char* exif, std::size_t bytes) {
    constexpr std::size_t kHeader = 8, kEntry = 12;
    if (!exif || bytes < kHeader) return 1;
    const std::string_view order(reinterpret_cast<const char*>(exif), 2);
    if (order != "II" && order != "MM") return 1;
    const bool little = order == "II";
    const auto number = [&](std::size_t at, std::size_t count) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < count; ++i)
            value = value << 8 | exif[little ? at + count - 1 - i : at + i];
        return value;
    };
    const std::size_t directory = number(4, 4);
    if (directory > bytes || bytes - directory < 2) return 1;
    const std::size_t entries = number(directory, 2);
    for (std::size_t i = 0; i < entries; ++i) {
        const std::size_t at = directory + 2 + i * kEntry;
        if (at + kEntry > bytes) return 1;
        constexpr std::uint32_t kOrientation = 0x0112;
        if (number(at, 2) != kOrientation) continue;
        const auto value = static_cast<int>(number(at + 8, 2));
        return value >= 1 && value <= 8 ? value : 1;
    }
    return 1;
}

}  // namespace weft
