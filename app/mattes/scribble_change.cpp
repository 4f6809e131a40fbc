#include "app/mattes/scribble_change.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "app/mattes/scribble_matte.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr int kMatteEdge_px = 2;  // of a found matte: as far as it is soft

cv::Mat round_brush(int radius) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

Matte as_matte(const cv::Mat& from) {
    Matte out(Size{from.cols, from.rows});
    for (int y = 0; y < from.rows; ++y)
        std::copy_n(from.ptr<std::uint8_t>(y), from.cols, out.pixel(0, y));
    return out;
}

// The pieces of `change` that a line touches. Where the edge was found a little beside the painted
// one, a thin rim would connect places that have nothing to do with each other.
cv::Mat touched_by(const cv::Mat& lines, const cv::Mat& change) {
    const cv::Mat disc = round_brush(kMatteEdge_px);
    cv::Mat thick, numbers, out(change.size(), CV_8UC1, cv::Scalar(0));
    cv::morphologyEx(change, thick, cv::MORPH_OPEN, disc);
    thick |= change & lines;
    const int count = cv::connectedComponents(thick, numbers);
    std::vector<bool> touched(static_cast<std::size_t>(count), false);
    for (int y = 0; y < change.rows; ++y)
        for (int x = 0; x < change.cols; ++x)
            if (lines.at<std::uint8_t>(y, x) != 0)
                touched[static_cast<std::size_t>(numbers.at<int>(y, x))] = true;
    touched[0] = false;  // what does not change
    for (int y = 0; y < change.rows; ++y)
        for (int x = 0; x < change.cols; ++x)
            if (touched[static_cast<std::size_t>(numbers.at<int>(y, x))])
                out.at<std::uint8_t>(y, x) = 255;
    cv::dilate(out, out, disc);
    return out & change;
}

// How far lines outside act where they are alone: as far as lines inside do.
cv::Mat near_to(const cv::Mat& lines, int times) {
    constexpr int kLeast_px = 24;
    const cv::Rect extent = cv::boundingRect(lines);
    const int reach = std::max(kLeast_px, std::max(extent.width, extent.height) / 2);
    cv::Mat distance;
    cv::distanceTransform(lines == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return distance <= times * reach;
}

// What the picture says if the lines are all that is known. Without lines inside, what was painted
// out of reach of those outside is surely inside, except at its edge, which may be wrong.
cv::Mat cut_with(const Matte& base, ViewU8x3 picture, const Matte& keep, const Matte& drop) {
    if (!is_empty(keep)) return as_mat(segment_scribbles(base, picture, keep, drop)).clone();
    constexpr int kEdge_px = 4;
    const cv::Mat outside = as_mat(drop) > 127, near = near_to(outside, 1);
    cv::Mat inside;
    cv::erode(as_mat(base) > 127, inside, round_brush(kEdge_px));
    inside &= ~near & near_to(outside, 2);
    if (cv::countNonZero(inside) == 0) return as_mat(base) & ~near;
    return as_mat(segment_scribbles(base, picture, as_matte(inside), drop)).clone();
}

}  // namespace

bool is_empty(const Matte& matte) {
    return cv::countNonZero(as_mat(matte) > 127) == 0;
}

Matte found_by_scribbles(const Matte& before, ViewU8x3 picture, const Matte& keep,
                         const Matte& drop) {
    if (!is_empty(drop) && !is_empty(keep)) {
        const Matte nothing(before.size());
        const Matte first = segment_scribbles(nothing, picture, keep, nothing);
        if (ends_at_edges(first, picture)) return change_by_scribbles(first, picture, keep, drop);
    }
    return segment_scribbles(before, picture, keep, drop);
}

Matte change_by_scribbles(const Matte& base, ViewU8x3 picture, const Matte& keep,
                          const Matte& drop) {
    const cv::Mat before = as_mat(base), found = cut_with(base, picture, keep, drop);
    const cv::Mat was = before > 127, is = found > 127, disc = round_brush(kMatteEdge_px);
    cv::Mat added = touched_by(as_mat(keep) > 127, is & ~was);
    cv::Mat removed = touched_by(as_mat(drop) > 127, was & ~is);
    cv::dilate(added, added, disc);
    cv::dilate(removed, removed, disc);
    cv::Mat out = before.clone();
    cv::max(before, found & added, out);
    cv::min(out, found | ~removed, out);
    return as_matte(out);
}

}  // namespace weft
