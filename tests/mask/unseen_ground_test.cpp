// What a passing thing uncovers of a surface that was not seen on the keyframe.
#include "engine/mask/unseen_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "engine/core/rng.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/uncovered.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

constexpr float kGroundLimit_px = 30;
constexpr int kSteps = 16;

// A disc passes in front of the surface, which is all the rest. On the last frame it has left where
// it was on the keyframe.
struct Passing {
    test::DiscScene scene;
    ImageF1 key;
    Passing() {
        scene.step = {6, 0};
        key = distance_without_disc(0);
    }
    [[nodiscard]] ImageF1 distance_without_disc(int t) const {
        Matte surface = scene.matte(t);
        for (int y = 0; y < surface.height(); ++y)
            for (int x = 0; x < surface.width(); ++x)
                surface.at(x, y) = static_cast<std::uint8_t>(255 - surface.at(x, y));
        return signed_distance(inside_of(surface), kGroundLimit_px);
    }
    // The matte of a walk that never gives back what the disc hid: the surface of the keyframe,
    // without the disc where it is.
    [[nodiscard]] ImageF1 found(int t) const {
        ImageF1 out = key;
        const ImageF1 now = distance_without_disc(t);
        std::transform(out.data(), out.data() + out.size_bytes() / sizeof(float), now.data(),
                       out.data(), [](float a, float b) { return std::min(a, b); });
        return out;
    }
    // What is seen where the disc was on the keyframe.
    struct Behind {
        std::uint8_t darker = 0;
        int moves_px = 0;           // upwards, per frame
        float measured_motion = 0;  // upwards, px
    };
    [[nodiscard]] ImageU8x3 frame(int t, const Behind& behind) const {
        const ImageU8x3 plain = scene.frame(t);
        ImageU8x3 out = plain;
        const Matte hole = scene.matte(0), disc = scene.matte(t);
        test::DiscScene without = scene;
        without.start = {-100, -100};
        without.step = {0, 0};
        const ImageU8x3 ground = without.frame(t);
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (hole.at(x, y) < 128 || disc.at(x, y) >= 128) continue;
                const int from = (y + behind.moves_px * t) % out.height();
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = static_cast<std::uint8_t>(
                        (behind.moves_px == 0 ? plain.at(x, y, c) : ground.at(x, from, c)) -
                        behind.darker);
            }
        }
        return out;
    }
    [[nodiscard]] FlowField flow(int t, const Behind& behind) const {
        FlowField out = scene.prev_from_cur(t);
        const Matte hole = scene.matte(0), disc = scene.matte(t);
        for (int y = 0; y < hole.height(); ++y) {
            for (int x = 0; x < hole.width(); ++x) {
                if (hole.at(x, y) >= 128 && disc.at(x, y) < 128)
                    out.d.at(x, y, 1) += behind.measured_motion;
            }
        }
        return out;
    }
    // Where the surface was added on any frame, of the places that the disc hid on the keyframe and
    // has left by the last one.
    [[nodiscard]] double added(const Behind& behind) const {
        const ImageU8x3 first = scene.frame(0);
        const SurfacePalette palette(first, key);
        UnseenGround ground(first, key);
        const ImageF2 still(scene.size);
        Matte any(scene.size);
        for (int t = 1; t <= kSteps; ++t) {
            const ImageU8x3 now = frame(t, behind), last_frame = frame(t - 1, behind);
            const FlowField measured = flow(t, behind);
            const Matte parting = parting_pixels(measured, rect_of(scene.size));
            const ImageF1 before = found(t - 1), phi = found(t);
            const Matte more = ground.advance(
                {now, last_frame, measured, parting, still, rect_of(scene.size), before, phi, 1.0f},
                palette);
            if (more.empty()) continue;
            for (int y = 0; y < any.height(); ++y)
                for (int x = 0; x < any.width(); ++x)
                    if (more.at(x, y) != 0) any.at(x, y) = 255;
        }
        double all = 0, hits = 0;
        const ImageF1 last = distance_without_disc(kSteps);
        for (int y = 0; y < any.height(); ++y) {
            for (int x = 0; x < any.width(); ++x) {
                if (key.at(x, y) > -3 || last.at(x, y) < 3) continue;
                all += 1;
                hits += any.at(x, y) != 0 ? 1 : 0;
            }
        }
        return hits / all;
    }
};

TEST(UnseenGround, WhatLooksLikeTheSurfaceAndContinuesItJoins) {
    EXPECT_GT(Passing().added({}), 0.9);
}

// The flow on what was just uncovered is still drawn along, but the picture fits the surface's
// motion.
TEST(UnseenGround, ThePictureOverrulesAWrongFlow) {
    EXPECT_GT(Passing().added({0, 0, 1.4f}), 0.8);
}

TEST(UnseenGround, WhatMovesOtherwiseStaysOutside) {
    EXPECT_EQ(Passing().added({0, 2, 2}), 0);
}

TEST(UnseenGround, WhatHasAnotherColourStaysOutside) {
    EXPECT_EQ(Passing().added({60}), 0);
}

// A white table behind a white shirt: coloured nearly as the surface, but there is an edge.
TEST(UnseenGround, WhatLiesBeyondAnEdgeStaysOutside) {
    EXPECT_EQ(Passing().added({18}), 0);
}

// A strap hangs over kerb and pavement on the keyframe. Both are of one grit, in which the step
// between them is lost, and most of what is outside is something else.
TEST(UnseenGround, WhatLooksRatherLikeTheOutsideBesideItStaysOutside) {
    const Size size{160, 120};
    const Recti strap{60, 46, 90, 70};
    ImageU8x3 now(size);
    Matte kerb(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            Rng grit(3, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
            const int base = y < 60 ? 120 : y < 76 ? 130 : 40;
            for (int c = 0; c < 3; ++c)
                now.at(x, y, c) =
                    static_cast<std::uint8_t>(base + static_cast<int>(grit.below(49)) - 24);
            kerb.at(x, y) = y < 60 ? 255 : 0;
        }
    }
    ImageF1 key = signed_distance(inside_of(kerb), kGroundLimit_px), found = key;
    for (int y = strap.y0; y < strap.y1; ++y) {
        for (int x = strap.x0; x < strap.x1; ++x) {
            key.at(x, y) = 0;
            found.at(x, y) = -1;
        }
    }
    const SurfacePalette palette(now, key);
    UnseenGround ground(now, key);
    const ImageF2 still(size);
    const FlowField rests(size);
    const Matte parting(size);
    for (int t = 0; t < kSteps; ++t)
        EXPECT_TRUE(
            ground
                .advance({now, now, rests, parting, still, rect_of(size), found, found, 1.0f},
                         palette)
                .empty())
            << t;
}

// Something of the surface's colours was seen outside on the keyframe. A black frame, on which
// every place seems to come from one, does not make it unknown.
TEST(UnseenGround, ABlackFrameTellsNothing) {
    const Passing passing;
    const Size size = passing.scene.size;
    test::DiscScene gone = passing.scene;
    gone.start = {-100, -100};
    gone.step = {0, 0};
    const ImageU8x3 now = gone.frame(0);
    const SurfacePalette palette(passing.scene.frame(0), passing.key);
    UnseenGround ground(passing.scene.frame(0), passing.key);
    const ImageF2 still(size);
    FlowField lost(size), rests(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            lost.d.at(x, y, 0) = static_cast<float>(10 - x);
            lost.d.at(x, y, 1) = static_cast<float>(10 - y);
            lost.valid.at(x, y) = 0;
        }
    }
    for (int t = 0; t < kSteps; ++t) {
        const FlowField& flow = t == 0 ? lost : rests;
        const Matte parting = parting_pixels(flow, rect_of(size));
        EXPECT_TRUE(ground
                        .advance({now, now, flow, parting, still, rect_of(size), passing.key,
                                  passing.key, 1.0f},
                                 palette)
                        .empty())
            << t;
    }
}

}  // namespace
}  // namespace weft
