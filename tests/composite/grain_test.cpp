#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/composite/grain.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr int kWidth = 200, kHeight = 120;

// Grain of a known kind over `base`: deviation by luma, neighbours hanging together along x.
ImageF3 grainy(const ImageF3& base, std::uint64_t seed) {
    Rng rng(seed);
    const auto normal = [&] {
        double sum = 0;
        for (int k = 0; k < 12; ++k)
            sum += rng.uniform();
        return static_cast<float>(sum - 6);
    };
    ImageF3 out = base;
    for (int y = 0; y < base.height(); ++y) {
        float last[3] = {normal(), normal(), normal()};
        for (int x = 0; x < base.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                const float fresh = normal();
                const float level = base.at(x, y, c);
                const float deviation = (level < 0.5f ? 4.0f : 8.0f) / 255.0f;
                out.at(x, y, c) += deviation * (0.8f * fresh + 0.6f * last[c]);
                last[c] = fresh;
            }
        }
    }
    return out;
}

ImageF3 two_greys() {
    ImageF3 base(kWidth, kHeight, 0.3f);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = kWidth / 2; x < kWidth; ++x) {
            for (int c = 0; c < 3; ++c)
                base.at(x, y, c) = 0.7f;
        }
    }
    return base;
}

GrainModel measured(const ImageF3& a, const ImageF3& b) {
    const Matte all(a.size(), 255);
    GrainMeter meter(0);
    meter.add(b, a, all, all, ImageF2(a.size()));
    return meter.model();
}

struct Statistics {
    double deviation = 0, next = 0;  // next: correlation with the right neighbour
};
Statistics statistics(const ImageF3& picture, const ImageF3& base, int x0, int x1) {
    double n = 0, squares = 0, neighbours = 0;
    for (int y = 8; y < kHeight - 8; ++y) {
        for (int x = x0; x < x1; ++x) {
            const double a = picture.at(x, y, 1) - base.at(x, y, 1);
            const double b = picture.at(x + 1, y, 1) - base.at(x + 1, y, 1);
            n += 1, squares += a * a, neighbours += a * b;
        }
    }
    return {std::sqrt(squares / n), neighbours / squares};
}

TEST(Grain, WhatIsPutBackHasTheMeasuredDeviationAndSpectrum) {
    const ImageF3 base = two_greys();
    const GrainModel model = measured(grainy(base, 1), grainy(base, 2));
    ASSERT_TRUE(model.present());
    ImageF3 made = base;
    add_grain(made, Matte(base.size(), 255), {0, 0}, model, 1, 77);
    const ImageF3 plate = grainy(base, 3);
    for (const auto& [x0, x1] : {std::pair{10, 80}, std::pair{120, 190}}) {
        const Statistics want = statistics(plate, base, x0, x1),
                         got = statistics(made, base, x0, x1);
        EXPECT_NEAR(got.deviation, want.deviation, 0.15 * want.deviation);
        EXPECT_NEAR(got.next, want.next, 0.1);
    }
}

TEST(Grain, IsFreshInEveryFrameAndDoesNotDependOnThePart) {
    const ImageF3 base = two_greys();
    const GrainModel model = measured(grainy(base, 1), grainy(base, 2));
    const Matte all(base.size(), 255);
    ImageF3 first = base, again = base, next = base;
    add_grain(first, all, {0, 0}, model, 1, 5);
    set_thread_count(1);
    add_grain(again, all, {0, 0}, model, 1, 5);
    set_thread_count(0);
    add_grain(next, all, {0, 0}, model, 1, 6);
    EXPECT_EQ(first, again);
    double together = 0, energy = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double a = first.at(x, y, 0) - base.at(x, y, 0);
            together += a * (next.at(x, y, 0) - base.at(x, y, 0)), energy += a * a;
        }
    }
    EXPECT_LT(std::abs(together / energy), 0.05);
    ImageF3 part(50, 40, 0.3f);
    add_grain(part, Matte(part.size(), 255), {20, 30}, model, 1, 5);
    EXPECT_EQ(part.at(7, 9, 2), first.at(27, 39, 2));
}

TEST(Grain, ACleanPlateHasNone) {
    ImageF3 clean(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (int c = 0; c < 3; ++c)
                clean.at(x, y, c) = 0.5f + 0.3f * std::sin(0.11f * static_cast<float>(x + 2 * y));
        }
    }
    EXPECT_FALSE(measured(clean, clean).present());
}

// Bars of shade, 16 px apart, that sweep over a grey surface by 3 px a frame.
ImageF3 barred(int frame) {
    ImageF3 out(kWidth, kHeight, 0.5f);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float phase =
                0.39f * static_cast<float>(x + 3 * frame) + 0.05f * static_cast<float>(y);
            const float shade = std::clamp(2.0f * std::sin(phase), -1.0f, 0.0f);
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) += 0.2f * shade;
        }
    }
    return out;
}

TEST(Grain, ShadowsThatSweepOverACleanPlateAreNoGrain) {
    EXPECT_FALSE(measured(barred(0), barred(1)).present());
}

// A fine texture that does not move, in a fifth of the picture under a shadow that comes: there it
// differs as finely as grain would.
TEST(Grain, AFineTextureUnderAComingShadowIsNoGrain) {
    const auto plate = [](bool shade) {
        Rng rng(3);
        ImageF3 out(kWidth, kHeight, 0.5f);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const float value = 0.5f + 0.1f * static_cast<float>(rng.uniform() - 0.5);
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = value * (shade && x >= kWidth * 4 / 5 ? 0.4f : 1.0f);
            }
        }
        return out;
    };
    EXPECT_FALSE(measured(plate(false), plate(true)).present());
}

TEST(Grain, IsMeasuredBesideAMovingShadowAndUnderADimmingLight) {
    const auto plate = [](int frame) {
        ImageF3 base(kWidth, kHeight, 0.3f - 0.02f * static_cast<float>(frame));
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < 40 + 8 * frame; ++x) {
                for (int c = 0; c < 3; ++c)
                    base.at(x, y, c) -= 0.1f;
            }
        }
        return base;
    };
    const GrainModel model = measured(grainy(plate(0), 7), grainy(plate(1), 8));
    EXPECT_NEAR(model.deviation[1][2], 4.0f / 255.0f, 0.6f / 255.0f);
}

// Detail of many frequencies up to a sixth of a cycle a pixel, seen through a camera that moves.
ImageF3 detailed(float move) {
    ImageF3 out(kWidth, kHeight, 0.4f);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float u = static_cast<float>(x) + move, v = static_cast<float>(y) - 0.6f * move;
            float value = 0;
            for (int k = 1; k <= 4; ++k) {
                const auto f = static_cast<float>(k);
                value += std::sin(0.28f * f * u + 0.11f * f * f) * std::cos(0.23f * f * v + f);
            }
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) += 0.08f * value;
        }
    }
    return out;
}

TEST(Grain, IsToldFromDetailThatMovesByPartsOfAPixel) {
    const GrainModel model = measured(grainy(detailed(0), 11), grainy(detailed(3.4f), 12));
    EXPECT_NEAR(model.deviation[1][2] * 255, 4.0f, 0.6f);
    // One step of luma holds both deviations that grainy() makes; further up it is the greater.
    EXPECT_GT(model.deviation[1][5], model.deviation[1][2]);
    EXPECT_FALSE(measured(detailed(0), detailed(3.4f)).present());
}

// What is fresh in every frame in two thirds of the picture is more than grain; the rest of the
// plate tells.
TEST(Grain, IsTheLeastThatAnyPartOfThePlateShows) {
    const auto plate = [](std::uint64_t seed) {
        ImageF3 out = grainy(ImageF3(kWidth, kHeight, 0.3f), seed);
        Rng rng(seed + 100);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = kWidth / 3; x < kWidth; ++x) {
                const float sparkle = 0.15f * static_cast<float>(rng.uniform() - 0.5);
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) += sparkle;
            }
        }
        return out;
    };
    const GrainModel model = measured(plate(1), plate(2));
    EXPECT_NEAR(model.deviation[1][2] * 255, 4.0f, 0.6f);
}

TEST(Grain, APatternThatIsFollowedBadlyIsNotTakenForGrain) {
    ImageF3 a(kWidth, kHeight), b(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](float shift) {
                    return 0.5f + 0.2f * std::sin(0.3f * (static_cast<float>(x) + shift)) *
                                      std::cos(0.21f * static_cast<float>(y));
                };
                a.at(x, y, c) = at(0), b.at(x, y, c) = at(0.4f);
            }
        }
    }
    const GrainModel model = measured(a, b);
    for (const auto& channel : model.deviation) {
        for (const float d : channel)
            EXPECT_LT(d, 1.0f / 255.0f);
    }
}

}  // namespace
}  // namespace weft
