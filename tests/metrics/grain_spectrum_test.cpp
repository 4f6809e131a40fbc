// The grain of a sequence as a spectrum.
#include <gtest/gtest.h>

#include "engine/core/rng.h"
#include "engine/metrics/grain_spectrum.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

constexpr Size kNoisySize{192, 128};
constexpr double kLevels = 4;  // deviation

// Grey with white noise of `levels`, or the same under a box of 2×2, which is softer.
ImageF3 noisy(std::uint64_t seed, double levels, bool soft = false) {
    ImageF3 white(kNoisySize), out(kNoisySize);
    Rng rng(seed);
    for (int y = 0; y < kNoisySize.height; ++y) {
        for (int x = 0; x < kNoisySize.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double normal =
                    (rng.uniform() + rng.uniform() + rng.uniform() + rng.uniform() - 2) * 1.7320508;
                white.at(x, y, c) = static_cast<float>(levels * normal / 255);
            }
        }
    }
    for (int y = 0; y < kNoisySize.height; ++y) {
        for (int x = 0; x < kNoisySize.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int u, int v) {
                    return white.at((x + u) % kNoisySize.width, (y + v) % kNoisySize.height, c);
                };
                out.at(x, y, c) =
                    0.5f + (soft ? 0.5f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) : at(0, 0));
            }
        }
    }
    return out;
}

GrainSpectrum spectrum_of(const std::vector<ImageF3>& frames) {
    GrainSpectrumMeter meter;
    const FlowField still = synthetic::constant_motion(kNoisySize, 0, 0);
    const Matte all(kNoisySize, 255);
    for (std::size_t k = 1; k < frames.size(); ++k)
        meter.add(frames[k - 1], frames[k], still, all, true);
    return meter.spectrum();
}

TEST(GrainSpectrumMeter, FindsTheDeviationOfFreshGrain) {
    const GrainSpectrum g = spectrum_of({noisy(1, kLevels), noisy(2, kLevels), noisy(3, kLevels)});
    for (const double deviation : g.deviation)
        EXPECT_NEAR(deviation, kLevels, 0.4);
    EXPECT_NEAR(*g.correlation, -0.5, 0.05);
}

TEST(GrainSpectrumMeter, TellsSoftGrainFromSharpGrain) {
    const GrainSpectrum sharp = spectrum_of({noisy(1, kLevels), noisy(2, kLevels)});
    const GrainSpectrum soft = spectrum_of({noisy(1, kLevels, true), noisy(2, kLevels, true)});
    // All of the energy of the soft one lies in low frequencies.
    EXPECT_GT(soft.band[1][0], 1.4 * sharp.band[1][0]);
    EXPECT_LT(soft.band[1][3], 0.6 * sharp.band[1][3]);
    EXPECT_NEAR(soft.deviation[1], sharp.deviation[1], 0.5);
}

TEST(GrainSpectrumMeter, GrainThatStaysIsNone) {
    const ImageF3 frame = noisy(1, kLevels);
    EXPECT_LT(spectrum_of({frame, frame, frame}).deviation[0], 0.01);
}

TEST(GrainSpectrumMeter, GrainThatDriftsSlowlyCorrelates) {
    // Each frame goes a third of the way on: two differences in a row are the same.
    const ImageF3 a = noisy(1, kLevels), b = noisy(2, kLevels);
    std::vector<ImageF3> frames;
    for (int k = 0; k < 4; ++k) {
        ImageF3 mixed(kNoisySize);
        for (int y = 0; y < kNoisySize.height; ++y) {
            for (int x = 0; x < kNoisySize.width; ++x) {
                for (int c = 0; c < 3; ++c)
                    mixed.at(x, y, c) =
                        a.at(x, y, c) + static_cast<float>(k) / 3 * (b.at(x, y, c) - a.at(x, y, c));
            }
        }
        frames.push_back(std::move(mixed));
    }
    EXPECT_GT(*spectrum_of(frames).correlation, 0.95);
}

}  // namespace
}  // namespace weft
