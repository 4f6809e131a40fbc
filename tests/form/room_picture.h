#pragma once
// One picture of a tiled room, by rays: a floor, and a wall of stripes at the back.

#include <algorithm>
#include <cmath>

#include "engine/core/image.h"

namespace weft {

struct RoomPicture {
    static constexpr Size kSize{640, 360};

    double focal_px = 600;
    double pitch = 0.2, yaw = 0.3;  ///< Of the camera, radians: down, and to the right.
    Matte luma{kSize}, floor{kSize}, wall{kSize};

    RoomPicture() { draw(); }
    RoomPicture(double focal, double down, double right)
        : focal_px(focal), pitch(down), yaw(right) {
        draw();
    }

    /// A direction of the room (x right, y down, z to the back) in view space.
    [[nodiscard]] glm::dvec3 seen(const glm::dvec3& d) const {
        const double x = std::cos(yaw) * d.x - std::sin(yaw) * d.z,
                     z = std::sin(yaw) * d.x + std::cos(yaw) * d.z;
        return {x, std::cos(pitch) * d.y - std::sin(pitch) * z,
                std::sin(pitch) * d.y + std::cos(pitch) * z};
    }

  private:
    static constexpr int kSamples = 4;  // a pixel, along each side
    static constexpr double kFloor = 1.5, kBack = 5, kTile = 0.5, kJoint = 0.04;

    // A direction of view space in the room.
    [[nodiscard]] glm::dvec3 ray(double x, double y) const {
        const glm::dvec3 r((x - kSize.width / 2.0) / focal_px, (y - kSize.height / 2.0) / focal_px,
                           1);
        const double up = std::cos(pitch) * r.y + std::sin(pitch) * r.z,
                     z = std::cos(pitch) * r.z - std::sin(pitch) * r.y;
        return {std::cos(yaw) * r.x + std::sin(yaw) * z, up,
                std::cos(yaw) * z - std::sin(yaw) * r.x};
    }

    static bool joint(double place) {
        return place / kTile - std::floor(place / kTile) < kJoint / kTile;
    }

    void draw() {
        for (int y = 0; y < kSize.height; ++y)
            for (int x = 0; x < kSize.width; ++x)
                draw(x, y);
    }

    void draw(int x, int y) {
        double light = 0;
        int on_floor = 0;
        for (int k = 0; k < kSamples * kSamples; ++k) {
            const glm::dvec3 d =
                ray(x + (k % kSamples + 0.5) / kSamples, y + (k / kSamples + 0.5) / kSamples);
            const bool below = d.z <= 0 || (d.y > 0 && kFloor / d.y < kBack / d.z);
            const glm::dvec3 p = d * (below ? kFloor / d.y : kBack / d.z);
            if (below)
                light += joint(p.x) || joint(p.z) ? 60 : 170;
            else
                light += joint(p.x) || joint(p.y) ? 110 : 200;
            on_floor += below;
        }
        constexpr int kAll = kSamples * kSamples;
        luma.at(x, y) = static_cast<std::uint8_t>(light / kAll);
        floor.at(x, y) = static_cast<std::uint8_t>(255 * on_floor / kAll);
        wall.at(x, y) = static_cast<std::uint8_t>(255 - floor.at(x, y));
    }
};

}  // namespace weft
