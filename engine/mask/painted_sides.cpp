#include "engine/mask/painted_sides.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <vector>

#include "engine/motion/optical_flow.h"
#include "engine/motion/plane_fit.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr int kEdge_levels = 14;   // across three pixels; stripes of a wallpaper have 10
constexpr float kLeastPiece = 90;  // px of 854×480
constexpr double kOnePlane = 0.7;  // of the surface's motion; beside what moves it is mixed
constexpr float kOnPlane_px = 1, kOffPlane_px = 2.5f;
constexpr double kMostOut = 0.1, kMostIn = 0.05;  // of the matte

// Where everything of the painted frame goes, and how far that is from what its surface does.
struct PlaneStep {
    cv::Mat off;      // CV_32F: px off the plane's motion; −1: not known
    cv::Mat misses;   // CV_32F: what the plane leads to looks different by, codes
    float usual = 0;  // miss inside
};

float middle(std::vector<float>& values) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

cv::Mat inside_mask(ViewU8x1 key) {
    return as_mat(key) > 127;
}

// The plane's motion from the painted frame to the next one; empty if it is none.
std::optional<glm::dmat3> plane_of(const PaintedInput& in, const cv::Mat& inside) {
    constexpr int kStride = 4, kClear = 5;
    constexpr std::size_t kFewest = 200;
    cv::Mat core;
    cv::erode(inside, core, cv::Mat::ones(kClear, kClear, CV_8U));
    std::vector<PlacePair> pairs;
    for (int y = 0; y < core.rows; y += kStride) {
        for (int x = 0; x < core.cols; x += kStride) {
            if (in.frame_from_next.valid.at(x, y) == 0) continue;
            const float* d = in.frame_from_next.d.pixel(x, y);
            const Vec2 next(x, y), here = next + Vec2(d[0], d[1]);
            const Vec2i at(glm::round(here));
            if (at.x < 0 || at.y < 0 || at.x >= core.cols || at.y >= core.rows ||
                core.at<std::uint8_t>(at.y, at.x) == 0)
                continue;
            pairs.push_back({here, next});
        }
    }
    if (pairs.size() < kFewest) return std::nullopt;
    const glm::dmat3 plane = fit_plane(pairs, {.from_median = true});
    const auto on = std::count_if(pairs.begin(), pairs.end(), [&](const PlacePair& pair) {
        return glm::length(mapped(plane, pair.from) - pair.to) < kOnPlane_px * in.unit_px;
    });
    if (static_cast<double>(on) < kOnePlane * static_cast<double>(pairs.size()))
        return std::nullopt;
    return plane;
}

PlaneStep step_of(const PaintedInput& in, const glm::dmat3& plane, const cv::Mat& inside) {
    const FlowField next_from_frame = invert_flow(in.frame_from_next);
    PlaneStep out;
    out.off = cv::Mat(inside.size(), CV_32F, cv::Scalar(-1));
    cv::Mat places(inside.size(), CV_32FC2), led;
    for (int y = 0; y < inside.rows; ++y) {
        for (int x = 0; x < inside.cols; ++x) {
            const Vec2 p(x, y), to = mapped(plane, p);
            places.at<cv::Vec2f>(y, x) = {to.x, to.y};
            if (next_from_frame.valid.at(x, y) == 0) continue;
            const float* d = next_from_frame.d.pixel(x, y);
            out.off.at<float>(y, x) = glm::length(p + Vec2(d[0], d[1]) - to);
        }
    }
    cv::remap(as_mat(in.next), led, places, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::absdiff(led, as_mat(in.frame), led);
    led.convertTo(led, CV_32F);
    cv::transform(led, out.misses, cv::Matx13f(1.0f / 3, 1.0f / 3, 1.0f / 3));
    cv::blur(out.misses, out.misses, {3, 3});
    std::vector<float> misses;
    for (int y = 0; y < inside.rows; y += 2)
        for (int x = 0; x < inside.cols; x += 2)
            if (inside.at<std::uint8_t>(y, x) != 0) misses.push_back(out.misses.at<float>(y, x));
    out.usual = middle(misses);
    return out;
}

// 255 where the picture has no edge.
cv::Mat plain_of(ViewU8x3 frame) {
    cv::Mat smooth, steepest(frame.height(), frame.width(), CV_8U, cv::Scalar(0));
    cv::GaussianBlur(as_mat(frame), smooth, {3, 3}, 0);
    const cv::Mat across(cv::Matx13f(-1, 0, 1)), down(cv::Matx31f(-1, 0, 1));
    for (const cv::Mat* along : {&across, &down}) {
        cv::Mat slope;
        cv::filter2D(smooth, slope, CV_32F, *along);
        std::vector<cv::Mat> channels;
        cv::split(slope, channels);
        for (const cv::Mat& channel : channels)
            steepest |= cv::abs(channel) > kEdge_levels;
    }
    return ~steepest;
}

cv::Mat grown(const cv::Mat& mask, int side) {
    cv::Mat out;
    cv::dilate(mask, out, cv::Mat::ones(side, side, CV_8U));
    return out;
}

// A coarse colour.
std::size_t cell_of(const std::uint8_t* c) {
    return static_cast<std::size_t>(c[0] >> 4) * 256 + static_cast<std::size_t>(c[1] >> 4) * 16 +
           static_cast<std::size_t>(c[2] >> 4);
}
using Colors = std::vector<double>;  // pixels of each cell

Colors colors_of(ViewU8x3 frame, const cv::Mat& mask) {
    Colors out(4096);
    for (int y = 0; y < mask.rows; ++y)
        for (int x = 0; x < mask.cols; ++x)
            if (mask.at<std::uint8_t>(y, x) != 0) out[cell_of(frame.pixel(x, y))] += 1;
    return out;
}

// Pieces of one side of the boundary.
class Pieces {
  public:
    Pieces(const PaintedInput& in, const cv::Mat& inside, const PlaneStep& step)
        : in_(in), inside_(inside), step_(step), plain_(plain_of(in.frame)) {
        area_ = cv::countNonZero(inside);
        colors_ = colors_of(in.frame, inside);
        cv::Mat stats, centres;
        const int count =
            cv::connectedComponentsWithStats(inside & plain_, labels_, stats, centres, 4, CV_32S);
        for (int k = 0; k < count; ++k)
            sizes_.push_back(k == 0 ? 0 : stats.at<int>(k, cv::CC_STAT_AREA));
    }

    // The pieces of `side` that `wrong` holds for, with their rims of `rim` pixels; a piece has no
    // more than a share of the matte.
    template <class Wrong>
    cv::Mat found(const cv::Mat& side, double most, int rim, Wrong&& wrong) const {
        cv::Mat labels, stats, centres, out(side.size(), CV_8U, cv::Scalar(0));
        const int count =
            cv::connectedComponentsWithStats(side & plain_, labels, stats, centres, 4, CV_32S);
        for (int k = 1; k < count; ++k) {
            const int px = stats.at<int>(k, cv::CC_STAT_AREA);
            if (static_cast<float>(px) < kLeastPiece * in_.unit_px * in_.unit_px ||
                px > most * area_)
                continue;
            // With what lies around it.
            const int reach = around_px() + 2;
            const cv::Rect box = cv::Rect(stats.at<int>(k, cv::CC_STAT_LEFT) - reach,
                                          stats.at<int>(k, cv::CC_STAT_TOP) - reach,
                                          stats.at<int>(k, cv::CC_STAT_WIDTH) + 2 * reach,
                                          stats.at<int>(k, cv::CC_STAT_HEIGHT) + 2 * reach) &
                                 cv::Rect({}, side.size());
            const cv::Mat piece = labels(box) == k;
            if (!is_thick(piece) || !wrong(piece, box)) continue;
            cv::Mat target = out(box);
            target |= grown(piece, rim);
        }
        return out & side;
    }

    // Moves otherwise than the surface and has none of its colours.
    [[nodiscard]] bool passes_in_front(const cv::Mat& piece, const cv::Rect& box) const {
        constexpr float kDifferent = 3;  // times the usual miss
        constexpr double kUnlike = 0.6, kKnown = 0.4;
        std::vector<float> off, misses;
        for (int y = 0; y < piece.rows; ++y) {
            for (int x = 0; x < piece.cols; ++x) {
                if (piece.at<std::uint8_t>(y, x) == 0) continue;
                misses.push_back(step_.misses(box).at<float>(y, x));
                const float px = step_.off(box).at<float>(y, x);
                if (px >= 0) off.push_back(px);
            }
        }
        if (static_cast<double>(off.size()) < kKnown * static_cast<double>(misses.size()) ||
            middle(off) < kOffPlane_px * in_.unit_px || middle(misses) < kDifferent * step_.usual)
            return false;
        return unlike(piece, box, true) > kUnlike;
    }

    // Goes on from the surface, stays on its plane, and lies between it and what moves.
    [[nodiscard]] bool is_surface(const cv::Mat& piece, const cv::Rect& box) const {
        constexpr double kStays = 0.6, kMoves = 0.6, kUnlike = 0.2;
        constexpr int kBeside = 7;
        if (!goes_on(piece, box) || unlike(piece, box, false) > kUnlike) return false;
        const cv::Mat stays = piece & (step_.misses(box) < 3 * step_.usual + 1);
        if (cv::countNonZero(stays) < kStays * cv::countNonZero(piece)) return false;
        const cv::Mat around = grown(piece, 2 * around_px() + 1) & ~grown(piece, kBeside) &
                               ~inside_(box) & (step_.off(box) >= 0);
        const int known = cv::countNonZero(around);
        return known > 0 &&
               cv::countNonZero(around & (step_.off(box) > 1.5 * kOnPlane_px * in_.unit_px)) >
                   kMoves * known;
    }

  private:
    // Whether it is the smaller part of something plain that the painted boundary cuts: a smooth
    // thing beside bricks is none of them.
    [[nodiscard]] bool goes_on(const cv::Mat& piece, const cv::Rect& box) const {
        constexpr int kContact_px = 8;
        const cv::Mat beyond = inside_(box) & plain_(box);
        if (cv::countNonZero(piece & grown(beyond, 3)) < kContact_px * in_.unit_px) return false;
        const cv::Mat touched = beyond & grown(piece, 3);
        std::set<int> parts;
        for (int y = 0; y < touched.rows; ++y)
            for (int x = 0; x < touched.cols; ++x)
                if (touched.at<std::uint8_t>(y, x) != 0) parts.insert(labels_(box).at<int>(y, x));
        int px = 0;
        for (const int part : parts)
            px += sizes_[static_cast<std::size_t>(part)];
        return px > cv::countNonZero(piece);
    }
    // The share of its pixels whose colours are rare in the inside; `of_it`: it is a part of that.
    [[nodiscard]] double unlike(const cv::Mat& piece, const cv::Rect& box, bool of_it) const {
        constexpr double kRare = 0.15;
        const Colors own = colors_of(in_.frame.crop({box.x, box.y, box.br().x, box.br().y}), piece);
        const double all = cv::countNonZero(piece), others = of_it ? area_ - all : area_;
        double rare = 0;
        for (std::size_t cell = 0; cell < own.size(); ++cell) {
            const double elsewhere = colors_[cell] - (of_it ? own[cell] : 0);
            if (elsewhere / std::max(1.0, others) < kRare * own[cell] / all) rare += own[cell];
        }
        return rare / all;
    }
    // How far what lies around a piece is looked at.
    [[nodiscard]] int around_px() const {
        return std::max(6, static_cast<int>(std::lround(12 * in_.unit_px)));
    }
    // A strip is the mixture of two sides.
    static bool is_thick(const cv::Mat& piece) {
        cv::Mat core;
        cv::erode(piece, core, cv::Mat::ones(5, 5, CV_8U));
        return cv::countNonZero(core) > 0;
    }

    const PaintedInput& in_;
    const cv::Mat& inside_;
    const PlaneStep& step_;
    cv::Mat plain_;
    cv::Mat labels_;          // of the inside's pieces
    std::vector<int> sizes_;  // px
    Colors colors_;
    double area_ = 0;
};

}  // namespace

Matte painted_sides(const PaintedInput& in) {
    const cv::Mat inside = inside_mask(in.key);
    const auto plane = plane_of(in, inside);
    if (!plane) return {};
    const PlaneStep step = step_of(in, *plane, inside);
    const Pieces pieces(in, inside, step);
    constexpr int kRimOut = 5, kRimIn = 3;
    const cv::Mat out =
        pieces.found(inside, kMostOut, kRimOut, [&](const cv::Mat& piece, const cv::Rect& box) {
            return pieces.passes_in_front(piece, box);
        });
    const cv::Mat joins = pieces.found(
        ~inside, kMostIn, kRimIn,
        [&](const cv::Mat& piece, const cv::Rect& box) { return pieces.is_surface(piece, box); });
    if (cv::countNonZero(out) + cv::countNonZero(joins) == 0) return {};
    Matte corrected(in.key.size());
    for (int y = 0; y < corrected.height(); ++y) {
        for (int x = 0; x < corrected.width(); ++x) {
            const bool goes = out.at<std::uint8_t>(y, x) != 0,
                       joined = joins.at<std::uint8_t>(y, x) != 0;
            corrected.at(x, y) = goes ? 0 : joined ? 255 : in.key.row(y)[x];
        }
    }
    return corrected;
}

}  // namespace weft
