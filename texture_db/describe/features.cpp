#include "texture_db/describe/features.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <span>

#include "texture_db/describe/feature_parts.h"

namespace weft {
namespace {

using Features = std::vector<float>;

struct Planes {
    cv::Mat l, a, b;  // L/100, a/60, b/60
};

Planes planes_of(ViewU8x3 sample) {
    const cv::Mat rgb(kDescribedSide, kDescribedSide, CV_8UC3,
                      const_cast<std::uint8_t*>(sample.data()),
                      static_cast<std::size_t>(sample.stride()));
    cv::Mat floats, lab;
    rgb.convertTo(floats, CV_32FC3, 1.0 / 255.0);
    cv::cvtColor(floats, lab, cv::COLOR_RGB2Lab);
    cv::Mat split[3];
    cv::split(lab, split);
    return {split[0] / 100.0, split[1] / 60.0, split[2] / 60.0};
}

double correlation_of(const cv::Mat& a, const cv::Mat& b) {
    return correlation(values_of(a), values_of(b));
}

void add_percentiles(const cv::Mat& plane, Features& out) {
    std::vector<float> values(plane.begin<float>(), plane.end<float>());
    auto from = values.begin();
    for (const double q : {0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98}) {
        const auto at = values.begin() +
                        static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
        std::nth_element(from, at, values.end());
        out.push_back(*at);
        from = at;
    }
}

// Lightness in 8 soft bins, hue in 8 weighted by chroma, chroma in 6.
void add_color_histograms(const Planes& p, Features& out) {
    std::array<double, 8> light{}, hue{};
    std::array<double, 6> chroma{};
    const auto soft = [](auto& bins, double at, double weight, bool around) {
        const int n = static_cast<int>(bins.size());
        const int low = static_cast<int>(std::floor(at));
        const double f = at - low;
        const auto bin = [&](int i) {
            return static_cast<std::size_t>(around ? ((i % n) + n) % n : std::clamp(i, 0, n - 1));
        };
        bins[bin(low)] += weight * (1 - f);
        bins[bin(low + 1)] += weight * f;
    };
    const auto *l = p.l.ptr<float>(), *a = p.a.ptr<float>(), *b = p.b.ptr<float>();
    for (std::size_t i = 0; i < p.l.total(); ++i) {
        const double c = std::hypot(a[i], b[i]);
        soft(light, static_cast<double>(l[i]) * 7, 1, false);
        soft(hue, (std::atan2(b[i], a[i]) / (2 * std::numbers::pi) + 1) * 8, c, true);
        soft(chroma, std::sqrt(c) * 5, 1, false);
    }
    const auto n = static_cast<double>(p.l.total());
    for (const double v : light)
        out.push_back(static_cast<float>(std::sqrt(v / n)));
    for (const double v : hue)
        out.push_back(static_cast<float>(std::sqrt(v / n)));
    for (const double v : chroma)
        out.push_back(static_cast<float>(std::sqrt(v / n)));
}

// Local binary patterns (Ojala et al. 2002): the 58 uniform ones and the rest at `radius`, and in
// the rotation-invariant form.
void add_binary_patterns(const cv::Mat& plane, int radius, Features& out) {
    static const std::array<int, 256> kUniform = [] {
        std::array<int, 256> bins{};
        int next = 0;
        for (unsigned code = 0; code < 256; ++code) {
            const unsigned turned = ((code << 1) | (code >> 7)) & 255u;
            bins[code] = std::popcount(code ^ turned) <= 2 ? next++ : 58;
        }
        return bins;
    }();
    std::array<double, 59> uniform{};
    std::array<double, 10> turned{};
    const int d = static_cast<int>(std::lround(radius / std::numbers::sqrt2));
    const std::array<std::array<int, 2>, 8> ring{
        {{radius, 0}, {d, d}, {0, radius}, {-d, d}, {-radius, 0}, {-d, -d}, {0, -radius}, {d, -d}}};
    int n = 0;
    for (int y = radius; y < plane.rows - radius; ++y) {
        for (int x = radius; x < plane.cols - radius; ++x) {
            const float centre = plane.at<float>(y, x) + 0.004f;  // flat places count as flat
            unsigned code = 0;
            for (unsigned k = 0; k < 8; ++k) {
                if (plane.at<float>(y + ring[k][1], x + ring[k][0]) > centre) code |= 1u << k;
            }
            const int bin = kUniform[code];
            uniform[static_cast<std::size_t>(bin)] += 1;
            turned[bin == 58 ? 9u : static_cast<unsigned>(std::popcount(code))] += 1;
            ++n;
        }
    }
    for (const double v : uniform)
        out.push_back(static_cast<float>(std::sqrt(v / n)));
    for (const double v : turned)
        out.push_back(static_cast<float>(std::sqrt(v / n)));
}

void add_color_energies(const Planes& p, Features& out) {
    out.push_back(static_cast<float>(correlation_of(p.l, p.a)));
    out.push_back(static_cast<float>(correlation_of(p.l, p.b)));
    out.push_back(static_cast<float>(correlation_of(p.a, p.b)));
    for (const cv::Mat* plane : {&p.l, &p.a, &p.b}) {
        cv::Mat last = *plane;
        for (const double on_plane : {0.8, 1.6, 3.2, 6.4, 12.8}) {
            // The coarse bands on half the grid.
            const bool coarse = on_plane > 5;
            if (coarse && last.rows == kDescribedSide) {
                cv::Mat half;
                cv::resize(last, half, {kDescribedSide / 2, kDescribedSide / 2}, 0, 0,
                           cv::INTER_AREA);
                last = half;
            }
            const double sigma = coarse ? on_plane / 2 : on_plane;
            cv::Mat blurred;
            cv::GaussianBlur(coarse ? last : *plane, blurred, {}, sigma, sigma,
                             cv::BORDER_REFLECT_101);
            const cv::Mat band = last - blurred;
            out.push_back(static_cast<float>(
                std::log(std::sqrt(band.dot(band) / static_cast<double>(band.total())) + 1e-3)));
            add_moments(values_of(band), band.cols, false, out);
            last = blurred;
        }
    }
}

void add_gradients(const cv::Mat& l, Features& out) {
    cv::Mat gx, gy;
    cv::Sobel(l, gx, CV_32F, 1, 0, 3, 0.125);
    cv::Sobel(l, gy, CV_32F, 0, 1, 3, 0.125);
    std::array<double, 8> strength{}, direction{};
    double sum = 1e-6;
    const auto *x = gx.ptr<float>(), *y = gy.ptr<float>();
    for (std::size_t i = 0; i < l.total(); ++i) {
        const double m = std::hypot(x[i], y[i]);
        const double at = std::clamp(std::log2(m / 0.002 + 1), 0.0, 7.0);
        strength[static_cast<std::size_t>(at)] += 1;
        double turn = std::atan2(y[i], x[i]) / std::numbers::pi + 1;
        turn -= std::floor(turn);
        direction[std::min<std::size_t>(static_cast<std::size_t>(turn * 8), 7)] += m;
        sum += m;
    }
    for (const double v : strength)
        out.push_back(static_cast<float>(std::sqrt(v / static_cast<double>(l.total()))));
    for (const double v : direction)
        out.push_back(static_cast<float>(std::sqrt(v / sum)));
}

}  // namespace

std::span<const float> values_of(const cv::Mat& plane) {
    return {plane.ptr<float>(), plane.total()};
}

std::vector<float> texture_features(ViewU8x3 sample) {
    const Planes p = planes_of(sample);
    Features out;
    out.reserve(480);
    for (const cv::Mat* plane : {&p.l, &p.a, &p.b}) {
        add_moments(values_of(*plane), kDescribedSide, true, out);
        add_percentiles(*plane, out);
    }
    add_color_histograms(p, out);
    add_binary_patterns(p.l, 1, out);
    add_binary_patterns(p.l, 2, out);
    cv::Mat half;
    cv::resize(p.l, half, {kDescribedSide / 2, kDescribedSide / 2}, 0, 0, cv::INTER_AREA);
    add_binary_patterns(half, 2, out);
    add_oriented_energies(values_of(p.l), out);
    add_color_energies(p, out);
    add_repetition(values_of(p.l), out);
    add_gradients(p.l, out);
    return out;
}

int texture_feature_count() {
    static const int kCount =
        static_cast<int>(texture_features(ImageU8x3(kDescribedSide, kDescribedSide, 128)).size());
    return kCount;
}

ImageU8x3 middle_sample(ViewU8x3 picture) {
    ImageU8x3 out(kDescribedSide, kDescribedSide);
    const auto mirrored = [](int i, int n) {
        if (n == 1) return 0;
        const int period = 2 * n - 2;
        i = ((i % period) + period) % period;
        return i < n ? i : period - i;
    };
    const int x0 = (picture.width() - kDescribedSide) / 2,
              y0 = (picture.height() - kDescribedSide) / 2;
    for (int y = 0; y < kDescribedSide; ++y) {
        for (int x = 0; x < kDescribedSide; ++x) {
            const std::uint8_t* from = picture.pixel(mirrored(x0 + x, picture.width()),
                                                     mirrored(y0 + y, picture.height()));
            std::copy_n(from, 3, out.pixel(x, y));
        }
    }
    return out;
}

}  // namespace weft
