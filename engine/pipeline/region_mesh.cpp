#include "engine/pipeline/region_mesh.h"

#include <algorithm>
#include <set>

#include "engine/core/parallel.h"
#include "engine/form/mesh_depth.h"
#include "engine/form/view_camera.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_form.h"

namespace weft {
namespace {

constexpr int kSquares = 80;
constexpr int kLeastStepPx = 4;

struct MeshInputs {
    const RegionMotion& motion;
    const FormMap* form;
    int reference;
    std::vector<Vec2> places;          // of the corners on the reference frame, px, y down
    std::vector<glm::dvec3> in_space;  // with a form
};

struct MeshFrame {
    std::vector<Vec2> at;       // px, y down
    std::vector<double> depth;  // empty: not known
};

// The depths that a frame shows, at the corners that it shows.
Expected<std::vector<double>> frame_depths(const MeshInputs& in, const std::vector<Vec2>& at,
                                           int frame) {
    WEFT_TRY(visible, in.motion.visible(frame));
    const Recti box = matte_bounds(visible);
    if (box.empty()) return std::vector<double>();
    WEFT_TRY(first_from_here, in.motion.between(frame, in.motion.plan().reference_frames.front()));
    Matte part(box.size());
    for (int y = box.y0; y < box.y1; ++y)
        std::copy(visible.row(y) + box.x0, visible.row(y) + box.x1, part.row(y - box.y0));
    const ShownForm shown = form_on_frame(*in.form, first_from_here, part, box, 1);
    std::vector<SeenCorner> corners(at.size());
    for (std::size_t k = 0; k < at.size(); ++k) {
        corners[k].place = in.in_space[k];
        if (!(std::abs(at[k].x) < 1e6f && std::abs(at[k].y) < 1e6f)) continue;
        const int x = static_cast<int>(std::floor(at[k].x)),
                  y = static_cast<int>(std::floor(at[k].y));
        if (box.contains(x, y))
            corners[k].depth = static_cast<double>(shown.depth.at(x - box.x0, y - box.y0));
    }
    return depths_of(corners);
}

Expected<MeshFrame> mesh_frame(const MeshInputs& in, int frame) {
    WEFT_TRY(there, in.motion.between(in.reference, frame));
    MeshFrame out;
    for (const Vec2 p : in.places)
        out.at.push_back(p + there.at(p));
    if (!in.form) return out;
    WEFT_TRY(depth, frame_depths(in, out.at, frame));
    out.depth = std::move(depth);
    return out;
}

// The corners' places by the region's first reference frame, whose form is known.
Status place_in_space(MeshInputs& in) {
    WEFT_TRY(first_from_here,
             in.motion.between(in.reference, in.motion.plan().reference_frames.front()));
    std::vector<Vec2> first;
    for (const Vec2 p : in.places)
        first.push_back(p + first_from_here.at(p));
    in.in_space = places_in_space(*in.form, first, in.motion.size());
    return {};
}

}  // namespace

Expected<SurfaceMesh> region_mesh(const RegionMotion& motion, const AnalysisStore& store,
                                  int reference, const std::vector<int>& frames) {
    WEFT_TRY(matte, motion.visible(reference));
    const Recti shown = matte_bounds(matte);
    if (shown.empty())
        return fail(ErrorCode::kRenderFailed,
                    "Frame " + std::to_string(reference) + " shows nothing of it.");
    const int step = std::max(kLeastStepPx, std::max(shown.width(), shown.height()) / kSquares);
    SurfaceMesh mesh = mesh_over(matte, reference, step);
    if (mesh.faces.empty())
        return fail(ErrorCode::kRenderFailed,
                    "Frame " + std::to_string(reference) + " shows too little of it.");
    WEFT_TRY(form, found_form(motion.plan(), store, motion.region()));
    const bool deep = form && !form->relief.empty();
    MeshInputs in{motion, deep ? form.get() : nullptr, reference, {}, {}};
    const auto height = static_cast<float>(motion.size().height);
    for (const Vec3 p : mesh.corners.at(reference))
        in.places.emplace_back(p.x, height - p.y);
    if (deep) WEFT_CHECK_OK(place_in_space(in));
    std::set<int> wanted(frames.begin(), frames.end());
    wanted.insert(reference);
    const std::vector<int> all(wanted.begin(), wanted.end());
    std::vector<MeshFrame> found(all.size());
    WEFT_CHECK_OK(parallel_try(all.size(), [&](std::size_t k) -> Status {
        WEFT_TRY(each, mesh_frame(in, all[k]));
        found[k] = std::move(each);
        return {};
    }));
    const auto at_reference =
        static_cast<std::size_t>(std::find(all.begin(), all.end(), reference) - all.begin());
    const std::vector<double>* depth = &found[at_reference].depth;
    mesh.depth = deep && !depth->empty();
    double mean = 0;
    for (const double value : *depth)
        mean += value / static_cast<double>(depth->size());
    const double focal = deep ? camera_with(static_cast<double>(form->relief_fov_deg),
                                            form->aspect.unsqueezed(motion.size()))
                                    .focal_px
                              : 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        // A frame that shows too little to tell has what the one before it has.
        if (!found[k].depth.empty()) depth = &found[k].depth;
        std::vector<Vec3>& corners = mesh.corners[all[k]];
        corners.clear();
        for (std::size_t c = 0; c < found[k].at.size(); ++c)
            corners.emplace_back(
                found[k].at[c].x, height - found[k].at[c].y,
                mesh.depth ? static_cast<float>(focal * (1 - (*depth)[c] / mean)) : 0.0f);
    }
    return mesh;
}

}  // namespace weft
