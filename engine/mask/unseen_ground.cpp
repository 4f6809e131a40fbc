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

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/mask/hidden_part.h"
#include "engine/mask/matte_box.h"
#include "engine/mask/motion_support.h"
#include "engine/mask/nearer_side.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/scene_pieces.h"

namespace weft {
namespace {

constexpr std::uint8_t kKnown = 255;
constexpr std::uint8_t kRipe = 4, kMostWaited = 12;  // frames
constexpr int kAcross_px = 2;                        // from an edge
constexpr int kSure = 2;       // times as fast where the surface itself is seen again
constexpr float kWith_px = 1;  // of the surface's motion, per frame

// What is plain goes along with anything, as what was just uncovered does, whose own motion nobody
// knows yet.
bool goes_along(const GroundStep& step, int x, int y) {
    constexpr float kDoubt = 0.5f;
    if (!step.area.contains(x, y)) return false;
    const float* d = step.flow.d.pixel(x, y);
    const float* s = step.surface_motion.pixel(x - step.area.x0, y - step.area.y0);
    const Vec2 own(d[0], d[1]), surface(s[0], s[1]);
    if (glm::length(own - surface) < kWith_px * step.unit_px) return true;
    const FramePair pair{step.frame, step.prev_frame, rect_of(step.frame.size())};
    return speaks_against(pair, {x, y}, surface, own) < kDoubt;
}

// The colours' log odds, summed over the surroundings that are not known either: a sheet's fold
// or stripe alone may be anybody's.
cv::Mat odds_around(const GroundStep& step, const Matte& known, const ImageF1& own,
                    const SurfacePalette& palette) {
    constexpr float kReach_px = 4;
    cv::Mat sums(known.height(), known.width(), CV_32F, cv::Scalar::all(0));
    parallel_rows(known.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            auto* sum = sums.ptr<float>(y);
            for (int x = 0; x < known.width(); ++x) {
                if (step.phi.row(y)[x] > 0 || known.at(x, y) != 0) continue;
                sum[x] = std::max(palette.odds(step.frame.pixel(x, y)), own.at(x, y));
            }
        }
    });
    const int side = 2 * static_cast<int>(std::lround(kReach_px * step.unit_px)) + 1;
    cv::boxFilter(sums, sums, -1, {side, side}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return sums;
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
    const float most = std::max(kLeast_levels, kTimes * median_of(own, 0.0f));
    std::vector<bool> has_edge;
    has_edge.reserve(across.size());
    for (std::vector<float>& steps : across)
        has_edge.push_back(median_of(steps, 0.0f) > most);
    for (int y = 0; y < pieces.height(); ++y) {
        for (int x = 0; x < pieces.width(); ++x)
            if (has_edge[static_cast<std::size_t>(labels.at<int>(y, x))]) pieces.at(x, y) = 0;
    }
}

std::ptrdiff_t pixels_of(const Matte& known) {
    return std::count(known.data(), known.data() + known.size_bytes(), kKnown);
}

bool any_in(const Matte& matte) {
    const std::uint8_t* codes = matte.data();
    return std::any_of(codes, codes + matte.size_bytes(), [](auto code) { return code != 0; });
}

}  // namespace

UnseenGround::UnseenGround(ViewU8x3 key_frame, ViewF1 key_phi)
    : known_(key_phi.size()), covered_(key_frame, key_phi), waited_(key_phi.size()) {
    for (int y = 0; y < known_.height(); ++y) {
        for (int x = 0; x < known_.width(); ++x)
            known_.at(x, y) = key_phi.row(y)[x] < 0 ? kKnown : 0;
    }
}

void UnseenGround::follow(const GroundStep& step, const SurfacePalette& palette) {
    covered_.advance(step);
    const Recti frame = rect_of(known_.size());
    Matte known(known_.size()), waited(known_.size());
    const auto was_seen = [&](Vec2i at, Vec2i from) {
        return step.parting.at(at.x, at.y) == 0 && frame.contains(from.x, from.y);
    };
    const auto source = [&](int x, int y) {
        const float* d = step.flow.d.pixel(x, y);
        return nearest_pixel({static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]});
    };
    parallel_rows(known.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < known.width(); ++x) {
                if (step.phi.row(y)[x] > 0) continue;
                const Vec2i from = source(x, y);
                if (was_seen({x, y}, from) && step.prev_phi.row(from.y)[from.x] <= 0)
                    known.at(x, y) = known_.at(from.x, from.y);
            }
        }
    });
    own_ = covered_.odds(step.frame);
    const cv::Mat odds = odds_around(step, known, own_, palette);
    parallel_rows(known.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < known.width(); ++x) {
                if (step.phi.row(y)[x] > 0 || known.at(x, y) != 0) continue;
                const bool likely = odds.at<float>(y, x) > 0;
                const bool goes = likely && goes_along(step, x, y);
                const bool sure =
                    likely && (goes || step.flow.valid.row(y)[x] == 0) && own_.at(x, y) > 0;
                const Vec2i from = sure ? covered_.place_before(x, y) : source(x, y);
                const bool seen = sure ? frame.contains(from.x, from.y) : was_seen({x, y}, from);
                const int so_far = seen ? waited_.at(from.x, from.y) : 0;
                const int more = sure ? kSure : goes ? 1 : -2;
                waited.at(x, y) =
                    static_cast<std::uint8_t>(std::clamp(so_far + more, 0, int{kMostWaited}));
            }
        }
    });
    // A black frame or a flash, after which nothing is followed, tells nothing.
    const bool broken = 2 * pixels_of(known) < pixels_of(known_);
    if (!broken) known_ = std::move(known);
    waited_ = broken ? Matte(known_.size()) : std::move(waited);
}

void UnseenGround::correct(ViewU8x1 wrong, ViewU8x1 inside) {
    covered_.correct(wrong, inside);
    for (int y = 0; y < wrong.height(); ++y) {
        for (int x = 0; x < wrong.width(); ++x) {
            if (wrong.row(y)[x] == 0) continue;
            known_.at(x, y) = inside.row(y)[x] != 0 ? 0 : kKnown;
            waited_.at(x, y) = 0;
        }
    }
}

// Of `ripe`, what is joined to the surface, and to what is known by now to be its own, more than to
// what is known to be outside.
Matte UnseenGround::joined(const GroundStep& step, Matte ripe, ViewU8x1 own) const {
    constexpr double kLeast_px = 60;
    if (!any_in(ripe)) return ripe;
    Matte beside(known_.size());
    for (int y = 0; y < ripe.height(); ++y) {
        for (int x = 0; x < ripe.width(); ++x) {
            const bool is_own = !own.empty() && own.row(y)[x] != 0;
            const Beside what = is_own || step.phi.row(y)[x] > 0 ? Beside::kSurface
                                : known_.at(x, y) != 0           ? Beside::kOther
                                                                 : Beside::kUnknown;
            beside.at(x, y) = static_cast<std::uint8_t>(what);
        }
    }
    keep_large(ripe, kLeast_px * static_cast<double>(step.unit_px * step.unit_px));
    if (any_in(ripe)) keep_joined(ripe, beside, std::numeric_limits<double>::infinity());
    return ripe;
}

Matte UnseenGround::advance(const GroundStep& step, const SurfacePalette& palette) {
    follow(step, palette);
    Matte own(known_.size()), like(known_.size());
    for (int y = 0; y < own.height(); ++y) {
        for (int x = 0; x < own.width(); ++x) {
            if (waited_.at(x, y) < kRipe) continue;
            (own_.at(x, y) > 0 ? own : like).at(x, y) = 255;
        }
    }
    own = joined(step, std::move(own), {});
    like = joined(step, std::move(like), own);
    drop_nearer_outside({step.frame, step.phi, known_, step.unit_px}, like);
    if (any_in(like)) keep_continuing(step, like);
    Matte added = either_of(own, like);
    return any_in(added) ? std::move(added) : Matte();
}

}  // namespace weft
