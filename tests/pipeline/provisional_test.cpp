#include "engine/pipeline/provisional.h"

#include <gtest/gtest.h>

#include <atomic>

#include "engine/compute/backend_registry.h"
#include "engine/pipeline/draft_analysis.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

const MemoryAnalysisStore kNothing;

// Notes what is stored.
class WatchedStore final : public AnalysisStore {
  public:
    [[nodiscard]] bool has(const AnalysisKey& key) const override { return kept_.has(key); }
    [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override {
        ++puts;
        return kept_.put(key, bytes);
    }
    [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override {
        return kept_.get(key);
    }
    std::atomic<int> puts = 0;  // by several threads

  private:
    MemoryAnalysisStore kept_;
};

RegionPlan lit_region(std::vector<int> references = {kFirst}) {
    RegionPlan region = make_region(sample_texture());
    region.reference_frames = std::move(references);
    region.light_source = LightSource::kPlate;
    return region;
}

ImageF3 rendered(const ShotSource& shot, const ShotPlan& plan, const AnalysisStore& store,
                 int frame, const std::vector<bool>& shown = {}) {
    std::vector<RegionScene> scenes;
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        if (!shown.empty() && !shown[static_cast<std::size_t>(k)]) {
            scenes.emplace_back();
            continue;
        }
        auto scene = make_scene(shot, plan, store, k, {}, {});
        EXPECT_TRUE(scene) << scene.error().text();
        scenes.push_back(scene ? std::move(*scene) : RegionScene());
    }
    auto made = render_frame(shot, plan, scenes, store, *make_cpu_backend(), frame);
    EXPECT_TRUE(made) << made.error().text();
    return made ? std::move(made->pixels) : ImageF3();
}

ImageF3 provisionally(const ShotSource& shot, const ShotPlan& plan, const AnalysisStore& known,
                      int frame) {
    const auto made = provisional_frame(shot, plan, known, frame);
    EXPECT_TRUE(made) << made.error().text();
    return made ? rendered(shot, made->plan, *made->store, frame, made->shown) : ImageF3();
}

ImageF3 exactly(const ShotSource& shot, const ShotPlan& plan, int frame) {
    MemoryAnalysisStore store;
    EXPECT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    return rendered(shot, plan, store, frame);
}

float largest_difference(const ImageF3& a, const ImageF3& b) {
    EXPECT_EQ(a.size(), b.size());
    float most = 0;
    for (std::size_t k = 0; a.size() == b.size() && k < a.size_bytes() / sizeof(float); ++k)
        most = std::max(most, std::abs(a.data()[k] - b.data()[k]));
    return most;
}

TEST(Provisional, OfTheReferenceFrameIsWhatARenderShowsIncludingPins) {
    const MemoryShot shot = make_wall(true);
    RegionPlan region = lit_region({4});
    region.has_holdout = true;
    region.corrections[4] = {{{40, 30}, {44, 31}}, {{60, 36}, {60, 36}}};
    const ShotPlan plan = make_plan(region);
    // With each frame's light estimated alone, it is the same light on the reference.
    EXPECT_EQ(largest_difference(provisionally(shot, plan, kNothing, 4), exactly(shot, plan, 4)),
              0.0f);
}

TEST(Provisional, DiffersInLightAloneFromAClipWhoseLightIsMeasuredTogether) {
    const MemoryShot shot = make_wall();
    RegionPlan region = lit_region();
    region.light_evidence = {1, 4, 7, 10};
    ShotPlan plan = make_plan(region);
    const ImageF3 first = provisionally(shot, plan, kNothing, kFirst);
    const ImageF3 exact = exactly(shot, plan, kFirst);
    EXPECT_GT(largest_difference(first, exact), 0.0f);
    plan.regions[0].light_source = LightSource::kNone;
    EXPECT_EQ(largest_difference(provisionally(shot, plan, kNothing, kFirst),
                                 exactly(shot, plan, kFirst)),
              0.0f);
}

TEST(Provisional, LeavesOutWhatIsNotKnownOnTheFrame) {
    MemoryShot shot = make_wall();
    shot.mattes[{1, 3}] = shot.mattes[{0, 3}];
    shot.keys[{2, kFirst}] = box_matte(kRegionBox);
    ShotPlan plan = make_plan(lit_region());  // its reference is another frame
    plan.regions.push_back(lit_region({3}));
    plan.regions.push_back(lit_region({3}));  // its matte has not been carried to frame 3
    plan.regions[2].matte_keys = {kFirst};
    const auto made = provisional_frame(shot, plan, kNothing, 3);
    ASSERT_TRUE(made) << made.error().text();
    EXPECT_EQ(made->shown, (std::vector<bool>{false, true, false}));
    EXPECT_TRUE(made->shows_anything());
    // The picture is that of the one region.
    MemoryShot alone = shot;
    alone.mattes[{0, 3}] = shot.mattes[{1, 3}];
    EXPECT_EQ(largest_difference(rendered(shot, made->plan, *made->store, 3, made->shown),
                                 exactly(alone, make_plan(lit_region({3}), 3, 3), 3)),
              0.0f);
    const auto nothing = provisional_frame(shot, make_plan(lit_region()), kNothing, 3);
    ASSERT_TRUE(nothing);
    EXPECT_FALSE(nothing->shows_anything());
}

TEST(Provisional, ShowsAPaintedMatteOnItsKeyAndReadsNoOtherFrame) {
    MemoryShot shot = make_wall();
    shot.mattes.clear();
    shot.keys[{0, 5}] = box_matte(kRegionBox);
    RegionPlan region = lit_region({5});
    region.matte_keys = {5};
    region.grain = 1;
    region.grain_frames = {5, 6, 7};
    region.shutter_deg.reset();
    region.shutter_evidence = {5, 6, 7};
    for (int frame = kFirst; frame <= kLast; ++frame)
        if (frame != 5) shot.plates.erase(frame);
    const ShotPlan plan = make_plan(region);
    const ImageF3 picture = provisionally(shot, plan, kNothing, 5);
    EXPECT_GT(largest_difference(picture, **shot.plate(5)), 0.05f);
}

TEST(Provisional, UsesWhatIsKnownAndStoresNothing) {
    const MemoryShot shot = make_wall();
    const ShotPlan plan = make_plan(lit_region());
    WatchedStore known;
    ASSERT_TRUE(analyse_shot(shot, plan, known, {}, {}));
    const int puts = known.puts;
    const auto made = provisional_frame(shot, plan, known, 6);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->shown, std::vector<bool>{true}) << "its place is known";
    EXPECT_EQ(*made->store->get({0, 6, AnalysisKind::kShading}),
              *known.get({0, 6, AnalysisKind::kShading}));
    EXPECT_FALSE(made->store->put({0, 6, AnalysisKind::kCoords}, {}));

    // Where only the light is missing, it is estimated.
    WatchedStore placed;
    for (int frame = kFirst; frame <= kLast; ++frame) {
        const AnalysisKey key{0, frame, AnalysisKind::kCoords};
        ASSERT_TRUE(placed.put(key, *known.get(key)));
    }
    const int before = placed.puts;
    const ImageF3 picture = provisionally(shot, plan, placed, 6);
    EXPECT_LT(largest_difference(picture, exactly(shot, plan, 6)), 0.25f);
    EXPECT_EQ(placed.puts, before);
    EXPECT_FALSE(placed.has({0, 6, AnalysisKind::kShading}));
    EXPECT_EQ(known.puts, puts);
}

TEST(Provisional, OfThePaperModeIsItsFirstPicture) {
    const MemoryShot shot = make_wall();
    RegionPlan region = lit_region({2});
    region.temporal = TemporalMode::kPaper;
    const ShotPlan plan = make_plan(region, 2, 3);
    EXPECT_EQ(largest_difference(provisionally(shot, plan, kNothing, 2), exactly(shot, plan, 2)),
              0.0f);
    const auto other = provisional_frame(shot, plan, kNothing, 3);
    ASSERT_TRUE(other);
    EXPECT_FALSE(other->shows_anything());
}

EarlierAnalysis stand_in(const ShotPlan& plan, const AnalysisStore& store) {
    return {&plan, &store, {0}};
}

TEST(Provisional, TakesFromAnEarlierAnalysisWhatIsNotKnown) {
    const MemoryShot shot = make_wall();
    const ShotPlan before = make_plan(lit_region());
    MemoryAnalysisStore then;
    ASSERT_TRUE(analyse_shot(shot, before, then, {}, {}));
    ShotPlan now = before;
    now.regions[0].reference_frames = {kFirst, 6};
    now.regions[0].corrections[6] = {{{60, 40}, {66, 42}}};
    const auto made = provisional_frame(shot, now, kNothing, 6, {stand_in(before, then)});
    ASSERT_TRUE(made) << made.error().text();
    EXPECT_EQ(made->shown, std::vector<bool>{true});
    // The pin moves the track of before; on its frame nothing else enters the exact one.
    MemoryAnalysisStore exact;
    ASSERT_TRUE(analyse_shot(shot, now, exact, {}, {}));
    const AnalysisKey track{0, 6, AnalysisKind::kCoords};
    EXPECT_EQ(decode_lattice(*made->store->get(track))->nodes(),
              decode_lattice(*exact.get(track))->nodes());
    EXPECT_EQ(*made->store->get({0, 6, AnalysisKind::kShading}),
              *then.get({0, 6, AnalysisKind::kShading}));
    // A surface that is followed from another frame lies elsewhere.
    now.regions[0].reference_frames = {2, 6};
    const auto other = provisional_frame(shot, now, kNothing, 6, {stand_in(before, then)});
    ASSERT_TRUE(other);
    EXPECT_FALSE(other->shows_anything());
    // So does another region.
    EarlierAnalysis none = stand_in(before, then);
    none.region_of = {-1};
    now.regions[0].reference_frames = {kFirst, 6};
    EXPECT_FALSE(provisional_frame(shot, now, kNothing, 6, {none})->shows_anything());
}

TEST(Provisional, TakesMattesFromBeforeAStroke) {
    MemoryShot shot = make_wall();
    shot.mattes.clear();
    for (const int key : {kFirst, 5})
        shot.keys[{0, key}] = box_matte(kRegionBox);
    RegionPlan region = lit_region();
    region.matte_keys = {kFirst};
    const ShotPlan before = make_plan(region);
    MemoryAnalysisStore then;
    ASSERT_TRUE(analyse_shot(shot, before, then, {}, {}));
    ShotPlan now = before;
    now.regions[0].matte_keys = {kFirst, 5};
    shot.keys[{0, 5}] = box_matte({20, 16, 100, 96});
    const auto matte = [&](int frame) {
        const auto made = provisional_frame(shot, now, kNothing, frame, {stand_in(before, then)});
        EXPECT_TRUE(made && made->shows_anything()) << frame;
        return decode_matte(*made->store->get({0, frame, AnalysisKind::kMatte}))->matte;
    };
    EXPECT_EQ(matte(5), (shot.keys[{0, 5}])) << "the stroke";
    EXPECT_EQ(matte(6), decode_matte(*then.get({0, 6, AnalysisKind::kMatte}))->matte);
}

class ShotWithPaintedHoldout final : public MemoryShot {
  public:
    ShotWithPaintedHoldout(const MemoryShot& shot, Matte holdout)
        : MemoryShot(shot), holdout_(std::move(holdout)) {}
    [[nodiscard]] Expected<Matte> holdout_key(int, int, int) const override { return holdout_; }

  private:
    Matte holdout_;
};

// The reference frame's holdout is not known then.
TEST(Provisional, ShowsAHoldoutOnTheFrameOnWhichItIsPainted) {
    MemoryShot painted = make_wall();
    painted.mattes.clear();
    painted.keys[{0, kFirst}] = box_matte(kRegionBox);
    const ShotWithPaintedHoldout shot(painted, box_matte({40, 30, 60, 60}));
    RegionPlan region = lit_region();
    region.matte_keys = {kFirst};
    const ShotPlan before = make_plan(region);
    MemoryAnalysisStore then;
    ASSERT_TRUE(analyse_shot(shot, before, then, {}, {}));
    ShotPlan now = before;
    now.regions[0].painted_holdouts.emplace_back().keys = {5};
    const auto at = [&](int frame) {
        auto made = provisional_frame(shot, now, kNothing, frame, {stand_in(before, then)});
        EXPECT_TRUE(made) << made.error().text();
        return std::move(*made);
    };
    const ProvisionalFrame made = at(5);
    ASSERT_TRUE(made.shows_anything());
    const ImageF3 with = rendered(shot, made.plan, *made.store, 5, made.shown);
    const ImageF3 without = rendered(shot, before, then, 5);
    const ImageF3& plate = **shot.plate(5);
    EXPECT_NE(without.pixel(50, 45)[0], plate.pixel(50, 45)[0]);
    EXPECT_EQ(with.pixel(50, 45)[0], plate.pixel(50, 45)[0]) << "it is cut out";
    EXPECT_NE(with.pixel(75, 45)[0], plate.pixel(75, 45)[0]);
    EXPECT_FALSE(at(6).shows_anything()) << "the holdout has not been propagated there";
}

TEST(DraftAnalysis, LeadsToAFrameOnTheShortestWay) {
    MemoryShot shot = make_wall();
    shot.mattes.clear();
    for (const int key : {3, 9})
        shot.keys[{0, key}] = box_matte(kRegionBox);
    RegionPlan region = lit_region({3});
    region.matte_keys = {3, 9};
    region.light_evidence = {1, 4, 7, 10};
    ShotPlan plan = make_plan(region);
    plan.regions.push_back(lit_region());
    for (const int beyond : {1, 2, 6, 7, 8, 9, 10})
        shot.plates.erase(beyond);  // only what lies on the way is read
    const auto draft = draft_analysis(shot, plan, 5, {true, false});
    ASSERT_TRUE(draft) << draft.error().text();
    const AnalysisStore& store = (*draft)->store;
    for (const int frame : {3, 4, 5}) {
        EXPECT_TRUE(store.has({0, frame, AnalysisKind::kMatte})) << frame;
        EXPECT_TRUE(store.has({0, frame, AnalysisKind::kCoords})) << frame;
    }
    EXPECT_FALSE(store.has({1, 5, AnalysisKind::kCoords})) << "it was not asked for";
    const auto made = provisional_frame(shot, plan, kNothing, 5, {(*draft)->as_earlier()});
    ASSERT_TRUE(made) << made.error().text();
    EXPECT_EQ(made->shown, (std::vector<bool>{true, false}));
    const auto field = decode_lattice(*made->store->get({0, 5, AnalysisKind::kCoords}));
    ASSERT_TRUE(field);
    const Vec2 wanted = wall_moved({0, 0}, 3) - wall_moved({0, 0}, 5);
    EXPECT_LT(distance(field->at({80, 56}), wanted), 0.3f);
    const CancelToken stop;
    stop.cancel();
    EXPECT_FALSE(draft_analysis(shot, plan, 5, {true, false}, stop));
}

TEST(Provisional, IsCancelled) {
    const CancelToken stop;
    stop.cancel();
    EXPECT_FALSE(provisional_frame(make_wall(), make_plan(lit_region()), kNothing, 1, {}, stop));
}

}  // namespace
}  // namespace weft
