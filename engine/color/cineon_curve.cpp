#include "engine/color/cineon_curve.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace weft {
namespace {

// Long double arithmetic runs on the x87 unit, which is the same on every x86-64 processor (as in
// srgb_curve.cpp).
constexpr long double kCodes = 1023.0L, kBlack = 95.0L, kWhite = 685.0L;
constexpr long double kDensityStep = 0.002L, kGamma = 0.6L;
constexpr long double kPerCode = kDensityStep / kGamma;  // powers of ten

long double above_base(long double code) {
    return std::pow(10.0L, (code - kWhite) * kPerCode);
}

struct Constants {
    long double black = above_base(kBlack);
    long double at_zero = above_base(0.0L);
    long double gain = 1.0L / (1.0L - black);
    // The tangent at code 0, of above_base() over the value.
    long double slope = at_zero * std::log(10.0L) * kPerCode * kCodes;
};

const Constants& constants() {
    static const Constants c;
    return c;
}

// y = value + t (slope + t curvature), t = x − start: the parabola through both ends and the middle
// of a segment.
struct Parabola {
    float start, value, slope, curvature;

    template <class F>
    static Parabola of(long double x0, long double x1, F&& exact) {
        const long double h = x1 - x0;
        const long double y0 = exact(x0), middle = exact(x0 + h / 2), y1 = exact(x1);
        const long double curvature = 2 * (y0 - 2 * middle + y1) / (h * h);
        return {static_cast<float>(x0), static_cast<float>(y0),
                static_cast<float>((y1 - y0) / h - curvature * h), static_cast<float>(curvature)};
    }
    [[nodiscard]] float at(float x) const {
        const float t = x - start;
        return value + t * (slope + t * curvature);
    }
};

long double decode_cineon_exactly(long double v) {
    const Constants& c = constants();
    const long double raw = v < 0 ? c.at_zero + v * c.slope : above_base(v * kCodes);
    return (raw - c.black) * c.gain;
}

long double encode_cineon_exactly(long double linear) {
    const Constants& c = constants();
    const long double raw = linear / c.gain + c.black;
    if (raw < c.at_zero) return (raw - c.at_zero) / c.slope;
    return (kWhite + std::log10(raw) / kPerCode) / kCodes;
}

// A thousand equal segments between 0 and 1: the error, h³/125 of the third derivative, is 4e-9 of
// the value.
class DecodeTable {
  public:
    DecodeTable() {
        for (std::size_t i = 0; i < kSegments; ++i)
            segments_[i] =
                Parabola::of(static_cast<long double>(i) / kSegments,
                             static_cast<long double>(i + 1) / kSegments, decode_cineon_exactly);
    }
    [[nodiscard]] float operator()(float v) const {
        if (v >= 0 && v < 1) return segments_[static_cast<std::size_t>(v * kSegments)].at(v);
        return std::isfinite(v) ? static_cast<float>(decode_cineon_exactly(v)) : v;
    }

  private:
    static constexpr std::size_t kSegments = 1024;
    std::array<Parabola, kSegments> segments_{};
};

// The logarithm's argument is divided into octaves of 64 segments, found by the leading bits.
class EncodeTable {
  public:
    EncodeTable() {
        for (std::uint32_t i = 0; i < kSegments; ++i) {
            segments_[i] = Parabola::of(
                std::bit_cast<float>(kLowest + (i << kShift)),
                std::bit_cast<float>(kLowest + ((i + 1) << kShift)),
                [](long double raw) { return (kWhite + std::log10(raw) / kPerCode) / kCodes; });
        }
    }
    [[nodiscard]] float operator()(float linear) const {
        const Constants& c = constants();
        const auto raw = static_cast<float>(linear / c.gain + c.black);
        const std::uint32_t i = (std::bit_cast<std::uint32_t>(raw) - kLowest) >> kShift;
        if (raw > 0 && i < kSegments && raw >= static_cast<float>(c.at_zero))
            return segments_[i].at(raw);
        return std::isfinite(linear) ? static_cast<float>(encode_cineon_exactly(linear)) : linear;
    }

  private:
    static constexpr int kFirst = -8, kLast = 4;  // from 2^-8 (code 0 is at 0.0052) to 2^4
    static constexpr std::uint32_t kShift = 23 - 6;
    static constexpr std::uint32_t kLowest = static_cast<std::uint32_t>(127 + kFirst) << 23;
    static constexpr std::uint32_t kSegments = static_cast<std::uint32_t>(kLast - kFirst) << 6;
    std::array<Parabola, kSegments> segments_{};
};

}  // namespace

void decode_cineon(std::span<float> values) {
    static const DecodeTable table;
    for (float& v : values)
        v = table(v);
}

void encode_cineon(std::span<float> values) {
    static const EncodeTable table;
    for (float& v : values)
        v = table(v);
}

}  // namespace weft
