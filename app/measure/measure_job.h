#pragma once
// Measures rendered sequences of one shot: `weft measure` prints the figures, `weft study` compares
// them.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/exchange/input_files.h"
#include "app/measure/light_measure.h"
#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/metrics/form_truth.h"
#include "engine/metrics/light_truth.h"
#include "engine/metrics/sequence_measure.h"

namespace weft {

struct MeasureJobOptions {
    /// Plate, a matte for every frame, placement, texture and motion; resolved paths. Without a
    /// frame list, all frames of the first result are measured.
    Project project;
    std::vector<std::string> results;  ///< Patterns of the results; at least one.
    MeasuringEstimator estimator = MeasuringEstimator::kDeepFlow;
    /// Without true motion, move the ideal texture by the estimated motion instead of omitting the
    /// floor and the sharpness.
    bool ideal_by_estimate = false;
    /// Ground truth: the scene rendered with the new material, to compare with the first result;
    /// empty: none.
    std::string truth;
    /// Gaussian blur before comparing, because the truth's texture is placed differently.
    float truth_blur_px = 0;
    /// EXRs with the layer `st` of the first result, to compare with the region's position pass;
    /// empty: none.
    std::string st;
    /// Folder for images of the light of the plate and of the first result; empty: none.
    std::string pictures;
    bool overwrite = false;  ///< Replace existing images.
    WriteLimits limits;
    AnalysisCacheOptions cache;  ///< Cache of the light estimate.
    /// Called with (result, frame) after each frame.
    std::function<void(std::size_t, const FrameMeasures&)> measured;
};

/// Differences between a result and the ground truth: 8-bit levels, after one overall gain.
struct TruthMeasures {
    Spread inside, soft_edge, shadow;
    /// Largest deviation of the region's median brightness, relative to the first frame, from that
    /// of the truth.
    double brightness_error = 0;
    /// Shadow edges of the picture itself; valid only if texture and truth are plain.
    ShadowEdges edges;
};

/// Figures of one result.
struct MeasuredResult {
    std::vector<FrameMeasures> frames;
    SequenceMeasures all;
    /// Standard deviation of the Gaussian that would blur steps to the sharper edges inside the
    /// matte.
    Spread focus_px, source_focus_px;
};

struct MeasureJobResult {
    std::vector<MeasuredResult> results;  ///< In the requested order.
    std::optional<TruthMeasures> truth;   ///< For the first result.
    std::optional<LightMeasures> light;   ///< Set if a pass gives the true light.
    std::optional<FormMeasures> form;     ///< Set if the layer `st` is given.
    std::vector<std::string> warnings;
};

/// Measures all results in one pass over the clip, so motion and the ideal texture are computed
/// once per frame. Errors: those of opening the shot; Usage when the matte is painted on single
/// frames; MissingFrames when a result lacks a frame; Unreadable when a size differs; cancellation.
[[nodiscard]] Expected<MeasureJobResult> run_measure_job(const MeasureJobOptions& options,
                                                         const CancelToken& cancel = {});

/// The plane that a region's result is made from, in 8-bit display codes: read, or synthesized as
/// in the render. Errors: those of reading and synthesizing.
[[nodiscard]] Expected<ImageU8x3> ideal_plane(const Project& project, const RegionPlan& plan,
                                              Size plate);

/// The matte of the region without its holdouts on a frame, and without what the plate's alpha says
/// is empty. Errors: those of reading.
[[nodiscard]] Expected<Matte> visible_matte(const Shot& shot, int frame);

/// A picture as it is measured.
struct MeasuredPicture {
    ImageF3 display;         ///< Display codes, white = 1; straight colours where it has an alpha.
    bool has_alpha = false;  ///< Without one, what was transparent lies over black.
};

/// The plate's frame, to compare with a result with or without an alpha: in straight colours, or
/// over black. Errors: those of reading.
[[nodiscard]] Expected<ImageF3> plate_like(const Shot& shot, int frame, bool has_alpha);

/// Reads the true motion between `earlier` and `later`; the region's motion_forward gives its
/// direction.
[[nodiscard]] Expected<FlowField> true_motion_between(const Shot& shot, int earlier, int later);

/// Reads rendered frames and converts them to display codes. Thread-safe.
class ResultReader {
  public:
    /// Errors: Unreadable; Usage for an unknown colour space.
    [[nodiscard]] static Expected<ResultReader> open(const std::string& pattern,
                                                     const Project& project);
    [[nodiscard]] Expected<MeasuredPicture> read(int frame) const;
    [[nodiscard]] const FrameReader& files() const { return *files_; }

  private:
    std::shared_ptr<const FrameReader> files_;
    std::shared_ptr<const ColorTransform> display_from_result_;
};

}  // namespace weft
