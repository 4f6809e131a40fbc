#include "engine/mask/shape_transport.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/foreign_entries.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/spread_motion.h"

namespace weft {
namespace {

constexpr float kHiddenWeight = 0.005f;
constexpr float kInconsistentWeight = 0.04f;  // weight of motion that failed the consistency check

float nearest_phi(ViewF1 phi, float x, float y) {
    const float u = std::clamp(x + 0.5f, 0.0f, static_cast<float>(phi.width()) - 0.5f);
    const float v = std::clamp(y + 0.5f, 0.0f, static_cast<float>(phi.height()) - 0.5f);
    return phi.row(static_cast<int>(v))[static_cast<int>(u)];
}

}  // namespace

Recti transported_bounds(ViewF1 prev_phi, const FlowField& prev_from_cur) {
    constexpr int kRows = 16;
    std::vector<Recti> boxes(static_cast<std::size_t>(prev_phi.height() / kRows + 1));
    parallel_rows(prev_phi.height(), kRows, [&](int y0, int y1) {
        Recti box;
        for (int y = y0; y < y1; ++y) {
            const float* d = prev_from_cur.d.row(y);
            for (int x = 0; x < prev_phi.width(); ++x) {
                const float was_x = static_cast<float>(x) + d[2 * x];
                const float was_y = static_cast<float>(y) + d[2 * x + 1];
                if (nearest_phi(prev_phi, was_x, was_y) <= 0) continue;
                box = box.united({x, y, x + 1, y + 1});
            }
        }
        boxes[static_cast<std::size_t>(y0 / kRows)] = box;
    });
    Recti all;
    for (const Recti& box : boxes)
        all = all.united(box);
    return all;
}

namespace {

// The motion inside and around the shape, and how far it is reliable.
TransportedShape measure_motion(ViewF1 prev_phi, const FlowField& prev_from_cur, const Recti& area,
                                const RefineScale& scale, ViewU8x1 hidden) {
    const int w = area.width(), h = area.height();
    ImageF1 inside(w, h), around(w, h);
    Vec2 mean(0);
    float total = 0, beside = 0, trusted = 0;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const float* d = prev_from_cur.d.pixel(area.x0 + x, area.y0 + y);
            const bool valid = prev_from_cur.valid.row(area.y0 + y)[area.x0 + x] != 0;
            const float phi = nearest_phi(prev_phi, static_cast<float>(area.x0 + x) + d[0],
                                          static_cast<float>(area.y0 + y) + d[1]);
            const bool behind = !hidden.empty() && hidden.row(area.y0 + y)[area.x0 + x] != 0;
            const float unsure = behind ? kHiddenWeight : kInconsistentWeight;
            const float confidence = valid ? 1.0f : unsure;
            const float weight = phi <= 0 ? 0.0f : confidence;
            inside.at(x, y) = weight;
            around.at(x, y) = phi <= 0 ? confidence : 0.0f;
            mean += weight * Vec2(d[0], d[1]);
            total += weight;
            if (phi > 0 && phi < scale.band_px) {
                beside += 1;
                trusted += valid ? 1.0f : 0.0f;
            }
        }
    }
    TransportedShape shape;
    shape.consistency = beside > 0 ? trusted / beside : 0.0f;
    const ViewF2 motion = prev_from_cur.d.view().crop(area);
    const float unit_px = scale.unit_px();
    shape.prev_from_cur =
        spread_motion(motion, inside, total > 0 ? mean / total : Vec2(0), unit_px);
    shape.outside_motion = spread_motion(motion, around, Vec2(0), unit_px);
    return shape;
}

// The distance where the motion leads. What is revealed is outside, and near enough to the boundary
// to be decided by its colours; what has entered is outside.
ImageF1 moved_distance(ViewF1 prev_phi, ViewF2 motion, const Matte& revealed, const Matte& entered,
                       const Recti& area, const RefineScale& scale) {
    constexpr float kUndecidedBands = 0.2f;
    const int w = area.width(), h = area.height();
    ImageF1 moved(area.size());
    Image<std::uint8_t, 1> inside(area.size());
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                const float* d = motion.pixel(x, y);
                moved.row(y)[x] = sample_bilinear(prev_phi, static_cast<float>(area.x0 + x) + d[0],
                                                  static_cast<float>(area.y0 + y) + d[1]);
                const bool other = revealed.row(y)[x] != 0 || entered.row(y)[x] != 0;
                inside.row(y)[x] = moved.row(y)[x] > 0 && !other ? 1 : 0;
            }
        }
    });
    // Stretching motion invalidates the distances: recompute them, but keep the sub-pixel position.
    ImageF1 distance = signed_distance(inside, scale.limit_px);
    for (int y = 0; y < h; ++y) {
        float* phi = distance.row(y);
        const float* m = moved.row(y);
        for (int x = 0; x < w; ++x) {
            if (entered.row(y)[x] != 0)
                phi[x] = std::min(phi[x], -scale.band_px);
            else if (revealed.row(y)[x] != 0)
                phi[x] = std::max(phi[x], -kUndecidedBands * scale.band_px);
            else if (std::abs(phi[x]) < 3)
                phi[x] = std::clamp(m[x], phi[x] - 0.5f, phi[x] + 0.5f);
        }
    }
    return distance;
}

// What something in front hides is that thing's.
void keep_seen(Matte& found, const Recti& area, ViewU8x1 hidden) {
    if (hidden.empty()) return;
    for (int y = 0; y < area.height(); ++y) {
        for (int x = 0; x < area.width(); ++x)
            if (hidden.row(area.y0 + y)[area.x0 + x] != 0) found.at(x, y) = 0;
    }
}

}  // namespace

TransportedShape transport_shape(const PreviousShape& prev, const FlowField& prev_from_cur,
                                 const ShownArea& shown, const Recti& area,
                                 const RefineScale& scale, Uncovered& uncovered, ViewU8x1 hidden) {
    TransportedShape shape = measure_motion(prev.phi, prev_from_cur, area, scale, hidden);
    shape.uncovered = uncovered.advance({prev_from_cur, prev.phi, prev.seen, shape.prev_from_cur,
                                         shape.outside_motion, area, scale.band_px});
    Matte entered = foreign_entries({shown.frame, prev_from_cur, prev.phi, shape.prev_from_cur,
                                     area, shown.palette, scale.unit_px()});
    keep_seen(entered, area, hidden);
    shape.phi = moved_distance(prev.phi, shape.prev_from_cur, shape.uncovered.revealed, entered,
                               area, scale);
    return shape;
}

}  // namespace weft
