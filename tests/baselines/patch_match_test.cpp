#include "bench/baselines/patch_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace weft {
namespace {

// Oblique stripes of two widths whose colour depends on the position.
ImageU8x3 stripes(Size size) {
    ImageU8x3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const double v = 0.5 + 0.3 * std::sin(0.55 * x + 0.3 * y) + 0.2 * std::sin(1.1 * y);
            out.at(x, y, 0) = static_cast<std::uint8_t>(255 * v);
            out.at(x, y, 1) = static_cast<std::uint8_t>(200 * v);
            out.at(x, y, 2) = static_cast<std::uint8_t>(255 - 100 * v);
        }
    }
    return out;
}

// Mean over the picture of the least mean squared difference of its 5×5 patches to the sample's.
double strangeness(const ImageU8x3& picture, const ImageU8x3& sample) {
    double total = 0;
    int count = 0;
    for (int y = 2; y + 3 < picture.height(); y += 5) {
        for (int x = 2; x + 3 < picture.width(); x += 5) {
            double best = 1e18;
            for (int v = 0; v + 5 <= sample.height(); ++v) {
                for (int u = 0; u + 5 <= sample.width(); ++u) {
                    double sum = 0;
                    for (int j = 0; j < 5 && sum < best; ++j) {
                        for (int i = 0; i < 15; ++i) {
                            const double d =
                                picture.pixel(x - 2, y - 2 + j)[i] - sample.pixel(u, v + j)[i];
                            sum += d * d;
                        }
                    }
                    best = std::min(best, sum);
                }
            }
            total += best / 75;
            ++count;
        }
    }
    return total / count;
}

TEST(PatchMatch, LooksLikeTheSampleEverywhere) {
    const ImageU8x3 sample = stripes({64, 56});
    PatchMatchOptions options;
    options.size = {93, 71};
    const ImageU8x3 made = patch_match_texture(sample, options);
    EXPECT_EQ(made.size(), options.size);
    // For comparison: shuffled sample pixels score some hundred times worse.
    EXPECT_LT(strangeness(made, sample), 120.0);
}

TEST(PatchMatch, TakesItsColoursFromTheSample) {
    const ImageU8x3 sample = stripes({40, 40});
    std::set<int> colours;
    const auto key = [](const std::uint8_t* p) { return p[0] << 16 | p[1] << 8 | p[2]; };
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x)
            colours.insert(key(sample.pixel(x, y)));
    const ImageU8x3 made = patch_match_texture(sample, {{64, 48}, 3, 0, 0, 3});
    for (int y = 0; y < made.height(); ++y)
        for (int x = 0; x < made.width(); ++x)
            ASSERT_EQ(colours.count(key(made.pixel(x, y))), 1u) << x << "," << y;
}

TEST(PatchMatch, DependsOnTheFrameAndOnNothingElse) {
    const ImageU8x3 sample = stripes({48, 48});
    PatchMatchOptions options;
    options.size = {80, 60};
    const ImageU8x3 first = patch_match_texture(sample, options);
    EXPECT_TRUE(first == patch_match_texture(sample, options));
    options.frame = 2;
    EXPECT_FALSE(first == patch_match_texture(sample, options));
}

TEST(PatchMatch, RepeatsASampleTooSmallForAPatch) {
    const ImageU8x3 sample = stripes({6, 5});
    const ImageU8x3 made = patch_match_texture(sample, {{14, 11}, 1, 0, 0, 3});
    EXPECT_EQ(made.at(13, 10, 1), sample.at(1, 0, 1));
}

TEST(PatchMatch, MakesPicturesSmallerThanAPatch) {
    const ImageU8x3 made = patch_match_texture(stripes({64, 64}), {{3, 2}, 1, 0, 0, 3});
    EXPECT_EQ(made.size(), (Size{3, 2}));
}

}  // namespace
}  // namespace weft
