#include "engine/compute/plane_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

ImageF3 noise(Size size, float high = 1) {
    Rng rng(3);
    ImageF3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int k = 0; k < 3 * size.width; ++k)
            out.row(y)[k] = high * static_cast<float>(rng.uniform());
    }
    return out;
}

TEST(WrappedIndex, RepeatsMirrorsAndClamps) {
    const auto line = [](WrapMode wrap) {
        std::vector<int> out;
        for (int i = -4; i < 8; ++i)
            out.push_back(wrapped_index(i, 3, wrap));
        return out;
    };
    EXPECT_EQ(line(WrapMode::kRepeat), (std::vector<int>{2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1}));
    EXPECT_EQ(line(WrapMode::kMirror), (std::vector<int>{2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1}));
    EXPECT_EQ(line(WrapMode::kClamp), (std::vector<int>{0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2}));
    for (const WrapMode wrap : {WrapMode::kRepeat, WrapMode::kMirror, WrapMode::kClamp}) {
        for (const int i : {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
            EXPECT_GE(wrapped_index(i, 7, wrap), 0);
            EXPECT_LT(wrapped_index(i, 7, wrap), 7);
        }
    }
}

TEST(PlanePyramid, HalvesDownToOneTexel) {
    const PlanePyramid pyramid(noise({37, 20}).view(), WrapMode::kRepeat);
    std::vector<Size> sizes;
    for (const auto& level : pyramid.levels())
        sizes.push_back(level.size());
    EXPECT_EQ(sizes,
              (std::vector<Size>{{37, 20}, {19, 10}, {10, 5}, {5, 3}, {3, 2}, {2, 1}, {1, 1}}));
    EXPECT_EQ(pyramid.size(), (Size{37, 20}));
}

TEST(PlanePyramid, BeginsWithThePlaneItself) {
    const ImageF3 plane = noise({24, 16}, 8.0f);
    const PlanePyramid pyramid(plane.view(), WrapMode::kClamp);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 24; ++x) {
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(pyramid.levels()[0].at(x, y, c), plane.at(x, y, c));
        }
    }
}

TEST(PlanePyramid, EveryLevelHasThePlanesMean) {
    const ImageF3 plane = noise({61, 47});
    const PlanePyramid pyramid(plane.view(), WrapMode::kRepeat);
    double mean = 0;
    for (int k = 0; k < 61 * 47; ++k)
        mean += plane.data()[3 * k] / (61.0 * 47);
    for (std::size_t level = 1; level < pyramid.levels().size(); ++level) {
        const auto& texels = pyramid.levels()[level];
        double sum = 0;
        for (int k = 0; k < texels.width() * texels.height(); ++k)
            sum += texels.data()[4 * k];
        const double of_level = sum / (texels.width() * texels.height());
        EXPECT_NEAR(of_level, mean, 1e-4) << level;
    }
}

TEST(PlanePyramid, TakesWhatIsNoLightAsNone) {
    ImageF3 plane(4, 4, 0.5f);
    plane.at(0, 0, 0) = -1;
    plane.at(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    plane.at(2, 0, 2) = std::numeric_limits<float>::infinity();
    const PlanePyramid pyramid(plane.view(), WrapMode::kRepeat);
    const auto& texels = pyramid.levels()[0];
    EXPECT_EQ(texels.at(0, 0, 0), 0);
    EXPECT_EQ(texels.at(1, 0, 1), 0);
    EXPECT_EQ(texels.at(2, 0, 2), 0);
    EXPECT_EQ(texels.at(3, 3, 0), 0.5f);
    // The levels above hold numbers only.
    EXPECT_NEAR(pyramid.levels().back().at(0, 0, 1), 0.5f * 15 / 16, 1e-5f);
}

TEST(PlanePyramid, TakesNothing) {
    EXPECT_TRUE(PlanePyramid().empty());
    EXPECT_TRUE(PlanePyramid(ImageF3().view(), WrapMode::kRepeat).empty());
}

TEST(PlanePyramid, DoesNotDependOnThreads) {
    const ImageF3 plane = noise({150, 133});
    set_thread_count(1);
    const PlanePyramid one(plane.view(), WrapMode::kMirror);
    set_thread_count(3);
    const PlanePyramid three(plane.view(), WrapMode::kMirror);
    set_thread_count(0);
    EXPECT_TRUE(std::ranges::equal(one.levels(), three.levels()));
}

TEST(PlanePyramid, ItsIdentityNamesItsTexels) {
    const ImageF3 texels = noise({9, 7});
    const PlanePyramid first(texels, WrapMode::kRepeat), second(texels, WrapMode::kRepeat);
    EXPECT_NE(first.identity(), 0u);
    EXPECT_NE(first.identity(), second.identity());
    PlanePyramid copy = first;
    EXPECT_EQ(copy.identity(), first.identity());
    const PlanePyramid moved = std::move(copy);
    EXPECT_EQ(moved.identity(), first.identity());
    EXPECT_EQ(copy.identity(), 0u);  // NOLINT: what is left is empty, and has no name.
    copy = second;
    EXPECT_EQ(copy.identity(), second.identity());
    EXPECT_EQ(PlanePyramid().identity(), 0u);
}

}  // namespace
}  // namespace weft
