#include "engine/motion/relocalise.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace weft {
namespace {

struct Points {
    std::vector<cv::Point2f> at;  // frame coordinates
    cv::Mat descriptors;
};

Points points_of(const RegistrationPicture& picture) {
    cv::Mat values(picture.area.height(), picture.area.width(), CV_8U),
        inside(values.size(), CV_8U);
    for (int y = 0; y < values.rows; ++y) {
        for (int x = 0; x < values.cols; ++x) {
            // The local deviation is 1; three of them fill the range.
            values.at<std::uint8_t>(y, x) =
                cv::saturate_cast<std::uint8_t>(128 + 42 * picture.value.at(x, y));
            inside.at<std::uint8_t>(y, x) = picture.inside.at(x, y) > 0 ? 255 : 0;
        }
    }
    constexpr int kMostPoints = 1200;
    std::vector<cv::KeyPoint> keys;
    Points out;
    cv::SIFT::create(kMostPoints)->detectAndCompute(values, inside, keys, out.descriptors);
    const cv::Point2f origin(static_cast<float>(picture.area.x0),
                             static_cast<float>(picture.area.y0));
    out.at.reserve(keys.size());
    // A key point's (0, 0) is the centre of the first pixel.
    for (const cv::KeyPoint& k : keys)
        out.at.push_back(k.pt + origin + cv::Point2f(0.5f, 0.5f));
    return out;
}

// True if the map keeps the corners of `area` in order and about their size.
bool sane(const cv::Mat& h, const Recti& area) {
    const auto x0 = static_cast<float>(area.x0), y0 = static_cast<float>(area.y0);
    const auto x1 = static_cast<float>(area.x1), y1 = static_cast<float>(area.y1);
    const std::vector<cv::Point2f> corners{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    std::vector<cv::Point2f> to;
    cv::perspectiveTransform(corners, to, h);
    const double ratio = cv::contourArea(to, true) / cv::contourArea(corners, true);
    return cv::isContourConvex(to) && ratio > 0.05 && ratio < 20;
}

}  // namespace

std::optional<LatticeField> find_again(const RegistrationPicture& anchor,
                                       const RegistrationPicture& cur, Size frame, int spacing_px) {
    constexpr std::size_t kFewest = 12;
    if (anchor.area.empty() || cur.area.empty()) return std::nullopt;
    const Points there = points_of(anchor), here = points_of(cur);
    if (there.at.size() < kFewest || here.at.size() < kFewest) return std::nullopt;
    std::vector<cv::DMatch> matches;
    cv::BFMatcher(cv::NORM_L2, true).match(here.descriptors, there.descriptors, matches);
    std::vector<cv::Point2f> from, to;
    for (const cv::DMatch& m : matches) {
        from.push_back(here.at[static_cast<std::size_t>(m.queryIdx)]);
        to.push_back(there.at[static_cast<std::size_t>(m.trainIdx)]);
    }
    if (from.size() < kFewest) return std::nullopt;
    const double tolerance_px = 3.0 * std::max(1.0, frame.width / 854.0);
    cv::Mat agreeing;
    const cv::Mat h = cv::findHomography(from, to, cv::RANSAC, tolerance_px, agreeing, 4000, 0.999);
    if (h.empty() || cv::countNonZero(agreeing) < static_cast<int>(kFewest) || !sane(h, cur.area))
        return std::nullopt;

    LatticeField field(frame, spacing_px);
    const double* m = h.ptr<double>();
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            // Beyond the horizon there is no surface; the region lies well before it.
            const double w = std::max(0.05, m[6] * p.x + m[7] * p.y + m[8]);
            field.set_node(i, j,
                           {static_cast<float>((m[0] * p.x + m[1] * p.y + m[2]) / w) - p.x,
                            static_cast<float>((m[3] * p.x + m[4] * p.y + m[5]) / w) - p.y});
        }
    }
    return field;
}

}  // namespace weft
