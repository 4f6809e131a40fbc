#pragma once
// What the places of a scene have shown, and whose it was.

#include <cstddef>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// A colour that a place has shown, code values in the light of the keyframe.
struct PlaceMode {
    Vec3 color{0};
    float frames = 0, inside = 0;  ///< Seen, and of these the surface's.
    bool of_key = false;           ///< The keyframe shows it.
};

/// The two colours that a place has shown most (a mixture as that of Stauffer & Grimson 1999, of
/// two modes), and whose it was whatever it showed.
struct ScenePlace {
    PlaceMode usual, other;
    float frames = 0, inside = 0;

    /// One more frame in which nothing moved there. `same_levels`: colours that differ by less are
    /// one. `is_usual`: false where the places around it show that something else is there.
    void see(const PlaceMode& seen, float same_levels, bool is_usual);
    /// It is known to have been inside, or outside, all along.
    void correct(bool is_inside);
};

/// The places of a scene, in pixels of its reduced keyframe and as far as half a frame beyond it.
class ScenePlaces {
  public:
    explicit ScenePlaces(Size frame);

    [[nodiscard]] Size size() const { return {2 * frame_.width, 2 * frame_.height}; }
    /// Where pixel (0, 0) of the keyframe lies.
    [[nodiscard]] Vec2i origin() const { return {frame_.width / 2, frame_.height / 2}; }
    [[nodiscard]] ScenePlace& at(Vec2i place) { return places_[index_of(place)]; }
    /// Null if it has not been seen, or is none.
    [[nodiscard]] const ScenePlace* known(Vec2i place) const;
    [[nodiscard]] bool has(Vec2i place) const {
        return place.x >= 0 && place.y >= 0 && place.x < size().width && place.y < size().height;
    }

  private:
    [[nodiscard]] std::size_t index_of(Vec2i place) const {
        return static_cast<std::size_t>(place.y) * static_cast<std::size_t>(size().width) +
               static_cast<std::size_t>(place.x);
    }

    Size frame_;
    std::vector<ScenePlace> places_;  // row by row
};

/// The mean difference of two colours' channels, code values.
[[nodiscard]] float color_difference(Vec3 a, Vec3 b);

}  // namespace weft
