#include "engine/color/grade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kMiddleGrey = 0.18f;
// ln R, G, B of linear sRGB for each mired along the CIE daylight locus (CIE 15:2004, 3.1), between
// 20,000 K and 4,000 K.
constexpr std::array<float, 3> kPerMired{0.0035f, -0.0004f, -0.0065f};

// Turns a colour of no luminance about the grey axis, and takes out the luminance that this adds.
std::array<float, 3> turned(const std::array<float, 3>& colour, float cosine, float sine) {
    const float third = 1.0f / std::numbers::sqrt3_v<float>;
    std::array<float, 3> out;
    for (std::size_t c = 0; c < 3; ++c) {
        const float across = third * (colour[(c + 2) % 3] - colour[(c + 1) % 3]);
        out[c] = cosine * colour[c] + sine * across;
    }
    const float luma = luma_709(out.data());
    for (float& v : out)
        v -= luma;
    return out;
}

class Grader {
  public:
    explicit Grader(const Grade& grade)
        : grade_(grade), gain_(temperature_gain(grade.temperature)) {
        const float angle = grade.hue_deg * std::numbers::pi_v<float> / 180.0f;
        cosine_ = std::cos(angle), sine_ = std::sin(angle);
        for (std::size_t c = 0; c < 3; ++c)
            gain_[c] *= grade.multiply[c] * std::exp2(grade.exposure);
    }

    void operator()(float* p) const {
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = curve(std::max(0.0f, p[c] * gain_[c]));
        if (grade_.saturation != 1 || grade_.hue_deg != 0) {
            const float luma = luma_709(p);
            const auto colour = turned({p[0] - luma, p[1] - luma, p[2] - luma}, cosine_, sine_);
            for (std::size_t c = 0; c < 3; ++c)
                p[c] = luma + grade_.saturation * colour[c];
        }
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = std::max(0.0f, p[c] + grade_.offset[c]);
    }

  private:
    [[nodiscard]] float curve(float v) const {
        if (grade_.contrast != 1) v = kMiddleGrey * std::pow(v / kMiddleGrey, grade_.contrast);
        return grade_.gamma != 1 ? std::pow(v, 1.0f / grade_.gamma) : v;
    }

    Grade grade_;
    std::array<float, 3> gain_;
    float cosine_ = 1, sine_ = 0;
};

}  // namespace

std::array<float, 3> temperature_gain(float mired) {
    std::array<float, 3> gain;
    for (std::size_t c = 0; c < 3; ++c)
        gain[c] = std::exp(mired * kPerMired[c]);
    const float luma = luma_709(gain.data());
    for (float& v : gain)
        v /= luma;
    return gain;
}

void apply_grade(ImageView<float, 3> picture, ViewU8x1 matte, const Grade& grade) {
    if (grade == Grade{}) return;
    const Grader grader(grade);
    parallel_rows(picture.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                float* p = picture.pixel(x, y);
                if (matte.row(y)[x] == 0 || !std::isfinite(p[0] + p[1] + p[2])) continue;
                grader(p);
            }
        }
    });
}

}  // namespace weft
