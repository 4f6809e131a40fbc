#include "engine/mask/background_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr int kStep = 4;  // motion is sampled at every fourth pixel
constexpr int kRounds = 6;
constexpr float kLeastScalePx = 0.1f;
constexpr int kTerms = 8;
constexpr std::array<int, 2> kRadii = {3, 12};  // of local corrections, in steps
constexpr std::array<float, 2> kSay = {1.0f, 0.05f};
constexpr float kPlaneWeight = 0.01f;  // weight of "no correction" against them

using Terms = std::array<double, kTerms>;

// Plane motion in coordinates centred on the frame and divided by its width.
struct PlaneMotion {
    Terms p{};
    double centre_x, centre_y, unit;

    explicit PlaneMotion(Size s)
        : centre_x(0.5 * s.width), centre_y(0.5 * s.height), unit(1.0 / s.width) {}

    [[nodiscard]] std::array<Terms, 2> rows(double px, double py) const {
        const double x = (px - centre_x) * unit, y = (py - centre_y) * unit;
        return {{{1, x, y, 0, 0, 0, x * x, x * y}, {0, 0, 0, 1, x, y, x * y, y * y}}};
    }
    [[nodiscard]] Vec2 at(double px, double py) const {
        const auto r = rows(px, py);
        double u = 0, v = 0;
        for (std::size_t i = 0; i < kTerms; ++i) {
            u += p[i] * r[0][i];
            v += p[i] * r[1][i];
        }
        return {static_cast<float>(u), static_cast<float>(v)};
    }
};

struct Sample {
    int x, y;
    Vec2 d;
    float weight;
};

std::vector<Sample> samples_of(ViewF1 phi, const FlowField& flow, float clearance_px) {
    std::vector<Sample> samples;
    for (int y = kStep / 2; y < phi.height(); y += kStep) {
        for (int x = kStep / 2; x < phi.width(); x += kStep) {
            if (flow.valid.row(y)[x] == 0) continue;
            const float* d = flow.d.pixel(x, y);
            if (sample_bilinear(phi, static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]) >
                -clearance_px) {
                continue;
            }
            samples.push_back({x, y, Vec2(d[0], d[1]), 1});
        }
    }
    return samples;
}

void fit(PlaneMotion& plane, const std::vector<Sample>& samples) {
    cv::Matx<double, kTerms, kTerms> a = cv::Matx<double, kTerms, kTerms>::eye() * 1e-3;
    cv::Vec<double, kTerms> b;
    for (const Sample& s : samples) {
        const auto rows = plane.rows(s.x, s.y);
        for (std::size_t k = 0; k < 2; ++k) {
            const double d = static_cast<double>(k == 0 ? s.d.x : s.d.y);
            for (std::size_t i = 0; i < kTerms; ++i) {
                const double w = static_cast<double>(s.weight) * rows[k][i];
                b[static_cast<int>(i)] += w * d;
                for (std::size_t j = 0; j < kTerms; ++j) {
                    a(static_cast<int>(i), static_cast<int>(j)) += w * rows[k][j];
                }
            }
        }
    }
    cv::Vec<double, kTerms> p;
    if (!cv::solve(a, b, p, cv::DECOMP_CHOLESKY)) return;
    for (std::size_t i = 0; i < kTerms; ++i)
        plane.p[i] = p[static_cast<int>(i)];
}

PlaneMotion fit_robustly(std::vector<Sample> samples, Size size) {
    PlaneMotion plane(size);
    if (samples.size() < 4 * kTerms) return plane;
    std::vector<float> misses(samples.size());
    for (int round = 0; round < kRounds; ++round) {
        fit(plane, samples);
        for (std::size_t i = 0; i < samples.size(); ++i)
            misses[i] = glm::length(samples[i].d - plane.at(samples[i].x, samples[i].y));
        std::vector<float> sorted = misses;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const float scale = 1.5f * std::max(*middle / 1.177f, kLeastScalePx);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const float r = misses[i] / scale;
            samples[i].weight = 1 / (1 + r * r);
        }
    }
    return plane;
}

// What the plane misses, averaged near by, on a grid of every kStep-th pixel.
ImageF2 local_corrections(const PlaneMotion& plane, const std::vector<Sample>& samples, Size size) {
    const int w = (size.width + kStep - 1) / kStep, h = (size.height + kStep - 1) / kStep;
    cv::Mat misses(h, w, CV_32FC3, cv::Scalar::all(0));
    for (const Sample& s : samples) {
        const Vec2 miss = s.d - plane.at(s.x, s.y);
        misses.at<cv::Vec3f>(s.y / kStep, s.x / kStep) = cv::Vec3f(1, miss.x, miss.y);
    }
    ImageF2 corrections(w, h);
    std::array<cv::Mat, kRadii.size()> means;
    for (std::size_t i = 0; i < kRadii.size(); ++i) {
        const int side = 2 * kRadii[i] + 1;
        cv::boxFilter(misses, means[i], CV_32F, cv::Size(side, side), cv::Point(-1, -1), true,
                      cv::BORDER_REPLICATE);
    }
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            cv::Vec3f sum(kPlaneWeight, 0, 0);
            for (std::size_t i = 0; i < kRadii.size(); ++i)
                sum += kSay[i] * means[i].at<cv::Vec3f>(y, x);
            corrections.pixel(x, y)[0] = sum[1] / sum[0];
            corrections.pixel(x, y)[1] = sum[2] / sum[0];
        }
    }
    return corrections;
}

}  // namespace

ImageF2 background_motion(ViewF1 prev_phi, const FlowField& prev_from_cur, float clearance_px) {
    const Size size = prev_phi.size();
    const std::vector<Sample> samples = samples_of(prev_phi, prev_from_cur, clearance_px);
    const PlaneMotion plane = fit_robustly(samples, size);
    const ImageF2 corrections = local_corrections(plane, samples, size);
    ImageF2 motion(size);
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const Vec2 d = plane.at(x, y) +
                               sample_bilinear(corrections, static_cast<float>(x) / kStep - 0.5f,
                                               static_cast<float>(y) / kStep - 0.5f);
                motion.pixel(x, y)[0] = d.x;
                motion.pixel(x, y)[1] = d.y;
            }
        }
    });
    return motion;
}

}  // namespace weft
