#include "engine/mask/hidden_part.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/background_motion.h"
#include "engine/mask/piece_motion.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr float kMixedBands = 1.3f;  // beside an occluder's outline measured motion is mixed

template <class Visit>
void visit_hidden(const Matte& hidden, const Recti& area, Visit&& visit) {
    parallel_rows(area.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* h = hidden.row(area.y0 + y) + area.x0;
            for (int x = 0; x < area.width(); ++x)
                if (h[x] != 0) visit(x, y);
        }
    });
}

void grow(Matte& pixels, int by) {
    cv::Mat seen(pixels.height(), pixels.width(), CV_8U, pixels.data());
    cv::dilate(seen, seen, cv::Mat::ones(2 * by + 1, 2 * by + 1, CV_8U));
}

void set_motion(FlowField& flow, int x, int y, Vec2 d) {
    flow.d.at(x, y, 0) = d.x;
    flow.d.at(x, y, 1) = d.y;
}

// How much of a surface is seen, and how that moves.
struct Seen {
    int all = 0, hidden = 0;  // samples of the surface
    std::vector<PlacePair> motion;

    Seen(const FlowField& flow, const Matte& hidden_now, const Matte& mixed, const ImageF1& phi) {
        constexpr int kStep = 4;
        for (int y = kStep / 2; y < phi.height(); y += kStep) {
            for (int x = kStep / 2; x < phi.width(); x += kStep) {
                const Vec2 d(flow.d.at(x, y, 0), flow.d.at(x, y, 1));
                if (sample_bilinear(phi, static_cast<float>(x) + d.x,
                                    static_cast<float>(y) + d.y) <= 0)
                    continue;
                ++all;
                hidden += hidden_now.at(x, y) != 0 ? 1 : 0;
                if (mixed.at(x, y) == 0 && flow.valid.at(x, y) != 0)
                    motion.push_back(pair_at(flow, x, y));
            }
        }
    }
    [[nodiscard]] bool enough() const {
        constexpr std::size_t kLeast = 20;
        return 4 * (all - hidden) >= all && motion.size() >= kLeast;
    }
};

FlowField by_background(const FlowField& measured, const Matte& mixed, const ImageF1& prev_phi,
                        float band_px) {
    FlowField flow = measured;
    visit_hidden(mixed, rect_of(flow.size()), [&](int x, int y) { flow.valid.at(x, y) = 0; });
    const ImageF2 background = background_motion(prev_phi, flow, band_px);
    visit_hidden(mixed, rect_of(flow.size()), [&](int x, int y) {
        set_motion(flow, x, y, {background.at(x, y, 0), background.at(x, y, 1)});
        flow.valid.at(x, y) = 255;
    });
    return flow;
}

}  // namespace

Matte hidden_part(ViewU8x1 in_front) {
    constexpr std::uint8_t kCovered = 64;
    Matte hidden(in_front.size());
    bool any = false;
    for (int y = 0; y < in_front.height(); ++y) {
        for (int x = 0; x < in_front.width(); ++x) {
            const bool covered = in_front.row(y)[x] >= kCovered;
            hidden.at(x, y) = covered ? 255 : 0;
            any |= covered;
        }
    }
    if (!any) return {};
    grow(hidden, 1);
    return hidden;
}

Matte either_of(const Matte& a, const Matte& b) {
    Matte both(b.size());
    for (int y = 0; y < both.height(); ++y) {
        for (int x = 0; x < both.width(); ++x)
            both.at(x, y) = std::max(a.empty() ? std::uint8_t{0} : a.at(x, y), b.at(x, y));
    }
    return both;
}

ImageF1 seen_distance(const ImageF1& phi, const Matte& hidden) {
    ImageF1 seen = phi;
    visit_hidden(hidden, rect_of(phi.size()), [&](int x, int y) { seen.at(x, y) = 0; });
    return seen;
}

void keep_hidden(ImageF1& near_odds, ImageF1& wide_odds, const ImageF1& expected_phi,
                 const Matte& hidden, Vec2i origin) {
    // Above what a short boundary gains, which would shrink the shape from frame to frame.
    constexpr float kOddsPerPixel = 1;
    const Recti area{origin.x, origin.y, origin.x + near_odds.width(),
                     origin.y + near_odds.height()};
    visit_hidden(hidden, area, [&](int x, int y) {
        near_odds.at(x, y) = kOddsPerPixel * expected_phi.at(x, y);
        wide_odds.at(x, y) = 0;
    });
}

FlowField motion_behind(const FlowField& measured, const Matte& hidden, const ImageF1& prev_phi,
                        float band_px) {
    Matte mixed = hidden;
    grow(mixed, static_cast<int>(std::lround(kMixedBands * band_px)));
    const Seen seen(measured, hidden, mixed, prev_phi);
    if (!seen.enough()) return by_background(measured, mixed, prev_phi, band_px);
    const glm::dmat3 plane = fit_piece(seen.motion);
    FlowField flow = measured;
    visit_hidden(hidden, rect_of(flow.size()), [&](int x, int y) {
        set_motion(flow, x, y, moved_by(plane, Vec2(x, y)));
        flow.valid.at(x, y) = 0;
    });
    return flow;
}

void move_seen(ImageF1& seen, ViewF1 phi) {
    for (int y = 0; y < seen.height(); ++y) {
        for (int x = 0; x < seen.width(); ++x)
            if (seen.at(x, y) != 0) seen.at(x, y) = phi.row(y)[x];
    }
}

}  // namespace weft
