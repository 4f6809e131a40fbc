#include "engine/pipeline/region_corners.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/form/planar_track.h"
#include "engine/form/plane_corners.h"
#include "engine/mask/keyed_shape.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_form.h"

namespace weft {
namespace {

constexpr int kMostPlaces = 400;
constexpr std::size_t kFewestPlaces = 12;
constexpr double kFewestShare = 0.2;  // of the places, on a frame that is fitted

// Places inside of the matte, a few hundred of them.
std::vector<Vec2> places_inside(const Matte& matte) {
    std::vector<Vec2> all;
    const int step = std::max(1, std::max(matte.width(), matte.height()) / 160);
    for (int y = step / 2; y < matte.height(); y += step)
        for (int x = step / 2; x < matte.width(); x += step)
            if (matte.at(x, y) > 127) all.push_back(centre_of_pixel(x, y));
    std::vector<Vec2> out;
    const std::size_t every = 1 + all.size() / kMostPlaces;
    for (std::size_t k = 0; k < all.size(); k += every)
        out.push_back(all[k]);
    return out;
}

Quad<double> box_around(const Matte& matte) {
    const Recti box = matte_bounds(matte);
    return {{{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}}};
}

// A frame's homography, as the corners of a box on the reference frame and on the frame.
struct FittedFrame {
    CornerTrack track;  // empty: too little of the surface is in the picture
    std::vector<float> off_px;
};

Expected<FittedFrame> fitted(const RegionMotion& motion, int reference, int frame,
                             const std::vector<Vec2>& places) {
    FittedFrame out;
    WEFT_TRY(there, motion.between(reference, frame));
    const Size size = motion.size();
    std::vector<Vec2> shown;
    std::copy_if(places.begin(), places.end(), std::back_inserter(shown), [&](Vec2 p) {
        const Vec2 q = p + there.at(p);
        return q.x >= 0 && q.y >= 0 && q.x < static_cast<float>(size.width) &&
               q.y < static_cast<float>(size.height);
    });
    if (shown.size() < kFewestPlaces ||
        static_cast<double>(shown.size()) < kFewestShare * static_cast<double>(places.size()))
        return out;
    PlanarTracker tracker(shown);
    WEFT_CHECK_OK(tracker.add(reference, LatticeField(there.full_size(), there.spacing())));
    if (frame != reference) WEFT_CHECK_OK(tracker.add(frame, there));
    out.track = tracker.track();
    const glm::dmat3 map = track_motion(out.track, ShapeFollow::kPlanar, reference, frame);
    for (const Vec2 p : shown) {
        const glm::dvec3 q = map * glm::dvec3(p, 1.0);
        const Vec2 followed = p + there.at(p);
        out.off_px.push_back(
            static_cast<float>(std::hypot(q.x / q.z - static_cast<double>(followed.x),
                                          q.y / q.z - static_cast<double>(followed.y))));
    }
    return out;
}

// Zeros, which are not convex, for corners that cross the plane's horizon.
Quad<double> moved_corners(const Quad<double>& corners, const glm::dmat3& map) {
    Quad<double> out{};
    double side = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 q = map * glm::dvec3(corners[k], 1.0);
        if (k == 0) side = q.z;
        if (!(q.z * side > 0)) return {};
        out[k] = {q.x / q.z, q.y / q.z};
    }
    return out;
}

// The corners on the reference frame that a form which is a plane gives; empty without one.
Expected<std::optional<Quad<double>>> corners_by_form(const RegionMotion& motion,
                                                      const AnalysisStore& store, int reference,
                                                      const std::vector<Vec2>& places) {
    using Found = Expected<std::optional<Quad<double>>>;
    WEFT_TRY(form, found_form(motion.plan(), store, motion.region()));
    if (!form) return Found(std::nullopt);
    const int first = motion.plan().reference_frames.front();
    WEFT_TRY(matte, motion.visible(first));
    const auto corners = plane_corners(*form, matte);
    if (!corners) return Found(std::nullopt);
    Quad<double> out{};
    std::copy(corners->begin(), corners->end(), out.begin());
    if (first == reference) return Found(out);
    WEFT_TRY(between, fitted(motion, reference, first, places));
    if (between.track.empty()) return Found(std::nullopt);
    out = moved_corners(out, track_motion(between.track, ShapeFollow::kPlanar, first, reference));
    return is_convex(out) ? Found(out) : Found(std::nullopt);
}

float quantile(std::vector<float>& values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

Expected<RegionCorners> region_corners(const RegionMotion& motion, const AnalysisStore& store,
                                       int reference, const std::vector<int>& frames) {
    WEFT_TRY(matte, motion.visible(reference));
    const std::vector<Vec2> places = places_inside(matte);
    if (places.size() < kFewestPlaces)
        return fail(ErrorCode::kRenderFailed, "Frame " + std::to_string(reference) +
                                                  " shows too little of it for a planar track.");
    RegionCorners out;
    WEFT_TRY(by_form, corners_by_form(motion, store, reference, places));
    out.on_form = by_form.has_value();
    const Quad<double> corners = by_form ? *by_form : box_around(matte);
    std::vector<FittedFrame> each(frames.size());
    WEFT_CHECK_OK(parallel_try(frames.size(), [&](std::size_t k) -> Status {
        WEFT_TRY(found, fitted(motion, reference, frames[k], places));
        each[k] = std::move(found);
        return {};
    }));
    std::vector<float> off;
    CornerTrack track;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (each[k].track.empty()) continue;
        track[frames[k]] = moved_corners(
            corners, track_motion(each[k].track, ShapeFollow::kPlanar, reference, frames[k]));
        off.insert(off.end(), each[k].off_px.begin(), each[k].off_px.end());
    }
    track[reference] = corners;
    // Corners far beyond what is seen may cross the plane's horizon on a frame; without it the
    // others still hold.
    std::erase_if(track, [](const auto& entry) { return !is_convex(entry.second); });
    WEFT_TRY(whole, completed(std::move(track)));
    out.track = std::move(whole);
    if (!off.empty()) {
        out.off_median_px = quantile(off, 0.5);
        out.off_p90_px = quantile(off, 0.9);
    }
    return out;
}

}  // namespace weft
