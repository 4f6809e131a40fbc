// A square drives over a still ground; two walks disagree about it on the way.
#include "engine/mask/joint_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace weft {
namespace {

constexpr Size kJointFrame{320, 180};
constexpr int kJointLast = 8;  // the keyframes are 0 and this
constexpr Vec2i kDrive{6, 0};
constexpr Recti kSquareAtStart{60, 60, 120, 120};
constexpr Recti kGroundPart{160, 20, 200, 50};
constexpr float kHalf = 0.5f;

Recti square_on(int frame) {
    return {kSquareAtStart.x0 + frame * kDrive.x, kSquareAtStart.y0,
            kSquareAtStart.x1 + frame * kDrive.x, kSquareAtStart.y1};
}

ImageU8x3 joint_picture(int frame) {
    ImageU8x3 out(kJointFrame);
    for (int y = 0; y < kJointFrame.height; ++y) {
        for (int x = 0; x < kJointFrame.width; ++x) {
            const bool square = square_on(frame).contains(x, y);
            const int u = square ? x - frame * kDrive.x : x + 7;
            const auto code = static_cast<std::uint8_t>(100 + (u * 13 + y * 29) % 23);
            const auto green = static_cast<std::uint8_t>(square ? code : 255 - code);
            const std::array<std::uint8_t, 3> color{code, green, 90};
            std::copy(color.begin(), color.end(), out.pixel(x, y));
        }
    }
    return out;
}

Matte joint_matte(const Recti& area) {
    Matte out(kJointFrame);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            out.at(x, y) = 255;
    return out;
}

// To the frame after, as a walk back measures it.
FlowField next_from(int frame) {
    FlowField out(kJointFrame);
    const Recti square = square_on(frame);
    for (int y = square.y0; y < square.y1; ++y)
        for (int x = square.x0; x < square.x1; ++x)
            out.d.pixel(x, y)[0] = kDrive.x;
    return out;
}

class JointWalks : public ::testing::Test {
  protected:
    JointWalks() {
        for (int f = 0; f <= kJointLast; ++f)
            before_.push_back(joint_matte(square_on(f))), after_.push_back(before_.back());
    }
    void add_ground(Matte& matte) const {
        for (int y = kGroundPart.y0; y < kGroundPart.y1; ++y)
            for (int x = kGroundPart.x0; x < kGroundPart.x1; ++x)
                matte.at(x, y) = 255;
    }
    // Without the upper half of the square.
    static Matte half_lost(int frame) {
        Recti part = square_on(frame);
        part.y0 = (part.y0 + part.y1) / 2;
        return joint_matte(part);
    }
    void decide(float share = kHalf) {
        joint_ = {};
        for (const int key : {0, kJointLast})
            joint_.remember(joint_picture(key), joint_matte(square_on(key)));
        const ImageF1 shares(kJointFrame, share);
        for (int f = kJointLast; f >= 0; --f) {
            const bool key = f == 0 || f == kJointLast;
            const ImageU8x3 picture = joint_picture(f);
            const FlowField motion = next_from(f);
            const auto k = static_cast<std::size_t>(f);
            joint_.add({f, picture, before_[k], after_[k], key ? ViewF1() : shares.view(),
                        ViewU8x1(), f == kJointLast ? nullptr : &motion});
        }
        joint_.decide();
    }
    float inside(int frame, Vec2i at) const {
        const auto k = static_cast<std::size_t>(frame);
        return joint_.inside(frame, before_[k], after_[k]).at(at.x, at.y);
    }

    std::vector<Matte> before_, after_;
    JointSides joint_;
};

constexpr Vec2i kOnGround{180, 35};

Vec2i in_upper_half(int frame) {
    return {(square_on(frame).x0 + square_on(frame).x1) / 2, square_on(frame).y0 + 14};
}

TEST_F(JointWalks, WhatOneHasTakenOfTheGroundIsOutside) {
    for (std::size_t f = 3; f < kJointLast; ++f)
        add_ground(before_[f]);
    // Also where that walk alone would count for much more.
    for (const float share : {kHalf, 0.05f}) {
        decide(share);
        for (int f = 3; f < kJointLast; ++f)
            EXPECT_LT(inside(f, kOnGround), 0.3f) << f;
    }
}

TEST_F(JointWalks, WhatOneHasLostIsInside) {
    for (int f = 1; f < 6; ++f)
        after_[static_cast<std::size_t>(f)] = half_lost(f);
    for (const float share : {kHalf, 0.95f}) {
        decide(share);
        for (int f = 1; f < 6; ++f)
            EXPECT_GT(inside(f, in_upper_half(f)), 0.7f) << f;
    }
}

TEST_F(JointWalks, BothMayBeRightInDifferentPlaces) {
    for (std::size_t f = 1; f < kJointLast; ++f) {
        add_ground(before_[f]);
        after_[f] = half_lost(static_cast<int>(f));
    }
    decide();
    for (int f = 1; f < kJointLast; ++f) {
        EXPECT_LT(inside(f, kOnGround), 0.3f) << f;
        EXPECT_GT(inside(f, in_upper_half(f)), 0.7f) << f;
    }
}

TEST_F(JointWalks, WhatBothAgreeOnStays) {
    decide();
    EXPECT_GT(inside(4, in_upper_half(4)), 0.99f);
    EXPECT_LT(inside(4, kOnGround), 0.01f);
}

}  // namespace
}  // namespace weft
