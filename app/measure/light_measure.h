#pragma once
// The light of a shot's region as Weft estimates it: compared with the true light where the artist
// has a pass, and as pictures.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cache/analysis_cache.h"
#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/core/image.h"
#include "engine/media/write_rule.h"
#include "engine/metrics/light_truth.h"
#include "engine/metrics/sequence_measure.h"

namespace weft {

struct LightMeasures {
    struct Frame {
        int frame = 0;
        ShadingAgreement agreement;
    };
    std::vector<Frame> frames;  ///< The frames that have a true light.
    Spread correlation, error_levels, true_deviation_levels;
    ShadowEdges::Summary edges;
};

/// Measures Φ of the first region of a shot.
class LightMeter {
  public:
    /// Analyses the frames of `frames` that are not cached. An albedo or lighting pass of the
    /// region is not used for the estimate; it is the truth to compare with. A single picture
    /// without a frame number is the truth of the reference frame only. Errors: those of opening
    /// and analysing; cancellation.
    [[nodiscard]] static Expected<std::shared_ptr<LightMeter>> open(
        const Project& project, const std::vector<int>& frames, const AnalysisCacheOptions& cache,
        const CancelToken& cancel, std::vector<std::string>& warnings);

    /// Returns true if there is a true light to compare with.
    [[nodiscard]] bool has_truth() const;
    /// Compares one frame if it has a true light. Errors: those of reading.
    [[nodiscard]] Status add(int frame);
    [[nodiscard]] LightMeasures summary() const;

    /// Named pictures in display codes: Φ, the plate's shading and reflectance, those of the result
    /// (estimated from the result alone), and the true light if known. They are dark outside the
    /// matte. `result` is in display codes. Light is shown on a grey of 0.35.
    using Pictures = std::vector<std::pair<std::string, ImageF3>>;
    [[nodiscard]] Expected<Pictures> pictures(int frame, const ImageF3& result) const;

  private:
    LightMeter() = default;
    [[nodiscard]] Expected<ImageF1> estimated(int frame) const;
    [[nodiscard]] Expected<std::optional<ImageF1>> truth(int frame) const;
    [[nodiscard]] Expected<Matte> visible(int frame) const;

    std::shared_ptr<const Shot> shot_, truth_shot_;
    std::shared_ptr<AnalysisStore> store_;
    std::shared_ptr<const ColorTransform> working_from_display_;
    bool truth_is_still_ = false;
    float reference_ = 1;  // S₀
    LightMeasures sum_;
    ShadowEdges edges_;
};

/// Writes each picture as FOLDER/NAME.FRAME.png, and all of them on one sheet with three per row as
/// FOLDER/sheet.FRAME.png. Creates the folder. Errors: those of writing.
[[nodiscard]] Status write_light_pictures(const std::string& folder, int frame,
                                          const LightMeter::Pictures& pictures,
                                          const WriteRule& rule);

}  // namespace weft
