// Parts of a matte that are confirmed on the way of a walk.
#include "engine/mask/confirmed_part.h"

#include <gtest/gtest.h>

#include "engine/mask/matte_propagation.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;

Matte filled(Size size, const Recti& box) {
    Matte out(size);
    for (int y = box.y0; y < box.y1; ++y)
        std::fill(out.row(y) + box.x0, out.row(y) + box.x1, 255);
    return out;
}

TEST(ConfirmedPart, ReplacesTheCodesOfItsAreaOnly) {
    const Matte matte(4, 1, 10);
    ConfirmedPart part{Matte(4, 1, 200), Matte(4, 1)};
    part.area.at(1, 0) = 255;
    part.area.at(2, 0) = 127;
    const Matte out = with_confirmed(matte, part);
    EXPECT_EQ(out.at(0, 0), 10);
    EXPECT_EQ(out.at(1, 0), 200);
    EXPECT_EQ(out.at(2, 0), 10) << "not above half";
}

TEST(ConfirmedPlaces, MoveWithTheSurfaceAndCountFrames) {
    ConfirmedPlaces places;
    EXPECT_FALSE(places.any());
    const Size size{8, 4};
    places.add(filled(size, {2, 1, 4, 3}));
    const Recti area{1, 0, 8, 4};
    ImageF2 motion(area.size());
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 7; ++x)
            motion.pixel(x, y)[0] = -2;  // everything moves 2 px to the right
    places.move(motion, area);
    places.move(motion, area);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const bool there = x >= 6 && x < 8 && y >= 1 && y < 3;
            EXPECT_EQ(places.since().at(x, y), there ? 2 : kNeverConfirmed) << x << ", " << y;
        }
    }
    places.clear();
    EXPECT_FALSE(places.any());
}

TEST(MergePositions, CountFromWhatIsKnownOfEachPlace) {
    const Size size{64, 8};
    FramesSince before(size, kNeverConfirmed), after(size, kNeverConfirmed);
    for (int y = 0; y < 8; ++y) {
        for (int x = 32; x < 64; ++x)
            before.at(x, y) = 2;
    }
    const MergePlace between{14, 10, 20};
    EXPECT_FLOAT_EQ(merge_positions(between, {}, {}, size).at(0, 0), 0.4f);
    const ImageF1 one = merge_positions(between, before, {}, size);
    EXPECT_FLOAT_EQ(one.at(4, 4), 0.4f);
    EXPECT_FLOAT_EQ(one.at(60, 4), 0.25f) << "frame 14 lies between 12 and 20";
    EXPECT_GT(one.at(32, 4), one.at(60, 4)) << "no step where the part ends";
    EXPECT_LT(one.at(32, 4), one.at(4, 4));
    // Without a keyframe on one side only what is confirmed there has a say.
    const ImageF1 open = merge_positions({14, 10, std::nullopt}, {}, before, size);
    EXPECT_FLOAT_EQ(open.at(4, 4), 0);
    EXPECT_FLOAT_EQ(open.at(60, 4), 4.0f / 6);
    const ImageF1 early = merge_positions({14, std::nullopt, 20}, before, {}, size);
    EXPECT_FLOAT_EQ(early.at(4, 4), 1);
    EXPECT_FLOAT_EQ(early.at(60, 4), 0.25f);
}

// A disc of which only the left half was painted. Half way, the upper right quarter is confirmed.
class HalfPainted : public testing::Test {
  protected:
    [[nodiscard]] Matte half(int t) const {
        Matte out = scene.matte(t);
        for (int y = 0; y < out.height(); ++y)
            for (int x = static_cast<int>(scene.center(t).x); x < out.width(); ++x)
                out.at(x, y) = 0;
        return out;
    }
    [[nodiscard]] ConfirmedPart upper_right(int t) const {
        const Vec2 c = scene.center(t);
        const Recti area{static_cast<int>(c.x) - 4, 10, static_cast<int>(c.x) + 34,
                         static_cast<int>(c.y)};
        return {scene.matte(t), filled(scene.size, area)};
    }
    // The share of the true disc that is covered, in the quarter on this side.
    [[nodiscard]] double covered(const Matte& matte, int t, bool upper) const {
        const Matte truth = scene.matte(t);
        const Vec2 c = scene.center(t);
        double both = 0, all = 0;
        for (int y = 0; y < truth.height(); ++y) {
            for (int x = static_cast<int>(c.x) + 3; x < truth.width(); ++x) {
                if ((static_cast<float>(y) < c.y) != upper || truth.at(x, y) < 128) continue;
                all += 1;
                both += matte.at(x, y) >= 128 ? 1 : 0;
            }
        }
        return both / all;
    }
    std::vector<MatteEstimate> walk(bool confirm) const {
        MatteWalker walker(scene.frame(0), half(0));
        std::vector<MatteEstimate> out;
        for (int t = 1; t <= 8; ++t) {
            out.push_back(walker.advance(scene.frame(t), scene.prev_from_cur(t)));
            if (confirm && t == 4) out.back() = walker.confirm(upper_right(4));
        }
        return out;
    }

    DiscScene scene{.step = {1.2f, 0.3f}};
};

TEST_F(HalfPainted, GoesOnFromWhatIsConfirmed) {
    const auto plain = walk(false), with = walk(true);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(plain[k].matte, with[k].matte);
        EXPECT_TRUE(with[k].since.empty());
    }
    const ConfirmedPart part = upper_right(4);
    EXPECT_EQ(with[3].matte, with_confirmed(plain[3].matte, part)) << "nothing else changes there";
    EXPECT_LT(covered(plain[7].matte, 8, true), 0.7) << "the painted half is taken for all of it";
    EXPECT_GT(covered(with[7].matte, 8, true), 0.9);
    EXPECT_EQ(with[7].since.at(static_cast<int>(scene.center(8).x) + 14,
                               static_cast<int>(scene.center(8).y) - 12),
              4);
    EXPECT_GT(with[7].since_confidence, with[7].confidence);
    // Where the picture marks the edge, it stays where it was to a tenth of a pixel.
    for (int y = 0; y < scene.size.height; ++y) {
        for (int x = 0; x < static_cast<int>(scene.center(8).x) - 14; ++x)
            ASSERT_NEAR(with[7].matte.at(x, y), plain[7].matte.at(x, y), 25) << x << ", " << y;
    }
}

TEST_F(HalfPainted, AWalkBackKnowsOnlyWhatWasConfirmed) {
    const ConfirmedPart part = upper_right(4);
    MatteWalker back(scene.frame(4), part.matte);
    const MatteEstimate start = back.confirm(part);
    EXPECT_EQ(start.matte, part.matte);
    // The same scene backwards: the true motion from frame 3 to 4 is that from 4 to 3, reversed.
    FlowField motion(scene.size);
    const Matte disc = scene.matte(3);
    for (int y = 0; y < scene.size.height; ++y) {
        for (int x = 0; x < scene.size.width; ++x) {
            motion.d.at(x, y, 0) = disc.at(x, y) >= 128 ? scene.step.x : 0;
            motion.d.at(x, y, 1) = disc.at(x, y) >= 128 ? scene.step.y : 0;
        }
    }
    const MatteEstimate found = back.advance(scene.frame(3), motion);
    const MatteEstimate before{walk(false)[2]};
    const MatteEstimate merged =
        merge_estimates(before, found, {3, 0, std::nullopt}, scene.frame(3));
    EXPECT_GT(covered(merged.matte, 3, true), covered(before.matte, 3, true) + 0.2);
    for (int y = static_cast<int>(scene.center(3).y) + 12; y < scene.size.height; ++y)
        for (int x = 0; x < scene.size.width; ++x)
            ASSERT_EQ(merged.matte.at(x, y), before.matte.at(x, y)) << "far from what is confirmed";
}

}  // namespace
}  // namespace weft
