// A wall of bricks over which a shadow moves: the whole clip as evidence.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/lighting/clip_reflectance.h"
#include "tests/lighting/lighting_scene.h"

namespace weft {
namespace {

constexpr int kClipFrames = 8, kStep = 18;

struct Clip {
    std::vector<SurfaceSample> samples;
    ClipReflectance reflectance;
};

int shadow_at(int frame) {
    return 40 + kStep * frame;
}

Clip clip(float exposure_at_end = 1) {
    const ShadingOptions options;
    const Matte matte = scene::box_matte({10, 10, 310, 230});
    Clip c;
    ReflectanceGatherer gatherer(options);
    for (int f = 0; f < kClipFrames; ++f) {
        const float exposure =
            1 + (exposure_at_end - 1) * static_cast<float>(f) / (kClipFrames - 1);
        c.samples.push_back(light_sample(scene::plate(exposure, shadow_at(f)), matte, options));
        gatherer.add(c.samples.back(), ImageF2(c.samples.back().box.size()));
    }
    c.reflectance = gatherer.finish();
    return c;
}

Shading shading_at(const Clip& c, int frame) {
    const SurfaceSample& sample = c.samples[static_cast<std::size_t>(frame)];
    return shading_with(sample, c.reflectance, ImageF2(sample.box.size()), {});
}

// Place and width (10% to 90%) of the falling edge of the shading along the middle rows, plate px.
struct Edge {
    float place = 0, width = 0;
};
Edge edge_of(const Shading& s, int near) {
    std::vector<float> profile(static_cast<std::size_t>(s.value.width()));
    for (int y = 40; y < 80; ++y) {
        for (int x = 0; x < s.value.width(); ++x)
            profile[static_cast<std::size_t>(x)] += s.value.at(x, y) / 40.0f;
    }
    const int centre = near / s.downscale, reach = 14;
    const float high = profile[static_cast<std::size_t>(centre - reach)];
    const float low = profile[static_cast<std::size_t>(centre + reach)];
    const auto crossing = [&](float share) {
        const float level = high + share * (low - high);
        for (int x = centre - reach; x < centre + reach; ++x) {
            const float a = profile[static_cast<std::size_t>(x)];
            const float b = profile[static_cast<std::size_t>(x) + 1];
            if (a >= level && b < level)
                return (static_cast<float>(x) + 0.5f + (a - level) / (a - b)) *
                       static_cast<float>(s.downscale);
        }
        return -1e3f;
    };
    return {crossing(0.5f), crossing(0.9f) - crossing(0.1f)};
}

TEST(ClipReflectance, AMovingShadowIsSharpAndWhereItIs) {
    const Clip c = clip();
    for (const int frame : {1, 3, 6}) {
        const Edge edge = edge_of(shading_at(c, frame), shadow_at(frame));
        EXPECT_NEAR(edge.place, static_cast<float>(shadow_at(frame)), 1.0f) << frame;
        EXPECT_LT(edge.width, 4.0f) << frame;  // two pixels of the small picture
    }
}

TEST(ClipReflectance, BricksAreNotLight) {
    const Clip c = clip();
    const Matte matte = scene::box_matte({10, 10, 310, 230});
    const Shading s = shading_at(c, 3);
    const ImageF1 blurred = scene::gaussian_estimate(scene::plate(1, shadow_at(3)), matte, 7.0f);
    // Beyond the shadow.
    const Matte lit_small = scene::box_matte({100, 10, 150, 110}, s.value.size());
    ImageF1 half(s.value.size());
    for (int y = 0; y < half.height(); ++y) {
        for (int x = 0; x < half.width(); ++x)
            half.at(x, y) = blurred.at(2 * x, 2 * y);
    }
    // The shadow lies on a place for five of the eight frames: a hard case.
    EXPECT_LT(scene::detail_energy(s.value, lit_small, 7),
              0.2 * scene::detail_energy(half, lit_small, 7));
}

// The shadow of leaves: bars of a third, 8 px wide and 24 apart, that sweep by 7 px a frame.
bool in_bar(int x, int frame) {
    return (x + 7 * frame) % 24 < 8;
}

TEST(ClipReflectance, ShadowsAsFineAsBricksAreLightIfTheyMove) {
    const Matte matte = scene::box_matte({10, 10, 310, 230});
    ReflectanceGatherer gatherer({});
    std::vector<SurfaceSample> samples;
    for (int f = 0; f < 12; ++f) {
        ImageF3 plate = scene::plate(1, 1000);
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                for (int c = 0; in_bar(x, f) && c < 3; ++c)
                    plate.at(x, y, c) *= 0.33f;
            }
        }
        samples.push_back(light_sample(plate, matte, {}));
        gatherer.add(samples.back(), ImageF2(samples.back().box.size()));
    }
    const ClipReflectance reflectance = gatherer.finish();
    const SurfaceSample& sample = samples[5];
    const Shading s = shading_with(sample, reflectance, ImageF2(sample.box.size()), {});
    double lit = 0, shaded = 0;
    int lit_count = 0, shaded_count = 0;
    for (int y = 20; y < 100; ++y) {
        for (int x = 60; x < 100; ++x) {
            const bool left = in_bar(2 * x - 2, 5), right = in_bar(2 * x + 3, 5);
            if (left && right) shaded += s.value.at(x, y), ++shaded_count;
            if (!left && !right && !in_bar(2 * x, 5)) lit += s.value.at(x, y), ++lit_count;
        }
    }
    ASSERT_GT(shaded_count, 100);
    EXPECT_NEAR((shaded / shaded_count) / (lit / lit_count), 0.33, 0.06);
}

// The shading of bricks on a column whose light along x is `form`, five times the same frame.
template <class Form>
Shading shading_of_column(const Form& form) {
    const Matte matte = scene::box_matte({10, 10, 310, 230});
    ReflectanceGatherer gatherer({});
    SurfaceSample sample;
    for (int f = 0; f < 5; ++f) {
        ImageF3 plate = scene::plate(1, 1000);
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                for (int c = 0; c < 3; ++c)
                    plate.at(x, y, c) *= form(x) / scene::light(x, y, 1000);
            }
        }
        sample = light_sample(plate, matte, {});
        gatherer.add(sample, ImageF2(sample.box.size()));
    }
    return shading_with(sample, gatherer.finish(), ImageF2(sample.box.size()), {});
}

TEST(ClipReflectance, FormIsNoPatternHoweverItRepeats) {
    // Dark towards both sides.
    const auto form = [](int x) {
        const float u = (static_cast<float>(x) - 160.0f) / 160.0f;
        return 1.0f - 0.7f * u * u;
    };
    const Shading s = shading_of_column(form);
    EXPECT_NEAR(s.value.at(20, 60) / s.value.at(80, 60), form(40), 0.06f);
    EXPECT_NEAR(s.value.at(140, 60) / s.value.at(80, 60), form(280), 0.06f);
}

TEST(ClipReflectance, WhereABodyTurnsAwayFromTheLightItIsDark) {
    // A cylinder lit from the left: the light falls to next to nothing at its right.
    const auto form = [](int x) {
        const float u = (static_cast<float>(x) - 160.0f) / 160.0f;
        const float away = 0.5f * std::sqrt(std::max(0.0f, 1 - u * u)) - 0.866f * u;
        return 0.03f + std::max(0.0f, away);
    };
    const Shading s = shading_of_column(form);
    for (const int x : {30, 60, 100, 120})
        EXPECT_NEAR(s.value.at(x, 60) / s.value.at(80, 60), form(2 * x) / form(160), 0.15f) << x;
    EXPECT_LT(s.value.at(140, 60) / s.value.at(80, 60), 0.2f);
}

// Soft bars of shadow that never move, narrower than the pavers they lie on.
float still_shade(int x, int y) {
    const auto u = static_cast<float>(x), v = static_cast<float>(y);
    return 0.65f - 0.2f * std::tanh(2 * std::sin(0.1f * u + 2 * std::sin(0.023f * v)) +
                                    std::cos(0.031f * u - 0.04f * v));
}

TEST(ClipReflectance, AStillShadowOnAFaintPatternIsLight) {
    // Pavers of 88 px with joints of 4 px that are a little darker.
    ImageF3 plate(scene::plate().size());
    for (int y = 0; y < plate.height(); ++y)
        for (int x = 0; x < plate.width(); ++x)
            for (int c = 0; c < 3; ++c)
                plate.at(x, y, c) =
                    0.4f * (x % 88 < 4 || y % 88 < 4 ? 0.8f : 1.0f) * still_shade(x, y);
    const Matte matte = scene::box_matte({10, 10, 310, 230});
    ReflectanceGatherer gatherer({});
    const SurfaceSample sample = light_sample(plate, matte, {});
    for (int f = 0; f < 5; ++f)
        gatherer.add(sample, ImageF2(sample.box.size()));
    const Shading s = shading_with(sample, gatherer.finish(), ImageF2(sample.box.size()), {});
    double real2 = 0, both = 0;
    for (int y = 20; y < 100; ++y) {
        for (int x = 20; x < 140; ++x) {
            const double found = std::log(s.value.at(x, y)) - std::log(s.value.at(80, 60));
            const double real =
                std::log(still_shade(2 * x, 2 * y)) - std::log(still_shade(160, 120));
            real2 += real * real, both += found * real;
        }
    }
    EXPECT_NEAR(both / real2, 1.0, 0.15) << "the share of the shadow that is in the light";
}

TEST(ClipReflectance, ALightThatDimsIsFollowed) {
    const Clip c = clip(0.6f);
    const float first = shading_at(c, 0).value.at(140, 60);
    const float last = shading_at(c, kClipFrames - 1).value.at(140, 60);
    EXPECT_NEAR(last / first, 0.6f, 0.018f);
}

TEST(ClipReflectance, WhereTheSurfaceIsAnotherTheFrameStandsForItself) {
    Clip c = clip();
    SurfaceSample other = c.samples[2];
    ImageF2 lost(other.box.size());
    for (int y = 0; y < lost.height(); ++y) {
        for (int x = 0; x < lost.width(); ++x)
            lost.at(x, y, 0) = 6.0f, lost.at(x, y, 1) = 2.0f;  // half a brick beside
    }
    const Shading with = shading_with(other, c.reflectance, lost, {});
    const Shading alone = shading_from_log(log_shading(other, {}).value, other);
    EXPECT_NEAR(with.value.at(140, 60) / alone.value.at(140, 60), 1.0f, 0.1f);
}

TEST(ClipReflectance, TwoFramesAreNoEvidence) {
    ReflectanceGatherer gatherer({});
    const Matte matte = scene::box_matte({10, 10, 310, 230});
    for (int f = 0; f < 2; ++f) {
        const SurfaceSample s = light_sample(scene::plate(), matte, {});
        gatherer.add(s, ImageF2(s.box.size()));
    }
    EXPECT_TRUE(gatherer.finish().box.empty());
}

}  // namespace
}  // namespace weft
