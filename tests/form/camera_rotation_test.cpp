#include "engine/form/camera_rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr Size kPlate{160, 96};
constexpr double kSceneFov_deg = 48.5;

// A camera at `eye` that looks at `target`, as it shows places of a world with z upwards.
struct Scene {
    glm::dvec3 right, up, back, eye;

    Scene(glm::dvec3 at, glm::dvec3 target) : eye(at) {
        back = glm::normalize(at - target);
        right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), back));
        up = glm::cross(back, right);
    }
    [[nodiscard]] std::array<double, 9> rotation() const {
        return {right.x, right.y, right.z, up.x, up.y, up.z, back.x, back.y, back.z};
    }
    // What `depth(x, y)` along each pixel's axis shows.
    template <class Depth>
    [[nodiscard]] ImageF3 places(const Depth& depth) const {
        const ViewCamera camera = camera_with(kSceneFov_deg, kPlate);
        ImageF3 out(kPlate);
        for (int y = 0; y < kPlate.height; ++y) {
            for (int x = 0; x < kPlate.width; ++x) {
                const auto ray =
                    camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
                const glm::dvec3 way = ray.x * right - ray.y * up - back;
                const glm::dvec3 place = eye + depth(way, x, y) * way;
                for (int c = 0; c < 3; ++c)
                    out.pixel(x, y)[c] = static_cast<float>(place[c]);
            }
        }
        return out;
    }
};

void expect_rotation(const ImageF3& places, const Scene& scene) {
    const auto found = camera_rotation(places, camera_with(kSceneFov_deg, kPlate));
    ASSERT_TRUE(found);
    for (std::size_t k = 0; k < 9; ++k)
        EXPECT_NEAR((*found)[k], scene.rotation()[k], 1e-3) << k;
}

TEST(CameraRotation, OfPlacesInSpace) {
    const Scene scene({1, -7, 2}, {0, 0, 0.5});
    expect_rotation(scene.places([](const glm::dvec3&, int x, int y) {
        return 6 + std::sin(0.1 * x) + 0.5 * std::cos(0.13 * y);
    }),
                    scene);
}

TEST(CameraRotation, OfPlacesOnOnePlane) {
    const Scene scene({1, -7, 2}, {0, 0, 0.5});
    // The floor at z = −1 where it is seen; elsewhere nothing.
    expect_rotation(scene.places([&](const glm::dvec3& way, int, int) {
        const double depth = (-1 - scene.eye.z) / way.z;
        return depth > 0 ? depth : std::numeric_limits<double>::quiet_NaN();
    }),
                    scene);
}

TEST(CameraRotation, IsUnknownWherePlacesDoNotFit) {
    const ViewCamera camera = camera_with(kSceneFov_deg, kPlate);
    const Scene scene({1, -7, 2}, {0, 0, 0.5});
    const ImageF3 places = scene.places(
        [](const glm::dvec3&, int x, int y) { return 6 + std::sin(0.1 * x) + std::cos(0.2 * y); });
    EXPECT_FALSE(camera_rotation(places, camera_with(80, kPlate))) << "another field of view";
    EXPECT_FALSE(camera_rotation(ImageF3(kPlate, 1.0f), camera)) << "one place";
    EXPECT_FALSE(camera_rotation(ImageF3(kPlate, std::numeric_limits<float>::infinity()), camera));
}

}  // namespace
}  // namespace weft
