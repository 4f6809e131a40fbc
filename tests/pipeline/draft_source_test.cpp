// Drafts of large plates are found on smaller ones, and come out at the plate's size.
#include "engine/pipeline/draft_source.h"

#include <gtest/gtest.h>

#include "engine/mask/plate_edge.h"
#include "engine/pipeline/draft_analysis.h"
#include "tests/pipeline/plate_sizes.h"

namespace weft {
namespace {

TEST(DraftSource, ReducesByTheSizeOfThePlate) {
    const ShotPlan plan = scene::plan_of(FlowQuality::kDraft);
    EXPECT_EQ(draft_factor(plan, {160, 112}), 1);
    EXPECT_EQ(draft_factor(plan, {854, 480}), 2);
    EXPECT_EQ(draft_factor(plan, {1920, 1080}), 4);
    EXPECT_EQ(draft_factor(plan, {8192, 4320}), 8);
    ShotPlan given = plan;
    given.regions[0].true_motion = true;
    EXPECT_EQ(draft_factor(given, {1920, 1080}), 1) << "its files are in pixels of the plate";
}

TEST(DraftSource, AnEnlargedMatteHasItsEdgeWhereItWasAndAsSteep) {
    Matte full(61, 41);
    for (int y = 0; y < 41; ++y)
        for (int x = 0; x < 61; ++x)
            full.at(x, y) = x >= 20 && y >= 12 ? 255 : 0;
    const MemoryShot shot = [&] {
        MemoryShot of(full.size());
        of.mattes[{0, 1}] = full;
        return of;
    }();
    for (const int factor : {2, 4}) {
        const Matte back =
            enlarged(*DraftSource(shot, factor).matte(0, 1), Vec2(factor), full.size());
        ASSERT_EQ(back.size(), full.size());
        int soft = 0;
        for (int x = 0; x < 61; ++x) {
            soft += back.at(x, 30) > 0 && back.at(x, 30) < 255 ? 1 : 0;
            const bool near = std::abs(x - 20) <= factor;
            EXPECT_TRUE(near || back.at(x, 30) == full.at(x, 30)) << x;
        }
        EXPECT_LE(soft, 2);
    }
}

TEST(DraftSource, AWallIsFollowedAndItsMatteCarried) {
    constexpr Size kPlate{1280, 720};
    MemoryShot shot = scene::shot_of(kPlate, 0.4f, 1);
    shot.keys[{0, 0}] = shot.mattes[{0, 0}];
    shot.mattes.clear();
    ShotPlan plan = scene::plan_of(FlowQuality::kFinal);
    plan.regions[0].matte_keys = {0};
    ASSERT_EQ(draft_factor(plan, kPlate), 2);
    const auto draft = draft_analysis(shot, plan, 2, {true});
    ASSERT_TRUE(draft) << draft.error().text();
    const LatticeField field = stored_coords((*draft)->store, 2);
    EXPECT_EQ(field.full_size(), kPlate);
    // Two steps of a picture that is enlarged twice.
    EXPECT_LT(distance(field.at({640, 360}), -4.0f * scene::kStep_px), 0.6f);
    const auto bytes = (*draft)->store.get({0, 2, AnalysisKind::kMatte});
    ASSERT_TRUE(bytes);
    const Matte matte = decode_matte(*bytes)->matte;
    EXPECT_EQ(matte.size(), kPlate);
    EXPECT_EQ(matte.at(640, 360), 255);
    EXPECT_EQ(matte.at(60, 60), 0);
}

}  // namespace
}  // namespace weft
