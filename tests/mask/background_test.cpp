#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "engine/mask/background_motion.h"
#include "engine/mask/background_plate.h"
#include "engine/mask/signed_distance.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;

ImageF1 distance_of(ViewU8x1 matte) {
    return signed_distance(inside_of(matte), 40);
}

Recti whole(Size s) {
    return {0, 0, s.width, s.height};
}

// A camera that turns and comes nearer, and a disc with a motion of its own.
Vec2 camera_motion(int x, int y) {
    return {3 - 0.02f * static_cast<float>(x), -1.5f + 0.01f * static_cast<float>(y)};
}

FlowField scene_motion(const DiscScene& scene) {
    FlowField flow(scene.size);
    const Matte disc = scene.matte(1);
    for (int y = 0; y < scene.size.height; ++y) {
        for (int x = 0; x < scene.size.width; ++x) {
            const Vec2 d = disc.at(x, y) >= 128 ? -scene.step : camera_motion(x, y);
            flow.d.at(x, y, 0) = d.x;
            flow.d.at(x, y, 1) = d.y;
        }
    }
    return flow;
}

TEST(BackgroundMotion, IsContinuedBehindTheShape) {
    DiscScene scene;
    scene.step = Vec2(6, -4);
    const ImageF2 motion = background_motion(distance_of(scene.matte(0)), scene_motion(scene), 6);
    for (int y = 4; y < scene.size.height - 4; y += 8) {
        for (int x = 4; x < scene.size.width - 4; x += 8) {
            const Vec2 miss = Vec2(motion.at(x, y, 0), motion.at(x, y, 1)) - camera_motion(x, y);
            EXPECT_LT(glm::length(miss), 0.1f) << x << "," << y;
        }
    }
}

TEST(BackgroundMotion, IsTheSameOnAnyNumberOfThreads) {
    const DiscScene scene;
    const auto motion = [&] {
        return background_motion(distance_of(scene.matte(0)), scene_motion(scene), 6);
    };
    set_thread_count(1);
    const ImageF2 one = motion();
    set_thread_count(3);
    const ImageF2 three = motion();
    set_thread_count(0);
    EXPECT_EQ(one, three);
}

TEST(BackgroundPlate, TellsTheShapeFromWhatItStoodBefore) {
    const DiscScene scene;
    BackgroundPlate plate(scene.frame(0), distance_of(scene.matte(0)));
    for (int t = 1; t <= 12; ++t) {  // the disc moves by 28 px, the camera stands
        plate.move(ImageF2(scene.size));
        if (t < 12) plate.update(scene.frame(t), distance_of(scene.matte(t)));
    }
    // Expected where it was long ago: right at neither edge.
    const ImageF1 expected = distance_of(scene.matte(6));
    const ImageF1 odds = plate.odds(scene.frame(12), expected, {}, whole(scene.size));
    const ImageF1 truth = distance_of(scene.matte(12)), began = distance_of(scene.matte(0));
    int wrong = 0, told = 0, never_seen = 0;
    for (int y = 0; y < scene.size.height; ++y) {
        for (int x = 0; x < scene.size.width; ++x) {
            if (began.at(x, y) > 2 && truth.at(x, y) > 2) {
                EXPECT_EQ(odds.at(x, y), 0);  // what lies there has never been seen
                ++never_seen;
                continue;
            }
            if (odds.at(x, y) == 0 || std::abs(truth.at(x, y)) < 2) continue;
            ++told;
            wrong += (odds.at(x, y) > 0) != (truth.at(x, y) > 0) ? 1 : 0;
        }
    }
    EXPECT_GT(never_seen, 50);
    EXPECT_GT(told, 10000);
    EXPECT_LT(wrong, told / 20);
}

// Where everything outside differs from what was seen, as on water, differences say nothing.
TEST(BackgroundPlate, IsSilentWhereTheBackgroundItselfChanges) {
    const DiscScene scene;
    BackgroundPlate plate(scene.frame(0), distance_of(scene.matte(0)));
    plate.move(ImageF2(scene.size));
    ImageU8x3 frame = scene.frame(1);
    Rng rng(5);
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            const auto change = static_cast<int>(rng.below(120)) - 60;
            for (int c = 0; c < 3; ++c)
                frame.at(x, y, c) =
                    static_cast<std::uint8_t>(std::clamp(frame.at(x, y, c) + change, 0, 255));
        }
    }
    const ImageF1 expected = distance_of(scene.matte(0));
    const ImageF1 calm = plate.odds(scene.frame(1), expected, {}, whole(scene.size));
    const ImageF1 odds = plate.odds(frame, expected, {}, whole(scene.size));
    double mean_calm = 0, mean = 0;
    int n = 0, taken_for_surface = 0;
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            if (expected.at(x, y) > -4) continue;
            mean_calm += static_cast<double>(calm.at(x, y));
            mean += static_cast<double>(odds.at(x, y));
            taken_for_surface += odds.at(x, y) > 1 ? 1 : 0;
            ++n;
        }
    }
    EXPECT_LT(mean_calm / n, -1.5);
    EXPECT_GT(mean / n, mean_calm / n + 0.5);
    EXPECT_LT(taken_for_surface, n / 50);
}

}  // namespace
}  // namespace weft
