#pragma once
// Registers a surface between two frames by comparing the pictures directly.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A frame's luma as registration compares it: inside the region only, less its local mean and over
/// its local deviation, so that shading and changes of light have little effect. Immutable.
struct RegistrationPicture {
    Recti area;      ///< Of the frame; the images below cover it.
    ImageF1 value;   ///< About −3…3.
    ImageF1 inside;  ///< 1 well inside the region, 0 where nothing is compared.
};

/// `luma`, `visible`: H×W, 8 bit, of one size. Pure; deterministic.
[[nodiscard]] RegistrationPicture registration_picture(ViewU8x1 luma, ViewU8x1 visible);

/// How well a map explains the frame: both in units of the local deviation.
struct RegistrationFit {
    double residual = 0;  ///< Robust mean of |anchor(map(p)) − cur(p)|.
    double share = 0;     ///< Of the region's pixels, those that the anchor shows and that agree.
};

struct RegistrationOptions {
    int samples = 60000;         ///< The most pixels that are compared, approximately.
    int iterations = 8;          ///< At most; stops when the map no longer changes.
    int lattice_px = 12;         ///< Spacing of the correction's nodes.
    float stiffness_px = 0.15f;  ///< The usual size of the correction's second differences, px.
    float still_px = 0.01f;      ///< No node moves farther once the map no longer changes.
    /// Of the samples only every so manieth along either axis is compared, and counts for those
    /// that are left out: for pictures without fine detail.
    int thinned = 1;
};

struct PlanarRegistration {
    LatticeField anchor_from_cur;
    RegistrationFit fit;
    bool found = false;  ///< False: too few pixels or no convergence; the field is the initial one.
};

/// The homography from the frame to the anchor, by Gauss–Newton on robust photometric residuals
/// (Lucas & Kanade 1981; Baker & Matthews 2004, forwards additive), from `initial`
/// (anchor_from_cur, right to about a pixel). The field has `initial`'s lattice. Pure;
/// deterministic.
[[nodiscard]] PlanarRegistration register_planar(const RegistrationPicture& anchor,
                                                 const RegistrationPicture& cur,
                                                 const LatticeField& initial,
                                                 const RegistrationOptions& options);

/// The homography that register_planar() `found`, from more pixels where those that it compared
/// leave a standard error above 0.01 px by their noise, as on faint surfaces. Pure; deterministic.
[[nodiscard]] LatticeField refine_planar(const RegistrationPicture& anchor,
                                         const RegistrationPicture& cur, const LatticeField& found,
                                         const RegistrationOptions& options);

/// `initial` plus a smooth correction: the maximum a posteriori displacement of a coarse lattice
/// under the photometric residuals and the prior that second differences are of the order of
/// `stiffness_px`; where the picture has no information the correction is extrapolated.
/// Pure; deterministic.
[[nodiscard]] LatticeField register_lattice(const RegistrationPicture& anchor,
                                            const RegistrationPicture& cur,
                                            const LatticeField& initial,
                                            const RegistrationOptions& options);

/// How well a map explains the frame, by one measure for all maps.
[[nodiscard]] RegistrationFit registration_fit(const RegistrationPicture& anchor,
                                               const RegistrationPicture& cur,
                                               const LatticeField& anchor_from_cur,
                                               const RegistrationOptions& options);

/// The mean correlation of the two pictures under a map, in cells of 24 px (of 640): 1 where all of
/// the surface is found again, 0 if too few places can be compared. Pure; deterministic.
[[nodiscard]] double registration_agreement(const RegistrationPicture& anchor,
                                            const RegistrationPicture& cur,
                                            const LatticeField& anchor_from_cur);

/// How much better one map explains the picture than another.
struct RegistrationLead {
    double gain = 0;    ///< In correlation, −2 to 2; positive for the first map.
    double errors = 0;  ///< The same in its standard errors.
};

/// The correlations of the two pictures under either map, compared in pairs in cells of 24 px; the
/// mean of their differences, and in units of its standard error. A Student's t: beyond ±2 it is
/// hardly chance, in noise it is about ±1, however faint the surface or strong the grain. 0 if too
/// few cells can be compared. `left_out`: the share of the cells, those in which the first map
/// leads most, that do not count, 0–0.5. Pure; deterministic.
[[nodiscard]] RegistrationLead registration_lead(const RegistrationPicture& anchor,
                                                 const RegistrationPicture& cur,
                                                 const LatticeField& a, const LatticeField& b,
                                                 double left_out = 0);

}  // namespace weft
