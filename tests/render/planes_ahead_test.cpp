#include "app/render/planes_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/parallel.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// A region to be grown, one whose sample is too small for that, one without a plane of its own.
ShotPlan three_regions() {
    ShotPlan plan = make_plan(make_region(sample_texture()));
    auto tiny = std::make_shared<TexturePicture>();
    tiny->pixels = ImageF3(1, 1);
    plan.regions.push_back(make_region(tiny));
    RegionPlan paper = make_region(sample_texture());
    paper.temporal = TemporalMode::kPaper;
    plan.regions.push_back(paper);
    return plan;
}

TEST(PlanesAhead, EqualPlanesMadeInPlace) {
    const ShotPlan plan = three_regions();
    PlanesAhead ahead(plan, kShotSize, {}, nullptr);
    auto grown = ahead.take(0);
    ASSERT_TRUE(grown && *grown);
    const auto in_place = make_plane(plan, plan.regions[0], kShotSize, {}, {});
    ASSERT_TRUE(in_place);
    const auto a = (*grown)->pyramid.levels(), b = in_place->pyramid.levels();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        ASSERT_EQ(a[k].size(), b[k].size());
        EXPECT_TRUE(
            std::equal(a[k].data(), a[k].data() + a[k].size_bytes() / sizeof(float), b[k].data()));
    }
    EXPECT_EQ((*grown)->stats->seam_length_px, in_place->stats->seam_length_px);

    const auto paper = ahead.take(2);
    ASSERT_TRUE(paper);
    EXPECT_FALSE(*paper) << "this mode makes one for every frame";
}

TEST(PlanesAhead, ManyInParallelHaveTheSameBytes) {
    ShotPlan plan = make_plan(make_region(sample_texture()));
    for (std::uint64_t key = 2; key <= 9; ++key) {
        plan.regions.push_back(plan.regions.front());
        plan.regions.back().random_key = key;
    }
    set_thread_count(3);
    PlanesAhead ahead(plan, kShotSize, {}, nullptr);
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        auto grown = ahead.take(k);
        ASSERT_TRUE(grown && *grown);
        const auto in_place = make_plane(plan, plan.regions[k], kShotSize, {}, {});
        ASSERT_TRUE(in_place);
        const auto &a = (*grown)->pyramid.levels()[0], &b = in_place->pyramid.levels()[0];
        ASSERT_EQ(a.size(), b.size());
        EXPECT_TRUE(std::equal(a.data(), a.data() + a.size_bytes() / sizeof(float), b.data())) << k;
    }
    set_thread_count(0);
}

TEST(PlanesAhead, AnErrorIsReturnedForItsRegion) {
    const ShotPlan plan = three_regions();
    PlanesAhead ahead(plan, kShotSize, {}, nullptr);
    const auto tiny = ahead.take(1);
    const auto in_place = make_plane(plan, plan.regions[1], kShotSize, {}, {});
    ASSERT_FALSE(tiny);
    ASSERT_FALSE(in_place);
    EXPECT_EQ(tiny.error().text(), in_place.error().text());
}

TEST(PlanesAhead, StopWhenCancelledOrDestroyed) {
    const ShotPlan plan = three_regions();
    { const PlanesAhead unwanted(plan, kShotSize, {}, nullptr); }
    const CancelToken cancel;
    cancel.cancel();
    PlanesAhead ahead(plan, kShotSize, cancel, nullptr);
    EXPECT_FALSE(ahead.take(0));
}

}  // namespace
}  // namespace weft
