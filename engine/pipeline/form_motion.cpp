#include "engine/pipeline/form_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/form/rigid_fit.h"
#include "engine/form/still_camera.h"
#include "engine/form/view_camera.h"
#include "engine/pipeline/form_evidence.h"
#include "engine/pipeline/form_laid.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

constexpr double kMatches = 60;  // of a frame
constexpr int kLeastMatches = 16;
constexpr double kMargin = 6.0 / 854;  // from the outline, where motion is a mixture
// What has to hold for a form to be laid at all. A wrong one is worse than none: tracks that slide
// look like the motion of some other form, often in front of a camera that nobody has.
constexpr double kLeastBelief = 0.6;
constexpr double kMostError = 0.3;    // ln stretch
constexpr double kLeastTurn_deg = 4;  // of the viewing direction
constexpr double kMostTurn_deg = 80;
constexpr double kLeastFov_deg = 18, kMostFov_deg = 85;
constexpr double kMostResidual = 0.6 / 854;  // by the long side
constexpr double kLeastStretch = 0.02;       // ln; less is not seen

FormFinding finding_of(const RigidFit& fit, FormFinding::Source source, const MotionLens& lens) {
    FormFinding out{source,
                    fit.plane,
                    fit.frames,
                    static_cast<float>(fit.belief()),
                    static_cast<float>(fit.tilt_deg),
                    static_cast<float>(fit.tilt_error_deg),
                    static_cast<float>(fit.fov_deg)};
    if (lens.fov_deg) return out;
    out.fov_error_deg = static_cast<float>(fit.fov_error_deg);
    out.fov_regions = lens.shared ? static_cast<std::uint8_t>(std::min(lens.regions, 255)) : 0;
    return out;
}

// Whether a place and its surroundings lie inside of a matte.
bool well_inside(const Matte& matte, Vec2 place, int margin) {
    const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
    if (x < margin || y < margin || x >= matte.width() - margin || y >= matte.height() - margin)
        return false;
    for (const int v : {y - margin, y, y + margin})
        for (const int u : {x - margin, x, x + margin})
            if (matte.row(v)[u] != 255) return false;
    return true;
}

std::vector<FrameMatches> matches_of(const std::vector<FormEvidence>& evidence, Size plate) {
    const int margin =
        std::max(1, static_cast<int>(std::lround(kMargin * std::max(plate.width, plate.height))));
    std::vector<FrameMatches> out;
    for (std::size_t k = 1; k < evidence.size(); ++k) {
        const FormEvidence& at = evidence[k];
        const auto inside = static_cast<double>(std::count(
            at.visible.data(), at.visible.data() + at.visible.size_bytes(), std::uint8_t{255}));
        const int step = std::max(2, static_cast<int>(std::sqrt(inside / kMatches)));
        FrameMatches m;
        for (int y = step / 2; y < plate.height; y += step) {
            for (int x = step / 2; x < plate.width; x += step) {
                const Vec2 frame = centre_of_pixel(x, y);
                if (!well_inside(at.visible, frame, margin)) continue;
                const Vec2 reference = frame + at.ref_from_cur.at(frame);
                if (!well_inside(evidence[0].visible, reference, margin)) continue;
                m.reference.push_back(reference);
                m.frame.push_back(frame);
            }
        }
        if (m.reference.size() >= kLeastMatches) out.push_back(std::move(m));
    }
    return out;
}

std::optional<RigidFit> fit_matches(const std::vector<FrameMatches>& matches, Size plate,
                                    const MotionLens& lens) {
    if (lens.shared && !lens.fov_deg) return fit_rigid_surface(matches, plate, *lens.shared);
    return fit_rigid_surface(matches, plate, tangent_of(lens.fov_deg, plate));
}

bool believable(const RigidFit& fit, Size plate) {
    return fit.belief() >= kLeastBelief && fit.error <= kMostError &&
           fit.turn_deg >= kLeastTurn_deg && fit.turn_deg <= kMostTurn_deg &&
           fit.fov_deg >= kLeastFov_deg && fit.fov_deg <= kMostFov_deg &&
           fit.residual_px <= kMostResidual * std::max(plate.width, plate.height) &&
           fit.log_stretch >= kLeastStretch;
}

}  // namespace

std::optional<double> tangent_of(std::optional<double> fov_deg, Size plate) {
    if (!fov_deg) return std::nullopt;
    return std::max(plate.width, plate.height) / camera_with(*fov_deg, plate).focal_px;
}

std::optional<RigidFit> fit_motion(const std::vector<FormEvidence>& evidence, Size plate,
                                   const MotionLens& lens) {
    auto fit = fit_matches(matches_of(evidence, plate), plate, lens);
    if (fit && !believable(*fit, plate)) fit.reset();
    return fit;
}

FormMap form_from_motion(const std::vector<FormEvidence>& evidence, Size plate,
                         const MotionLens& lens) {
    const std::vector<FrameMatches> matches = matches_of(evidence, plate);
    const auto fit = fit_matches(matches, plate, lens);
    FormFinding flat;
    flat.frames = static_cast<int>(matches.size());
    flat.belief = 0;
    if (!fit) {
        flat.no_parallax = !shows_parallax(matches, plate);
        return flat_over(plate, flat);
    }
    flat = finding_of(*fit, FormFinding::Source::kNone, lens);
    if (!believable(*fit, plate)) return flat_over(plate, flat);
    return laid_flat(fit->surface, finding_of(*fit, FormFinding::Source::kMotion, lens), evidence,
                     plate);
}

}  // namespace weft
