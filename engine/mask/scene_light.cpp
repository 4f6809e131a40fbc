#include "engine/mask/scene_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace weft {
namespace {

constexpr float kDarkest = 8;  // luma code below which there is no ratio

// The natural logarithm of the median; 0 of none.
float log_median(std::vector<float>& ratios) {
    if (ratios.empty()) return 0;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return std::log(*middle);
}

}  // namespace

ImageF1 scene_gain(const ImageF1& expected, const ImageF1& luma, const Matte& left_out) {
    constexpr float kSpread = 0.15f, kAlone = 4;  // natural logarithms; blocks
    constexpr int kSide = 49;                     // blocks
    ImageF1 gain(luma.size());
    std::vector<float> ratios;
    for (int y = 0; y < gain.height(); ++y) {
        for (int x = 0; x < gain.width(); ++x) {
            const float least = std::min(expected.at(x, y), luma.at(x, y));
            if (least < kDarkest || left_out.at(x, y) != 0) continue;
            gain.at(x, y) = luma.at(x, y) / expected.at(x, y);
            ratios.push_back(gain.at(x, y));
        }
    }
    const float usual = log_median(ratios);
    cv::Mat sums(gain.height(), gain.width(), CV_32FC2, cv::Scalar::all(0));
    for (int y = 0; y < gain.height(); ++y) {
        for (int x = 0; x < gain.width(); ++x) {
            if (gain.at(x, y) <= 0) continue;
            const float off = std::log(gain.at(x, y)) - usual;
            const float weight = 1 / (1 + off * off / (kSpread * kSpread));
            sums.at<cv::Vec2f>(y, x) = {weight, weight * off};
        }
    }
    cv::boxFilter(sums, sums, CV_32F, {kSide, kSide}, {-1, -1}, false, cv::BORDER_CONSTANT);
    for (int y = 0; y < gain.height(); ++y) {
        for (int x = 0; x < gain.width(); ++x) {
            const auto& sum = sums.at<cv::Vec2f>(y, x);
            gain.at(x, y) = std::exp(usual + sum[1] / (sum[0] + kAlone));
        }
    }
    return gain;
}

}  // namespace weft
