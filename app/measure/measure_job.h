#pragma once
// Measures rendered sequences of one shot: what `weft measure` prints and `weft study` compares.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/exchange/input_files.h"
#include "app/measure/light_measure.h"
#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/metrics/light_truth.h"
#include "engine/metrics/sequence_measure.h"

namespace weft {

struct MeasureJobOptions {
    /// Plate, matte for every frame, placement, texture and motion; paths resolved. Without frames
    /// all that the first result has are measured.
    Project project;
    std::vector<std::string> results;  ///< Patterns; at least one.
    MeasuringEstimator estimator = MeasuringEstimator::kDeepFlow;
    /// Where there is no true motion, move the ideal texture by the estimate that measures, rather
    /// than going without floor and sharpness.
    bool ideal_by_estimate = false;
    /// The same scene rendered with the new material, to compare the first result with; empty:
    /// none.
    std::string truth;
    float truth_blur_px = 0;  ///< Compare after a Gaussian: the truth's texture lies elsewhere.
    /// Folder for pictures of the light of the plate and of the first result; empty: none.
    std::string pictures;
    bool overwrite = false;  ///< Replace pictures that exist.
    WriteLimits limits;
    AnalysisCacheOptions cache;  ///< Of the estimate of light, where one is wanted.
    /// Called with (result, frame) after each.
    std::function<void(std::size_t, const FrameMeasures&)> measured;
};

/// A result beside the true picture: 8-bit levels, up to one overall gain.
struct TruthMeasures {
    Spread inside, soft_edge, shadow;
    /// The most by which the region's median brightness, as a share of the first frame's, departs
    /// from the true one's.
    double brightness_error = 0;
    ShadowEdges edges;  ///< Of the picture itself: only where texture and truth are plain.
};

/// The figures of one result.
struct MeasuredResult {
    std::vector<FrameMeasures> frames;
    SequenceMeasures all;
    /// Deviation of the Gaussian that would blur steps to the sharper edges inside of the matte.
    Spread focus_px, source_focus_px;
};

struct MeasureJobResult {
    std::vector<MeasuredResult> results;  ///< In the order asked for.
    std::optional<TruthMeasures> truth;   ///< Of the first result.
    std::optional<LightMeasures> light;   ///< Where a pass gives the true light.
    std::vector<std::string> warnings;
};

/// Measures all results in one pass over the clip: motion and the ideal texture are worked out once
/// a frame. Errors: those of opening the shot; Usage when the matte is painted on single frames;
/// MissingFrames when a result lacks one; Unreadable when a size differs; cancellation.
[[nodiscard]] Expected<MeasureJobResult> run_measure_job(const MeasureJobOptions& options,
                                                         const CancelToken& cancel = {});

/// The plane that a region's result is made from, in 8-bit display codes: the given one, or grown
/// again as the render does. Errors: as reading and growing.
[[nodiscard]] Expected<ImageU8x3> ideal_plane(const Project& project, const RegionPlan& plan,
                                              Size plate);

/// What of the region is seen on a frame. Errors: of reading.
[[nodiscard]] Expected<Matte> visible_matte(const Shot& shot, int frame);

/// The file of true motion between `earlier` and `later`, which way it points by the region's
/// motion_forward.
[[nodiscard]] Expected<FlowField> true_motion_between(const Shot& shot, int earlier, int later);

/// Reads a rendered frame and takes it to display codes, white = 1.
class ResultReader {
  public:
    /// Errors: Unreadable, Usage for a colour space that is not known.
    [[nodiscard]] static Expected<ResultReader> open(const std::string& pattern,
                                                     const Project& project);
    [[nodiscard]] Expected<ImageF3> read(int frame) const;
    [[nodiscard]] const FrameReader& files() const { return *files_; }

  private:
    std::shared_ptr<const FrameReader> files_;
    std::shared_ptr<const ColorTransform> display_from_result_;
};

}  // namespace weft
