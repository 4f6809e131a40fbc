#include "engine/motion/scene_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kSceneSize{120, 75};
constexpr int kSceneFrames = 24;
constexpr Vec2 kPan{1.5f, -0.5f};  // px from frame to frame

const WaveTexture& scene_of_walk() {
    static const WaveTexture scene(3);
    return scene;
}
const WaveTexture& scene_alike() {
    static const WaveTexture scene(4);
    return scene;
}

// `value(scene, other, t, place)`: what shows of a panning scene and of one that looks alike, at a
// place that pans with them. Returns the first frame on which the scene is another one;
// kSceneFrames if none is.
int first_other(const std::function<float(float, float, int, Vec2)>& value) {
    SceneWatch watch;
    FlowField motion(kSceneSize);
    for (int y = 0; y < kSceneSize.height; ++y) {
        for (int x = 0; x < kSceneSize.width; ++x)
            motion.d.pixel(x, y)[0] = -kPan.x, motion.d.pixel(x, y)[1] = -kPan.y;
    }
    int first = kSceneFrames;
    for (int t = 0; t < kSceneFrames; ++t) {
        const Matte luma = draw(kSceneSize, [&](Vec2 p) {
            const Vec2 q = p - static_cast<float>(t) * kPan;
            return value(scene_of_walk()(q), scene_alike()(q), t, q);
        });
        const auto frame =
            std::make_shared<const SceneFrame>(scene_frame(luma, t > 0 ? motion : FlowField()));
        if (!watch.still_shows(frame)) first = std::min(first, t);
    }
    return first;
}

TEST(SceneWatch, APanAndFadesShowTheSameScene) {
    EXPECT_EQ(first_other([](float a, float, int, Vec2) { return a; }), kSceneFrames);
    const auto fade = [](int t) { return std::max(0.0f, 1 - 0.06f * static_cast<float>(t)); };
    EXPECT_EQ(first_other([&](float a, float, int t, Vec2) { return a * fade(t); }), kSceneFrames);
    EXPECT_EQ(first_other([&](float a, float, int t, Vec2) { return 1 - (1 - a) * fade(t); }),
              kSceneFrames);
}

TEST(SceneWatch, ACutBetweenScenesThatLookAlikeIsSeenAtOnce) {
    EXPECT_EQ(first_other([](float a, float b, int t, Vec2) { return t < 10 ? a : b; }), 10);
}

TEST(SceneWatch, ADissolveIsSeenBeforeItsEnd) {
    for (const int length : {6, 12}) {
        const int first = first_other([&](float a, float b, int t, Vec2) {
            const float share =
                std::clamp(static_cast<float>(t - 9) / static_cast<float>(length), 0.0f, 1.0f);
            return a * (1 - share) + b * share;
        });
        EXPECT_GT(first, 10 + length / 3) << length;
        EXPECT_LE(first, 12 + length) << length;
    }
}

TEST(SceneWatch, WhatChangesPatchByPatchIsAFastMove) {
    // As the ground does before a fast car: within twelve frames nothing is left of the first, but
    // nothing was ever a mixture.
    EXPECT_EQ(first_other([](float a, float b, int t, Vec2 q) {
                  const int patch =
                      static_cast<int>(std::floor(q.x / 30) * 5 + std::floor(q.y / 30) * 7 + 1200) %
                      12;
                  return t - 6 > patch ? b : a;
              }),
              kSceneFrames);
}

TEST(SceneWatch, AnotherSceneStaysOne) {
    SceneWatch watch;
    const auto seen = [&](const WaveTexture& scene) {
        return watch.still_shows(std::make_shared<const SceneFrame>(
            scene_frame(draw(kSceneSize, scene), FlowField(kSceneSize))));
    };
    EXPECT_TRUE(seen(scene_of_walk()));
    EXPECT_FALSE(seen(scene_alike()));
    EXPECT_FALSE(seen(scene_alike()));
}

}  // namespace
}  // namespace weft
