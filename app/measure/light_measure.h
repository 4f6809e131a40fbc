#pragma once
// The light of a shot's region as Weft estimates it: against a true one where the artist has a
// pass, and as pictures.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/render/analysis_cache.h"
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
    std::vector<Frame> frames;  ///< Those that have a true light.
    Spread correlation, error_levels, true_deviation_levels;
    ShadowEdges::Summary edges;
};

/// Φ of the first region of a shot.
class LightMeter {
  public:
    /// Analyses what of `frames` is not in the cache yet. An albedo or lighting pass of the region
    /// is not used for the estimate but is the truth to compare with; one picture without a frame
    /// number is the truth of the reference frame alone. Errors: those of opening and analysing;
    /// cancellation.
    [[nodiscard]] static Expected<std::shared_ptr<LightMeter>> open(
        const Project& project, const std::vector<int>& frames, const AnalysisCacheOptions& cache,
        const CancelToken& cancel, std::vector<std::string>& warnings);

    /// Whether there is a truth at all.
    [[nodiscard]] bool has_truth() const;
    /// Compares one frame, if it has a truth. Errors: of reading.
    [[nodiscard]] Status add(int frame);
    [[nodiscard]] LightMeasures summary() const;

    /// Pictures in display codes, each with a name: Φ, the plate's shading and reflectance, the
    /// result's (estimated from the result alone), and the true light where there is one. Outside
    /// of the matte they are dark. `result` in display codes. Light is shown as a grey of 0.35
    /// under it.
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

/// Writes each as FOLDER/NAME.FRAME.png, and all of them on one sheet, three a row, as
/// FOLDER/sheet.FRAME.png. Makes the folder. Errors: of writing.
[[nodiscard]] Status write_light_pictures(const std::string& folder, int frame,
                                          const LightMeter::Pictures& pictures,
                                          const WriteRule& rule);

}  // namespace weft
