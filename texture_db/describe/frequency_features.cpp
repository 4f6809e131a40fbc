// Features from the Fourier transform of the whole sample: oriented energies and repetition.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "texture_db/describe/feature_parts.h"

namespace weft {
namespace {

constexpr int kScales = 5, kOrientations = 6;

// Log-Gabor filters in the frequency domain (Field 1987): wavelengths 3, 6, 12, 24, 48 px. The
// output of a coarse one fits on a coarser grid, of this many samples a side.
constexpr std::array<int, kScales> kGrid{96, 96, 48, 24, 24};

// Frequency of a row or column of a spectrum, in cycles a side.
int frequency(int i, int n) {
    return i < n / 2 ? i : i - n;
}

const std::array<cv::Mat, kScales * kOrientations>& filters() {
    static const auto kFilters = [] {
        std::array<cv::Mat, kScales * kOrientations> bank;
        for (int s = 0; s < kScales; ++s) {
            for (int o = 0; o < kOrientations; ++o) {
                const int n = kGrid[static_cast<std::size_t>(s)];
                cv::Mat f(n, n, CV_32FC2);
                const double centre = 1.0 / (3.0 * std::pow(2.0, s));
                for (int y = 0; y < n; ++y) {
                    for (int x = 0; x < n; ++x) {
                        const double u = frequency(x, n) / double{kDescribedSide};
                        const double v = frequency(y, n) / double{kDescribedSide};
                        const double radius = std::hypot(u, v);
                        float value = 0;
                        if (radius > 0) {
                            const double r = std::log(radius / centre) / std::log(1.7);
                            double turn = std::atan2(v, u) - o * std::numbers::pi / kOrientations;
                            turn = std::atan2(std::sin(turn), std::cos(turn));
                            const double t = turn / (std::numbers::pi / kOrientations * 0.75);
                            // The inverse transform is scaled here.
                            value = static_cast<float>(std::exp(-0.5 * (r * r + t * t)) /
                                                       (kDescribedSide * kDescribedSide));
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

// The lowest frequencies of a spectrum, as the spectrum of a grid of n samples a side.
cv::Mat low_frequencies(const cv::Mat& spectrum, int n) {
    if (n == spectrum.rows) return spectrum;
    cv::Mat out(n, n, CV_32FC2);
    const int h = n / 2, far = spectrum.rows - h;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x)
            spectrum(cv::Rect(x * far, y * far, h, h)).copyTo(out(cv::Rect(x * h, y * h, h, h)));
    }
    return out;
}

// Every k-th sample of a grid, n a side.
cv::Mat thinned(const cv::Mat& grid, int n) {
    const int k = grid.rows / n;
    if (k == 1) return grid;
    cv::Mat out(n, n, CV_32F);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x)
            out.at<float>(y, x) = grid.at<float>(k * y, k * x);
    }
    return out;
}

cv::Mat tapered(std::span<const float> values) {
    const cv::Mat plane(kDescribedSide, kDescribedSide, CV_32F, const_cast<float*>(values.data()));
    static const cv::Mat kWindow = [] {
        cv::Mat w(kDescribedSide, kDescribedSide, CV_32F);
        const auto edge = [](int i) {
            const double d = std::min(i, kDescribedSide - 1 - i) + 0.5;
            return d >= 10 ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * d / 10);
        };
        for (int y = 0; y < kDescribedSide; ++y)
            for (int x = 0; x < kDescribedSide; ++x)
                w.at<float>(y, x) = static_cast<float>(edge(y) * edge(x));
        return w;
    }();
    return (plane - cv::mean(plane)[0]).mul(kWindow);
}

}  // namespace

void add_moments(std::span<const float> values, int width, bool with_mean,
                 std::vector<float>& out) {
    const cv::Mat plane(static_cast<int>(values.size()) / width, width, CV_32F,
                        const_cast<float*>(values.data()));
    cv::Scalar mean, deviation;
    cv::meanStdDev(plane, mean, deviation);
    const double s = std::max(deviation[0], 1e-4);
    double third = 0, fourth = 0;
    const auto middle = static_cast<float>(mean[0]), scale = static_cast<float>(1 / s);
    for (int y = 0; y < plane.rows; ++y) {
        const auto* p = plane.ptr<float>(y);
        // Separate sums let the compiler use vector instructions without reordering.
        std::array<float, 8> three{}, four{};
        for (int x = 0; x + 8 <= plane.cols; x += 8) {
            for (int k = 0; k < 8; ++k) {
                const float z = (p[x + k] - middle) * scale, square = z * z;
                three[static_cast<std::size_t>(k)] += square * z;
                four[static_cast<std::size_t>(k)] += square * square;
            }
        }
        for (std::size_t k = 0; k < 8; ++k) {
            third += three[k];
            fourth += four[k];
        }
    }
    const auto n = static_cast<double>(plane.total());
    if (with_mean) out.push_back(static_cast<float>(mean[0]));
    out.push_back(static_cast<float>(std::sqrt(s)));
    out.push_back(static_cast<float>(std::cbrt(third / n)));
    out.push_back(static_cast<float>(std::log(fourth / n + 1e-3)));
}

double correlation(std::span<const float> x, std::span<const float> y) {
    const cv::Mat a(1, static_cast<int>(x.size()), CV_32F, const_cast<float*>(x.data()));
    const cv::Mat b(1, static_cast<int>(y.size()), CV_32F, const_cast<float*>(y.data()));
    cv::Scalar ma, sa, mb, sb;
    cv::meanStdDev(a, ma, sa);
    cv::meanStdDev(b, mb, sb);
    const double covariance = a.dot(b) / static_cast<double>(a.total()) - ma[0] * mb[0];
    return covariance / std::max(sa[0] * sb[0], 1e-9);
}

void add_oriented_energies(std::span<const float> plane, std::vector<float>& out) {
    cv::Mat spectrum, response, filtered;
    cv::dft(tapered(plane), spectrum, cv::DFT_COMPLEX_OUTPUT);
    std::array<std::array<double, kOrientations>, kScales> energy{};
    std::array<cv::Mat, kScales> by_scale;
    for (std::size_t s = 0; s < kScales; ++s) {
        const int n = kGrid[s];
        const cv::Mat low = low_frequencies(spectrum, n);
        by_scale[s] = cv::Mat::zeros(n, n, CV_32F);
        for (std::size_t o = 0; o < kOrientations; ++o) {
            cv::multiply(low, filters()[s * kOrientations + o], filtered);
            cv::dft(filtered, response, cv::DFT_INVERSE);
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
                      std::cos(2 * std::numbers::pi * k * o / kOrientations);
                im += energy[s][static_cast<std::size_t>(o)] *
                      std::sin(2 * std::numbers::pi * k * o / kOrientations);
            }
            out.push_back(static_cast<float>(std::hypot(re, im) / (sum + 1e-6)));
        }
        add_moments(values_of(by_scale[s]), by_scale[s].cols, false, out);
        if (s > 0) {
            out.push_back(static_cast<float>(correlation(
                values_of(thinned(by_scale[s - 1], by_scale[s].rows)), values_of(by_scale[s]))));
        }
    }
}

void add_repetition(std::span<const float> plane, std::vector<float>& out) {
    cv::Mat spectrum, power, acf;
    cv::dft(tapered(plane), spectrum, cv::DFT_COMPLEX_OUTPUT);
    cv::mulSpectrums(spectrum, spectrum, power, 0, true);
    cv::dft(power, acf, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    const double zero = std::max(static_cast<double>(acf.at<float>(0, 0)), 1e-6);
    for (const int radius : {1, 2, 3, 4, 6, 8, 11, 16, 22, 32}) {
        double sum = 0, low = 1, high = -1;
        constexpr int kAngles = 24;
        for (int k = 0; k < kAngles; ++k) {
            const double t = std::numbers::pi * k / kAngles;
            const int x = static_cast<int>(std::lround(radius * std::cos(t)));
            const int y = static_cast<int>(std::lround(radius * std::sin(t)));
            const double v =
                static_cast<double>(acf.at<float>((y + kDescribedSide) % kDescribedSide,
                                                  (x + kDescribedSide) % kDescribedSide)) /
                zero;
            sum += v;
            low = std::min(low, v);
            high = std::max(high, v);
        }
        out.push_back(static_cast<float>(sum / kAngles));
        out.push_back(static_cast<float>(low));
        out.push_back(static_cast<float>(high));
    }
}

}  // namespace weft
