#include "engine/mask/newcomers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/mask/motion_sides.h"
#include "engine/mask/motion_support.h"
#include "engine/mask/patch_difference.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/spread_motion.h"

namespace weft {
namespace {

constexpr float kClearlyOut_px = 2;  // outside, on the frame before
constexpr float kMixed_px = 2;       // motion at the boundary is mixed
constexpr int kRim_px = 2;           // beside the boundary
// Half of how wide newcomers are where they are doubted. Of rendered sleeves, coats and walls
// behind them, what was rightly taken in is at most 10 px deep when it is new, another sleeve 13
// to 36.
constexpr float kThick_px = 9;
constexpr float kEvidenceSpread_px = 10;  // of the evidence
constexpr float kNewcomerMemory = 0.9f;   // of it, from frame to frame
constexpr float kMostEvidence = 4;        // log odds of it
constexpr float kAccepted = 2;            // from which on a newcomer is none any more
constexpr float kWeight = 2;              // since colours speak against it; with 3 walls lose more
constexpr float kAgree = 0.3f;  // deviation of the surface's motion, of what it is told from
// Of the surface, to tell whether a part goes as a newcomer does.
constexpr float kPartEvery_px = 6, kPart = 0.1f, kPartTogether_px = 0.8f;

// Whether a pixel of the frame has no past that motion can tell, and lies where the surface has
// moved away from what surrounds it.
bool appears(const NewcomersInput& in, int x, int y) {
    if (!in.area.contains(x, y)) return false;
    const int u = x - in.area.x0, v = y - in.area.y0;
    if (in.appearing.row(v)[u] == 0 &&
        (in.flow.valid.row(y)[x] != 0 || in.expected_phi.row(v)[u] >= 0))
        return false;
    const float* o = in.outside_motion.pixel(u, v);
    return sample_bilinear(in.prev_phi, static_cast<float>(x) + o[0],
                           static_cast<float>(y) + o[1]) > 0;
}

Vec2 pixel_of(ViewF2 field, int x, int y) {
    const float* d = field.pixel(x, y);
    return {d[0], d[1]};
}

// Where a pixel was on the frame before.
Vec2 place_by_flow(const FlowField& flow, int x, int y) {
    return Vec2(x, y) + pixel_of(flow.d, x, y);
}

bool can_be_sampled(Vec2 p, Size size) {
    return p.x >= 0 && p.y >= 0 && p.x <= static_cast<float>(size.width - 1) &&
           p.y <= static_cast<float>(size.height - 1);
}

// Motions of some of the pixels that have a weight.
std::vector<Vec2> some_motions(ViewF2 motion, ViewF1 weight, float unit_px) {
    const int step = std::max(2, static_cast<int>(std::lround(kPartEvery_px * unit_px)));
    std::vector<Vec2> out;
    for (int y = 0; y < weight.height(); y += step) {
        for (int x = 0; x < weight.width(); x += step)
            if (weight.row(y)[x] > 0) out.push_back(pixel_of(motion, x, y));
    }
    return out;
}

// Whether a part of the surface goes as a newcomer does, though another is nearer.
bool any_part_goes(const std::vector<Vec2>& surface, Vec2 motion, float within) {
    const auto close = std::count_if(surface.begin(), surface.end(), [&](Vec2 of_surface) {
        return glm::length(of_surface - motion) < within;
    });
    return static_cast<float>(close) > kPart * static_cast<float>(surface.size());
}

// The squares of a motion's lengths, and 1.
ImageF2 squared_lengths(ViewF2 motion) {
    ImageF2 out(motion.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float* d = motion.pixel(x, y);
            out.pixel(x, y)[0] = d[0] * d[0] + d[1] * d[1];
            out.pixel(x, y)[1] = 1;
        }
    }
    return out;
}

}  // namespace

void Newcomers::carry(const NewcomersInput& in) {
    const Size size = in.flow.size();
    Matte entered(size), doubted(size);
    ImageF1 odds(size);
    parallel_rows(size.height, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const Vec2 p = place_by_flow(in.flow, x, y);
                const bool was_out =
                    can_be_sampled(p, size) &&
                    sample_bilinear(in.prev_phi, p.x, p.y) < -kClearlyOut_px * in.unit_px;
                const bool has_none = appears(in, x, y);
                if (was_out) entered.at(x, y) = 255;
                if (was_out || has_none) doubted.at(x, y) = 255;
                if (entered_.empty()) continue;
                const int fx = std::clamp(static_cast<int>(std::lround(p.x)), 0, size.width - 1);
                const int fy = std::clamp(static_cast<int>(std::lround(p.y)), 0, size.height - 1);
                if (!was_out) entered.at(x, y) = entered_.at(fx, fy);
                if (was_out || has_none) continue;
                doubted.at(x, y) = doubted_.at(fx, fy);
                odds.at(x, y) = odds_.at(fx, fy);
            }
        }
    });
    entered_ = std::move(entered);
    doubted_ = std::move(doubted);
    odds_ = std::move(odds);
}

// 1 where the surface that was there from the first has valid motion.
ImageF1 Newcomers::trusted(const NewcomersInput& in) const {
    ImageF1 out(in.area.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const int fx = in.area.x0 + x, fy = in.area.y0 + y;
                if (in.flow.valid.row(fy)[fx] == 0 || doubted_.at(fx, fy) != 0) continue;
                const Vec2 p = place_by_flow(in.flow, fx, fy);
                const float was = sample_bilinear(in.prev_phi, p.x, p.y);
                out.at(x, y) = was > kMixed_px * in.unit_px ? 1.0f : 0.0f;
            }
        }
    });
    return out;
}

void Newcomers::judge(const NewcomersInput& in, const Matte& thick) {
    const ViewF2 motion = in.flow.d.view().crop(in.area);
    const ImageF1 weight = trusted(in);
    const ImageF2 surface = spread_motion(motion, weight, Vec2(0), in.unit_px);
    const std::vector<Vec2> all = some_motions(motion, weight, in.unit_px);
    const ImageF2 squares = spread_motion(squared_lengths(motion), weight, Vec2(0), in.unit_px);
    parallel_rows(in.area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < in.area.width(); ++x) {
                const int fx = in.area.x0 + x, fy = in.area.y0 + y;
                if (thick.at(x, y) == 0 || doubted_.at(fx, fy) == 0) continue;
                if (in.flow.valid.row(fy)[fx] == 0) continue;
                // What comes only now, and where a patch shows both sides.
                const Vec2 p = place_by_flow(in.flow, fx, fy);
                if (sample_bilinear(in.prev_phi, p.x, p.y) <= kPatchRadius + 1) continue;
                const Vec2 moved = pixel_of(motion, x, y), of_surface = pixel_of(surface, x, y);
                // Nothing of the surface is near, or its motion there is not one.
                const Vec2 square = pixel_of(squares, x, y);
                const float deviation2 = square.x - glm::dot(of_surface, of_surface);
                const Vec2 apart = moved - of_surface;
                if (square.y < 0.5f || deviation2 > kAgree * kAgree * glm::dot(apart, apart))
                    continue;
                float now =
                    side_of(moved, of_surface, pixel_of(in.outside_motion, x, y), in.unit_px);
                if (now < 0 && any_part_goes(all, moved, kPartTogether_px * in.unit_px)) continue;
                if (now < 0)
                    now *= speaks_against({in.frame, in.prev_frame, in.area}, {fx, fy}, of_surface,
                                          moved);
                float& sum = odds_.at(fx, fy);
                sum = std::clamp(kNewcomerMemory * sum + now, -kMostEvidence, kMostEvidence);
                if (sum > kAccepted) doubted_.at(fx, fy) = 0;
            }
        }
    });
}

// Where newcomers make up something thick, and beside it: what a surface that turns shows of itself
// is a strip at its edge, and so is what motion that is found a little off makes doubtful. Empty if
// they do nowhere.
Matte Newcomers::thick_parts(const NewcomersInput& in) const {
    const int w = in.area.width(), h = in.area.height();
    cv::Mat inside(h, w, CV_8U), depth;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const int fx = in.area.x0 + x, fy = in.area.y0 + y;
            const Vec2 p = place_by_flow(in.flow, fx, fy);
            const bool is = doubted_.at(fx, fy) != 0 && sample_bilinear(in.prev_phi, p.x, p.y) > 0;
            inside.at<std::uint8_t>(y, x) = is ? 255 : 0;
        }
    }
    cv::distanceTransform(inside, depth, cv::DIST_L2, cv::DIST_MASK_5);
    const float thick_px = kThick_px * in.unit_px;
    const cv::Mat around = depth <= thick_px;
    if (cv::countNonZero(around) == w * h) return {};
    cv::Mat far;
    cv::distanceTransform(around, far, cv::DIST_L2, cv::DIST_MASK_5);
    Matte out(in.area.size());
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x)
            out.at(x, y) =
                far.at<float>(y, x) <= thick_px + kEvidenceSpread_px * in.unit_px ? 255 : 0;
    }
    return out;
}

// What has just come is as doubtful as what came there before.
ImageF1 Newcomers::spread(const NewcomersInput& in, const Matte& thick) const {
    const int w = in.area.width(), h = in.area.height();
    cv::Mat known(h, w, CV_32FC2, cv::Scalar::all(0));
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const int fx = in.area.x0 + x, fy = in.area.y0 + y;
            if (thick.at(x, y) == 0 || doubted_.at(fx, fy) == 0 || odds_.at(fx, fy) == 0) continue;
            known.at<cv::Vec2f>(y, x) = {1, odds_.at(fx, fy)};
        }
    }
    const int r = std::max(1, static_cast<int>(std::lround(kEvidenceSpread_px * in.unit_px)));
    cv::boxFilter(known, known, CV_32F, cv::Size(2 * r + 1, 2 * r + 1), cv::Point(-1, -1), true,
                  cv::BORDER_CONSTANT);
    ImageF1 out(in.area.size());
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const auto& sum = known.at<cv::Vec2f>(y, x);
            if (thick.at(x, y) == 0 || doubted_.at(in.area.x0 + x, in.area.y0 + y) == 0) continue;
            if (sum[0] > 0) out.at(x, y) = std::min(0.0f, kWeight * sum[1] / sum[0]);
        }
    }
    return out;
}

ImageF1 Newcomers::advance(const NewcomersInput& in) {
    carry(in);
    const Matte thick = thick_parts(in);
    if (thick.empty()) return ImageF1(in.area.size());
    judge(in, thick);
    return spread(in, thick);
}

// Beside doubtful newcomers the outside is theirs: what the boundary takes in there next.
void Newcomers::settle(ViewF1 phi) {
    parallel_rows(phi.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < phi.width(); ++x)
                if (phi.row(y)[x] <= 0) entered_.at(x, y) = doubted_.at(x, y) = 0;
        }
    });
    cv::Mat inside(phi.height(), phi.width(), CV_8U, doubted_.data(),
                   static_cast<std::size_t>(doubted_.stride()));
    cv::Mat beside;
    cv::dilate(inside, beside, cv::Mat(), cv::Point(-1, -1), kRim_px);
    parallel_rows(phi.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < phi.width(); ++x)
                if (phi.row(y)[x] <= 0) doubted_.at(x, y) = beside.at<std::uint8_t>(y, x);
        }
    });
}

void Newcomers::forget(ViewU8x1 where) {
    for (int y = 0; y < entered_.height(); ++y) {
        for (int x = 0; x < entered_.width(); ++x) {
            if (where.row(y)[x] == 0) continue;
            entered_.at(x, y) = doubted_.at(x, y) = 0;
            odds_.at(x, y) = 0;
        }
    }
}

void add_newcomers(const ImageF1& odds, ImageF1& near, ImageF1& wide) {
    constexpr float kDoubtful = -1;
    parallel_rows(odds.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < odds.width(); ++x) {
                near.at(x, y) += odds.at(x, y);
                wide.at(x, y) += std::min(0.0f, odds.at(x, y) - kDoubtful);
            }
        }
    });
}

}  // namespace weft
