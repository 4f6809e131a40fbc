#include "engine/pipeline/form_pass.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/setting.h"
#include "engine/form/flatten.h"
#include "engine/form/normal_metric.h"
#include "engine/form/position_metric.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

// A frame's coordinates are as good as its motion was followed; the reference frame's are exact.
constexpr double kOtherFrames = 0.01;
// About a hundred cells across the plate: finer than the folds that a texture can follow.
constexpr int kCells = 108, kLeastSpacing_px = 4;
constexpr double kMostPlates = 4;  // of the domain's area, at that spacing

int spacing_for(Size plate, Size domain) {
    const int side = std::max(plate.width, plate.height);
    const int spacing = std::max(kLeastSpacing_px, (side + kCells - 1) / kCells);
    const double plates = static_cast<double>(domain.width) * domain.height /
                          (static_cast<double>(plate.width) * plate.height);
    const double wider = std::sqrt(std::max(1.0, plates / kMostPlates));
    return static_cast<int>(std::ceil(spacing * wider));
}

struct Evidence {
    Matte visible;
    LatticeField ref_from_cur;
};

Expected<Evidence> evidence_at(const PassContext& context, const AnalysisStore& store, int region,
                               int frame) {
    WEFT_TRY(extent, extent_matte(context.source, context.plan, store, region, frame));
    WEFT_TRY(holdout, holdout_matte(context.source, context.plan, store, region, frame));
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(field, decode_lattice(bytes));
    return Evidence{without_holdout(extent, holdout), std::move(field)};
}

// Where a frame's visible surface lies on the reference frame's plane, at most a plate beyond it.
Recti place_of(const Evidence& at) {
    constexpr int kStep = 8;
    const Size size = at.visible.size();
    const Recti most{-size.width, -size.height, 2 * size.width, 2 * size.height};
    Recti out{};
    for (int y = kStep / 2; y < size.height; y += kStep) {
        for (int x = kStep / 2; x < size.width; x += kStep) {
            if (at.visible.row(y)[x] < 128) continue;
            const Vec2 p(static_cast<float>(x), static_cast<float>(y));
            const Vec2 q = p + at.ref_from_cur.at(p);
            if (!(std::abs(q.x) < 1e6f && std::abs(q.y) < 1e6f)) continue;
            const int qx = static_cast<int>(std::floor(q.x)),
                      qy = static_cast<int>(std::floor(q.y));
            out = out.united(Recti{qx, qy, qx + 1, qy + 1}.grown(kStep).intersected(most));
        }
    }
    return out;
}

std::string text_of(const std::vector<int>& frames) {
    const auto [first, last] = std::minmax_element(frames.begin(), frames.end());
    if (*first == *last) return "frame " + std::to_string(*first);
    return "frames " + std::to_string(*first) + " to " + std::to_string(*last);
}

tl::unexpected<Error> no_form(const std::vector<int>& frames, RegionPlan::FormFrom from) {
    if (from == RegionPlan::FormFrom::kNormals) {
        return fail(ErrorCode::kUnreadable, "The normal pass shows no form on " + text_of(frames) +
                                                ": inside the matte its normals are zero or not "
                                                "finite. Choose the layer with the normals of this "
                                                "surface" +
                                                by({{setting::kNormalLayer}}) +
                                                ", or leave the pass out.");
    }
    return fail(ErrorCode::kUnreadable,
                "The position pass shows no form on " + text_of(frames) +
                    ": inside the matte its places are constant, on one line or not finite. "
                    "Choose the layer with the places of this surface" +
                    by({{setting::kPositionLayer}}) + ", or leave the pass out.");
}

// Adds what a frame's pass shows.
Status add_pass(const PassContext& context, int region, int frame, const Evidence& at,
                double weight, MetricField& field) {
    const RegionPlan& plan = context.plan.regions[static_cast<std::size_t>(region)];
    if (plan.form_from == RegionPlan::FormFrom::kPositions) {
        WEFT_TRY(positions, context.source.positions(region, frame));
        add_positions(field, positions, at.visible, at.ref_from_cur, weight);
        return {};
    }
    WEFT_TRY(pass, context.source.normals(region, frame));
    const auto normals =
        view_normals(pass.normals, at.visible, pass.camera, pass.camera_from_world);
    if (!normals) {
        return fail(ErrorCode::kUnreadable,
                    "Many normals of the normal pass face away from the camera on frame " +
                        std::to_string(frame) +
                        ", so they are not in the axes that are set. Set the space they are in" +
                        by({{setting::kNormalSpace, "camera"}, {setting::kNormalSpace, "world"}}) +
                        ".");
    }
    add_normals(field, *normals, at.visible, pass.camera, at.ref_from_cur, weight);
    return {};
}

}  // namespace

Expected<FormMap> form_from(const PassContext& context, const AnalysisStore& store, int region,
                            const std::vector<int>& frames) {
    const Size plate = context.source.size();
    Recti domain{0, 0, plate.width, plate.height};
    std::vector<Evidence> evidence;
    for (const int frame : frames) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_TRY(at, evidence_at(context, store, region, frame));
        domain = domain.united(place_of(at));
        evidence.push_back(std::move(at));
    }
    MetricField field(plate, domain, spacing_for(plate, domain.size()));
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_CHECK_OK(
            add_pass(context, region, frames[k], evidence[k], k == 0 ? 1 : kOtherFrames, field));
    }
    if (!field.finish()) {
        const RegionPlan& plan = context.plan.regions[static_cast<std::size_t>(region)];
        return no_form(frames, plan.form_from);
    }
    return flat_from_reference(field);
}

Status find_forms(const PassContext& context, AnalysisStore& store) {
    for (int k = 0; k < static_cast<int>(context.plan.regions.size()); ++k) {
        const RegionPlan& region = context.plan.regions[static_cast<std::size_t>(k)];
        const AnalysisKey key{k, region.reference_frames.front(), AnalysisKind::kForm};
        if (!region.has_form() || store.has(key)) continue;
        WEFT_TRY(form, form_from(context, store, k, region.form_evidence));
        WEFT_CHECK_OK(store.put(key, encode(form)));
    }
    return {};
}

}  // namespace weft
