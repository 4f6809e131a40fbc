#include "engine/synthesis/endless_plane.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/synthesis/plane_energy.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

std::unique_ptr<EndlessPlane> endless(const ImageU8x3& sample, std::uint64_t seed = 1) {
    PlaneOptions o;
    o.seed = seed;
    auto plane = EndlessPlane::make(sample, o);
    EXPECT_TRUE(plane);
    return std::move(*plane);
}

// Every texel shows the sample pixel that it names, so that no seam is hidden; and the seams across
// and along the tiles' borders are as good as those inside.
TEST(EndlessPlane, HasNoUncountedSeam) {
    const ImageU8x3 sample = blob_sample(96, 96, 3);
    const auto plane = endless(sample);
    const int t = plane->tile_px();
    const auto part = plane->read({-2 * t, -t, 2 * t, 3 * t});
    ASSERT_TRUE(part);
    const SampleAtlas atlas(sample.view());
    double border = 0, inside = 0;
    int border_texels = 0, inside_texels = 0;
    for (int y = 0; y < 4 * t; ++y) {
        for (int x = 0; x < 4 * t; ++x) {
            const std::int32_t* s = part->source.pixel(x, y);
            ASSERT_TRUE(rect_of(sample.size()).contains(s[0], s[1]));
            ASSERT_TRUE(std::equal(sample.pixel(s[0], s[1]), sample.pixel(s[0], s[1]) + 3,
                                   part->pixels.pixel(x, y)));
            const double e = texel_energy(atlas, part->source, {x, y}, false).energy;
            const bool at_border = x % t == t - 1 || y % t == t - 1;
            (at_border ? border : inside) += e;
            ++(at_border ? border_texels : inside_texels);
        }
    }
    EXPECT_GT(inside, 0);
    EXPECT_LT(border / border_texels, 1.5 * inside / inside_texels);
    // What hidden butt joints would cost: nearly every border texel would be a seam.
    EXPECT_LT(border / border_texels, 5.0);
}

TEST(EndlessPlane, AnyPartIsTheSameHoweverItIsRead) {
    const ImageU8x3 sample = blob_sample(64, 60, 4);
    const auto plane = endless(sample), again = endless(sample), other = endless(sample, 2);
    const Recti rect{-300, 1000, 200, 1260};
    const auto whole = plane->read(rect);
    ASSERT_TRUE(whole);
    for (int y = rect.y0; y < rect.y1; y += 130) {
        for (int x = rect.x1 - 125; x >= rect.x0; x -= 125) {
            const auto part = again->read({x, y, x + 125, y + 130});
            ASSERT_TRUE(part);
            for (int py = 0; py < 130; ++py) {
                ASSERT_TRUE(std::equal(part->pixels.row(py), part->pixels.row(py) + 3 * 125,
                                       whole->pixels.pixel(x - rect.x0, y - rect.y0 + py)));
            }
        }
    }
    EXPECT_NE(other->read(rect)->pixels, whole->pixels);
}

TEST(EndlessPlane, DoesNotComeBackAndTakesBoundedMemory) {
    const auto plane = endless(blob_sample(64, 60, 5));
    const int t = plane->tile_px();
    const auto here = plane->read({0, 0, 5 * t, t});
    for (int k = 1; k < 6; ++k)
        EXPECT_NE(here->pixels, plane->read({0, k * t, 5 * t, (k + 1) * t})->pixels);
    for (int k = 0; k < 200; ++k)
        ASSERT_TRUE(plane->read({k * 7001, -k * 5003, k * 7001 + 50, -k * 5003 + 50}));
    EXPECT_LE(plane->bytes(), 16u * static_cast<std::size_t>(t * t) * 11u);
}

TEST(EndlessPlane, ThreadsMayReadAtOnce) {
    const ImageU8x3 sample = blob_sample(64, 60, 6);
    const auto plane = endless(sample), alone = endless(sample);
    const auto truth = alone->read({0, 0, 700, 700});
    std::vector<std::jthread> threads;
    std::array<bool, 3> same{};
    for (std::size_t i = 0; i < same.size(); ++i) {
        threads.emplace_back([&, i] {
            same[i] = plane->read({0, 0, 700, 700})->pixels == truth->pixels;
        });
    }
    threads.clear();
    EXPECT_TRUE(same[0] && same[1] && same[2]);
}

TEST(EndlessPlane, BadRequestsAreErrors) {
    PlaneOptions o;
    EXPECT_FALSE(EndlessPlane::make(blob_sample(20, 20, 1), o));
    const auto plane = endless(blob_sample(64, 60, 7));
    EXPECT_FALSE(plane->read({0, 0, 0, 5}));
    EXPECT_FALSE(plane->read({0, 0, 5, 2'000'000'000}));
    CancelToken cancel;
    cancel.cancel(130);
    const auto stopped = plane->read({0, 0, 10, 10}, cancel);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace weft::test
