#include "engine/pipeline/st_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <optional>

#include "engine/core/parallel.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/lattice_root.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/st_rim.h"

namespace weft {
namespace {

constexpr int kMapBandRows = 16;
constexpr float kMissedPx = 0.05f;  // a place that is missed by more is not shown
constexpr float kBesidePx = 16;     // the inverse lattice is off by less, except beside folds

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
    const ImageF2 cur_from_ref =
        coarse_inverse(ref_from_cur).dense({0, 0, visible.width(), visible.height()});
    const Recti box = matte_bounds(visible);
    const Vec2 low(box.x0, box.y0), high(box.x1, box.y1);
    parallel_rows(visible.height(), kMapBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            std::optional<Vec2> beside;
            for (int x = 0; x < visible.width(); ++x) {
                const Vec2 q = centre_of_pixel(x, y);
                const float* d = cur_from_ref.pixel(x, y);
                const Vec2 start = q + Vec2(d[0], d[1]);
                if (glm::any(glm::lessThan(start, low - kBesidePx)) ||
                    glm::any(glm::greaterThan(start, high + kBesidePx)))
                    continue;
                LatticeRoot root = root_of(ref_from_cur, q, start);
                // Beside a fold it is near where the pixel before came from.
                if (!(root.miss <= kMissedPx) && beside)
                    root = root_of(ref_from_cur, q, q + *beside);
                beside.reset();
                if (!(root.miss <= kMissedPx)) continue;
                beside = root.place - q;
                const float share = coverage_at(visible, root.place);
                if (share > 0) put_place(map, x, y, root.place, share);
            }
        }
    });
}

StMaps empty_maps(Size size) {
    return {{ImageF2(size), ImageF1(size)}, {ImageF2(size), ImageF1(size)}};
}

void continue_maps(StMaps& maps) {
    for (StMap* map : {&maps.warp, &maps.stabilize})
        continue_map(map->st, map->visible);
}

}  // namespace

StMaps st_maps_of(const LatticeField& there_from_here, const Matte& visible) {
    StMaps out = empty_maps(visible.size());
    add_warp(out.warp, there_from_here, visible);
    add_stabilize(out.stabilize, there_from_here, visible);
    continue_maps(out);
    return out;
}

Expected<StMaps> st_maps(const ShotSource& source, const ShotPlan& plan,
                         const AnalysisStore& analysis, int frame) {
    const ZonedAnalysis store(source, plan, analysis);
    StMaps out = empty_maps(source.size());
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        WEFT_TRY(visible, shown_matte(source, plan, store, k, frame));
        WEFT_TRY(bytes, store.get({k, frame, AnalysisKind::kCoords}));
        WEFT_TRY(ref_from_cur, decode_lattice(bytes));
        add_warp(out.warp, ref_from_cur, visible);
        add_stabilize(out.stabilize, ref_from_cur, visible);
    }
    continue_maps(out);
    return out;
}

}  // namespace weft
