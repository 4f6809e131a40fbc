// What a walk has seen all the way from its keyframe, and what it guesses.
#include "engine/mask/followed.h"

#include <gtest/gtest.h>

#include "engine/mask/matte_propagation.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/uncovered.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;

constexpr float kFollowedLimit_px = 30;

ImageF1 disc_distance(const DiscScene& scene, int t) {
    return signed_distance(inside_of(scene.matte(t)), kFollowedLimit_px);
}

ImageF2 steady_motion(Size size, Vec2 d) {
    ImageF2 field(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            field.pixel(x, y)[0] = d.x;
            field.pixel(x, y)[1] = d.y;
        }
    }
    return field;
}

DiscScene fast_disc() {
    DiscScene scene;
    scene.step = {6, 0};
    return scene;
}

TEST(Followed, WhatASurfaceUncoversIsGuessed) {
    const DiscScene scene = fast_disc();
    Followed followed(scene.size);
    const ImageF1 before = disc_distance(scene, 0), now = disc_distance(scene, 1);
    const FlowField flow = scene.prev_from_cur(1);
    const Matte parting = parting_pixels(flow, rect_of(scene.size));
    const ImageF2 surface = steady_motion(scene.size, -scene.step);
    followed.advance({flow, parting, surface, rect_of(scene.size), before, now});
    const auto y = static_cast<int>(scene.start.y);
    const auto left = static_cast<int>(scene.start.x - scene.radius_px);
    EXPECT_EQ(followed.known().at(left + 3, y), 0) << "uncovered";
    EXPECT_EQ(followed.known().at(left - 10, y), Followed::kKnown) << "was seen before";
    EXPECT_EQ(followed.known().at(left + 20, y), Followed::kKnown) << "the surface";
}

TEST(Followed, WhatBecomesSurfaceIsGuessedAlsoWhereItWasSeen) {
    const DiscScene scene;
    DiscScene larger = scene;
    larger.radius_px += 8;
    Followed followed(scene.size);
    const FlowField flow = scene.prev_from_cur(1);
    const Matte parting = parting_pixels(flow, rect_of(scene.size));
    const ImageF2 surface = steady_motion(scene.size, -scene.step);
    followed.advance({flow, parting, surface, rect_of(scene.size), disc_distance(scene, 0),
                      disc_distance(larger, 1)});
    const Vec2 center = scene.center(1);
    const auto x = static_cast<int>(center.x + scene.radius_px + 4);
    EXPECT_EQ(followed.known().at(x, static_cast<int>(center.y)), 0);
    Matte confirmed(scene.size, 255);
    followed.know(confirmed);
    EXPECT_EQ(followed.known().at(x, static_cast<int>(center.y)), Followed::kKnown);
}

TEST(Followed, WhatIsFoundAgainElsewhereIsGuessed) {
    const DiscScene scene;
    Followed followed(scene.size);
    const FlowField flow = scene.prev_from_cur(1);
    const Matte parting = parting_pixels(flow, rect_of(scene.size));
    // The surface was expected in the left quarter, and is found beside it.
    const Recti expected{0, 0, scene.size.width / 4, scene.size.height};
    const ImageF2 surface = steady_motion(expected.size(), -scene.step);
    followed.advance(
        {flow, parting, surface, expected, disc_distance(scene, 0), disc_distance(scene, 1)});
    const Vec2 center = scene.center(1);
    EXPECT_EQ(followed.known().at(static_cast<int>(center.x), static_cast<int>(center.y)), 0);
}

// Near the second keyframe, where by their places in time the walk back from it decides, since the
// picture tells nothing.
TEST(MergeEstimates, WhatIsKnownCountsForMoreThanWhatIsGuessed) {
    const DiscScene scene;
    DiscScene wrong = scene;
    wrong.start += Vec2(9, 5);
    MatteEstimate before{scene.matte(0), 0.8f}, after{wrong.matte(0), 0.8f};
    const MergePlace place{8, 0, 10};
    const ImageU8x3 blank(scene.size, 120);
    const auto overlap_now = [&] {
        return test::overlap(merge_estimates(before, after, place, blank).matte, scene.matte(0));
    };
    EXPECT_LT(overlap_now(), 0.9) << "by the places in time alone";
    before.followed = Matte(scene.size, Followed::kKnown);
    after.followed = Matte(scene.size);
    EXPECT_GT(overlap_now(), 0.96);
    before.followed = Matte(scene.size);
    EXPECT_LT(overlap_now(), 0.9) << "neither knows";
}

}  // namespace
}  // namespace weft
