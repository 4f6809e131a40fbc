#include "engine/media/file_color.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "engine/media/big_endian.h"
#include "engine/media/icc_profile.h"

namespace weft {
namespace {

using Primaries = std::array<double, 8>;

// Coordinates in files are rounded, some to three digits.
constexpr double kSamePrimary = 0.004;

bool same(const Primaries& a, const Primaries& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= kSamePrimary)) return false;
    return true;
}

constexpr Primaries kRec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

struct Known {
    const char* name;
    Primaries xy;
};
// SMPTE ST 2065-1, ACES S-2014-004, SMPTE RP 431-2 with D65, ITU-R BT.2020, Adobe RGB (1998).
constexpr Known kKnown[] = {
    {"ACES2065-1", {0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767}},
    {"ACEScg", {0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767}},
    {"P3-D65", {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290}},
    {"Rec.2020", {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290}},
    {"Adobe RGB (1998)", {0.64, 0.33, 0.21, 0.71, 0.15, 0.06, 0.3127, 0.3290}},
};

// The text of one 'desc' tag: ASCII in version 2, UTF-16 in version 4, of which ASCII is kept.
std::string text_of(const unsigned char* tag, std::size_t bytes) {
    if (bytes < 12) return {};
    const std::string_view kind(reinterpret_cast<const char*>(tag), 4);
    std::string out;
    if (kind == "desc") {
        const std::size_t count = std::min<std::size_t>(big_endian_u32(tag + 8), bytes - 12);
        for (std::size_t i = 0; i < count && tag[12 + i] != 0; ++i)
            out += static_cast<char>(tag[12 + i]);
    } else if (kind == "mluc" && bytes >= 28) {
        const std::size_t length = big_endian_u32(tag + 20), start = big_endian_u32(tag + 24);
        if (start > bytes || length > bytes - start) return {};
        // Some names end with a 0 that is counted.
        for (std::size_t i = 0; i + 1 < length && (tag[start + i] | tag[start + i + 1]) != 0;
             i += 2)
            out += tag[start + i] == 0 ? static_cast<char>(tag[start + i + 1]) : '?';
    }
    constexpr std::size_t kLongest = 80;
    return out.substr(0, kLongest);
}

}  // namespace

std::string icc_profile_name(const unsigned char* profile, std::size_t bytes) {
    const auto tag = icc_tag(profile, bytes, "desc");
    return text_of(tag.data(), tag.size());
}

std::string note_of_profile(const std::string& name) {
    // Programs' own sRGB profiles all have the word in their name.
    if (name.find("sRGB") != std::string::npos) return {};
    return name.empty() ? "has an ICC profile" : "has the ICC profile '" + name + "'";
}

std::string note_of_primaries(const std::array<double, 8>& xy) {
    if (same(xy, kRec709)) return {};
    for (const Known& known : kKnown)
        if (same(xy, known.xy)) return std::string("has the primaries of ") + known.name;
    return "has other primaries than Rec.709";
}

std::string note_of_gamma(double exponent) {
    constexpr double kDisplay = 1 / 2.2, kTolerance = 0.01;
    if (!(exponent > 0) || std::abs(exponent - kDisplay) <= kTolerance) return {};
    char text[48];
    std::snprintf(text, sizeof text, "is encoded with a gamma of %.2f", 1 / exponent);
    return text;
}

}  // namespace weft
