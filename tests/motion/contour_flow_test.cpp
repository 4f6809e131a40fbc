#include "engine/motion/contour_flow.h"

#include <gtest/gtest.h>

#include "engine/motion/optical_flow.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kFigureFrame{320, 200};

// A flat figure with a bump on each side, so that its outline tells all of its motion.
bool in_figure(Vec2 p) {
    const Vec2 q = p - Vec2(130, 100);
    const float r = std::hypot(q.x, q.y), angle = std::atan2(q.y, q.x);
    return r < 50 + 9 * std::sin(3 * angle) + 5 * std::cos(5 * angle + 1);
}

Matte figure(Vec2 at) {
    return draw(kFigureFrame, [&](Vec2 p) { return in_figure(p - at) ? 1.0f : 0.0f; });
}

// The figure in one tone over a textured ground, which moves the other way.
Matte flat_frame(Vec2 at, float noise, std::uint64_t seed) {
    const WaveTexture ground(4);
    Rng rng(seed);
    return draw(kFigureFrame, [&](Vec2 p) {
        const float speckle = noise * static_cast<float>(rng.uniform() - 0.5);
        return in_figure(p - at) ? 0.55f + speckle : ground(p + at);
    });
}

float mean_visible_error(const FlowField& flow, const Matte& visible, Vec2 truth) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < kFigureFrame.height; ++y) {
        for (int x = 0; x < kFigureFrame.width; ++x) {
            if (visible.at(x, y) < 128) continue;
            const float* d = flow.d.pixel(x, y);
            sum += distance({d[0], d[1]}, truth);
            ++count;
        }
    }
    return static_cast<float>(sum / count);
}

TEST(ContourFlow, FollowsAFlatFigureByItsOutline) {
    const Vec2 step(7, -3);
    const Matte prev = flat_frame({0, 0}, 0, 1), cur = flat_frame(step, 0, 2);
    const Matte prev_in = figure({0, 0}), cur_in = figure(step);
    const FlowField flow = estimate_contour_flow(cur, cur_in, prev, prev_in);
    EXPECT_LT(mean_visible_error(flow, cur_in, -step), 0.3f);
    // The estimate over the whole frame, which this is for, is misled by the ground.
    EXPECT_GT(mean_visible_error(estimate_flow(cur, prev, FlowQuality::kFinal), cur_in, -step),
              1.0f);
    for (int y = 0; y < kFigureFrame.height; ++y) {
        for (int x = 0; x < kFigureFrame.width; ++x)
            ASSERT_EQ(flow.valid.at(x, y), cur_in.at(x, y) >= 128 ? 255 : 0) << x << "," << y;
    }
}

TEST(ContourFlow, NothingToFollowIsNothingValid) {
    const Matte luma = flat_frame({0, 0}, 0, 1), nothing(kFigureFrame);
    const FlowField flow = estimate_contour_flow(luma, nothing, luma, nothing);
    for (int y = 0; y < kFigureFrame.height; ++y) {
        for (int x = 0; x < kFigureFrame.width; ++x)
            ASSERT_EQ(flow.valid.at(x, y), 0);
    }
}

TEST(StructureToNoise, TellsATextureFromSpeckle) {
    const Vec2 step(2, 1);
    const Matte prev_in = figure({0, 0}), cur_in = figure(step);
    FlowField truth(kFigureFrame);
    for (int y = 0; y < kFigureFrame.height; ++y) {
        for (int x = 0; x < kFigureFrame.width; ++x) {
            truth.d.at(x, y, 0) = -step.x;
            truth.d.at(x, y, 1) = -step.y;
        }
    }
    const WaveTexture skin(9);
    const auto textured = [&](Vec2 at) {
        return draw(kFigureFrame, [&](Vec2 p) { return skin(p - at); });
    };
    EXPECT_GT(structure_to_noise(textured(step), cur_in, textured({0, 0}), prev_in, truth), 3.0f);
    // Fresh noise in every frame has slopes too, but nothing of it comes back.
    EXPECT_LT(structure_to_noise(flat_frame(step, 0.1f, 2), cur_in, flat_frame({0, 0}, 0.1f, 1),
                                 prev_in, truth),
              1.25f);
    EXPECT_LT(structure_to_noise(flat_frame(step, 0, 2), cur_in, flat_frame({0, 0}, 0, 1), prev_in,
                                 truth),
              1.25f);
}

TEST(StructureToNoise, IsUnknownWithoutPixels) {
    const Matte luma = flat_frame({0, 0}, 0, 1), nothing(kFigureFrame);
    EXPECT_EQ(structure_to_noise(luma, nothing, luma, nothing, FlowField(kFigureFrame)),
              std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace weft
