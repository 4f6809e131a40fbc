#include "texture_db/describe/attributes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "texture_db/describe/feature_parts.h"
#include "texture_db/describe/features.h"

namespace weft {
namespace {

using A = TextureAttribute;

float unit(float v) {
    return std::clamp(v, 0.0f, 1.0f);
}

cv::Mat lab_of(ViewU8x3 image) {
    const cv::Mat rgb(image.height(), image.width(), CV_8UC3,
                      const_cast<std::uint8_t*>(image.data()),
                      static_cast<std::size_t>(image.stride()));
    cv::Mat floats, lab;
    rgb.convertTo(floats, CV_32FC3, 1.0 / 255.0);
    cv::cvtColor(floats, lab, cv::COLOR_RGB2Lab);
    return lab;
}

LabColor color_of(const cv::Scalar& s) {
    return {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
}

// Mean over the tenth of the pixels with the most chroma.
LabColor accent_of(const cv::Mat& lab) {
    std::vector<std::pair<float, int>> order;
    order.reserve(lab.total());
    const auto* p = lab.ptr<cv::Vec3f>();
    for (int i = 0; i < static_cast<int>(lab.total()); ++i)
        order.emplace_back(-std::hypot(p[i][1], p[i][2]), i);
    const std::size_t n = order.size() / 10;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end());
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n));
    cv::Vec3d sum(0, 0, 0);
    for (std::size_t i = 0; i < n; ++i)
        sum += p[order[i].second];
    const double k = 1.0 / static_cast<double>(std::max<std::size_t>(n, 1));
    return {static_cast<float>(sum[0] * k), static_cast<float>(sum[1] * k),
            static_cast<float>(sum[2] * k)};
}

struct Structure {
    float direction = 0, angle = 0, fine = 0;
};

// The structure tensor over the whole sample (Bigün & Granlund 1987).
Structure structure_of(const cv::Mat& l) {
    cv::Mat smooth, gx, gy;
    cv::GaussianBlur(l, smooth, {}, 1.0);
    cv::Sobel(smooth, gx, CV_32F, 1, 0, 3, 0.125);
    cv::Sobel(smooth, gy, CV_32F, 0, 1, 3, 0.125);
    const double xx = gx.dot(gx), yy = gy.dot(gy), xy = gx.dot(gy);
    const double sum = xx + yy, difference = std::hypot(xx - yy, 2 * xy);
    Structure s;
    s.direction = sum > 1e-6 ? static_cast<float>(difference / sum) : 0.0f;
    // Lines run across the gradient.
    const double across = 0.5 * std::atan2(2 * xy, xx - yy) + std::numbers::pi / 2;
    double turn = across / std::numbers::pi;
    turn -= std::floor(turn);
    s.angle = static_cast<float>(turn);
    const cv::Mat rest = l - smooth;
    s.fine = static_cast<float>(std::sqrt(rest.dot(rest) / static_cast<double>(l.total())));
    return s;
}

struct Repetition {
    float regular = 0, size_px = 2;
};

// The normalised autocorrelation by the Wiener–Khinchin theorem: how far it stays high is the size
// of the structure, how high it rises again is the regularity.
Repetition repetition_of(const cv::Mat& l) {
    cv::Mat broad, flat;
    cv::GaussianBlur(l, broad, {}, 24.0);
    flat = l - broad;
    cv::Mat padded = cv::Mat::zeros(2 * kDescribedSide, 2 * kDescribedSide, CV_32F);
    flat.copyTo(padded(cv::Rect(0, 0, kDescribedSide, kDescribedSide)));
    cv::Mat spectrum, power, acf;
    cv::dft(padded, spectrum, cv::DFT_COMPLEX_OUTPUT);
    cv::mulSpectrums(spectrum, spectrum, power, 0, true);
    cv::dft(power, acf, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    const float zero = acf.at<float>(0, 0);
    Repetition r;
    if (zero < 1e-3f) return r;
    constexpr int kReach = 48;
    const auto at = [&](int dx, int dy) {
        const int x = (dx + 2 * kDescribedSide) % (2 * kDescribedSide),
                  y = (dy + 2 * kDescribedSide) % (2 * kDescribedSide);
        const float overlap =
            static_cast<float>((kDescribedSide - std::abs(dx)) * (kDescribedSide - std::abs(dy))) /
            static_cast<float>(kDescribedSide * kDescribedSide);
        return acf.at<float>(y, x) / zero / overlap;
    };
    // Mean over angles by radius; the structure is as large as the radius where it falls below
    // 0.35.
    std::array<double, kReach> ring{};
    std::array<int, kReach> count{};
    for (int dy = 0; dy < kReach; ++dy) {
        for (int dx = -kReach + 1; dx < kReach; ++dx) {
            const int radius = static_cast<int>(std::lround(std::hypot(dx, dy)));
            if (radius >= kReach) continue;
            ring[static_cast<std::size_t>(radius)] += at(dx, dy);
            ++count[static_cast<std::size_t>(radius)];
        }
    }
    int fall = 1;
    while (fall < kReach - 1 &&
           ring[static_cast<std::size_t>(fall)] / count[static_cast<std::size_t>(fall)] > 0.35)
        ++fall;
    r.size_px = 2.0f * static_cast<float>(fall);
    // A second peak: a local maximum beyond the first slope.
    float best = 0;
    for (int dy = 0; dy < kReach - 1; ++dy) {
        for (int dx = -kReach + 2; dx < kReach - 1; ++dx) {
            if (std::hypot(dx, dy) < std::max(4.0, 1.6 * fall)) continue;
            const float v = at(dx, dy);
            if (v > best && v >= at(dx - 1, dy) && v >= at(dx + 1, dy) && v >= at(dx, dy - 1) &&
                v >= at(dx, dy + 1))
                best = v;
        }
    }
    r.regular = best;
    return r;
}

float gloss_of(const cv::Mat& l, float mean, float spread) {
    if (spread < 2) return 0;
    int high = 0;
    const auto* p = l.ptr<float>();
    const float limit = std::max(mean + 2.2f * spread, 55.0f);
    for (int i = 0; i < static_cast<int>(l.total()); ++i)
        high += p[i] > limit ? 1 : 0;
    const float share = static_cast<float>(high) / static_cast<float>(l.total());
    return unit(share / 0.05f) * unit((spread - 4) / 14);
}

}  // namespace

MeasuredTexture measure_texture(ViewU8x3 srgb) {
    const ImageU8x3 sample = middle_sample(srgb);
    const cv::Mat lab = lab_of(sample);
    cv::Mat planes[3];
    cv::split(lab, planes);
    cv::Scalar mean, spread;
    cv::meanStdDev(lab, mean, spread);
    MeasuredTexture m;
    m.mean = color_of(mean);
    m.accent = accent_of(lab);
    const float chroma = std::hypot(m.mean.a, m.mean.b);
    const Structure structure = structure_of(planes[0]);
    const Repetition repetition = repetition_of(planes[0]);
    TextureAttributes& a = m.attributes;
    a[A::kBrightness] = unit(m.mean.l / 100);
    a[A::kSaturation] = unit(chroma / 60);
    // Warm colours lie around a hue of 60° (orange), cold ones opposite.
    const float warm = m.mean.a * 0.5f + m.mean.b * 0.866f;
    a[A::kWarmth] = unit(0.5f + warm / 60);
    a[A::kContrast] = unit(static_cast<float>(spread[0]) / 25);
    a[A::kColourVariety] = unit(static_cast<float>(std::hypot(spread[1], spread[2])) / 20);
    a[A::kScale] = unit(std::log2(repetition.size_px / 2) / std::log2(24.0f));
    a[A::kRoughness] = unit(structure.fine / 7);
    a[A::kRegularity] = unit((repetition.regular - 0.05f) / 0.6f);
    a[A::kDirectionality] = unit((structure.direction - 0.1f) / 0.75f);
    a[A::kLineAngle] = structure.angle;
    a[A::kGloss] = gloss_of(planes[0], m.mean.l, static_cast<float>(spread[0]));
    return m;
}

}  // namespace weft
