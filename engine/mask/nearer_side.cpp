#include "engine/mask/nearer_side.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/mask/matte_box.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr float kBeside_px = 10;  // of 854×480: how far a piece is compared with either side
constexpr float kSmooth_px = 3;   // … and its own texture averaged
constexpr float kFew = 0.02f;     // of the pixels around: nothing can be said
constexpr double kMostOutside = 1.0 / 3;

// Sums of the colours of the pixels of `mask` around each pixel; fourth: how many they are, as a
// share of all.
cv::Mat sums_around(const cv::Mat& frame, const cv::Mat& mask, int reach) {
    cv::Mat sums(frame.size(), CV_32FC4, cv::Scalar::all(0));
    for (int y = 0; y < frame.rows; ++y) {
        for (int x = 0; x < frame.cols; ++x) {
            if (mask.at<std::uint8_t>(y, x) == 0) continue;
            const auto& c = frame.at<cv::Vec3b>(y, x);
            sums.at<cv::Vec4f>(y, x) = {static_cast<float>(c[0]), static_cast<float>(c[1]),
                                        static_cast<float>(c[2]), 1};
        }
    }
    const int side = 2 * reach + 1;
    cv::boxFilter(sums, sums, -1, {side, side}, {-1, -1}, true, cv::BORDER_CONSTANT);
    return sums;
}

Vec3 mean_of(const cv::Vec4f& sums) {
    return Vec3(sums[0], sums[1], sums[2]) / sums[3];
}

float difference(Vec3 color, const cv::Vec4f& side) {
    if (side[3] < kFew) return std::numeric_limits<float>::max();
    return glm::length(color - mean_of(side));
}

}  // namespace

void drop_nearer_outside(const BetweenSides& in, Matte& pieces) {
    const auto reach = [&](float px) {
        return std::max(1, static_cast<int>(std::lround(px * in.unit_px)));
    };
    const Recti box =
        matte_box(pieces, 1).grown(reach(kBeside_px)).intersected(rect_of(pieces.size()));
    if (box.empty()) return;
    const cv::Rect part(box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0);
    const cv::Mat frame = as_mat(in.frame)(part), outside = as_mat(in.outside)(part);
    cv::Mat inside(part.size(), CV_8U);
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            inside.at<std::uint8_t>(y, x) = in.phi.row(box.y0 + y)[box.x0 + x] > 0 ? 255 : 0;
    const cv::Mat found = as_mat(pieces)(part);
    const cv::Mat own = sums_around(frame, found, reach(kSmooth_px)),
                  surface = sums_around(frame, inside, reach(kBeside_px)),
                  other = sums_around(frame, outside, reach(kBeside_px));
    cv::Mat labels;
    const int count = cv::connectedComponents(found, labels, 8, CV_32S);
    std::vector<double> judged(static_cast<std::size_t>(count)), nearer(judged);
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            const auto piece = static_cast<std::size_t>(labels.at<int>(y, x));
            if (piece == 0) continue;
            const Vec3 color = mean_of(own.at<cv::Vec4f>(y, x));
            const float to_surface = difference(color, surface.at<cv::Vec4f>(y, x)),
                        to_outside = difference(color, other.at<cv::Vec4f>(y, x));
            if (to_surface == to_outside) continue;
            judged[piece] += 1;
            if (to_outside < to_surface) nearer[piece] += 1;
        }
    }
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            const auto piece = static_cast<std::size_t>(labels.at<int>(y, x));
            if (nearer[piece] > kMostOutside * judged[piece]) pieces.at(box.x0 + x, box.y0 + y) = 0;
        }
    }
}

}  // namespace weft
