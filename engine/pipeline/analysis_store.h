#pragma once
// A shot's analysis: results that need the frames in order, stored so that rendering a frame is a
// pure function.

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "engine/composite/focus_course.h"
#include "engine/composite/grain.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/form/form_map.h"
#include "engine/lighting/shading.h"
#include "engine/lighting/still_surface.h"
#include "engine/mask/confirmed_part.h"
#include "engine/motion/lattice_field.h"

namespace weft {

enum class AnalysisKind : std::uint8_t {
    kMatteForward,   ///< Propagated from the keyframe before (only while the mattes are made),
    kMatteBackward,  ///< and from the one after.
    kMatte,          ///< Propagated and merged, with its confidence.
    kCoords,         ///< ref_from_cur
    kCoordsOneWay,   ///< The same between two references, as tracked from one of them.
    kTrackBefore,    ///< Between two references: as tracked from the one before,
    kTrackAfter,     ///< and from the one after.
    /// Between two references: the frame repeats the drawing of the frame before in time.
    kHeldBetween,
    kHidingFrames,  ///< Over how many frames a seam hides that a texture returned to its shape.
    kLightSample,   ///< The plate as the shading estimate sees it (only while light is estimated).
    kShading,
    kForm,          ///< At the reference frame, from the clip.
    kStillSurface,  ///< At the reference frame, what highlights move over.
    kGrain,         ///< At the reference frame.
    kShutter,       ///< The plate's shutter, at the reference frame.
    kFocus,         ///< What the frame alone tells of the plate's focus.
    kPaperTexture   ///< The paper mode's synthesised picture.
};

struct AnalysisKey {
    int region = 0;
    int frame = 0;
    AnalysisKind kind = AnalysisKind::kCoords;
    /// Of mattes: 0 is the full matte, k the painted holdout k − 1, a zone as zone_layer() says.
    int layer = 0;
    auto operator<=>(const AnalysisKey&) const = default;
};

using Bytes = std::vector<std::uint8_t>;

/// Keeps blobs by key. Thread-safe.
class AnalysisStore {
  public:
    virtual ~AnalysisStore() = default;
    [[nodiscard]] virtual bool has(const AnalysisKey& key) const = 0;
    [[nodiscard]] virtual Status put(const AnalysisKey& key, const Bytes& bytes) = 0;
    /// Error: RenderFailed if it is missing or damaged.
    [[nodiscard]] virtual Expected<Bytes> get(const AnalysisKey& key) const = 0;
};

/// Keeps everything in memory: tests and single frames.
class MemoryAnalysisStore final : public AnalysisStore {
  public:
    [[nodiscard]] bool has(const AnalysisKey& key) const override;
    [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override;
    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override;

  private:
    mutable std::mutex mutex_;
    std::map<AnalysisKey, Bytes> blobs_;
};

/// A propagated matte with its confidence, 0–1. What is kept to be merged (kMatteForward,
/// kMatteBackward) has the places that were confirmed and what was followed, too (MatteEstimate).
struct StoredMatte {
    Matte matte;
    float confidence = 1;
    FramesSince since = {};
    float since_confidence = 1;
    Matte followed = {};
};

[[nodiscard]] Bytes encode(const StoredMatte& matte);
[[nodiscard]] Bytes encode(const LatticeField& field);
[[nodiscard]] Bytes encode(const FormMap& form);
[[nodiscard]] Bytes encode(const Shading& shading);  ///< 16 bit, logarithmic: steps of 0.03%.
/// Luma in 16 bit as above, weights in 8 bit; chromaticities are left out.
[[nodiscard]] Bytes encode(const SurfaceSample& sample);
/// Colours in 16 bit, as shadings.
[[nodiscard]] Bytes encode(const StillSurface& still);
[[nodiscard]] Bytes encode(const GrainModel& grain);
[[nodiscard]] Bytes encode(const FocusReading& focus);
[[nodiscard]] Bytes encode(const ImageU8x3& picture);
[[nodiscard]] Bytes encode(float number);
/// Errors: RenderFailed if the bytes are not what the encoder wrote.
[[nodiscard]] Expected<StoredMatte> decode_matte(const Bytes& bytes);
[[nodiscard]] Expected<LatticeField> decode_lattice(const Bytes& bytes);
[[nodiscard]] Expected<FormMap> decode_form(const Bytes& bytes);
[[nodiscard]] Expected<Shading> decode_shading(const Bytes& bytes);
[[nodiscard]] Expected<SurfaceSample> decode_light_sample(const Bytes& bytes);
[[nodiscard]] Expected<StillSurface> decode_still_surface(const Bytes& bytes);
[[nodiscard]] Expected<GrainModel> decode_grain(const Bytes& bytes);
[[nodiscard]] Expected<FocusReading> decode_focus(const Bytes& bytes);
[[nodiscard]] Expected<ImageU8x3> decode_picture(const Bytes& bytes);
[[nodiscard]] Expected<float> decode_number(const Bytes& bytes);

}  // namespace weft
