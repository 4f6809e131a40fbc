#include "engine/pipeline/analyse.h"

#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/surface_pass.h"
#include "engine/pipeline/surface_stop.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

RegionPlan region_from(std::vector<int> references) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.reference_frames = std::move(references);
    return region;
}

// Mean distance inside the region from where the wall's points were on the reference frame.
float coords_error(const AnalysisStore& store, int frame, int reference) {
    const LatticeField field = stored_coords(store, frame);
    if (field.empty()) return 1e9f;
    float sum = 0;
    int count = 0;
    for (int y = kRegionBox.y0; y < kRegionBox.y1; y += 3) {
        for (int x = kRegionBox.x0; x < kRegionBox.x1; x += 3, ++count) {
            const Vec2 p = centre_of(x, y);
            sum += distance(p + field.at(p), wall_moved(p, reference - frame));
        }
    }
    return sum / static_cast<float>(count);
}

TEST(Analysis, FollowsTheSurfaceBothWaysFromAMiddleReference) {
    const MemoryShot shot = make_wall();
    MemoryAnalysisStore store;
    analyse(shot, make_plan(region_from({5})), store);
    for (int frame = kFirst; frame <= kLast; ++frame)
        EXPECT_LT(coords_error(store, frame, 5), 0.15f) << frame;
    EXPECT_EQ(coords_error(store, 5, 5), 0.0f);
}

TEST(Analysis, DoesNotDependOnTheFramesAskedFor) {
    const MemoryShot shot = make_wall(true);
    RegionPlan region = region_from({4});
    region.has_holdout = true;
    region.light_source = LightSource::kPlate;
    const auto analysed = [&](int first, int last) {
        MemoryAnalysisStore store;
        analyse(shot, make_plan(region, first, last), store);
        std::vector<Bytes> out;
        for (const auto kind : {AnalysisKind::kCoords, AnalysisKind::kShading}) {
            const auto bytes = store.get({0, 8, kind});
            EXPECT_TRUE(bytes);
            out.push_back(bytes ? *bytes : Bytes());
        }
        return out;
    };
    const auto all = analysed(1, 10);
    EXPECT_FALSE(all[0].empty());
    EXPECT_EQ(analysed(7, 9), all);
    EXPECT_EQ(analysed(8, 8), all);
}

TEST(Analysis, DoesNotDependOnThreads) {
    const MemoryShot shot = make_wall(true);
    RegionPlan region = region_from({1});
    region.has_holdout = true;
    region.light_source = LightSource::kPlate;
    const auto analysed = [&](int threads) {
        set_thread_count(threads);
        MemoryAnalysisStore store;
        analyse(shot, make_plan(region, 1, 4), store);
        set_thread_count(0);
        return std::pair(*store.get({0, 4, AnalysisKind::kCoords}),
                         *store.get({0, 4, AnalysisKind::kShading}));
    };
    EXPECT_EQ(analysed(1), analysed(3));
}

TEST(Analysis, RegionsSideBySideAreThoseOneAfterTheOther) {
    MemoryShot shot = make_wall();
    for (int frame = kFirst; frame <= kLast; ++frame)
        shot.mattes[{1, frame}] = box_matte({30, 24, 90, 80});
    ShotPlan plan = make_plan(region_from({1}), 1, 5);
    plan.regions.push_back(region_from({3}));
    const auto analysed = [&](int threads) {
        set_thread_count(threads);
        MemoryAnalysisStore store;
        analyse(shot, plan, store);
        set_thread_count(0);
        std::vector<Bytes> out;
        for (const int region : {0, 1}) {
            for (int frame = 1; frame <= 5; ++frame)
                out.push_back(*store.get({region, frame, AnalysisKind::kCoords}));
        }
        return out;
    };
    const auto alone = analysed(1);
    EXPECT_EQ(analysed(2), alone);   // side by side
    EXPECT_EQ(analysed(16), alone);  // steps of several frames, too
}

// More frames on their way take more memory.
TEST(Analysis, FramesArePreparedSideBySideWhereThreadsAndMemoryAllow) {
    const MemoryShot shot = make_wall();
    const MemoryAnalysisStore store;
    const std::vector<SurfaceJob> none;
    const auto ahead = [&](int threads, bool spare_memory) {
        ShotPlan plan = make_plan(region_from({1}));
        plan.spare_memory = spare_memory;
        const PassContext context{shot, plan, {}, {}, nullptr};
        set_thread_count(threads);
        const int frames = SurfaceStops(context, store, none, SurfaceLeg::kForward).ahead();
        set_thread_count(0);
        return frames;
    };
    EXPECT_EQ(ahead(2, false), 1);
    EXPECT_EQ(ahead(8, false), 2);
    EXPECT_EQ(ahead(64, false), 4);
    EXPECT_EQ(ahead(64, true), 1);
}

TEST(Analysis, TwoReferencesAreBlendedBetweenAndKeptThemselves) {
    const MemoryShot shot = make_wall();
    MemoryAnalysisStore one, two;
    analyse(shot, make_plan(region_from({2})), one);
    analyse(shot, make_plan(region_from({2, 8})), two);
    // At the references, and up to the second, where the walk came from.
    EXPECT_EQ(stored_coords(two, 2).nodes(), stored_coords(one, 2).nodes());
    EXPECT_EQ(stored_coords(two, 8).nodes(), stored_coords(one, 8).nodes());
    EXPECT_EQ(stored_coords(two, 1).nodes(), stored_coords(one, 1).nodes());
    // Between them the track of the second one counts too, without a jump beside it.
    EXPECT_NE(stored_coords(two, 5).nodes(), stored_coords(one, 5).nodes());
    for (int frame = kFirst; frame <= kLast; ++frame)
        EXPECT_LT(coords_error(two, frame, 2), 0.2f) << frame;
}

TEST(Analysis, AHeldDrawingHasTheSameCoordinatesToTheBit) {
    MemoryShot shot = make_wall();
    // Frames 4 and 5 show the drawing of frame 3.
    shot.plates[4] = shot.plates[5] = shot.plates[3];
    MemoryAnalysisStore store;
    analyse(shot, make_plan(region_from({1})), store);
    EXPECT_EQ(stored_coords(store, 4).nodes(), stored_coords(store, 3).nodes());
    EXPECT_EQ(stored_coords(store, 5).nodes(), stored_coords(store, 3).nodes());
    EXPECT_NE(stored_coords(store, 6).nodes(), stored_coords(store, 5).nodes());
}

TEST(Analysis, AHeldDrawingHoldsBetweenReferencesToo) {
    MemoryShot shot = make_wall();
    for (const int held : {4, 5})
        shot.plates[held] = shot.plates[3];
    shot.plates[9] = shot.plates[8];
    // A correction of 6 px that has to be spread between frames 2 and 9.
    RegionPlan region = region_from({2, 9});
    region.corrections[9] = {{{80, 60}, {86, 60}}};
    for (const std::vector<int>& references : {std::vector<int>{2, 9}, std::vector<int>{9, 2}}) {
        region.reference_frames = references;
        MemoryAnalysisStore store;
        analyse(shot, make_plan(region), store);
        EXPECT_EQ(stored_coords(store, 4).nodes(), stored_coords(store, 3).nodes());
        EXPECT_EQ(stored_coords(store, 5).nodes(), stored_coords(store, 3).nodes());
        EXPECT_NE(stored_coords(store, 6).nodes(), stored_coords(store, 5).nodes());
        EXPECT_EQ(stored_coords(store, 8).nodes(), stored_coords(store, 9).nodes())
            << "a drawing with a reference lies as the reference does";
    }
}

TEST(Analysis, ACorrectionHoldsFromItsFrameOnAndIsSpreadBeforeIt) {
    const MemoryShot shot = make_wall();
    RegionPlan region = region_from({2, 8});
    region.corrections[8] = {{{80, 60}, {86, 60}}};
    MemoryAnalysisStore plain, moved;
    analyse(shot, make_plan(region_from({2, 8})), plain);
    analyse(shot, make_plan(region), moved);
    // How far the texture stands from where it would be without the correction, on each frame.
    const auto shift = [&](int frame) {
        const Vec2 p(90, 60);
        return distance(p + stored_coords(moved, frame).at(p),
                        p + stored_coords(plain, frame).at(p));
    };
    EXPECT_EQ(shift(1), 0);
    EXPECT_EQ(shift(2), 0);
    EXPECT_GT(shift(5), 1.5f);
    EXPECT_LT(shift(5), 4.5f);
    EXPECT_NEAR(shift(8), 6, 0.5);
    EXPECT_NEAR(shift(10), 6, 0.6);
    EXPECT_LT(shift(3), shift(5));
    EXPECT_LT(shift(5), shift(7));
}

TEST(Analysis, ACorrectionBeforeThePlacementIsSpreadToo) {
    const MemoryShot shot = make_wall();
    RegionPlan region = region_from({8, 3});
    region.corrections[3] = {{{80, 60}, {80, 65}}};
    MemoryAnalysisStore plain, moved;
    analyse(shot, make_plan(region_from({8, 3})), plain);
    analyse(shot, make_plan(region), moved);
    const auto shift = [&](int frame) {
        const Vec2 p(90, 60);
        return distance(stored_coords(moved, frame).at(p), stored_coords(plain, frame).at(p));
    };
    EXPECT_EQ(shift(8), 0);
    EXPECT_EQ(shift(10), 0);
    EXPECT_NEAR(shift(3), 5, 0.5);
    EXPECT_NEAR(shift(1), 5, 0.6);
    EXPECT_GT(shift(5), shift(7));
}

TEST(Analysis, TheFirstReferenceHoldsThePlacementWhereverItLies) {
    const MemoryShot shot = make_wall();
    MemoryAnalysisStore store;
    analyse(shot, make_plan(region_from({6, 2, 9})), store);
    EXPECT_EQ(coords_error(store, 6, 6), 0.0f);
    for (int frame = kFirst; frame <= kLast; ++frame)
        EXPECT_LT(coords_error(store, frame, 6), 0.2f) << frame;
}

TEST(Analysis, TheSurfaceComesBackWithItsCoordinates) {
    const MemoryShot shot = make_wall(true);
    RegionPlan region = region_from({1});
    region.has_holdout = true;
    MemoryAnalysisStore store;
    analyse(shot, make_plan(region), store);
    // The disc covers (80, 56) on frame 5 and has left it on frame 8.
    ASSERT_GT(disc_matte(5).at(80, 56), 0);
    ASSERT_EQ(disc_matte(8).at(80, 56), 0);
    const Vec2 p = centre_of(80, 56);
    for (const int frame : {4, 5, 6, 8, 10}) {
        EXPECT_LT(distance(p + stored_coords(store, frame).at(p), wall_moved(p, 1 - frame)), 0.35f)
            << frame;
        EXPECT_LT(coords_error(store, frame, 1), 0.2f) << frame;
    }
}

TEST(Analysis, TakesTrueMotionPointingEitherWay) {
    for (const bool forward : {true, false}) {
        MemoryShot shot = make_wall(true);
        for (int frame = kFirst; frame <= kLast; ++frame) {
            FlowField motion(kShotSize);
            const Matte disc = disc_matte(frame);
            for (int y = 0; y < kShotSize.height; ++y) {
                for (int x = 0; x < kShotSize.width; ++x) {
                    const Vec2 p = centre_of(x, y);
                    const Vec2 step = disc.at(x, y) ? Vec2(18, 0) : wall_moved(p, 1) - p;
                    motion.d.at(x, y, 0) = forward ? step.x : -step.x;
                    motion.d.at(x, y, 1) = forward ? step.y : -step.y;
                }
            }
            shot.motions[{0, frame}] = std::move(motion);
        }
        RegionPlan region = region_from({5});
        region.has_holdout = region.true_motion = true;
        region.motion_forward = forward;
        MemoryAnalysisStore store, with_more_threads;
        set_thread_count(1);
        analyse(shot, make_plan(region), store);
        set_thread_count(16);
        analyse(shot, make_plan(region), with_more_threads);
        set_thread_count(0);
        for (int frame = kFirst; frame <= kLast; ++frame) {
            EXPECT_LT(coords_error(store, frame, 5), 0.02f)
                << frame << (forward ? " forward" : " backward");
            EXPECT_EQ(*with_more_threads.get({0, frame, AnalysisKind::kCoords}),
                      *store.get({0, frame, AnalysisKind::kCoords}));
        }
    }
}

TEST(Analysis, FollowsATrackExactlyBothWaysAndThroughCorrections) {
    const MemoryShot shot = make_wall(false, false);  // the picture says that nothing moves
    RegionPlan region = region_from({5});
    for (int frame = kFirst; frame <= kLast; ++frame) {
        Quad<double>& quad = region.track[frame];
        const Vec2 corners[] = {{30, 30}, {120, 35}, {125, 90}, {25, 85}};
        for (std::size_t k = 0; k < 4; ++k)
            quad[k] = wall_moved(corners[k], frame);
    }
    MemoryAnalysisStore store;
    analyse(shot, make_plan(region), store);
    for (int frame = kFirst; frame <= kLast; ++frame)
        EXPECT_LT(coords_error(store, frame, 5), 1e-3f) << frame;

    region.reference_frames = {5, 8};
    region.corrections[8] = {{{80, 56}, {82, 56}}};
    MemoryAnalysisStore corrected;
    analyse(shot, make_plan(region), corrected);
    EXPECT_EQ(stored_coords(corrected, 5).at({80, 56}), (Vec2{0, 0}));
    for (const int frame : {8, 10})
        EXPECT_NEAR(coords_error(corrected, frame, 5), 2.0f, 1e-2f) << frame;
}

TEST(Analysis, AMissingFileOfTrueMotionIsTold) {
    const MemoryShot shot = make_wall();
    RegionPlan region = region_from({5});
    region.true_motion = true;
    for (const int threads : {1, 2, 16}) {
        set_thread_count(threads);
        MemoryAnalysisStore store;
        const Status status = analyse_shot(shot, make_plan(region), store, {}, {});
        set_thread_count(0);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::kMissingFrames);
    }
}

TEST(Analysis, ReportsEveryFrameOnce) {
    const MemoryShot shot = make_wall();
    const ShotPlan plan = make_plan(region_from({4}));
    MemoryAnalysisStore store;
    const int steps = count_surface_steps(plan, store);
    std::vector<ProgressEvent> events;
    expect_ok(
        analyse_shot(shot, plan, store, {}, [&](const ProgressEvent& e) { events.push_back(e); }));
    ASSERT_EQ(static_cast<int>(events.size()), steps);
    for (std::size_t k = 0; k < events.size(); ++k) {
        EXPECT_EQ(events[k].done, static_cast<int>(k) + 1);
        EXPECT_EQ(events[k].total, steps);
    }
    EXPECT_EQ(steps, 7 + 4);  // 4…10, then 4…1
}

TEST(Analysis, DoesNothingTwice) {
    const MemoryShot shot = make_wall();
    const ShotPlan plan = make_plan(region_from({1}), 1, 4);
    MemoryAnalysisStore store;
    analyse(shot, plan, store);
    const int read = shot.plates_read();
    EXPECT_EQ(count_surface_steps(plan, store), 0);
    analyse(shot, plan, store);
    EXPECT_EQ(shot.plates_read(), read);
}

TEST(Analysis, StopsSoonAfterItIsCancelled) {
    for (const int reason : {143, 130}) {
        const MemoryShot shot = make_wall();
        MemoryAnalysisStore store;
        const CancelToken cancel;
        int visited = 0;
        const Status status = analyse_shot(shot, make_plan(region_from({1})), store, cancel,
                                           [&](const ProgressEvent&) {
                                               if (++visited == 3) cancel.cancel(reason);
                                           });
        ASSERT_FALSE(status);
        EXPECT_EQ(exit_code(status.error().code), reason);
        EXPECT_EQ(visited, 3);
        EXPECT_LE(shot.plates_read(), 5);  // at most one was being read ahead
    }
}

TEST(Analysis, AMissingPlateIsToldWithItsFrame) {
    MemoryShot shot = make_wall();
    shot.plates.erase(6);
    MemoryAnalysisStore store;
    const Status status = analyse_shot(shot, make_plan(region_from({1})), store, {}, {});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::kMissingFrames);
    EXPECT_NE(status.error().text().find("frame 6"), std::string::npos);
    // What came before is kept, so that it need not be done again.
    EXPECT_TRUE(store.has({0, 5, AnalysisKind::kCoords}));
}

TEST(Mattes, KeyframesStayAsPainted) {
    MemoryShot shot = make_wall();
    shot.mattes.clear();
    RegionPlan region = region_from({1});
    region.matte_keys = {3, 8};
    // Painted by hand: with an edge that no propagation would give.
    for (const int key : region.matte_keys) {
        const Vec2 moved = wall_moved({0, 0}, key);
        Matte painted = draw(kShotSize, [&](Vec2 p) {
            const Vec2 q = p - moved;
            return q.x > 30 && q.x < 110 && q.y > 20 && q.y < 90 ? 1.0f : 0.0f;
        });
        painted.at(5, 5) = 77;
        shot.keys[{0, key}] = painted;
    }
    const ShotPlan plan = make_plan(region);
    MemoryAnalysisStore store;
    EXPECT_GT(count_matte_steps(plan, store), 0);
    analyse(shot, plan, store);
    EXPECT_EQ(count_matte_steps(plan, store), 0);
    for (int frame = kFirst; frame <= kLast; ++frame) {
        const auto bytes = store.get({0, frame, AnalysisKind::kMatte});
        ASSERT_TRUE(bytes) << frame;
        const auto matte = decode_matte(*bytes);
        ASSERT_TRUE(matte);
        if (frame == 3 || frame == 8) {
            EXPECT_EQ(matte->matte, (shot.keys[{0, frame}])) << frame;
            EXPECT_EQ(matte->confidence, 1.0f);
        }
        // The matte moves with the wall: its middle is in it, what lies well outside is not.
        const Vec2 middle = wall_moved({70, 55}, frame), outside = wall_moved({135, 55}, frame);
        EXPECT_GT(matte->matte.at(static_cast<int>(middle.x), static_cast<int>(middle.y)), 200)
            << frame;
        EXPECT_LT(matte->matte.at(static_cast<int>(outside.x), static_cast<int>(outside.y)), 50)
            << frame;
    }
}

TEST(Mattes, DoNotDependOnTheFramesAskedFor) {
    MemoryShot shot = make_wall();
    RegionPlan region = region_from({4});
    region.matte_keys = {3, 6};
    for (const int key : region.matte_keys)
        shot.keys[{0, key}] = box_matte(kRegionBox);
    const auto matte_of_5 = [&](int first, int last) {
        MemoryAnalysisStore store;
        analyse(shot, make_plan(region, first, last), store);
        const auto bytes = store.get({0, 5, AnalysisKind::kMatte});
        return bytes ? *bytes : Bytes();
    };
    const Bytes all = matte_of_5(1, 10);
    EXPECT_FALSE(all.empty());
    EXPECT_EQ(matte_of_5(5, 5), all);
}

TEST(Mattes, AMissingKeyframeIsTold) {
    const MemoryShot shot = make_wall();
    RegionPlan region = region_from({1});
    region.matte_keys = {3};
    MemoryAnalysisStore store;
    const Status status = analyse_shot(shot, make_plan(region), store, {}, {});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::kMissingFrames);
}

}  // namespace
}  // namespace weft
