#include "engine/mask/unseen_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/matte_box.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/scene_pieces.h"
#include "engine/mask/uncovered.h"

namespace weft {
namespace {

constexpr std::uint8_t kKnown = 255;
constexpr std::uint8_t kRipe = 6, kMostWaited = 12;  // frames
constexpr int kAcross_px = 2;                        // from an edge
constexpr float kWith_px = 1;                        // of the surface's motion, per frame

bool goes_along(const GroundStep& step, int x, int y) {
    if (!step.area.contains(x, y)) return false;
    const float* own = step.flow.d.pixel(x, y);
    const float* surface = step.surface_motion.pixel(x - step.area.x0, y - step.area.y0);
    return glm::length(Vec2(own[0] - surface[0], own[1] - surface[1])) < kWith_px * step.unit_px;
}

// Means of the frame's colours around each pixel of `box`, over those that are not 0 in `of`; their
// share in `share`.
cv::Mat means_around(ViewU8x3 frame, const cv::Mat& of, const Recti& box, int side,
                     cv::Mat& share) {
    cv::Mat sums(box.height(), box.width(), CV_32FC3, cv::Scalar::all(0));
    share = cv::Mat(sums.size(), CV_32F, cv::Scalar(0));
    for (int y = 0; y < sums.rows; ++y) {
        for (int x = 0; x < sums.cols; ++x) {
            if (of.at<std::uint8_t>(y, x) == 0) continue;
            const std::uint8_t* code = frame.pixel(box.x0 + x, box.y0 + y);
            sums.at<cv::Vec3f>(y, x) = {float(code[0]), float(code[1]), float(code[2])};
            share.at<float>(y, x) = 1;
        }
    }
    cv::blur(sums, sums, {side, side}, {-1, -1}, cv::BORDER_CONSTANT);
    cv::blur(share, share, {side, side}, {-1, -1}, cv::BORDER_CONSTANT);
    for (int y = 0; y < sums.rows; ++y) {
        for (int x = 0; x < sums.cols; ++x)
            sums.at<cv::Vec3f>(y, x) *= 1 / std::max(share.at<float>(y, x), 1e-6f);
    }
    return sums;
}

// Of what is ripe only that stays whose surroundings are coloured rather like the surface beside it
// than like what is known to be outside beside it.
void keep_nearer(const GroundStep& step, const Matte& known, Matte& ripe) {
    constexpr float kAround_px = 25, kOwn_px = 4, kFewest = 0.01f;
    const int reach = static_cast<int>(std::lround(kAround_px * step.unit_px));
    const Recti box = matte_box(ripe, 0).grown(reach).intersected(rect_of(ripe.size()));
    cv::Mat inside(box.height(), box.width(), CV_8U), outside(inside.size(), CV_8U);
    const cv::Mat all(inside.size(), CV_8U, cv::Scalar(255));
    for (int y = 0; y < inside.rows; ++y) {
        for (int x = 0; x < inside.cols; ++x) {
            inside.at<std::uint8_t>(y, x) = step.phi.row(box.y0 + y)[box.x0 + x] > 1 ? 255 : 0;
            outside.at<std::uint8_t>(y, x) = known.at(box.x0 + x, box.y0 + y);
        }
    }
    cv::Mat surface_share, other_share, own_share;
    const int side = 2 * reach + 1;
    const int own_side = 2 * static_cast<int>(std::lround(kOwn_px * step.unit_px)) + 1;
    const cv::Mat surface = means_around(step.frame, inside, box, side, surface_share);
    const cv::Mat other = means_around(step.frame, outside, box, side, other_share);
    const cv::Mat own = means_around(step.frame, all, box, own_side, own_share);
    for (int y = 0; y < inside.rows; ++y) {
        for (int x = 0; x < inside.cols; ++x) {
            std::uint8_t& code = ripe.at(box.x0 + x, box.y0 + y);
            if (code == 0 || other_share.at<float>(y, x) < kFewest) continue;
            const cv::Vec3f& color = own.at<cv::Vec3f>(y, x);
            if (surface_share.at<float>(y, x) < kFewest ||
                cv::norm(color - surface.at<cv::Vec3f>(y, x)) >
                    cv::norm(color - other.at<cv::Vec3f>(y, x)))
                code = 0;
        }
    }
}

float median(std::vector<float>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The step of the picture across the pixel, code values; none at the border.
std::optional<float> step_across(ViewU8x3 frame, Vec2i at, Vec2i way) {
    const Vec2i a = at - kAcross_px * way, b = at + 2 * kAcross_px * way;
    const Recti all = rect_of(frame.size());
    if (!all.contains(a.x, a.y) || !all.contains(b.x, b.y)) return {};
    const std::uint8_t *p = frame.pixel(a.x, a.y), *q = frame.pixel(b.x, b.y);
    return static_cast<float>(std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) +
                              std::abs(p[2] - q[2])) /
           3;
}

// Pieces go where the picture has an edge along the border of the surface: what continues a surface
// does so without a step that it does not have itself.
void keep_continuing(const GroundStep& step, Matte& pieces) {
    constexpr float kLeast_levels = 3, kTimes = 1.5f;
    constexpr std::array<Vec2i, 4> kWays{Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)};
    const cv::Mat view(pieces.height(), pieces.width(), CV_8U, pieces.data());
    cv::Mat labels;
    const int count = cv::connectedComponents(view, labels, 8, CV_32S);
    std::vector<std::vector<float>> across(static_cast<std::size_t>(count));
    std::vector<float> own;
    const Recti frame = rect_of(pieces.size());
    for (int y = 0; y < pieces.height(); ++y) {
        for (int x = 0; x < pieces.width(); ++x) {
            const auto label = static_cast<std::size_t>(labels.at<int>(y, x));
            const bool inside = step.phi.row(y)[x] > 3 * kAcross_px;
            if (label == 0 && !(inside && (x + 3 * y) % 8 == 0)) continue;
            for (const Vec2i way : kWays) {
                const Vec2i there = Vec2i(x, y) + kAcross_px * way;
                const bool meets =
                    frame.contains(there.x, there.y) && step.phi.row(there.y)[there.x] > 0;
                if (label != 0 && !meets) continue;
                if (const auto found = step_across(step.frame, {x, y}, way))
                    (label != 0 ? across[label] : own).push_back(*found);
            }
        }
    }
    const float most = std::max(kLeast_levels, kTimes * median(own));
    std::vector<bool> has_edge;
    has_edge.reserve(across.size());
    for (std::vector<float>& steps : across)
        has_edge.push_back(median(steps) > most);
    for (int y = 0; y < pieces.height(); ++y) {
        for (int x = 0; x < pieces.width(); ++x)
            if (has_edge[static_cast<std::size_t>(labels.at<int>(y, x))]) pieces.at(x, y) = 0;
    }
}

bool any_in(const Matte& matte) {
    const std::uint8_t* codes = matte.data();
    return std::any_of(codes, codes + matte.size_bytes(), [](auto code) { return code != 0; });
}

}  // namespace

UnseenGround::UnseenGround(ViewF1 key_phi) : known_(key_phi.size()), waited_(key_phi.size()) {
    for (int y = 0; y < known_.height(); ++y) {
        for (int x = 0; x < known_.width(); ++x)
            known_.at(x, y) = key_phi.row(y)[x] < 0 ? kKnown : 0;
    }
}

void UnseenGround::follow(const GroundStep& step, const SurfacePalette& palette) {
    const Recti frame = rect_of(known_.size());
    const Matte parting = parting_pixels(step.flow, frame);
    Matte known(known_.size()), waited(known_.size());
    parallel_rows(known.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < known.width(); ++x) {
                if (step.phi.row(y)[x] > 0) continue;
                const float* d = step.flow.d.pixel(x, y);
                const Vec2i from =
                    nearest_pixel({static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]});
                const bool was_seen = parting.at(x, y) == 0 && frame.contains(from.x, from.y);
                if (was_seen && step.prev_phi.row(from.y)[from.x] <= 0)
                    known.at(x, y) = known_.at(from.x, from.y);
                if (known.at(x, y) != 0) continue;
                const int so_far = was_seen ? waited_.at(from.x, from.y) : 0;
                const bool is_like =
                    goes_along(step, x, y) && palette.odds(step.frame.pixel(x, y)) > 0;
                waited.at(x, y) = static_cast<std::uint8_t>(
                    std::clamp(so_far + (is_like ? 1 : -2), 0, int{kMostWaited}));
            }
        }
    });
    known_ = std::move(known);
    waited_ = std::move(waited);
}

Matte UnseenGround::advance(const GroundStep& step, const SurfacePalette& palette) {
    constexpr double kLeast_px = 60;
    follow(step, palette);
    Matte ripe(known_.size()), beside(known_.size());
    for (int y = 0; y < ripe.height(); ++y) {
        for (int x = 0; x < ripe.width(); ++x) {
            ripe.at(x, y) = waited_.at(x, y) >= kRipe ? 255 : 0;
            const Beside what = step.phi.row(y)[x] > 0 ? Beside::kSurface
                                : known_.at(x, y) != 0 ? Beside::kOther
                                                       : Beside::kUnknown;
            beside.at(x, y) = static_cast<std::uint8_t>(what);
        }
    }
    keep_large(ripe, kLeast_px * static_cast<double>(step.unit_px * step.unit_px));
    if (!any_in(ripe)) return {};
    keep_nearer(step, known_, ripe);
    keep_joined(ripe, beside, std::numeric_limits<double>::infinity());
    keep_continuing(step, ripe);
    return any_in(ripe) ? std::move(ripe) : Matte();
}

}  // namespace weft
