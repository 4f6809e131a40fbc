#include "engine/motion/patch_search.h"

#include <gtest/gtest.h>

#include "engine/core/isa.h"
#include "engine/motion/optical_flow.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kPatchFrame{203, 141};

Matte changed_texture(Vec2 by, float lift = 0, float scale = 1) {
    const WaveTexture texture(3);
    return draw(kPatchFrame, [&](Vec2 p) { return texture((p - by) / scale) + lift; });
}

// The mean error over the picture's middle.
double error_of(const FlowField& flow, Vec2 truth) {
    const Recti inner = rect_of(kPatchFrame).grown(-24);
    double sum = 0;
    for (int y = inner.y0; y < inner.y1; ++y) {
        for (int x = inner.x0; x < inner.x1; ++x) {
            const float* d = flow.d.pixel(x, y);
            sum += distance({d[0], d[1]}, truth);
        }
    }
    return sum / (static_cast<double>(inner.width()) * inner.height());
}

TEST(PatchSearch, InstructionSetsGiveTheSameBits) {
    const Matte a = changed_texture({0, 0}), b = changed_texture({5.3f, -2.6f});
    for (const FlowQuality quality : {FlowQuality::kDraft, FlowQuality::kFinal}) {
        force_isa(Isa::kScalar);
        const FlowField scalar = estimate_flow(a, b, quality);
        force_isa(std::nullopt);
        EXPECT_EQ(scalar.d, estimate_flow(a, b, quality).d);
    }
}

TEST(PatchSearch, BothDirectionsAreThoseOfEachAlone) {
    const Matte a = changed_texture({0, 0}), b = changed_texture({3, 1});
    const FlowPair both = estimate_flows(a, b, FlowQuality::kFinal);
    EXPECT_EQ(both.b_from_a.d, estimate_flow(a, b, FlowQuality::kFinal).d);
    EXPECT_EQ(both.a_from_b.d, estimate_flow(b, a, FlowQuality::kFinal).d);
}

TEST(PatchSearch, FindsLargeMotion) {
    const Vec2 by(24.4f, -11.3f);
    const FlowField found = estimate_flow(changed_texture({0, 0}, 0, 4), changed_texture(by, 0, 4),
                                          FlowQuality::kFinal);
    EXPECT_LT(error_of(found, by), 0.3);
}

TEST(PatchSearch, DoesNotMindAChangeOfLight) {
    const Vec2 by(2.2f, 1.4f);
    const FlowField found =
        estimate_flow(changed_texture({0, 0}), changed_texture(by, -0.15f), FlowQuality::kFinal);
    EXPECT_LT(error_of(found, by), 0.1);
}

TEST(PatchSearch, WhatShowsNothingDoesNotMove) {
    const Matte grey(kPatchFrame, 128);
    EXPECT_EQ(error_of(estimate_flow(grey, grey, FlowQuality::kFinal), {0, 0}), 0.0);
}

TEST(PatchSearch, HalvesToTheMeansOfFourPixels) {
    Matte picture(Size{5, 3});
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x)
            picture.at(x, y) = static_cast<std::uint8_t>(10 * y + x);
    }
    const SearchPicture half = SearchPicture(picture).halved();
    EXPECT_EQ(half.size(), (Size{3, 2}));
    EXPECT_EQ(*half.at(0, 0), 5.5f);
    EXPECT_EQ(*half.at(1, 0), 7.5f);
    EXPECT_EQ(*half.at(2, 1), 24.0f);  // beyond the border pixels repeat
    EXPECT_EQ(*half.at(-5, -9), *half.at(0, 0));
}

}  // namespace
}  // namespace weft
