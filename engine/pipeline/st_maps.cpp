#include "engine/pipeline/st_maps.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

constexpr int kMapBandRows = 16;
constexpr int kSteps = 4;  // of Newton's method, from the inverse lattice on
constexpr float kSettledPx = 1e-3f;
constexpr float kMissedPx = 0.05f;  // a place that is missed by more is not shown

void put_place(StMap& map, int x, int y, Vec2 place, float visible) {
    const Size size = map.visible.size();
    float* st = map.st.pixel(x, y);
    st[0] = place.x / static_cast<float>(size.width);
    st[1] = 1 - place.y / static_cast<float>(size.height);
    float& below = map.visible.at(x, y);
    below = visible + (1 - visible) * below;
}

void add_warp(StMap& map, const LatticeField& ref_from_cur, const Matte& visible) {
    parallel_rows(visible.height(), kMapBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < visible.width(); ++x) {
                if (visible.row(y)[x] == 0) continue;
                const Vec2 p = centre_of_pixel(x, y);
                put_place(map, x, y, p + ref_from_cur.at(p),
                          static_cast<float>(visible.row(y)[x]) / 255.0f);
            }
        }
    });
}

// The place near `start` that the field takes to `target`, and by how much it is missed, px.
struct Root {
    Vec2 place;
    float miss;
};

Root root_of(const LatticeField& ref_from_cur, Vec2 target, Vec2 start) {
    const auto residual = [&](Vec2 p) { return p + ref_from_cur.at(p) - target; };
    constexpr float kStep = 1;
    Vec2 p = start, r = residual(p);
    for (int k = 0; k < kSteps && glm::length(r) > kSettledPx; ++k) {
        const glm::mat2 slope(residual(p + Vec2(kStep, 0)) - r, residual(p + Vec2(0, kStep)) - r);
        if (!(std::abs(glm::determinant(slope)) > 1e-6f)) break;
        const Vec2 next = p - glm::inverse(slope) * r;
        const Vec2 left = residual(next);
        if (!(glm::length(left) < glm::length(r))) break;
        p = next, r = left;
    }
    return {p, glm::length(r)};
}

// Between the centres of four pixels; 0 beyond the picture.
float coverage_at(const Matte& matte, Vec2 place) {
    const float fx = place.x - 0.5f, fy = place.y - 0.5f;
    if (!(fx > -1 && fy > -1 && fx < static_cast<float>(matte.width()) &&
          fy < static_cast<float>(matte.height())))
        return 0;
    const int x = static_cast<int>(std::floor(fx)), y = static_cast<int>(std::floor(fy));
    const auto code = [&](int i, int j) {
        const bool inside = i >= 0 && j >= 0 && i < matte.width() && j < matte.height();
        return inside ? static_cast<float>(matte.row(j)[i]) : 0.0f;
    };
    const float u = fx - static_cast<float>(x), v = fy - static_cast<float>(y);
    const float upper = (1 - u) * code(x, y) + u * code(x + 1, y);
    const float lower = (1 - u) * code(x, y + 1) + u * code(x + 1, y + 1);
    return ((1 - v) * upper + v * lower) / 255.0f;
}

void add_stabilize(StMap& map, const LatticeField& ref_from_cur, const Matte& visible) {
    const LatticeField cur_from_ref = inverse(ref_from_cur);
    parallel_rows(visible.height(), kMapBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < visible.width(); ++x) {
                const Vec2 q = centre_of_pixel(x, y);
                const Root root = root_of(ref_from_cur, q, q + cur_from_ref.at(q));
                if (!(root.miss <= kMissedPx)) continue;
                const float share = coverage_at(visible, root.place);
                if (share > 0) put_place(map, x, y, root.place, share);
            }
        }
    });
}

}  // namespace

Expected<StMaps> st_maps(const ShotSource& source, const ShotPlan& plan,
                         const AnalysisStore& analysis, int frame) {
    const ZonedAnalysis store(source, plan, analysis);
    const Size size = source.size();
    StMaps out{{ImageF2(size), ImageF1(size)}, {ImageF2(size), ImageF1(size)}};
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        WEFT_TRY(visible, shown_matte(source, plan, store, k, frame));
        WEFT_TRY(bytes, store.get({k, frame, AnalysisKind::kCoords}));
        WEFT_TRY(ref_from_cur, decode_lattice(bytes));
        add_warp(out.warp, ref_from_cur, visible);
        add_stabilize(out.stabilize, ref_from_cur, visible);
    }
    return out;
}

}  // namespace weft
