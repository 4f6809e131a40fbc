#pragma once
// The provenance of a result's pixel: texture, sample, seams and light.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/core/texture_mapping.h"
#include "engine/lighting/shading.h"
#include "engine/motion/lattice_field.h"
#include "engine/temporal/temporal_mode.h"
#include "engine/temporal/track_seam.h"

namespace weft {

/// A map of a synthesized plane: what each texel shows, and the cost of seams there.
struct PlaneMap {
    Image<std::int32_t, 2> source;  ///< Pixel of the sample.
    Image<std::uint8_t, 1> which;   ///< Index of the sample.
    Matte energy;                   ///< 0: no seam; from 48 on: a seam, higher if it costs more.
    std::vector<std::string> samples;
    /// Ids of the samples: from their library, otherwise from their pixels.
    std::vector<std::string> ids;
    Image<std::uint8_t, 1> orientation;  ///< As in SampleAtlas::Page; empty: all upright.
    Image<std::int32_t, 1> patch;        ///< Number of the patch, from 1 (number_patches()).
};

/// The two tracks that a frame between two reference frames combines.
struct TwoTracks {
    int before = 0, after = 0;  ///< The reference frames.
    float share_after = 0;      ///< Weight of the later track without a seam.
    struct Seam {
        TrackSeam labels;  ///< Labels of this frame only.
        LatticeField before, after;
    };
    std::optional<Seam> seam;  ///< Set if the tracks disagree: each place shows one of them.
};

/// Provenance of one region on one frame. Immutable; queries take microseconds.
struct Provenance {
    LatticeField ref_from_cur;
    TextureMapping mapping;
    std::shared_ptr<const PlaneMap> plane;  ///< Null: the texture is used without synthesis.
    std::string texture, texture_id;        ///< Name of the file; its id as in PlaneMap::ids.
    int reference_frame = 0;                ///< Reference frame of `on_reference`.
    int frame = 0;
    int track_frame = 0;  ///< Reference frame that this frame is tracked from.
    std::optional<TwoTracks> two;
    TemporalMode temporal = TemporalMode::kLocked;
    float fresh = 1;  ///< Temporal blend α of the paper mode.
    std::optional<Shading> shading;
    float reference_shading = 1;

    struct Answer {
        Vec2 on_reference;              ///< Pixel of the reference frame.
        Vec2 texel;                     ///< Texel of the plane.
        std::string sample, sample_id;  ///< File and id of the sample.
        std::optional<Vec2i> in_sample;
        std::optional<int> patch;  ///< Number of the patch.
        /// Reference frames of the tracks and their weights. The weights add up to 1 minus the
        /// share that is synthesized on this frame.
        struct Share {
            int frame = 0;
            float weight = 0;
        };
        std::vector<Share> tracks;
        float made_anew = 0;
        std::optional<int> seam;  ///< Cost of the seam; empty: no seam.
        /// The patches that the seam joins, lower number first. Empty if there is no seam, or no
        /// other patch within kSeamReach texels.
        std::optional<std::pair<int, int>> seam_between;
        std::optional<float> light;  ///< Gain of the light.
    };
    static constexpr int kSeamReach = 3;
    [[nodiscard]] Answer at(Vec2 plate_pixel) const;
    /// The texel of the plane that the pixel shows.
    [[nodiscard]] Vec2 texel_at(Vec2 plate_pixel) const;

  private:
    /// Weight of the later track at a pixel; nothing if there is only one track.
    [[nodiscard]] std::optional<float> share_after(Vec2 plate_pixel) const;
    [[nodiscard]] Vec2 on_reference(Vec2 plate_pixel) const;
};

}  // namespace weft
