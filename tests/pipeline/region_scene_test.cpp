#include "engine/pipeline/region_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/pipeline/synthesis_inputs.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// A second sample, unlike the first.
ImageF3 other_sample() {
    ImageF3 out(70, 64);
    const WaveTexture red(41), green(42), blue(43);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const Vec2 p = centre_of(x, y);
            out.at(x, y, 0) = static_cast<float>(code_of(red(p))) / 255.0f;
            out.at(x, y, 1) = static_cast<float>(code_of(green(p))) / 255.0f;
            out.at(x, y, 2) = static_cast<float>(code_of(blue(p))) / 255.0f;
        }
    }
    return out;
}

TEST(RegionScene, APlaneOfSeveralTurnedSamplesShowsTheirPixels) {
    auto texture = std::make_shared<TexturePicture>(*sample_texture());
    texture->also.push_back(other_sample());
    RegionPlan region = make_region(texture);
    region.orientations = {.rotations = true, .mirror = true};
    region.refine_passes = 1;
    const auto plane = grow_texture(region, plane_options(region, 3, {260, 220}));
    ASSERT_TRUE(plane) << plane.error().text();
    ImageF3 picture = plane_in_working_space(region, *plane);
    color("linear", "srgb")->apply(picture);
    std::set<int> samples, orientations;
    int wrong = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            samples.insert(plane->origin.pixel(x, y)[0]);
            orientations.insert(plane->origin.pixel(x, y)[1]);
            for (int c = 0; c < 3; ++c) {
                const long code = std::lround(255 * picture.at(x, y, c));
                wrong += code != plane->pixels.at(x, y, c);
            }
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(samples.size(), 2u);
    EXPECT_GT(orientations.size(), 3u);
}

TEST(RegionScene, EnlargedPlanesHaveFinerLevelsAsMemoryAllows) {
    for (int side = 64; side <= 4096; side += 64) {
        const int levels = finer_levels({side, side});
        EXPECT_LE(std::int64_t{side} * side << (2 * levels),
                  8'000'000 + (levels == 0 ? 1 << 24 : 0));
        if (side > 64) {
            EXPECT_LE(levels, finer_levels({side - 64, side - 64}));
        }
    }
    // A plate of 1920×1080, enlarged four times and twice, and as it is.
    const auto at = [](float scale) {
        PlanePlacement placement;
        placement.scale = scale;
        return finer_levels(plane_size(placement, {1920, 1080}));
    };
    EXPECT_EQ(at(4), 2);
    EXPECT_EQ(at(2), 1);
    EXPECT_EQ(at(1), 0);
}

TEST(RegionScene, SettingsReachTheSynthesis) {
    RegionPlan region = make_region(sample_texture());
    region.refine_passes = 7;
    region.seam_cost = SeamCost::kPaper;
    region.align = false;
    region.orientations.mirror = true;
    const PlaneOptions o = plane_options(region, 3, {260, 220});
    EXPECT_EQ(o.refine_passes, 7);
    EXPECT_EQ(o.seam_cost, SeamCost::kPaper);
    EXPECT_FALSE(o.align);
    EXPECT_TRUE(o.orientations.mirror);
    EXPECT_FALSE(o.orientations.rotations);
    const PlaneOptions standard = plane_options(make_region(sample_texture()), 3, {260, 220});
    EXPECT_EQ(standard.refine_passes, kDefaultRefinePasses);
    EXPECT_TRUE(standard.align);
}

TEST(RegionScene, LockedPatchesAreInTheRenderedPlane) {
    const MemoryShot shot = make_wall();
    ShotPlan plan = make_plan(make_region(sample_texture()), 1, 2);
    plan.keep_planes = true;
    MemoryAnalysisStore store;
    ASSERT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    const auto before = make_scene(shot, plan, store, 0, {}, {});
    ASSERT_TRUE(before) << before.error().text();
    ASSERT_TRUE(before->grown);
    PlaneAmendment kept;
    for (int y = 100; y < 140; ++y)
        for (int x = 60; x < 130; ++x) {
            const std::int32_t* from = before->grown->source.pixel(x, y);
            kept.runs.push_back({x, y, 1, from[0], from[1], 0, 0});
        }
    plan.seed = 8;
    const auto without = make_scene(shot, plan, store, 0, {}, {});
    plan.regions[0].amendments = {kept};
    const auto with = make_scene(shot, plan, store, 0, {}, {});
    ASSERT_TRUE(without && with);
    const auto same = [&](const RegionScene& other) {
        for (int y = 100; y < 140; ++y)
            for (int x = 60; x < 130; ++x)
                if (!std::equal(before->grown->pixels.pixel(x, y),
                                before->grown->pixels.pixel(x, y) + 3,
                                other.grown->pixels.pixel(x, y)))
                    return false;
        return true;
    };
    EXPECT_FALSE(same(*without));
    EXPECT_TRUE(same(*with));
    // A plane that was kept on disk without it is not taken for this one.
    const std::vector<ImageU8x3> samples = synthesis_samples(plan.regions[0]);
    PlaneOptions options = plane_options(plan.regions[0], plan.seed, {512, 512});
    const Hash128 plain = plane_key(samples, options);
    options.amendments = plan.regions[0].amendments;
    EXPECT_NE(plane_key(samples, options).hex(), plain.hex());
    const Hash128 amended = plane_key(samples, options);
    options.amendments[0].kind = PlaneAmendment::Kind::kAgain;
    EXPECT_NE(plane_key(samples, options).hex(), amended.hex());
}

}  // namespace
}  // namespace weft
