#pragma once
// Where a pixel of a result comes from.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/lighting/shading.h"
#include "engine/motion/lattice_field.h"
#include "engine/temporal/history_seam.h"
#include "engine/temporal/temporal_mode.h"

namespace weft {

/// Of a grown texture plane: what each texel shows, and what seams cost there.
struct PlaneMap {
    Image<std::int32_t, 2> source;  ///< Place in the sample.
    Image<std::uint8_t, 1> which;   ///< Of several samples.
    Matte energy;                   ///< 0: no seam; from 48 on: a seam, the costlier the more.
    std::vector<std::string> samples;
    std::vector<std::string> ids;  ///< Of the samples: in their library, else of their pixels.
    Image<std::uint8_t, 1> orientation;  ///< As in SampleAtlas::Page; empty: all upright.
    Image<std::int32_t, 1> patch;        ///< Number of the patch, from 1 (number_patches()).
};

/// How a frame between two references takes its texture from both.
struct TwoTracks {
    int before = 0, after = 0;  ///< The references.
    float share_after = 0;      ///< Where there is no seam.
    struct Seam {
        HistorySeam labels;  ///< Of this frame alone.
        LatticeField before, after;
    };
    std::optional<Seam> seam;  ///< Where they do not agree: each place shows one of them.
};

/// Of one region on one frame. Immutable; asking it takes microseconds.
struct Provenance {
    LatticeField ref_from_cur;
    Mat3 plane_from_plate{1};
    std::shared_ptr<const PlaneMap> plane;  ///< Null: the texture is used as it is.
    std::string texture, texture_id;        ///< Name of the file; as PlaneMap::ids.
    int reference_frame = 0;                ///< In whose pixels `on_reference` is.
    int frame = 0;
    int track_frame = 0;  ///< The reference that this frame was followed from.
    std::optional<TwoTracks> two;
    TemporalMode temporal = TemporalMode::kLocked;
    float fresh = 1;  ///< α of the paper's mode.
    std::optional<Shading> shading;
    float reference_shading = 1;

    struct Answer {
        Vec2 on_reference;              ///< Plate pixel of the reference frame.
        Vec2 texel;                     ///< Of the texture plane.
        std::string sample, sample_id;  ///< File, and its id.
        std::optional<Vec2i> in_sample;
        std::optional<int> patch;  ///< Its number.
        /// Where the texture was carried from, and with what weight; they add up to 1 but for what
        /// is made anew on this frame.
        struct Share {
            int frame = 0;
            float weight = 0;
        };
        std::vector<Share> histories;
        float made_anew = 0;
        std::optional<int> seam;  ///< Its cost there; empty: no seam.
        /// The patches that the seam joins, the lower number first: its name. Empty where there is
        /// no seam, or the other patch is not within kSeamReach texels.
        std::optional<std::pair<int, int>> seam_between;
        std::optional<float> light;  ///< Gain.
    };
    static constexpr int kSeamReach = 3;
    [[nodiscard]] Answer at(Vec2 plate_pixel) const;
    /// Place of the texture plane that the pixel shows.
    [[nodiscard]] Vec2 texel_at(Vec2 plate_pixel) const;

  private:
    /// The share of the history after at a pixel; nothing where there is one history.
    [[nodiscard]] std::optional<float> share_after(Vec2 plate_pixel) const;
    [[nodiscard]] Vec2 on_reference(Vec2 plate_pixel) const;
};

}  // namespace weft
