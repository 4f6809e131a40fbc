#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "texture_db/describe/feature_parts.h"
#include "texture_db/describe/features.h"

namespace weft {
namespace {

// L / 100 of CIE Lab.
cv::Mat lightness_of(ViewU8x3 sample) {
    const cv::Mat rgb(kDescribedSide, kDescribedSide, CV_8UC3,
                      const_cast<std::uint8_t*>(sample.data()),
                      static_cast<std::size_t>(sample.stride()));
    cv::Mat floats, lab, lightness;
    rgb.convertTo(floats, CV_32FC3, 1.0 / 255.0);
    cv::cvtColor(floats, lab, cv::COLOR_RGB2Lab);
    cv::extractChannel(lab, lightness, 0);
    return lightness / 100.0;
}

}  // namespace

float synthesisability(ViewU8x3 sample) {
    const cv::Mat lightness = lightness_of(sample);
    // Evenness: how much the mean and the contrast differ between the nine parts.
    std::vector<double> means, contrasts;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            cv::Scalar mean, deviation;
            cv::meanStdDev(lightness(cv::Rect(32 * x, 32 * y, 32, 32)), mean, deviation);
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
    // and of the bottom on the top, relative to the contrast.
    const auto join = [&](bool vertical) {
        const cv::Mat t = vertical ? cv::Mat(lightness.t()) : lightness;
        double best = 1e9;
        for (int shift = -24; shift <= 24; shift += 2) {
            for (const int overlap : {20, 28, 36}) {
                const int y0 = std::max(0, shift), rows = kDescribedSide - std::abs(shift);
                const cv::Mat right = t(cv::Rect(kDescribedSide - overlap, y0, overlap, rows));
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
