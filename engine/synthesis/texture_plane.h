#pragma once
// A texture plane: a sample grown into a larger image of the same texture by repeated placement and
// cuts along the best seams (Kwatra et al. 2003; the paper, 2.1–2.3).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/compute/backend.h"
#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/seam/seam.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_amendment.h"
#include "engine/synthesis/plane_lattice.h"
#include "engine/synthesis/plane_mode.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_period.h"

namespace weft {

/// A picture that the plane should resemble (the warped previous frame in the paper's mode, an
/// illumination picture). It enters placement costs and the data terms of the cut with `weight`
/// (λ_t, 0–1000).
struct PlaneGuide {
    ViewU8x3 target;  ///< Of the plane's size.
    ViewU8x1 known;   ///< 0 where the target is unknown.
    float weight = 1.0f;

    /// Integer weights in placement costs: of a filled pixel, and of a guided one.
    static constexpr std::uint32_t kFillWeight = 256;
    [[nodiscard]] std::uint32_t guide_weight() const {
        return static_cast<std::uint32_t>(weight * static_cast<float>(kFillWeight) + 0.5f);
    }
};

/// The default number of refinement rounds. The first cuts all seams again, the others lay further
/// blocks over the worst seams. Other seam methods and guided planes are not refined.
inline constexpr int kDefaultRefinePasses = 2;

struct PlaneOptions {
    Size size{512, 512};  ///< Texels.
    SeamMethod seam = SeamMethod::kGraphCut;
    SeamCost seam_cost = SeamCost::kGradient;
    int overlap_px = 36;  ///< Largest overlap along the sweep, 12 … sample/2.
    int feather_px = 0;   ///< Blend across the seams, 0 is off.
    std::uint64_t seed = 1;
    std::uint64_t region = 0, frame = 0;  ///< Further keys of the random numbers.
    bool tileable = false;                ///< Opposite borders join along cut seams.
    std::optional<PlaneGuide> guide;
    int refine_passes = kDefaultRefinePasses;  ///< Rounds of blocks over the worst seams, 0 is off.
    Orientations orientations;               ///< Turned and mirrored samples besides upright ones.
    std::vector<PlaneAmendment> amendments;  ///< Carried out in this order once it is grown.
    bool align = true;  ///< Keep a texture that repeats by itself (bricks, tiles) in step.
    /// Of one upright sample without a guide; otherwise kAuto is kSynthesize.
    PlaneMode mode = PlaneMode::kSynthesize;
    /// Whether a tileable plane of kAuto may become larger than `size`, by up to an eighth, to hold
    /// whole periods of its sample.
    bool whole_periods = false;
    /// Searches for placements if it can do so faster than the CPU; the plane is the same.
    const Backend* backend = nullptr;
    /// Searches by direct sums and cuts by max-flow alone, as the paper does, to compare times. The
    /// plane is the same.
    bool plain_solvers = false;
};

/// Times in seconds of wall clock; total includes planning and cold caches. Where several threads
/// work, a stage has its share of the time that they took together.
struct PlaneStats {
    double search_s = 0, seam_s = 0, refine_s = 0, other_s = 0, total_s = 0;
    double seam_energy = 0;  ///< Σ over seam pixel pairs of ‖A−B‖(p) + ‖A−B‖(q), 8-bit units.
    std::int64_t seam_length_px = 0;  ///< Neighbouring pairs that are not neighbours in the source.
    double seam_energy_per_area = 0;
    std::size_t peak_graph_bytes = 0;
    int placements = 0;    ///< Of the first sweep.
    int refinements = 0;   ///< Blocks that refinement laid over seams.
    TexturePeriod period;  ///< That patches kept to their neighbours.
    PlaneLattice lattice;  ///< That all patches lie on (PlaneMode::kAuto); empty: none.
};

struct TexturePlane {
    ImageU8x3 pixels;  ///< In the sample's encoding.
    /// Which sample pixel (x, y) each texel shows (before feathering), and of which sample in which
    /// orientation (see SampleAtlas::Page); `origin` is empty where there is one upright sample.
    Image<std::int32_t, 2> source;
    Image<std::uint8_t, 2> origin;
    PlaneStats stats;
};

/// The source map as positions in the atlas of the same samples and orientations.
[[nodiscard]] Image<std::int32_t, 2> atlas_positions(const SampleAtlas& atlas,
                                                     const TexturePlane& plane);

/// Checks that a sample of this size can be grown with this overlap (px). Errors: Usage, with the
/// sizes that are allowed.
[[nodiscard]] Status check_sample(Size sample, int overlap_px);

/// Grows a plane, or lays the sample itself as the mode says. Deterministic: the same samples and
/// options give the same bytes for any number of threads. Errors: Usage if there is no sample or
/// more than 64, a sample is smaller than 24 px on a side or than the overlap, or the size is not
/// in [1, 16384]; NoSpace; cancelled. A sample of one colour is not an error: the plane has that
/// colour.
[[nodiscard]] Expected<TexturePlane> grow_plane(const std::vector<ViewU8x3>& samples,
                                                const PlaneOptions& options,
                                                const CancelToken& cancel = {},
                                                const ProgressFn& progress = {});
[[nodiscard]] Expected<TexturePlane> grow_plane(ViewU8x3 sample, const PlaneOptions& options,
                                                const CancelToken& cancel = {},
                                                const ProgressFn& progress = {});

/// A warning about a sample before it is grown (that it is one flat colour), if there is one.
[[nodiscard]] std::optional<std::string> sample_warning(ViewU8x3 sample);

}  // namespace weft
