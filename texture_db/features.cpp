#include "texture_db/features.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace weft {
namespace {

constexpr int kSide = 96;
constexpr int kScales = 5, kOrientations = 6;
constexpr double kPi = std::numbers::pi;

using Features = std::vector<float>;

struct Planes {
    cv::Mat l, a, b;  // L/100, a/60, b/60
};

Planes planes_of(ViewU8x3 sample) {
    const cv::Mat rgb(kSide, kSide, CV_8UC3, const_cast<std::uint8_t*>(sample.data()),
                      static_cast<std::size_t>(sample.stride()));
    cv::Mat floats, lab;
    rgb.convertTo(floats, CV_32FC3, 1.0 / 255.0);
    cv::cvtColor(floats, lab, cv::COLOR_RGB2Lab);
    cv::Mat split[3];
    cv::split(lab, split);
    return {split[0] / 100.0, split[1] / 60.0, split[2] / 60.0};
}

void add_moments(const cv::Mat& plane, Features& out, bool with_mean) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(plane, mean, deviation);
    const double s = std::max(deviation[0], 1e-4);
    double third = 0, fourth = 0;
    const auto* p = plane.ptr<float>();
    for (std::size_t i = 0; i < plane.total(); ++i) {
        const double z = (static_cast<double>(p[i]) - mean[0]) / s;
        third += z * z * z;
        fourth += z * z * z * z;
    }
    const auto n = static_cast<double>(plane.total());
    if (with_mean) out.push_back(static_cast<float>(mean[0]));
    out.push_back(static_cast<float>(std::sqrt(s)));
    out.push_back(static_cast<float>(std::cbrt(third / n)));
    out.push_back(static_cast<float>(std::log(fourth / n + 1e-3)));
}

void add_percentiles(const cv::Mat& plane, Features& out) {
    std::vector<float> values(plane.begin<float>(), plane.end<float>());
    std::sort(values.begin(), values.end());
    for (const double q : {0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98})
        out.push_back(values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))]);
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
        soft(hue, (std::atan2(b[i], a[i]) / (2 * kPi) + 1) * 8, c, true);
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

// Log-Gabor filters in the frequency domain (Field 1987): wavelengths 3, 6, 12, 24, 48 px.
const std::array<cv::Mat, kScales * kOrientations>& filters() {
    static const auto kFilters = [] {
        std::array<cv::Mat, kScales * kOrientations> bank;
        for (int s = 0; s < kScales; ++s) {
            for (int o = 0; o < kOrientations; ++o) {
                cv::Mat f(kSide, kSide, CV_32FC2);
                const double centre = 1.0 / (3.0 * std::pow(2.0, s));
                for (int y = 0; y < kSide; ++y) {
                    for (int x = 0; x < kSide; ++x) {
                        const double u = (x < kSide / 2 ? x : x - kSide) / double{kSide};
                        const double v = (y < kSide / 2 ? y : y - kSide) / double{kSide};
                        const double radius = std::hypot(u, v);
                        float value = 0;
                        if (radius > 0) {
                            const double r = std::log(radius / centre) / std::log(1.7);
                            double turn = std::atan2(v, u) - o * kPi / kOrientations;
                            turn = std::atan2(std::sin(turn), std::cos(turn));
                            const double t = turn / (kPi / kOrientations * 0.75);
                            value = static_cast<float>(std::exp(-0.5 * (r * r + t * t)));
                        }
                        f.at<cv::Vec2f>(y, x) = {value, value};
                    }
                }
                bank[static_cast<std::size_t>(s * kOrientations + o)] = f;
            }
        }
        return bank;
    }();
    return kFilters;
}

cv::Mat tapered(const cv::Mat& plane) {
    static const cv::Mat kWindow = [] {
        cv::Mat w(kSide, kSide, CV_32F);
        const auto edge = [](int i) {
            const double d = std::min(i, kSide - 1 - i) + 0.5;
            return d >= 10 ? 1.0 : 0.5 - 0.5 * std::cos(kPi * d / 10);
        };
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                w.at<float>(y, x) = static_cast<float>(edge(y) * edge(x));
        return w;
    }();
    return (plane - cv::mean(plane)[0]).mul(kWindow);
}

double correlation(const cv::Mat& a, const cv::Mat& b) {
    cv::Scalar ma, sa, mb, sb;
    cv::meanStdDev(a, ma, sa);
    cv::meanStdDev(b, mb, sb);
    const double covariance = a.dot(b) / static_cast<double>(a.total()) - ma[0] * mb[0];
    return covariance / std::max(sa[0] * sb[0], 1e-9);
}

// Energies by scale and orientation, their unevenness over the sample, what is left of them when
// the sample is turned, and how energies of neighbouring scales go together (Portilla & Simoncelli
// 2000).
void add_energies(const cv::Mat& l, Features& out) {
    cv::Mat spectrum, response, filtered;
    cv::dft(tapered(l), spectrum, cv::DFT_COMPLEX_OUTPUT);
    std::array<std::array<double, kOrientations>, kScales> energy{};
    std::array<cv::Mat, kScales> by_scale;
    for (std::size_t s = 0; s < kScales; ++s) {
        by_scale[s] = cv::Mat::zeros(kSide, kSide, CV_32F);
        for (std::size_t o = 0; o < kOrientations; ++o) {
            cv::multiply(spectrum, filters()[s * kOrientations + o], filtered);
            cv::dft(filtered, response, cv::DFT_INVERSE | cv::DFT_SCALE);
            cv::Mat parts[2], magnitude;
            cv::split(response, parts);
            cv::magnitude(parts[0], parts[1], magnitude);
            cv::Scalar mean, deviation;
            cv::meanStdDev(magnitude, mean, deviation);
            energy[s][o] = mean[0];
            out.push_back(static_cast<float>(std::log(mean[0] + 1e-4)));
            out.push_back(static_cast<float>(deviation[0] / (mean[0] + 1e-4)));
            by_scale[s] += magnitude;
        }
    }
    for (std::size_t s = 0; s < kScales; ++s) {
        double sum = 0, top = 0, low = 1e9;
        for (const double e : energy[s]) {
            sum += e;
            top = std::max(top, e);
            low = std::min(low, e);
        }
        out.push_back(static_cast<float>(std::log(sum + 1e-4)));
        out.push_back(static_cast<float>(low / (top + 1e-6)));
        for (int k = 1; k <= 3; ++k) {
            double re = 0, im = 0;
            for (int o = 0; o < kOrientations; ++o) {
                re += energy[s][static_cast<std::size_t>(o)] *
                      std::cos(2 * kPi * k * o / kOrientations);
                im += energy[s][static_cast<std::size_t>(o)] *
                      std::sin(2 * kPi * k * o / kOrientations);
            }
            out.push_back(static_cast<float>(std::hypot(re, im) / (sum + 1e-6)));
        }
        add_moments(by_scale[s], out, false);
        if (s > 0) {
            out.push_back(static_cast<float>(correlation(by_scale[s - 1], by_scale[s])));
        }
    }
}

void add_color_energies(const Planes& p, Features& out) {
    out.push_back(static_cast<float>(correlation(p.l, p.a)));
    out.push_back(static_cast<float>(correlation(p.l, p.b)));
    out.push_back(static_cast<float>(correlation(p.a, p.b)));
    for (const cv::Mat* plane : {&p.l, &p.a, &p.b}) {
        cv::Mat last = *plane;
        for (const double sigma : {0.8, 1.6, 3.2, 6.4, 12.8}) {
            cv::Mat blurred;
            cv::GaussianBlur(*plane, blurred, {}, sigma, sigma, cv::BORDER_REFLECT_101);
            const cv::Mat band = last - blurred;
            out.push_back(static_cast<float>(
                std::log(std::sqrt(band.dot(band) / static_cast<double>(band.total())) + 1e-3)));
            add_moments(band, out, false);
            last = blurred;
        }
    }
}

// Autocorrelation of the lightness by radius (mean, lowest, highest over the angles).
void add_repetition(const cv::Mat& l, Features& out) {
    cv::Mat spectrum, power, acf;
    cv::dft(tapered(l), spectrum, cv::DFT_COMPLEX_OUTPUT);
    cv::mulSpectrums(spectrum, spectrum, power, 0, true);
    cv::dft(power, acf, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    const double zero = std::max(static_cast<double>(acf.at<float>(0, 0)), 1e-6);
    for (const int radius : {1, 2, 3, 4, 6, 8, 11, 16, 22, 32}) {
        double sum = 0, low = 1, high = -1;
        constexpr int kAngles = 24;
        for (int k = 0; k < kAngles; ++k) {
            const double t = kPi * k / kAngles;
            const int x = static_cast<int>(std::lround(radius * std::cos(t)));
            const int y = static_cast<int>(std::lround(radius * std::sin(t)));
            const double v =
                static_cast<double>(acf.at<float>((y + kSide) % kSide, (x + kSide) % kSide)) / zero;
            sum += v;
            low = std::min(low, v);
            high = std::max(high, v);
        }
        out.push_back(static_cast<float>(sum / kAngles));
        out.push_back(static_cast<float>(low));
        out.push_back(static_cast<float>(high));
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
        double turn = std::atan2(y[i], x[i]) / kPi + 1;
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

std::vector<float> texture_features(ViewU8x3 sample) {
    const Planes p = planes_of(sample);
    Features out;
    out.reserve(480);
    for (const cv::Mat* plane : {&p.l, &p.a, &p.b}) {
        add_moments(*plane, out, true);
        add_percentiles(*plane, out);
    }
    add_color_histograms(p, out);
    add_binary_patterns(p.l, 1, out);
    add_binary_patterns(p.l, 2, out);
    cv::Mat half;
    cv::resize(p.l, half, {kSide / 2, kSide / 2}, 0, 0, cv::INTER_AREA);
    add_binary_patterns(half, 2, out);
    add_energies(p.l, out);
    add_color_energies(p, out);
    add_repetition(p.l, out);
    add_gradients(p.l, out);
    return out;
}

int texture_feature_count() {
    static const int kCount =
        static_cast<int>(texture_features(ImageU8x3(kSide, kSide, 128)).size());
    return kCount;
}

ImageU8x3 middle_sample(ViewU8x3 picture) {
    ImageU8x3 out(kSide, kSide);
    const auto mirrored = [](int i, int n) {
        if (n == 1) return 0;
        const int period = 2 * n - 2;
        i = ((i % period) + period) % period;
        return i < n ? i : period - i;
    };
    const int x0 = (picture.width() - kSide) / 2, y0 = (picture.height() - kSide) / 2;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const std::uint8_t* from = picture.pixel(mirrored(x0 + x, picture.width()),
                                                     mirrored(y0 + y, picture.height()));
            std::copy_n(from, 3, out.pixel(x, y));
        }
    }
    return out;
}

float synthesisability(ViewU8x3 sample) {
    const Planes p = planes_of(sample);
    // Evenness: how much the mean and the contrast differ between the nine parts.
    std::vector<double> means, contrasts;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            cv::Scalar mean, deviation;
            cv::meanStdDev(p.l(cv::Rect(32 * x, 32 * y, 32, 32)), mean, deviation);
            means.push_back(mean[0]);
            contrasts.push_back(deviation[0]);
        }
    }
    const auto spread = [](const std::vector<double>& v) {
        double sum = 0, squares = 0;
        for (const double x : v) {
            sum += x;
            squares += x * x;
        }
        const double mean = sum / 9;
        return std::pair(mean, std::sqrt(std::max(0.0, squares / 9 - mean * mean)));
    };
    const double contrast = spread(contrasts).first + 0.02;
    const double uneven =
        spread(means).second / contrast + 0.7 * spread(contrasts).second / contrast;
    // Joining: the best overlap of 24 px of the right side on the left one, by sliding up and down,
    // and of the bottom on the top, against the contrast.
    const auto join = [&](bool vertical) {
        const cv::Mat t = vertical ? cv::Mat(p.l.t()) : p.l;
        double best = 1e9;
        for (int shift = -24; shift <= 24; shift += 2) {
            for (const int overlap : {20, 28, 36}) {
                const int y0 = std::max(0, shift), rows = kSide - std::abs(shift);
                const cv::Mat right = t(cv::Rect(kSide - overlap, y0, overlap, rows));
                const cv::Mat left = t(cv::Rect(0, y0 - shift, overlap, rows));
                const cv::Mat difference = right - left;
                best = std::min(
                    best, difference.dot(difference) / static_cast<double>(difference.total()));
            }
        }
        return std::sqrt(best) / (std::numbers::sqrt2 * contrast);
    };
    const double seam = 0.5 * (join(false) + join(true));
    const double score = 0.5 * std::exp(-1.2 * uneven) + 0.5 * std::clamp(1.25 - seam, 0.0, 1.0);
    return static_cast<float>(std::clamp(score, 0.0, 1.0));
}

}  // namespace weft
