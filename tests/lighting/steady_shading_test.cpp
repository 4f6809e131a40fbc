#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/lighting/shading.h"

namespace weft {
namespace {

constexpr Size kFull{256, 192};
constexpr Size kSmall{128, 96};

// Noise of deviation 0.01 (ln units), another in each frame, of a few pixels' size.
float noise(int x, int y, int frame) {
    const auto of = [](int v, unsigned prime) { return static_cast<unsigned>(v) * prime; };
    const unsigned hash = of(x / 3, 73856093u) ^ of(y / 3, 19349663u) ^ of(frame, 83492791u);
    const unsigned mixed = (hash ^ hash >> 13) * 0x5bd1e995u;
    return 0.01f * 3.46f * (static_cast<float>((mixed ^ mixed >> 15) & 0xffffu) / 65535.0f - 0.5f);
}

Shading frame(int t, const std::function<float(int, int)>& light) {
    Shading s{ImageF1(kSmall), 2, kFull, {}};
    for (int y = 0; y < kSmall.height; ++y) {
        for (int x = 0; x < kSmall.width; ++x)
            s.value.at(x, y) = light(x, y) * std::exp(noise(x, y, t));
    }
    return s;
}

double deviation(const Shading& s, float truth) {
    double sum = 0, square = 0;
    for (int y = 8; y < kSmall.height - 8; ++y) {
        for (int x = 8; x < kSmall.width - 8; ++x) {
            const double e = std::log(s.value.at(x, y) / truth);
            sum += e, square += e * e;
        }
    }
    const double n = (kSmall.height - 16) * (kSmall.width - 16);
    return std::sqrt(square / n - sum / n * (sum / n));
}

TEST(SteadyShading, TakesTheNoiseOut) {
    const auto light = [](int, int) { return 0.6f; };
    Shading steady = frame(0, light);
    const ImageF2 still(kFull);
    for (int t = 1; t < 12; ++t)
        steady = steady_shading(frame(t, light), steady, still);
    EXPECT_LT(deviation(steady, 0.6f), 0.6 * deviation(frame(11, light), 0.6f));
}

TEST(SteadyShading, FollowsADimmingLight) {
    const ImageF2 still(kFull);
    Shading steady = frame(0, [](int, int) { return 1.0f; });
    float truth = 1;
    for (int t = 1; t < 40; ++t) {
        truth *= 0.987f;  // down by 40% over the shot
        steady = steady_shading(frame(t, [truth](int, int) { return truth; }), steady, still);
        ASSERT_NEAR(steady.value.at(64, 48) / truth, 1.0f, 0.03f) << "frame " << t;
    }
}

TEST(SteadyShading, AMovingShadowDoesNotLag) {
    const ImageF2 still(kFull);
    const auto shadow_at = [](int edge) {
        return [edge](int x, int) { return x < edge ? 0.3f : 1.0f; };
    };
    Shading steady = frame(0, shadow_at(30));
    for (int t = 1; t < 12; ++t) {
        const int edge = 30 + 3 * t;
        steady = steady_shading(frame(t, shadow_at(edge)), steady, still);
        for (int y = 10; y < 90; ++y) {
            ASSERT_LT(steady.value.at(edge - 1, y), 0.33f) << "frame " << t;
            ASSERT_GT(steady.value.at(edge, y), 0.92f) << "frame " << t;
        }
    }
}

TEST(SteadyShading, FollowsTheSurfacesMotion) {
    // The light pattern moves with the surface, 4 plate pixels to the right a frame.
    const auto pattern = [](int t) {
        return [t](int x, int) {
            return 0.5f + 0.2f * std::sin(0.3f * static_cast<float>(x - 2 * t));
        };
    };
    ImageF2 motion(kFull);
    for (int y = 0; y < kFull.height; ++y) {
        for (int x = 0; x < kFull.width; ++x)
            motion.at(x, y, 0) = -4.0f;
    }
    Shading steady = frame(0, pattern(0));
    for (int t = 1; t < 10; ++t)
        steady = steady_shading(frame(t, pattern(t)), steady, motion);
    double steady_error = 0, raw_error = 0;
    const Shading raw = frame(9, pattern(9));
    for (int x = 40; x < 110; ++x) {
        for (int y = 10; y < 86; ++y) {
            const float truth = pattern(9)(x, y);
            steady_error += std::abs(std::log(steady.value.at(x, y) / truth));
            raw_error += std::abs(std::log(raw.value.at(x, y) / truth));
        }
    }
    EXPECT_LT(steady_error, 0.75 * raw_error);
}

TEST(SteadyShading, WithoutMotionOrWithAnotherSizeTheNewOneStands) {
    const auto light = [](int, int) { return 0.6f; };
    const Shading a = frame(0, light), b = frame(1, light);
    const ImageF2 unknown(kFull, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(steady_shading(b, a, unknown).value, b.value);
    const Shading other{ImageF1(64, 48, 1.0f), 4, kFull, {}};
    EXPECT_EQ(steady_shading(b, other, ImageF2(kFull)).value, b.value);
}

TEST(SteadyShading, IsTheSameForAnyNumberOfThreads) {
    const auto light = [](int x, int) { return x < 50 ? 0.3f : 0.7f; };
    const Shading a = frame(0, light), b = frame(1, light);
    const ImageF2 motion(kFull, 0.7f);
    set_thread_count(1);
    const Shading one = steady_shading(b, a, motion);
    set_thread_count(4);
    const Shading many = steady_shading(b, a, motion);
    set_thread_count(0);
    EXPECT_EQ(one.value, many.value);
}

}  // namespace
}  // namespace weft
