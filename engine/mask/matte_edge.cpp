#include "engine/mask/matte_edge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/box_gaussian.h"
#include "engine/mask/edge_shift.h"
#include "engine/mask/matte_cleaning.h"

namespace weft {
namespace {

// Outwards the outer end of the edge moves away from the inner one; inwards the other way round.
EdgeShift shift_of(const MatteEdge& edge) {
    return {edge.choke_px, std::max(edge.feather_px, 0.0f), std::min(edge.feather_px, 0.0f)};
}

// How far beyond the matte the settings reach.
int growth_px(const MatteEdge& edge) {
    const float px = std::max(edge.choke_px, 0.0f) + std::max(edge.feather_px, 0.0f);
    return static_cast<int>(std::ceil(px)) + box_gaussian_reach(edge.blur_px) +
           box_gaussian_reach(edge.smooth_px) + 3;
}

Recti covered_box(ViewF1 alpha) {
    std::vector<Recti> rows(static_cast<std::size_t>(alpha.height()));
    parallel_rows(alpha.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const float* row = alpha.row(y);
            int first = 0, end = alpha.width();
            while (first < end && !(row[first] > 0))
                ++first;
            while (end > first && !(row[end - 1] > 0))
                --end;
            if (first < end) rows[static_cast<std::size_t>(y)] = {first, y, end, y + 1};
        }
    });
    Recti box;
    for (const Recti& row : rows)
        box = box.united(row);
    return box;
}

KeyedNumbers divided(KeyedNumbers keys, int factor) {
    for (NumberKey& key : keys.keys)
        for (double& v : key.numbers)
            v /= factor;
    return keys;
}

}  // namespace

MatteEdge MatteEdgePlan::at(int frame) const {
    MatteEdge out = edge;
    if (!choke_keys.empty()) out.choke_px = choke_keys.float_at(frame)[0];
    if (!feather_keys.empty()) out.feather_px = feather_keys.float_at(frame)[0];
    if (!blur_keys.empty()) out.blur_px = blur_keys.float_at(frame)[0];
    return out;
}

MatteEdgePlan divided(const MatteEdgePlan& plan, int factor) {
    const auto by = static_cast<float>(factor);
    MatteEdgePlan out = plan;
    for (int* area : {&out.edge.min_island_px, &out.edge.min_hole_px})
        if (*area > 0) *area = std::max(1, *area / (factor * factor));
    for (float* px :
         {&out.edge.smooth_px, &out.edge.choke_px, &out.edge.feather_px, &out.edge.blur_px})
        *px /= by;
    out.choke_keys = divided(plan.choke_keys, factor);
    out.feather_keys = divided(plan.feather_keys, factor);
    out.blur_keys = divided(plan.blur_keys, factor);
    return out;
}

ImageF1 with_edge(ViewF1 alpha, const MatteEdge& edge) {
    ImageF1 out(alpha.size());
    const Recti covered = covered_box(alpha);
    if (covered.empty()) return out;
    const Recti box = covered.grown(growth_px(edge)).intersected(rect_of(alpha.size()));
    ImageF1 part(box.size());
    for (int y = 0; y < box.height(); ++y)
        std::copy_n(alpha.pixel(box.x0, box.y0 + y), box.width(), part.row(y));
    if (edge.min_island_px > 0) remove_islands(part, edge.min_island_px);
    if (edge.min_hole_px > 0) fill_holes(part, edge.min_hole_px);
    if (edge.smooth_px > 0) part = smoothed_edge(part, edge.smooth_px);
    const EdgeShift shift = shift_of(edge);
    if (shift.reach() > 0) part = shifted_edge(part, shift);
    if (edge.blur_px > 0) part = box_gaussian(std::move(part), edge.blur_px);
    for (int y = 0; y < box.height(); ++y)
        std::copy_n(part.row(y), box.width(), out.pixel(box.x0, box.y0 + y));
    return out;
}

Matte with_edge(Matte matte, const MatteEdge& edge) {
    if (edge.none() || matte.empty()) return matte;
    ImageF1 alpha(matte.size());
    const std::size_t count = matte.size_bytes();
    std::transform(matte.data(), matte.data() + count, alpha.data(),
                   [](std::uint8_t m) { return static_cast<float>(m) / 255.0f; });
    const ImageF1 edged = with_edge(alpha.view(), edge);
    std::transform(edged.data(), edged.data() + count, matte.data(), [](float a) {
        return static_cast<std::uint8_t>(std::clamp(a, 0.0f, 1.0f) * 255.0f + 0.5f);
    });
    return matte;
}

}  // namespace weft
