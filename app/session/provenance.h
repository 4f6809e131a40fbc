#pragma once
// Where a pixel of a result comes from.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/lighting/shading.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Of a grown texture plane: what each texel shows, and what seams cost there.
struct PlaneMap {
    Image<std::int32_t, 2> source;  ///< Place in the sample.
    Image<std::uint8_t, 1> which;   ///< Of several samples.
    Matte energy;                   ///< 0: no seam; from 48 on: a seam, the costlier the more.
    std::vector<std::string> samples;
    Image<std::uint8_t, 1> orientation;  ///< As in SampleAtlas::Page; empty: all upright.
};

/// Of one region on one frame. Immutable; asking it takes microseconds.
struct Provenance {
    LatticeField ref_from_cur;
    Mat3 plane_from_plate{1};
    std::shared_ptr<const PlaneMap> plane;  ///< Null: the texture is used as it is.
    std::string texture;                    ///< Name of the file.
    int reference_frame = 0;
    std::optional<Shading> shading;
    float reference_shading = 1;

    struct Answer {
        Vec2 on_reference;   ///< Plate pixel of the reference frame.
        Vec2 texel;          ///< Of the texture plane.
        std::string sample;  ///< File.
        std::optional<Vec2i> in_sample;
        std::optional<int> seam;     ///< Its cost there; empty: no seam.
        std::optional<float> light;  ///< Gain.
    };
    [[nodiscard]] Answer at(Vec2 plate_pixel) const;
};

}  // namespace weft
