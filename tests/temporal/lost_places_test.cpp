#include "engine/temporal/lost_places.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kLostFrame{256, 176};

Matte all() {
    return draw(kLostFrame, [](Vec2) { return 1.0f; });
}

// How far a fold carries the places of the frame: up to 9 px in its middle.
Vec2 fold(Vec2 p) {
    const float from_middle = distance(p, {170, 90});
    return Vec2(9, -4) * std::exp(-from_middle * from_middle / (2 * 26 * 26));
}

LatticeField folded() {
    LatticeField out(kLostFrame, 8);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, fold(out.node_position(i, j)));
    }
    return out;
}

std::shared_ptr<const StepFrame> step_frame(const Matte& luma) {
    return std::make_shared<const StepFrame>(luma, all(), all());
}

LostPlaces with_noise(double residual) {
    LostPlaces places;
    places.note({residual, 0.95});
    return places;
}

TEST(LostPlaces, FindsAFoldThatIsBeyondTheReachOfRegistration) {
    const WaveTexture texture(5);
    const Anchor anchor{step_frame(draw(kLostFrame, texture)), LatticeField(kLostFrame, 8)};
    const auto cur = step_frame(draw(kLostFrame, [&](Vec2 p) { return texture(p + fold(p)); }));
    const Registered near =
        register_against(anchor, *cur, false, LatticeField(kLostFrame, 8), FlowQuality::kDraft);
    const Vec2 middle(170, 90);
    ASSERT_GT(distance(near.anchor_from_cur.at(middle), fold(middle)), 3);
    const auto wider = with_noise(0.05).find(anchor, *cur, {}, near, FlowQuality::kDraft);
    ASSERT_TRUE(wider);
    for (const Vec2 p : {middle, Vec2(150, 70), Vec2(190, 110), Vec2(60, 60)})
        EXPECT_LT(distance(wider->anchor_from_cur.at(p), fold(p)), 0.5f);
}

TEST(LostPlaces, DoesNotLookWhereOnlyNoiseIsLeft) {
    const WaveTexture texture(5);
    const Anchor anchor{step_frame(draw(kLostFrame, texture)), LatticeField(kLostFrame, 8)};
    const auto cur = step_frame(draw(kLostFrame, [&](Vec2 p) { return texture(p + fold(p)); }));
    const Registered found = register_against(anchor, *cur, false, folded(), FlowQuality::kDraft);
    EXPECT_FALSE(with_noise(found.fit.residual).find(anchor, *cur, {}, found, FlowQuality::kDraft));
}

TEST(LostPlaces, DoesNotTakeAnotherPictureForTheSurface) {
    const WaveTexture texture(5), other(6);
    const Anchor anchor{step_frame(draw(kLostFrame, texture)), LatticeField(kLostFrame, 8)};
    const auto cur = step_frame(draw(kLostFrame, other));
    const Registered found =
        register_against(anchor, *cur, false, LatticeField(kLostFrame, 8), FlowQuality::kDraft);
    EXPECT_FALSE(with_noise(0.05).find(anchor, *cur, {}, found, FlowQuality::kDraft));
}

// A faint plane that stands still, under shades that wander off: they are found again where they
// went to, and the paint is not.
TEST(LostPlaces, DoesNotFollowShades) {
    const WaveTexture paint(5), leaves(8);
    const auto lit = [&](Vec2 p, Vec2 wind) {
        const float shade = std::clamp(2.2f * leaves((p + wind) * 0.6f) - 0.6f, 0.0f, 1.0f);
        return (0.75f + 0.25f * paint(p)) * (0.35f + 0.5f * shade);
    };
    const Anchor anchor{step_frame(draw(kLostFrame,
                                        [&](Vec2 p) {
                                            return lit(p, {0, 0});
                                        })),
                        LatticeField(kLostFrame, 8)};
    const auto cur = step_frame(draw(kLostFrame, [&](Vec2 p) {
        return lit(p, {7 * std::sin(p.y / 40), 9 * std::cos(p.x / 50)});
    }));
    const Registered found =
        register_against(anchor, *cur, false, LatticeField(kLostFrame, 8), FlowQuality::kDraft);
    EXPECT_FALSE(with_noise(0.12).find(anchor, *cur, {}, found, FlowQuality::kDraft));
}

}  // namespace
}  // namespace weft
