#include "engine/pipeline/shown_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

using ::testing::ElementsAre;

// Pictures of a scene: 'a' and 'b' pan slowly, 'k' is black, 'w' white, 'd' scene a under a fifth
// of the light.
ImageF3 picture(char scene, int frame) {
    const WaveTexture wave(scene == 'b' ? 77 : 21);
    ImageF3 out(kShotSize);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const Vec2 p = 0.5f * centre_of(x, y) + Vec2(frame, 0);
            float v = static_cast<float>(code_of(wave(p))) / 255.0f;
            if (scene == 'b') v = y < 50 ? 0.05f : 0.6f + 0.4f * v;
            if (scene == 'd') v *= 0.4f;
            if (scene == 'k') v = 0.01f * v;
            if (scene == 'w') v = 1;
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = v;
        }
    }
    return out;
}

struct Walked {
    std::vector<int> seen, cuts;
};

Walked run(const std::string& scenes) {
    const auto views_of = [&](int frame) {
        const ImageF3 plate = picture(scenes[static_cast<std::size_t>(frame)], frame);
        return std::make_shared<const PlateViews>(make_views(plate, *color("srgb", "srgb")));
    };
    const int count = static_cast<int>(scenes.size());
    ShownFrames shown;
    Walked out;
    for (int frame = 0; frame < count; ++frame) {
        const auto peek = [&](int ahead) -> Expected<ShownFrames::Seen> {
            if (frame + ahead >= count) return ShownFrames::Seen{};
            return ShownFrames::Seen{frame + ahead, views_of(frame + ahead), false};
        };
        const auto seen = shown.next({frame, views_of(frame), false}, peek);
        EXPECT_TRUE(seen);
        out.seen.push_back(seen->frame);
        if (seen->cut) out.cuts.push_back(frame);
    }
    return out;
}

TEST(ShownFrames, WhatShowsNothingIsPassedOver) {
    EXPECT_THAT(run("aakka").seen, ElementsAre(0, 1, 1, 1, 4));
    EXPECT_THAT(run("aawaa").seen, ElementsAre(0, 1, 1, 3, 4));
    EXPECT_THAT(run("aadaa").seen, ElementsAre(0, 1, 2, 3, 4)) << "dim is not black";
}

TEST(ShownFrames, AShotThatBeginsBlackIsSeenFromItsFirstPicture) {
    EXPECT_THAT(run("kkaa").seen, ElementsAre(2, 2, 2, 3));
    EXPECT_THAT(run("kkk").seen, ElementsAre(0, 1, 2)) << "there is nothing else";
}

TEST(ShownFrames, AnotherSceneIsACutUnlessItIsBrief) {
    const Walked cut = run("aabbbb");
    EXPECT_THAT(cut.seen, ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(cut.cuts, ElementsAre(2));
    const Walked flash = run("aabbaa");
    EXPECT_THAT(flash.seen, ElementsAre(0, 1, 1, 1, 4, 5));
    EXPECT_THAT(flash.cuts, ElementsAre());
    EXPECT_THAT(run("aakkbb").cuts, ElementsAre(4)) << "a cut through black";
}

TEST(ShownFrames, MotionIsKeptBetweenNeighboursOnly) {
    const auto views_of = [](char scene, int frame) {
        return make_views(picture(scene, frame), *color("srgb", "srgb"));
    };
    EXPECT_TRUE(are_neighbours(views_of('a', 1), views_of('a', 2)));
    EXPECT_FALSE(are_neighbours(views_of('a', 1), views_of('k', 2)));
    EXPECT_FALSE(are_neighbours(views_of('a', 1), views_of('b', 2)));
}

}  // namespace
}  // namespace weft
