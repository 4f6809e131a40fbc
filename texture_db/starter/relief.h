#pragma once
// Internal: a surface with height, colour and shine, rendered under a light.

#include <functional>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "texture_db/starter/starter.h"
#include "texture_db/starter/toolkit.h"

namespace weft::starter {

/// One place of a surface.
struct Texel {
    Rgb color;         ///< Albedo, sRGB-encoded.
    float height = 0;  ///< In sample pixels.
    float shine = 0;   ///< 0 matte … 1 mirror-like.
};

/// How a surface is lit.
struct Light {
    float azimuth_deg = 125;  ///< Direction that the light comes from: 90 top, 180 left.
    float elevation_deg = 45;
    float relief = 1;        ///< Factor on the heights.
    float occlusion = 0.6f;  ///< How dark hollows get.
    float gloss = 30;        ///< Exponent of the highlight.
    float highlight = 0.5f;
    float ambient = 0.35f;
    float grain = 0.008f;  ///< Of the camera.
};

/// A square of surface at twice the picture's resolution, with a border so that hollows and strands
/// at the edges are right.
class Relief {
  public:
    explicit Relief(int side_px);
    static constexpr int kFine = 2;
    static constexpr int kBorder_px = 8;

    [[nodiscard]] int side_px() const { return side_px_; }
    [[nodiscard]] int fine() const { return fine_; }
    [[nodiscard]] Texel& at(int x, int y) {
        return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(fine_) +
                       static_cast<std::size_t>(x)];
    }
    /// The place of a fine texel in sample pixels.
    [[nodiscard]] static float place(int i) {
        return (static_cast<float>(i) + 0.5f) / kFine - kBorder_px;
    }
    /// Calls make(x, y, texel) for every texel.
    template <class Make>
    void each(Make make) {
        for (int y = 0; y < fine_; ++y) {
            const float py = place(y);
            for (int x = 0; x < fine_; ++x)
                make(place(x), py, at(x, y));
        }
    }
    /// Lights it and averages to the picture.
    [[nodiscard]] ImageU8x3 photograph(const Light& light, std::uint32_t seed) const;

  private:
    int side_px_, fine_;
    std::vector<Texel> texels_;
};

/// A hair, blade or straw: a bent stroke drawn over what is below.
struct Strand {
    float x = 0, y = 0;           ///< Root, sample pixels.
    float angle = 0;              ///< Radians, 0 to the right, downwards positive.
    float length = 10, bend = 0;  ///< Bend: change of the angle over the length.
    float width = 1;
    Rgb root, tip;
    float lift = 1;      ///< Height at the tip above the root's.
    float taper = 0.8f;  ///< How much thinner the tip is.
    float base = 0;      ///< Height of the root.
};
void draw(Relief& relief, const Strand& strand);

/// Calls make(cell x, cell y) for the cells of `spacing` px that cover the relief and `reach` px
/// around it, row by row: the same order for every size of relief.
void scatter(const Relief& relief, float spacing, float reach,
             const std::function<void(int, int)>& make);

/// A family's result besides the surface.
struct Label {
    std::string name;
    std::vector<std::string> tags;
    Light light;
    StarterUnit unit;
};

}  // namespace weft::starter
