#include "engine/color/srgb_curve.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/color/color_space.h"

namespace weft {
namespace {

constexpr float kEncodedToe = 0.04045f;  // below, the encoded curve is a straight line
constexpr float kLinearToe = 0.0031308f;
constexpr float kSlope = 12.92f;

// Long double arithmetic and powl() run on the x87 unit, which is the same on every x86-64
// processor; pow() has variants with and without FMA that may differ in the last bit.
long double decode_exactly(long double v) {
    return std::pow((v + 0.055L) / 1.055L, 2.4L);
}
long double encode_exactly(long double v) {
    return 1.055L * std::pow(v, 1.0L / 2.4L) - 0.055L;
}

// y = value + t (slope + t curvature), t = x − start: the parabola through both ends and the middle
// of a segment. At 64 segments to an octave its error, h³/125 of the third derivative, is 4e-8 of
// y; and since segments start at the powers of two, 1 becomes exactly 1.
struct Segment {
    float start, value, slope, curvature;
};

// Segments for x in [2^kFirst, 2^kLast), found by the leading bits of x.
template <int kFirst, int kLast>
class Curve {
  public:
    using Function = long double (*)(long double);

    explicit Curve(Function exact) : exact_(exact) {
        for (std::uint32_t i = 0; i < kSegments; ++i) {
            const long double x0 = std::bit_cast<float>(kLowest + (i << kShift));
            const long double x1 = std::bit_cast<float>(kLowest + ((i + 1) << kShift));
            const long double h = x1 - x0;
            const long double y0 = exact(x0), middle = exact(x0 + h / 2), y1 = exact(x1);
            const long double curvature = 2 * (y0 - 2 * middle + y1) / (h * h);
            const long double slope = (y1 - y0) / h - curvature * h;
            segments_[i] = {static_cast<float>(x0), static_cast<float>(y0),
                            static_cast<float>(slope), static_cast<float>(curvature)};
        }
    }

    // `magnitude` is positive and above the toe, or infinite or NaN.
    float operator()(float magnitude) const {
        const std::uint32_t i = (std::bit_cast<std::uint32_t>(magnitude) - kLowest) >> kShift;
        if (i >= kSegments) {
            if (!std::isfinite(magnitude)) return magnitude;
            return static_cast<float>(exact_(magnitude));
        }
        const Segment& s = segments_[i];
        const float t = magnitude - s.start;
        return s.value + t * (s.slope + t * s.curvature);
    }

  private:
    static constexpr std::uint32_t kShift = 23 - 6;
    static constexpr std::uint32_t kLowest = static_cast<std::uint32_t>(127 + kFirst) << 23;
    static constexpr std::uint32_t kSegments = static_cast<std::uint32_t>(kLast - kFirst) << 6;

    Function exact_;
    std::array<Segment, kSegments> segments_;
};

using DecodeCurve = Curve<-5, 4>;
using EncodeCurve = Curve<-9, 8>;

const DecodeCurve& decode_curve() {
    static const DecodeCurve curve(decode_exactly);
    return curve;
}

const EncodeCurve& encode_curve() {
    static const EncodeCurve curve(encode_exactly);
    return curve;
}

float decode(const DecodeCurve& curve, float v) {
    const float magnitude = std::abs(v);
    if (magnitude <= kEncodedToe) return v / kSlope;
    return std::copysign(curve(magnitude), v);
}

float encode(const EncodeCurve& curve, float v) {
    const float magnitude = std::abs(v);
    if (magnitude <= kLinearToe) return v * kSlope;
    return std::copysign(curve(magnitude), v);
}

}  // namespace

float srgb_to_linear(float encoded) {
    return decode(decode_curve(), encoded);
}
float linear_to_srgb(float linear) {
    return encode(encode_curve(), linear);
}

void decode_srgb(std::span<float> values) {
    const DecodeCurve& curve = decode_curve();
    for (float& v : values)
        v = decode(curve, v);
}

void encode_srgb(std::span<float> values) {
    const EncodeCurve& curve = encode_curve();
    for (float& v : values)
        v = encode(curve, v);
}

}  // namespace weft
