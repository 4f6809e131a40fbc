// Periods, repeats, several samples, turned and mirrored ones.

#include "engine/synthesis/repetition.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "engine/synthesis/light_guide.h"
#include "engine/synthesis/placement_memory.h"
#include "engine/synthesis/plane_energy.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

TEST(TexturePeriod, FindsTheLatticeOfBricks) {
    const TexturePeriod period = find_period(brick_sample(96, 96, 32, 16));
    ASSERT_EQ(period.count, 2);
    EXPECT_LT(period.mismatch, 0.01);
    EXPECT_TRUE(period.holds({16, 16}, 0.5));
    EXPECT_TRUE(period.holds({32, 0}, 0.5));
    EXPECT_TRUE(period.holds({-64, 32}, 0.5));
    EXPECT_FALSE(period.holds({16, 0}, 2));
    EXPECT_FALSE(period.holds({0, 16}, 2));
    EXPECT_FALSE(period.holds({3, 32}, 2));
    EXPECT_TRUE(period.holds({2, 32}, 2));
    EXPECT_EQ(period.axis_px(), (Size{32, 32}));
}

TEST(TexturePeriod, StripesHaveOneStep) {
    ImageU8x3 stripes(96, 96);
    Rng rng(1);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            for (int c = 0; c < 3; ++c) {
                stripes.at(x, y, c) =
                    static_cast<std::uint8_t>((y % 20 < 6 ? 40 : 160) + rng.below(30));
            }
        }
    }
    const TexturePeriod period = find_period(stripes);
    ASSERT_GE(period.count, 1);
    EXPECT_TRUE(period.holds({0, 40}, 1));
    EXPECT_FALSE(period.holds({0, 30}, 4));
}

TEST(TexturePeriod, MarksTheTranslationsThatHold) {
    TexturePeriod none, rows, lattice, slanted;
    rows.count = 1, rows.steps[0] = {1, 17};
    lattice.count = 2, lattice.steps = {Vec2i{16, 16}, Vec2i{-16, 16}};
    slanted.count = 2, slanted.steps = {Vec2i{9, -2}, Vec2i{4, 21}};
    for (const TexturePeriod& period : {none, rows, lattice, slanted}) {
        for (const Vec2i first : {Vec2i{0, 0}, Vec2i{-70, 13}, Vec2i{200, -91}}) {
            const auto held = period.held(first, {49, 61}, 2);
            for (int y = 0; y < 61; ++y) {
                for (int x = 0; x < 49; ++x) {
                    ASSERT_EQ(held.at(x, y) != 0, period.holds(first + Vec2i{x, y}, 2))
                        << period.count << ": " << first.x + x << ", " << first.y + y;
                }
            }
        }
    }
}

TEST(TexturePeriod, BlobsHaveNone) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        EXPECT_EQ(find_period(blob_sample(96, 96, seed)).count, 0) << seed;
}

TEST(Repetition, ACopiedPictureRepeatsAndAFreshOneDoesNot) {
    const ImageU8x3 fresh = blob_sample(400, 400, 1);
    ImageU8x3 copied(400, 400);
    for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 400; ++x)
            std::copy_n(fresh.pixel(x % 90, y % 70), 3, copied.pixel(x, y));
    }
    const Repetition of_copied = measure_repetition(copied.view(), {});
    EXPECT_GT(of_copied.peak, 0.99);
    EXPECT_EQ(of_copied.peak_at.x % 90, 0);
    EXPECT_EQ(of_copied.peak_at.y % 70, 0);
    EXPECT_LT(measure_repetition(fresh.view(), {}).peak, 0.4);
}

TEST(Repetition, TellsTheTexturesOwnPeriodFromRepeats) {
    TexturePlane plane;
    plane.pixels = brick_sample(400, 400, 32, 16);
    plane.stats.period = find_period(plane.pixels.view().crop({0, 0, 96, 96}));
    // Each texel shows a pixel of its own, but for a copy of one part 130 px to the right.
    plane.source = Image<std::int32_t, 2>(400, 400);
    for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 400; ++x) {
            const bool copy = x >= 200;
            plane.source.pixel(x, y)[0] = copy ? x - 132 : x;
            plane.source.pixel(x, y)[1] = y;
        }
    }
    const Repetition r = measure_repetition(plane);
    EXPECT_GT(r.own_period, 0.95);
    EXPECT_LT(r.peak, r.own_period - 0.2);
    EXPECT_EQ(r.verbatim_at, (Vec2i{132, 0}));
    EXPECT_NEAR(r.verbatim, 132.0 / (400 - 132), 0.08);
}

TEST(PlacementMemory, AvoidsEqualStepsAndPlacesUsedNearby) {
    const Recti next{200, 0, 296, 96};
    const PlacementMemory steps({{{0, 0}, {0, 0, 96, 96}}, {{70, 3}, {70, 3, 166, 99}}}, {96, 96});
    const std::vector<Vec2i> origins{{140, 6}, {139, 8}};
    EXPECT_EQ(steps.least_repetitive(origins, next), (std::vector<Vec2i>{{139, 8}}));
    EXPECT_EQ(steps.least_repetitive({{140, 6}}, next), (std::vector<Vec2i>{{140, 6}}));
    // The neighbour shows the sample's left part; another place of it is free.
    const PlacementMemory used({{{100, 0}, {100, 0, 196, 96}}}, {96, 96});
    EXPECT_EQ(used.least_repetitive({{200, 0}, {50, 0}}, next), (std::vector<Vec2i>{{50, 0}}));
}

TEST(SampleAtlas, PlacesGoThereAndBack) {
    const ImageU8x3 a = blob_sample(40, 30, 1), b = blob_sample(25, 50, 2);
    const SampleAtlas atlas({a.view(), b.view()}, {true, true});
    ASSERT_EQ(atlas.pages().size(), 16u);
    const std::array<ViewU8x3, 2> samples{a.view(), b.view()};
    for (const SampleAtlas::Page& page : atlas.pages()) {
        for (int y = page.rect.y0; y < page.rect.y1; ++y) {
            for (int x = page.rect.x0; x < page.rect.x1; ++x) {
                const SampleAtlas::Place place = atlas.place_of({x, y});
                const ViewU8x3 s = samples[static_cast<std::size_t>(place.sample)];
                ASSERT_EQ(place.orientation, page.orientation);
                ASSERT_TRUE(std::equal(s.pixel(place.at.x, place.at.y),
                                       s.pixel(place.at.x, place.at.y) + 3,
                                       atlas.pixels().pixel(x, y)));
                ASSERT_EQ(atlas.position_of(place), (Vec2i{x, y}));
            }
        }
    }
    EXPECT_NE(atlas.page_of({0, 0}).orientation, atlas.pages()[1].orientation);
}

TEST(Orientations, PlanesOfSeveralTurnedSamplesRecount) {
    const ImageU8x3 a = blob_sample(96, 90, 1), b = blob_sample(110, 120, 2);
    for (const bool tileable : {false, true}) {
        PlaneOptions o = sized(300, 280);
        o.tileable = tileable;
        o.orientations = {true, true};
        const auto plane = grow_plane({a.view(), b.view()}, o);
        ASSERT_TRUE(plane);
        const SampleAtlas atlas({a.view(), b.view()}, o.orientations);
        const std::array<ViewU8x3, 2> samples{a.view(), b.view()};
        Image<std::int32_t, 2> source(o.size);
        std::array<int, 16> used{};
        for (int y = 0; y < 280; ++y) {
            for (int x = 0; x < 300; ++x) {
                const std::uint8_t* origin = plane->origin.pixel(x, y);
                const std::int32_t* s = plane->source.pixel(x, y);
                ASSERT_TRUE(std::equal(plane->pixels.pixel(x, y), plane->pixels.pixel(x, y) + 3,
                                       samples[origin[0]].pixel(s[0], s[1])));
                const Vec2i at = atlas.position_of({origin[0], origin[1], {s[0], s[1]}});
                source.pixel(x, y)[0] = at.x, source.pixel(x, y)[1] = at.y;
                ++used[static_cast<std::size_t>(origin[0] * 8 + origin[1])];
            }
        }
        EXPECT_DOUBLE_EQ(recount_energy(atlas, source, tileable).energy, plane->stats.seam_energy);
        EXPECT_GE(std::count_if(used.begin(), used.end(), [](int n) { return n > 500; }), 5);
    }
}

TEST(LightGuide, BrightPartsOfThePlaneFollowIt) {
    // A sample whose left half is dark and whose right half is bright, so large that a patch may
    // show either.
    constexpr int kSide = 440, kPlane = 400;
    ImageU8x3 sample = blob_sample(kSide, kSide, 3);
    for (int y = 0; y < kSide; ++y) {
        for (int i = 0; i < 3 * kSide; ++i) {
            sample.row(y)[i] =
                static_cast<std::uint8_t>(sample.row(y)[i] / 2 + (i / 3 < kSide / 2 ? 0 : 110));
        }
    }
    Image<std::uint8_t, 1> wanted(kPlane, kPlane);
    for (int y = 0; y < kPlane; ++y) {
        for (int x = 0; x < kPlane; ++x)
            wanted.at(x, y) = y < kPlane / 2 ? 60 : 200;
    }
    const auto difference = [](const TexturePlane& plane) {
        double above = 0, below = 0;
        for (int y = 0; y < kPlane; ++y) {
            for (int x = 0; x < kPlane; ++x)
                (y < kPlane / 2 ? above : below) += plane.pixels.at(x, y, 1);
        }
        return (below - above) / (kPlane * kPlane / 2);
    };
    const ImageU8x3 target = light_guide(sample, wanted);
    EXPECT_GT(target.at(0, kPlane - 1, 1), 2 * target.at(0, 0, 1));
    // Detail of the picture is no light: a fine checkerboard over it changes next to nothing.
    Image<std::uint8_t, 1> detailed = wanted;
    for (int y = 0; y < kPlane; ++y) {
        for (int x = 0; x < kPlane; ++x)
            detailed.at(x, y) =
                static_cast<std::uint8_t>(wanted.at(x, y) + ((x / 3 + y / 3) % 2 ? 40 : -40));
    }
    const ImageU8x3 smooth = light_guide(sample, detailed);
    int worst = 0;
    for (int y = 0; y < kPlane; ++y) {
        for (int x = 0; x < kPlane; ++x)
            worst = std::max(worst, std::abs(smooth.at(x, y, 1) - target.at(x, y, 1)));
    }
    EXPECT_LE(worst, 4);
    PlaneOptions o = sized(kPlane, kPlane);
    const double without = difference(*grow_plane(sample, o));
    const Image<std::uint8_t, 1> known(kPlane, kPlane, 255);
    o.guide = PlaneGuide{target, known, 1.0f};
    EXPECT_GT(difference(*grow_plane(sample, o)), without + 25);
}

TEST(SeamCostChoice, ThePapersVariantGrowsASoundPlane) {
    const ImageU8x3 sample = blob_sample(96, 96, 5);
    PlaneOptions o = sized(250, 200);
    o.seam_cost = SeamCost::kPaper;
    const auto plane = grow_plane(sample, o);
    ASSERT_TRUE(plane);
    expect_sound(sample, *plane, o);
    o.seam_cost = SeamCost::kGradient;
    o.refine_passes = 0;
    // It measures contrast, not mismatch.
    EXPECT_GT(plane->stats.seam_energy, grow_plane(sample, o)->stats.seam_energy);
}

}  // namespace
}  // namespace weft::test
