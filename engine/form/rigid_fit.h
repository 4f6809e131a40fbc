#pragma once
// The form of what moves as one rigid thing, from its motion.

#include <optional>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/form/rigid_surface.h"

namespace weft {

/// Where a frame shows places of the surface, in pixels: pairs of one place each.
struct FrameMatches {
    std::vector<Vec2> reference, frame;
};

/// What is believed of the long side over the focal length: a normal distribution.
struct TangentBelief {
    double value = 0.91, deviation = 0.35;  ///< A field of view of 49° (32° to 64°).
};

constexpr double kGivenTangentDeviation = 1e-3;  ///< Of a tangent that is given.

/// A rigid surface that explains how its places move, and how far that is to be believed.
struct RigidFit {
    RigidSurface surface;
    bool plane = true;
    int frames = 0;          ///< That were used.
    double residual_px = 0;  ///< Of the matches, root of the median square.
    double turn_deg = 0;     ///< The largest, of the viewing direction on the surface.
    /// ln stretch of the flat picture on it, and its standard error: root mean squares over the
    /// places of the reference frame.
    double log_stretch = 0, error = 0;
    double tilt_deg = 0, tilt_error_deg = 0;  ///< Of the surface at the centre against the picture.
    double fov_deg = 0, fov_error_deg = 0;    ///< Horizontal.
    double tangent_error = 0;  ///< Of surface.tangent, with what was believed before.
    TangentBelief believed;    ///< What that was.

    /// How much of the form is likely to be there: 0, no evidence, to 1.
    [[nodiscard]] double belief() const;
    /// What the motion alone says of the tangent; empty if it says nothing.
    [[nodiscard]] std::optional<TangentBelief> measured_tangent() const;
};

/// Fits a plane, and where that leaves more than the noise a curved surface, to matches between the
/// reference frame and others, with a pose for each frame: bundle adjustment (Triggs et al. 2000)
/// over nearness, focal length and poses, by Levenberg–Marquardt with a Schur complement on the
/// poses, from many starts, since a plane's homographies have two solutions (Malis & Vargas 2007).
/// The noise is what is left, and at least what tracks are known to be off. Competing solutions and
/// the covariance make up the error. `tangent`: long side over focal length, where it is known;
/// else it is found, from fields of view as they are common. Empty if the matches are too few, are
/// not those of a rigid thing, or are what a camera at one place shows, which turns and zooms.
/// Bit-identical everywhere; thread-safe.
[[nodiscard]] std::optional<RigidFit> fit_rigid_surface(const std::vector<FrameMatches>& frames,
                                                        Size picture,
                                                        std::optional<double> tangent);
/// The same with what is believed of the tangent before.
[[nodiscard]] std::optional<RigidFit> fit_rigid_surface(const std::vector<FrameMatches>& frames,
                                                        Size picture, const TangentBelief& tangent);

/// What several surfaces before one lens say of it together, by the weights of their errors. Empty
/// for fewer than two, and if they contradict each other, as when the lens zooms.
[[nodiscard]] std::optional<TangentBelief> shared_tangent(
    const std::vector<TangentBelief>& measured);

}  // namespace weft
