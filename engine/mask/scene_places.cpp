#include "engine/mask/scene_places.h"

#include <glm/common.hpp>
#include <utility>

namespace weft {
namespace {

constexpr float kLongest = 30;  // frames that a place remembers

void count(bool is_inside, float& frames, float& inside) {
    if (frames < kLongest)
        frames += 1;
    else
        inside *= 1 - 1 / kLongest;
    inside += is_inside ? 1.0f : 0.0f;
}

}  // namespace

float color_difference(Vec3 a, Vec3 b) {
    const Vec3 d = glm::abs(a - b);
    return (d.x + d.y + d.z) / 3;
}

void ScenePlace::see(const PlaceMode& seen, float same_levels, bool is_usual) {
    const bool is_inside = seen.inside > 0;
    count(is_inside, frames, inside);
    for (PlaceMode* mode : {&usual, &other}) {
        if (mode->frames == 0 || (mode == &usual && !is_usual)) continue;
        if (color_difference(seen.color, mode->color) > same_levels) continue;
        count(is_inside, mode->frames, mode->inside);
        mode->color += (seen.color - mode->color) / mode->frames;
        if (other.frames > 0 && other.frames >= usual.frames) std::swap(usual, other);
        return;
    }
    (usual.frames == 0 ? usual : other) = seen;
}

void ScenePlace::correct(bool is_inside) {
    for (PlaceMode* mode : {&usual, &other})
        mode->inside = is_inside ? mode->frames : 0.0f;
    inside = is_inside ? frames : 0.0f;
}

ScenePlaces::ScenePlaces(Size frame)
    : frame_(frame),
      places_(4 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height)) {}

const ScenePlace* ScenePlaces::known(Vec2i place) const {
    if (!has(place)) return nullptr;
    const ScenePlace& found = places_[index_of(place)];
    return found.frames > 0 ? &found : nullptr;
}

}  // namespace weft
