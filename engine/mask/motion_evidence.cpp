#include "engine/mask/motion_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kMostMotion = 3, kMostColor = 2;  // log odds
constexpr float kSpread_px = 4;                   // at 854×480

int spread_steps(float unit_px) {
    return std::max(1, static_cast<int>(std::lround(kSpread_px * unit_px / kMotionEvidenceStep)));
}

}  // namespace

ImageF1 motion_evidence(const MotionReturnInput& in) {
    constexpr int kStep = kMotionEvidenceStep;
    ImageF1 odds(
        Size{(in.frame.width() + kStep - 1) / kStep, (in.frame.height() + kStep - 1) / kStep});
    parallel_rows(odds.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < odds.width(); ++x) {
                const float motion = in.departs.row(y * kStep)[x * kStep];
                const float color = in.palette.odds(in.frame.pixel(x * kStep, y * kStep));
                odds.at(x, y) = std::clamp(motion, -kMostMotion, kMostMotion) +
                                std::clamp(color, -kMostColor, kMostColor);
            }
        }
    });
    cv::Mat pixels(odds.height(), odds.width(), CV_32F, odds.data(),
                   static_cast<std::size_t>(odds.stride()) * sizeof(float));
    const int side = 2 * spread_steps(in.unit_px) + 1;
    cv::boxFilter(pixels, pixels, CV_32F, cv::Size(side, side));
    return odds;
}

PieceLabels motion_pieces(ViewF1 odds, float least, float unit_px) {
    cv::Mat over(odds.height(), odds.width(), CV_8U);
    for (int y = 0; y < odds.height(); ++y) {
        for (int x = 0; x < odds.width(); ++x)
            over.at<std::uint8_t>(y, x) = odds.row(y)[x] > least ? 255 : 0;
    }
    const int side = 2 * spread_steps(unit_px) + 1;
    const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(side, side));
    cv::morphologyEx(over, over, cv::MORPH_CLOSE, disc);
    PieceLabels labels(odds.size());
    cv::Mat out(labels.height(), labels.width(), CV_32S, labels.data(),
                static_cast<std::size_t>(labels.stride()) * sizeof(std::int32_t));
    cv::connectedComponents(over, out, 8, CV_32S);
    return labels;
}

}  // namespace weft
