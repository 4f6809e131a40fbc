#include "engine/pipeline/focus_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/composite/focus.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/lighting/plate_detail.h"
#include "engine/lighting/shading_lookup.h"
#include "engine/pipeline/focus_frames.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/region_light.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_zones.h"
#include "engine/pipeline/surface_pass.h"

namespace weft {
namespace {

constexpr float kSoftEdge = 0.015f;  // gradient of an edge that is out of focus
constexpr float kLightShare = 0.3f;  // of an edge's step, from which it is an edge of light
constexpr float kLeastLight = 1e-5f;
constexpr int kDownscale = 4;  // of the light that edges are compared with
// Without blur there are no penumbras to be told from it.
constexpr float kSharp_px = 0.6f;

// A region on one frame.
struct Looked {
    const ShotSource& source;
    const ShotPlan& plan;
    const AnalysisStore& store;
    int index, frame;
    const ImageF3& working;
    const Matte& visible;
    Recti box;
};

// The shading over the box, at full size.
ImageF1 light_over(const Shading& shading, const Recti& box) {
    ImageF1 out(box.size());
    std::vector<float> scratch, row(static_cast<std::size_t>(box.width()));
    for (int y = 0; y < box.height(); ++y) {
        shading_row(shading, box.x0, box.y0 + y, scratch, row);
        std::copy(row.begin(), row.end(), out.row(y));
    }
    return out;
}

// Whether light explains most of an edge's step. The shading is taken a pixel of it further out,
// since it is that much softer than the plate.
bool is_light(const EdgeBlur& edge, ViewF3 plate, const ImageF1& light, int reach) {
    const auto ln = [](float v) { return std::log(std::max(v, kLeastLight)); };
    const auto sign = [](int v) { return (v > 0 ? 1 : 0) - (v < 0 ? 1 : 0); };
    const Vec2i way = edge.bright - edge.dark;
    const Vec2i out{reach * sign(way.x), reach * sign(way.y)};
    const auto light_at = [&](Vec2i p) {
        return ln(light.at(std::clamp(p.x, 0, light.width() - 1),
                           std::clamp(p.y, 0, light.height() - 1)));
    };
    const auto luma_at = [&](Vec2i p) { return ln(luma_709(plate.pixel(p.x, p.y))); };
    const float of_light = light_at(edge.bright + out) - light_at(edge.dark - out);
    return of_light > kLightShare * (luma_at(edge.bright) - luma_at(edge.dark));
}

// The frame's light as the frame alone tells it, or as the artist says; empty: none is found. It
// does not need the frames on the way from the reference frame, which the analysis' own light does.
Expected<std::optional<Shading>> light_alone(const Looked& at) {
    using Found = Expected<std::optional<Shading>>;
    const RegionPlan& region = region_of(at.plan, at.index);
    if (region.light_source != LightSource::kPlate || !region.lights() ||
        is_transfer(region.light.form))
        return Found(std::nullopt);
    ShadingOptions options = shading_options(at.plan, at.working.size());
    options.downscale = kDownscale;
    Found out = region.estimates_light()
                    ? Found(estimate_shading(at.working, at.visible, options))
                    : region_shading(at.source, region, at.store, at.index, at.frame, at.working);
    if (!out || !*out) return out;
    WEFT_TRY(detail, light_detail(at.source, at.plan, at.store, at.index, at.frame));
    if (!detail.empty()) *out = with_light_detail(**out, at.working, at.visible, at.box, detail);
    return out;
}

// The plate's edges in the box that are paint: the edge of a shadow is as soft as its penumbra.
Expected<PictureEdges> paint_edges(const Looked& at) {
    const ViewF3 plate = at.working.view().crop(at.box);
    PictureEdges out = picture_edges(plate, at.visible.view().crop(at.box), kSoftEdge);
    const float blur = strong_blur_px(out);
    if (!(blur > kSharp_px) && !region_of(at.plan, at.index).has_depth &&
        !(blur_slope(out.edges, at.box.size()).agreement > 0))
        return out;
    WEFT_TRY(light, light_alone(at));
    if (!light) return out;
    const ImageF1 there = light_over(*light, at.box);
    std::erase_if(out.edges, [&](const EdgeBlur& edge) {
        return is_light(edge, plate, there, light->downscale);
    });
    return out;
}

// What can be seen of the region and is finite.
Expected<Matte> visible_matte(const ShotSource& source, const ShotPlan& plan,
                              const AnalysisStore& store, int region, int frame,
                              const ImageF3& working) {
    WEFT_TRY(extent, extent_matte(source, plan, store, region, frame));
    WEFT_TRY(holdout, holdout_matte(source, plan, store, region, frame));
    Matte out = without_holdout(extent, holdout);
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float* p = working.pixel(x, y);
                if (out.row(y)[x] != 0 && !std::isfinite(p[0] + p[1] + p[2])) out.row(y)[x] = 0;
            }
        }
    });
    return out;
}

// The frames that are still to be read, with their regions.
struct Reading {
    int frame = 0, region = 0;
    auto operator<=>(const Reading&) const = default;  // NOLINT(modernize-use-nullptr)
};

std::vector<Reading> missing_readings(const ShotPlan& plan, const AnalysisStore& store) {
    std::vector<Reading> out;
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        for (const int frame : needed_focus_frames(plan, region_of(plan, k))) {
            if (!store.has({k, frame, AnalysisKind::kFocus})) out.push_back({frame, k});
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

Expected<FocusReading> stored(const AnalysisStore& store, int region, int frame) {
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kFocus}));
    return decode_focus(bytes);
}

// Those between two neighbours of the grid that differ.
Expected<std::vector<Reading>> missing_between(const ShotPlan& plan, const AnalysisStore& store) {
    std::vector<Reading> out;
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        const RegionPlan& region = region_of(plan, k);
        const std::vector<int> grid = needed_focus_frames(plan, region);
        for (std::size_t i = 1; i < grid.size(); ++i) {
            if (grid[i] - grid[i - 1] > kFocusStep) continue;
            WEFT_TRY(before, stored(store, k, grid[i - 1]));
            WEFT_TRY(after, stored(store, k, grid[i]));
            if (!differ(before, after)) continue;
            for (const int frame : focus_frames_between(region, grid[i - 1], grid[i])) {
                if (!store.has({k, frame, AnalysisKind::kFocus})) out.push_back({frame, k});
            }
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

Status read_all(const PassContext& context, AnalysisStore& store,
                const std::vector<Reading>& wanted, bool counted) {
    // A few frames at once, whose plates are held.
    constexpr std::size_t kAtOnce = 4;
    for (std::size_t first = 0; first < wanted.size(); first += kAtOnce) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        const Clock::time_point start = Clock::now();
        const std::size_t count = std::min(kAtOnce, wanted.size() - first);
        std::vector<Status> done(count);
        parallel_for(count, [&](std::size_t i) {
            const Reading& r = wanted[first + i];
            auto read = focus_reading(context.source, context.plan, store, r.region, r.frame);
            done[i] = read ? store.put({r.region, r.frame, AnalysisKind::kFocus}, encode(*read))
                           : fail_in(std::move(read).error(), "Frame " + std::to_string(r.frame));
        });
        for (std::size_t i = 0; i < count; ++i) {
            WEFT_CHECK_OK(std::move(done[i]));
            if (counted && context.step)
                context.step(wanted[first + i].frame,
                             seconds_since(start) / static_cast<double>(count));
        }
    }
    return {};
}

}  // namespace

int count_focus_steps(const ShotPlan& plan, const AnalysisStore& store) {
    return static_cast<int>(missing_readings(plan, store).size());
}

Status read_focus(const PassContext& context, AnalysisStore& store) {
    WEFT_CHECK_OK(read_all(context, store, missing_readings(context.plan, store), true));
    WEFT_TRY(between, missing_between(context.plan, store));
    return read_all(context, store, between, false);
}

Expected<FocusReading> focus_reading(const ShotSource& source, const ShotPlan& plan,
                                     const AnalysisStore& store, int region, int frame) {
    WEFT_TRY(plate, source.plate(frame));
    WEFT_TRY(working, working_plate(source, plan, frame, *plate));
    WEFT_TRY(visible, visible_matte(source, plan, store, region, frame, working));
    const Recti box = matte_bounds(visible);
    FocusReading out;
    if (box.empty()) return out;
    WEFT_TRY(edges, paint_edges({source, plan, store, region, frame, working, visible, box}));
    out.blur_px = strong_blur_px(edges);
    out.error_px = strong_blur_error_px(edges);
    out.confidence = blur_confidence(edges);
    if (!region_of(plan, region).has_depth) {
        out.slope = blur_slope(edges.edges, box.size());
        out.slope.constant -= out.slope.by_x * static_cast<float>(box.x0) +
                              out.slope.by_y * static_cast<float>(box.y0);
        return out;
    }
    WEFT_TRY(nearness, source.depth(region, frame));
    // There is one lens, so the whole plate is measured; the region alone shows too little detail.
    const Matte everywhere(working.size(), 255);
    const auto lens = fit_focus(edge_blurs(working, everywhere, kSoftEdge), nearness);
    out.has_lens = lens.has_value();
    if (lens) out.lens = *lens;
    return out;
}

Expected<FocusState> focus_on(const ShotPlan& plan, const AnalysisStore& store, int region,
                              int frame) {
    const RegionPlan& settings = region_of(plan, region);
    ShotPlan one;
    one.frames = {frame};
    std::vector<TimedReading> readings;
    for (const int at : needed_focus_frames(one, settings)) {
        WEFT_TRY(reading, stored(store, region, at));
        if (!readings.empty() && at - readings.back().frame <= kFocusStep &&
            differ(readings.back().reading, reading)) {
            for (const int between : focus_frames_between(settings, readings.back().frame, at)) {
                WEFT_TRY(dense, stored(store, region, between));
                readings.push_back({between, dense});
            }
        }
        readings.push_back({at, reading});
    }
    return focus_at(frame, readings);
}

}  // namespace weft
