#include "engine/mask/uncovered.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

// Where the pixel of a field's pixel (x, y) was, on the frame before.
Vec2 place_before(ViewF2 motion, const Recti& area, int x, int y) {
    const float* d = motion.pixel(x, y);
    return {static_cast<float>(area.x0 + x) + d[0], static_cast<float>(area.y0 + y) + d[1]};
}

bool lies_in(Vec2i p, Size size) {
    return p.x >= 0 && p.y >= 0 && p.x < size.width && p.y < size.height;
}

// How many pixels of this frame come from each place of the one before.
cv::Mat count_origins(ViewF2 flow) {
    cv::Mat count(flow.height(), flow.width(), CV_32F, cv::Scalar(0));
    for (int y = 0; y < flow.height(); ++y) {
        for (int x = 0; x < flow.width(); ++x) {
            const Vec2i from = nearest_pixel(place_before(flow, rect_of(flow.size()), x, y));
            if (lies_in(from, flow.size())) count.at<float>(from.y, from.x) += 1;
        }
    }
    return count;
}

}  // namespace

Matte parting_pixels(const FlowField& flow, const Recti& area) {
    constexpr float kShared = 1.3f;  // pixels that come from one
    constexpr int kMeanSide = 3, kMajority = 5;
    const Size full = flow.d.size();
    cv::Mat origins, shared(area.height(), area.width(), CV_32F, cv::Scalar(1));
    cv::blur(count_origins(flow.d), origins, cv::Size(kMeanSide, kMeanSide));
    const ViewF2 motion = flow.d.view().crop(area);
    parallel_rows(area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < area.width(); ++x) {
                const Vec2i from = nearest_pixel(place_before(motion, area, x, y));
                if (lies_in(from, full)) shared.at<float>(y, x) = origins.at<float>(from.y, from.x);
            }
        }
    });
    cv::blur(shared, shared, cv::Size(kMeanSide, kMeanSide));
    cv::Mat parting(area.height(), area.width(), CV_8U);
    for (int y = 0; y < area.height(); ++y) {
        const std::uint8_t* valid = flow.valid.row(area.y0 + y) + area.x0;
        for (int x = 0; x < area.width(); ++x) {
            const bool parts = valid[x] == 0 && shared.at<float>(y, x) > kShared;
            parting.at<std::uint8_t>(y, x) = parts ? 255 : 0;
        }
    }
    Matte out(area.size());
    cv::Mat smooth(area.height(), area.width(), CV_8U, out.data());
    cv::medianBlur(parting, smooth, kMajority);
    return out;
}

namespace {

// What surrounds the surface is not just one thing: its motion leads near to where it was, not
// there. What leads far outside is the surface itself, which has swung out.
Matte appearing_pixels(const UncoveredInput& in) {
    constexpr float kNearBands = 0.6f;
    const Matte parting = parting_pixels(in.flow, in.area);
    Matte out(in.area.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (parting.at(x, y) == 0) continue;
                const Vec2 surface = place_before(in.surface_motion, in.area, x, y);
                const Vec2 around = place_before(in.outside_motion, in.area, x, y);
                const Vec2i nearest = nearest_pixel(surface);
                // What comes into the frame, or from behind something that is known to be in front.
                if (!lies_in(nearest, in.prev_phi.size())) continue;
                if (in.prev_seen.row(nearest.y)[nearest.x] == 0) continue;
                if (sample_bilinear(in.prev_phi, around.x, around.y) > -kNearBands * in.band_px)
                    out.at(x, y) = 255;
            }
        }
    });
    return out;
}

// Of `pixels`, those that are joined to what is `outside`.
Matte joined_to(const Matte& outside, const Matte& pixels) {
    Matte joined(pixels.size());
    std::vector<Vec2i> open;
    const auto visit = [&](Vec2i from) {
        for (const Vec2i step : {Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)}) {
            const Vec2i to = from + step;
            if (!lies_in(to, pixels.size())) continue;
            if (pixels.at(to.x, to.y) == 0 || joined.at(to.x, to.y) != 0) continue;
            joined.at(to.x, to.y) = 255;
            open.push_back(to);
        }
    };
    for (int y = 0; y < pixels.height(); ++y) {
        for (int x = 0; x < pixels.width(); ++x)
            if (outside.at(x, y) != 0) visit({x, y});
    }
    while (!open.empty()) {
        const Vec2i p = open.back();
        open.pop_back();
        visit(p);
    }
    return joined;
}

std::int64_t count_of(const Matte& pixels) {
    std::int64_t n = 0;
    for (int y = 0; y < pixels.height(); ++y) {
        const std::uint8_t* row = pixels.row(y);
        n += std::count_if(row, row + pixels.width(), [](std::uint8_t m) { return m != 0; });
    }
    return n;
}

}  // namespace

UncoveredParts Uncovered::advance(const UncoveredInput& in) {
    constexpr float kFollow = 0.3f;  // weight of a frame against those before
    // Of rendered sleeves and torsos 0.1 to 1.6 % look so without being joined to the outside (0.5
    // % in the middle of them), of a film's dancer, striped walls and cars 3 to 11 %.
    constexpr float kReachBands =
        0.2f;  // of what lies outside, so that a slight leak does not cut it off
    constexpr float kOften = 0.01f, kOftenNow = 0.02f;
    UncoveredParts out{appearing_pixels(in), Matte(in.area.size())};
    Matte outside(in.area.size()), candidates(in.area.size());
    std::int64_t inside = 0;
    for (int y = 0; y < outside.height(); ++y) {
        for (int x = 0; x < outside.width(); ++x) {
            const Vec2 was = place_before(in.surface_motion, in.area, x, y);
            const float phi = sample_bilinear(in.prev_phi, was.x, was.y);
            if (phi <= kReachBands * in.band_px) outside.at(x, y) = 255;
            if (phi <= 0) continue;
            ++inside;
            candidates.at(x, y) = out.appearing.at(x, y);
        }
    }
    out.revealed = joined_to(outside, candidates);
    const auto alone = static_cast<float>(count_of(candidates) - count_of(out.revealed)) /
                       static_cast<float>(std::max<std::int64_t>(inside, 1));
    alone_ = alone_ < 0 ? alone : alone_ + kFollow * (alone - alone_);
    if (alone_ > kOften || alone > kOftenNow) return {Matte(in.area.size()), Matte(in.area.size())};
    return out;
}

void judge_uncovered(ViewU8x3 frame, const UncoveredParts& uncovered, const LocalColorField& colors,
                     const SurfacePalette& palette, ImageF1& near_odds, ImageF1& wide_odds) {
    constexpr float kSure = 2;  // log odds for inside; a pale cloth's colours are everywhere
    parallel_rows(frame.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < frame.width(); ++x) {
                if (uncovered.appearing.at(x, y) == 0) continue;
                const std::uint8_t* c = frame.pixel(x, y);
                const ColorProbability p = colors.at(x, y, Vec3(c[0], c[1], c[2]));
                const float known = p.confidence();
                const float undecided = known * (1 - std::abs(2 * p.inside - 1));
                const float odds = palette.odds(c);
                const float sure = odds > 0 ? std::max(0.0f, odds - kSure) : odds;
                near_odds.at(x, y) += (1 - known) * odds + undecided * sure;
                wide_odds.at(x, y) = std::min(wide_odds.at(x, y), 0.0f);
            }
        }
    });
}

}  // namespace weft
