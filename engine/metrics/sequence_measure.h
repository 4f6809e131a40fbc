#pragma once
// Everything that method.md, 7 measures of a result, fed frame by frame: a clip of any length needs
// the memory of a few frames.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/metrics/drift.h"
#include "engine/metrics/grain_spectrum.h"
#include "engine/metrics/ideal.h"
#include "engine/metrics/illumination.h"
#include "engine/metrics/measuring_motion.h"
#include "engine/metrics/motion_chain.h"
#include "engine/metrics/pops.h"

namespace weft {

/// The texture of the region, to compare with: gives the floor and the sharpness kept.
struct IdealInputs {
    ImageU8x3 plane;  ///< Encoded RGB; repeats.
    TextureMapping mapping;
    IdealFilter filter;
};

struct MeasureOptions {
    int erode_px = 2;  ///< Pixels next to a matte's edge that TDE leaves out.
    MeasuringEstimator estimator = MeasuringEstimator::kDeepFlow;
    std::optional<IdealInputs> ideal;
    /// Round the ideal to 8 bits, as a result in 8-bit files was. False for 16-bit and float files.
    bool quantise_ideal = true;
    bool measure_drift = true;
    bool measure_grain = false;
    bool measure_pops = false;
};

class SequenceMeasure;

/// One frame. All of one size through the sequence; encoded RGB, 1.0 = white.
struct MeasureFrame {
    int frame = 0;
    ViewF3 result;
    ViewF3 source;
    ViewU8x1 matte;  ///< What of the region is seen, holdouts taken out.
    /// The motion between the frame before and this one; null: estimated from the source frames.
    const FlowField* motion = nullptr;
    MotionDirection direction = MotionDirection::kForward;
    /// Where this frame's pixels lie on the reference frame of the ideal; null: chained from the
    /// motion, with the first frame as the reference. Rendered texture coordinates uv go in as
    /// uv − pixel, with the identity as the mapping.
    const FlowField* ref_from_cur = nullptr;
    /// Another measure of the same clip that has added this frame just before: its estimated motion
    /// and its ideal are taken over instead of being worked out again. Null: none.
    const SequenceMeasure* twin = nullptr;
};

/// What was measured of one frame. Nothing where it cannot be said.
struct FrameMeasures {
    int frame = 0;
    std::int64_t region_pixels = 0;    ///< Matte ≥ kInsideCoverage.
    std::optional<double> tde;         ///< 8-bit units; nothing in the first frame.
    std::optional<double> source_tde;  ///< The source's own, over the same pixels.
    std::int64_t tde_pixels = 0;
    std::optional<double> tde_floor;     ///< Of the ideally moved texture where that is known.
    std::optional<double> tde_at_floor;  ///< The result's TDE over the floor's pixels alone.
    std::int64_t floor_pixels = 0;
    std::optional<double> sharpness_kept;
    std::optional<double> rms_contrast_kept;
    std::int64_t sharpness_pixels = 0;
    std::optional<double> mean_v, source_mean_v;  ///< 8-bit units.
    /// How far the matte's edge departs from where it was, moved with the plate: pixels; nothing in
    /// the first frame (matte_chatter.h).
    std::optional<double> matte_chatter_px;
    std::optional<PopSteps> steps;  ///< MeasureOptions::measure_pops; nothing in the first frame.
    double outside_mean = 0,
           outside_max = 0;  ///< |result − source| where the matte is 0, 8-bit units.
    std::int64_t outside_pixels = 0, outside_differing = 0;
};

/// Least, mean and largest over the frames that have a value.
struct Spread {
    std::int64_t frames = 0;
    double least = 0, mean = 0, largest = 0;
    void add(const std::optional<double>& v);
};

struct SequenceMeasures {
    std::int64_t frames = 0;
    std::string motion;  ///< "given (forward)", "given (backward)", "deepflow", "farneback",
                         ///< several joined by " and ", or empty for one frame.
    Spread tde, source_tde, tde_floor, tde_at_floor, sharpness_kept, rms_contrast_kept,
        matte_chatter_px;
    /// tde_at_floor.mean / tde_floor.mean: how many times the floor.
    std::optional<double> tde_over_floor;
    std::optional<ResidualMotion> drift;  ///< First result moved by the motion, against the last.
    double tiv = 0, source_tiv = 0, tiv_relative = 0;
    /// What changes from frame to frame beyond the motion. No blocks: not measured.
    GrainSpectrum grain, source_grain;
    Pops pops;
    double outside_mean = 0, outside_max = 0;
    std::int64_t outside_differing = 0;
};

/// Measures a sequence. Keeps the lumas of the frame before and of the first, their mattes and the
/// motion chain, and some numbers of every frame, whatever the length. One thread at a time; uses
/// several inside, with the same numbers for any count.
class SequenceMeasure {
  public:
    explicit SequenceMeasure(MeasureOptions options);
    ~SequenceMeasure();
    SequenceMeasure(SequenceMeasure&&) noexcept;
    SequenceMeasure& operator=(SequenceMeasure&&) noexcept;

    /// Adds the next frame in ascending order. Errors: Unreadable when a picture, matte or field is
    /// of another size than the first result (the message gives frame and sizes).
    [[nodiscard]] Expected<FrameMeasures> add(const MeasureFrame& frame);

    /// Overall figures of what has been added so far. Drift is worked out here (about a second for
    /// a full 854×480 frame); nothing when fewer than two frames were added or no patch was found.
    [[nodiscard]] SequenceMeasures summary() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace weft
