#include "engine/media/icc_profile.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/core/input_file.h"
#include "engine/media/big_endian.h"

namespace weft {
namespace {

int u16_at(std::span<const unsigned char> tag, std::size_t at) {
    return tag[at] << 8 | tag[at + 1];
}

// Of a 'curv' tag (ICC.1:2010, 10.5): nothing, a gamma, or a table.
std::optional<double> middle_of_table(std::span<const unsigned char> tag) {
    constexpr std::size_t kHead = 12;
    const std::size_t count = big_endian_u32(tag.data() + 8);
    if (count == 0) return 0.5;
    if (count > (tag.size() - kHead) / 2) return std::nullopt;
    if (count == 1) return std::pow(0.5, u16_at(tag, kHead) / 256.0);
    return u16_at(tag, kHead + 2 * ((count - 1) / 2)) / 65535.0;
}

// Of a 'para' tag (10.15), whose straight part near black ends below the middle.
std::optional<double> middle_of_formula(std::span<const unsigned char> tag) {
    constexpr std::size_t kParameters[] = {1, 3, 4, 5, 7};
    const int kind = u16_at(tag, 8);
    if (kind > 4 || tag.size() < 12 + 4 * kParameters[kind]) return std::nullopt;
    const auto parameter = [&](std::size_t k) {
        return static_cast<std::int32_t>(big_endian_u32(tag.data() + 12 + 4 * k)) / 65536.0;
    };
    const double base = kind == 0 ? 0.5 : 0.5 * parameter(1) + parameter(2);
    const double added = kind == 2 ? parameter(3) : kind == 4 ? parameter(5) : 0;
    return std::pow(base, parameter(0)) + added;
}

// The light, from 0 to 1, that a profile gives to the middle value.
std::optional<double> middle_of_curve(const unsigned char* profile, std::size_t bytes) {
    for (const char* signature : {"rTRC", "kTRC"}) {
        const auto tag = icc_tag(profile, bytes, signature);
        if (tag.size() < 12) continue;
        const std::string_view kind(reinterpret_cast<const char*>(tag.data()), 4);
        if (kind == "curv") return middle_of_table(tag);
        if (kind == "para") return middle_of_formula(tag);
    }
    return std::nullopt;
}

}  // namespace

std::span<const unsigned char> icc_tag(const unsigned char* profile, std::size_t bytes,
                                       std::string_view signature) {
    constexpr std::size_t kHeader = 128, kEntry = 12;
    if (!profile || bytes < kHeader + 4) return {};
    const std::uint32_t count = big_endian_u32(profile + kHeader);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t at = kHeader + 4 + i * kEntry;
        if (at + kEntry > bytes) return {};
        if (std::string_view(reinterpret_cast<const char*>(profile + at), 4) != signature) continue;
        const std::size_t offset = big_endian_u32(profile + at + 4),
                          size = big_endian_u32(profile + at + 8);
        if (offset > bytes || size > bytes - offset) return {};
        return {profile + offset, size};
    }
    return {};
}

std::vector<unsigned char> profile_of_webp(const std::string& path) {
    // RIFF's head, then the chunk VP8X of 10 bytes, then ICCP if there is a profile (WebP Container
    // Specification, Extended File Format).
    constexpr std::size_t kHead = 38, kLongest = 4 << 20;
    const auto file = InputFile::open(path);
    std::array<unsigned char, kHead> head{};
    if (!file || file->read_at(0, head.data(), kHead) != kHead) return {};
    const std::string_view text(reinterpret_cast<const char*>(head.data()), kHead);
    if (text.substr(8, 8) != "WEBPVP8X" || text.substr(30, 4) != "ICCP") return {};
    const std::size_t bytes =
        head[34] | head[35] << 8 | head[36] << 16 | std::size_t{head[37]} << 24;
    if (bytes > kLongest) return {};
    std::vector<unsigned char> profile(bytes);
    if (file->read_at(kHead, profile.data(), bytes) != bytes) return {};
    return profile;
}

FileColor color_of_profile(const unsigned char* profile, std::size_t bytes,
                           const std::string& by_type) {
    const std::string name = icc_profile_name(profile, bytes);
    const auto middle = middle_of_curve(profile, bytes);
    FileColor color{by_type, note_of_profile(name)};
    if (!middle || !std::isfinite(*middle)) return color;
    // Displays have 0.19 to 0.29 (gamma 2.4 to 1.8), and sRGB 0.21.
    constexpr double kLinearFrom = 0.4;
    color.space = *middle >= kLinearFrom ? "linear" : "srgb";
    if (color.space != by_type) {
        const std::string which =
            name.empty() ? "an ICC profile" : "the ICC profile '" + name + "'";
        const bool linear = color.space == "linear";
        color.note = "has " + which + (linear ? ", which is linear" : ", which is not linear");
    }
    return color;
}

}  // namespace weft
