// Steps of a result that the plate does not have.
#include "engine/metrics/pops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "engine/metrics/sequence_measure.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using namespace synthetic;

constexpr Size kPopSize{192, 144};
constexpr int kFrames = 16;

// How a picture of a frame comes about: the surface moves by 1.5 px a frame.
struct Taken {
    double blur_px = 0, gain = 1, grain = 1, slid_px = 0;
};
using Course = std::function<Taken(int)>;

// Waves in many directions; a blur damps each by its frequency.
struct Wave {
    double x = 0, y = 0, phase = 0, height = 0;
};

std::vector<Wave> waves_of(std::uint64_t seed, double blur_px) {
    std::vector<Wave> out;
    Rng rng(seed);
    for (int k = 0; k < 24; ++k) {
        const double angle = 2 * kPi * rng.uniform(), phase = 2 * kPi * rng.uniform();
        const double w = 2 * kPi / (5 + 25 * rng.uniform());
        out.push_back({w * std::cos(angle), w * std::sin(angle), phase,
                       std::exp(-0.5 * w * w * blur_px * blur_px) / 5});
    }
    return out;
}

ImageF3 picture(std::uint64_t seed, int frame, const Taken& how, std::uint64_t noise_seed) {
    ImageF1 luma(kPopSize);
    const std::vector<Wave> waves = waves_of(seed, how.blur_px);
    Rng rng(noise_seed, static_cast<std::uint64_t>(frame));
    for (int y = 0; y < kPopSize.height; ++y) {
        for (int x = 0; x < kPopSize.width; ++x) {
            double noise = -6;
            for (int i = 0; i < 12; ++i)
                noise += rng.uniform();
            double v = 110;
            for (const Wave& w : waves)
                v += 28 * w.height *
                     std::sin(w.x * (x - 1.5 * frame - how.slid_px) + w.y * y + w.phase);
            luma.at(x, y) = static_cast<float>(how.gain * v + how.grain * noise);
        }
    }
    return grey(luma);
}

Pops measured_pops(const Course& result, const Course& source) {
    MeasureOptions options;
    options.measure_drift = false;
    options.measure_pops = true;
    SequenceMeasure measure(options);
    const Matte matte = rectangle(kPopSize, {16, 16, 176, 128});
    const FlowField motion = constant_motion(kPopSize, 1.5f, 0);
    for (int f = 1; f <= kFrames; ++f) {
        const ImageF3 seen = picture(7, f, result(f), 100), plate = picture(8, f, source(f), 200);
        MeasureFrame frame;
        frame.frame = f;
        frame.result = seen, frame.source = plate, frame.matte = matte, frame.motion = &motion;
        EXPECT_TRUE(measure.add(frame));
    }
    return measure.summary().pops;
}

Taken plain(int /*frame*/) {
    return {};
}

bool has(const PopsOfKind& pops, int frame) {
    return std::find(pops.frames.begin(), pops.frames.end(), frame) != pops.frames.end();
}

TEST(Pops, ASteadyResultHasNone) {
    EXPECT_TRUE(measured_pops(plain, plain).frames().empty());
}

TEST(Pops, ABlurredFrameIsFound) {
    const Pops pops = measured_pops([](int f) { return Taken{f == 9 ? 1.2 : 0.0}; }, plain);
    const PopsOfKind& kind = pops.of(PopKind::kSharpness);
    EXPECT_TRUE(has(kind, 9) && has(kind, 10));
    EXPECT_TRUE(kind.frame == 9 || kind.frame == 10);
    EXPECT_GT(kind.largest, 0.1);
    EXPECT_TRUE(pops.of(PopKind::kLight).frames.empty());
    EXPECT_TRUE(pops.of(PopKind::kPlace).frames.empty());
}

TEST(Pops, ABrighterFrameIsFound) {
    const Pops pops = measured_pops([](int f) { return Taken{0, f == 6 ? 1.08 : 1.0}; }, plain);
    const PopsOfKind& kind = pops.of(PopKind::kLight);
    EXPECT_EQ(kind.frames, (std::vector<int>{6, 7}));
    EXPECT_NEAR(kind.largest, std::log(1.08), 0.01);
    EXPECT_TRUE(pops.of(PopKind::kPlace).frames.empty());
}

TEST(Pops, AStepOfGrainIsFound) {
    const Pops pops = measured_pops([](int f) { return Taken{0, 1, f >= 11 ? 2.0 : 1.0}; }, plain);
    EXPECT_EQ(pops.of(PopKind::kGrain).frames, std::vector<int>{11});
    EXPECT_TRUE(pops.of(PopKind::kLight).frames.empty());
    EXPECT_TRUE(pops.of(PopKind::kPlace).frames.empty());
}

TEST(Pops, AJumpIsFound) {
    const Pops pops = measured_pops(
        [](int f) {
            return Taken{0, 1, 1, f >= 8 ? 2.0 : 0.0};
        },
        plain);
    const PopsOfKind& kind = pops.of(PopKind::kPlace);
    EXPECT_EQ(kind.frames, std::vector<int>{8});
    EXPECT_NEAR(kind.largest, 2, 0.3);
    EXPECT_TRUE(pops.of(PopKind::kSharpness).frames.empty());
}

TEST(Pops, AFlickerOnMostFramesDoesNotHideItself) {
    const Pops pops = measured_pops([](int f) { return Taken{f % 3 == 0 ? 1.0 : 0.0}; }, plain);
    EXPECT_GE(pops.of(PopKind::kSharpness).frames.size(), 8u);
}

TEST(Pops, WhatThePlateDoesIsNone) {
    // A pull of focus, in the plate and the result; moving light, and a flash.
    const Course pull = [](int f) { return Taken{0.12 * f}; };
    EXPECT_TRUE(measured_pops(pull, pull).frames().empty());
    const Course light = [](int f) { return Taken{0, 1 + 0.15 * std::sin(0.5 * f)}; };
    EXPECT_TRUE(measured_pops(light, light).frames().empty());
    const Course flash = [](int f) { return Taken{0, f == 7 ? 1.3 : 1.0}; };
    EXPECT_TRUE(measured_pops(flash, flash).frames().empty());
    // A result that does not take the flash does not pop.
    EXPECT_TRUE(measured_pops(plain, flash).frames().empty());
}

TEST(Pops, APullOfTheResultAloneIsSmooth) {
    const Course pull = [](int f) { return Taken{0.1 * f}; };
    EXPECT_TRUE(measured_pops(pull, plain).of(PopKind::kSharpness).frames.empty());
}

TEST(Pops, AStepIsJudgedByThoseAroundIt) {
    std::vector<PopSteps> steps;
    for (int f = 1; f <= 9; ++f) {
        PopSteps s;
        s.frame = f;
        const double step = f == 5 ? 0.2 : 0.01;
        s.step[0] = PopSteps::Step{step, step, 0};
        steps.push_back(s);
    }
    const auto off = departures(steps, PopKind::kSharpness);
    EXPECT_NEAR(*off[4], 0.19, 1e-9);
    EXPECT_EQ(*off[0], 0);
    EXPECT_FALSE(departures(steps, PopKind::kLight)[0]);
    EXPECT_EQ(find_pops(steps).frames(), std::vector<int>{5});
    EXPECT_STREQ(name_of(PopKind::kPlace), "place");
}

}  // namespace
}  // namespace weft
