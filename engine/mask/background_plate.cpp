#include "engine/mask/background_plate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kClearancePx = 3;      // nearer to the shape, its colour is mixed in
constexpr float kSurePx = 12;          // farther outside, a difference is noise and not surface
constexpr float kLeastNoise = 4;       // mean difference of an unchanged pixel, 8-bit levels
constexpr float kForeignSpread = 160;  // levels over which the differences of another object spread
constexpr float kMostPlateOdds = 3;
constexpr float kMostGain = 2;        // of a shadow that comes or goes
constexpr float kLightShare = 0.35f;  // weight of a difference in brightness alone

int difference(const std::uint8_t* a, const std::uint8_t* b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// The same, but a change of brightness alone counts less, because a shadow may have come or gone.
float difference_but_light(const std::uint8_t* a, const std::uint8_t* b) {
    const auto plain = static_cast<float>(difference(a, b));
    const int ab = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const int bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    if (bb == 0) return plain;
    const float gain =
        std::clamp(static_cast<float>(ab) / static_cast<float>(bb), 1 / kMostGain, kMostGain);
    float left = kLightShare * std::abs(1 - gain) * static_cast<float>(b[0] + b[1] + b[2]);
    for (int i = 0; i < 3; ++i)
        left += std::abs(static_cast<float>(a[i]) - gain * static_cast<float>(b[i]));
    return std::min(plain, left);
}

// Difference, summed over channels, of a pixel and the most similar one of the plate around it.
float least_difference_but_light(const std::uint8_t* c, ViewU8x3 plate, int x, int y) {
    float least = 3 * 255;
    for (int v = std::max(0, y - 1); v <= std::min(plate.height() - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(plate.width() - 1, x + 1); ++u)
            least = std::min(least, difference_but_light(c, plate.pixel(u, v)));
    }
    return least;
}

}  // namespace

BackgroundPlate::BackgroundPlate(ViewU8x3 frame, ViewF1 phi)
    : picture_(frame.size()), known_(frame.size()) {
    update(frame, phi);
}

void BackgroundPlate::update(ViewU8x3 frame, ViewF1 phi) {
    parallel_rows(frame.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < frame.width(); ++x) {
                if (phi.row(y)[x] > -kClearancePx) continue;
                std::copy(frame.pixel(x, y), frame.pixel(x, y) + 3, picture_.pixel(x, y));
                known_.row(y)[x] = 255;
            }
        }
    });
}

void BackgroundPlate::forget(ViewU8x1 where) {
    for (int y = 0; y < where.height(); ++y) {
        for (int x = 0; x < where.width(); ++x)
            if (where.row(y)[x] != 0) known_.at(x, y) = 0;
    }
}

void BackgroundPlate::move(ViewF2 background_from_cur) {
    const int w = picture_.width(), h = picture_.height();
    cv::Mat map(h, w, CV_32FC2);
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            auto* m = map.ptr<cv::Vec2f>(y);
            for (int x = 0; x < w; ++x) {
                const float* d = background_from_cur.pixel(x, y);
                m[x] = cv::Vec2f(static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]);
            }
        }
    });
    ImageU8x3 picture(picture_.size());
    Image<std::uint8_t, 1> known(picture_.size());
    const cv::Mat from(h, w, CV_8UC3, picture_.row(0)), was_known(h, w, CV_8U, known_.row(0));
    cv::Mat to(h, w, CV_8UC3, picture.row(0)), is_known(h, w, CV_8U, known.row(0));
    cv::remap(from, to, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    cv::remap(was_known, is_known, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    parallel_rows(h, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x)
                known.row(y)[x] = known.row(y)[x] == 255 ? 255 : 0;
        }
    });
    picture_ = std::move(picture);
    known_ = std::move(known);
}

float BackgroundPlate::difference(const std::uint8_t* color, int x, int y) const {
    if (known_.row(y)[x] == 0) return -1;
    return least_difference_but_light(color, picture_, x, y) / 3;
}

ImageF1 BackgroundPlate::odds(ViewU8x3 frame, ViewF1 expected_phi, ViewF1 surface_difference,
                              const Recti& area) const {
    const int w = area.width(), h = area.height();
    cv::Mat differences(h, w, CV_32F, cv::Scalar(0)), sure(h, w, CV_32FC2, cv::Scalar::all(0));
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                const int fx = area.x0 + x, fy = area.y0 + y;
                if (known_.row(fy)[fx] == 0) continue;
                const float d = least_difference_but_light(frame.pixel(x, y), picture_, fx, fy) / 3;
                differences.at<float>(y, x) = d;
                if (expected_phi.row(y)[x] < -kSurePx)
                    sure.at<cv::Vec2f>(y, x) = cv::Vec2f(1, std::min(d, 30.0f));
            }
        }
    });
    cv::Mat patch, noise;
    cv::blur(differences, patch, cv::Size(3, 3));
    const int side = 2 * (std::min(picture_.width(), picture_.height()) / 12) + 1;
    cv::boxFilter(sure, noise, CV_32F, cv::Size(side, side), cv::Point(-1, -1), true,
                  cv::BORDER_REPLICATE);
    const cv::Scalar all = cv::mean(sure);
    const auto mean_noise = static_cast<float>(all[0] > 0 ? all[1] / all[0] : 0.0);
    ImageF1 odds(area.size());
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                if (known_.row(area.y0 + y)[area.x0 + x] == 0) continue;
                const auto& n = noise.at<cv::Vec2f>(y, x);
                const float local = (n[1] + 0.05f * mean_noise) / (n[0] + 0.05f);
                const float scale = std::max(kLeastNoise, local);
                // Laplacian for the background and for what the surface showed here, uniform for
                // anything else.
                const float shown =
                    surface_difference.empty() ? -1.0f : surface_difference.row(y)[x];
                const float foreign = std::log(2 * scale / kForeignSpread);
                const float value = (shown < 0 ? foreign : std::max(foreign, -shown / scale)) +
                                    patch.at<float>(y, x) / scale;
                odds.row(y)[x] = std::clamp(value, -kMostPlateOdds, kMostPlateOdds);
            }
        }
    });
    return odds;
}

}  // namespace weft
