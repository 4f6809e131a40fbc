#include "app/cache/analysis_key.h"

#include <functional>

#include "app/shot/painted_mattes.h"
#include "engine/media/frame_writer.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

class AnalysisKeyTest : public ShotTest {
  protected:
    RegionKeys keys_after(const std::function<void(Region&)>& change,
                          Quality quality = Quality::kDraft) const {
        JobSpec job = spec("out");
        job.project.settings.quality = quality;
        Region region = *job.project.regions[0];
        change(region);
        job.project.regions[0] = region;
        const auto shot = open_shot(job.project);
        EXPECT_TRUE(shot) << (shot ? "" : shot.error().text());
        const auto keys = shot ? region_keys(**shot, 0, {}) : Expected<RegionKeys>(RegionKeys());
        EXPECT_TRUE(keys) << (keys ? "" : keys.error().text());
        return keys.value_or(RegionKeys());
    }
    std::string surface_after(const std::function<void(Region&)>& change) const {
        return keys_after(change).surface;
    }
    // Painted mattes are known by their contents.
    void write_different_mattes() const {
        int frame = 0;
        for (const char* name : {"a.png", "b.png", "c.png"})
            ASSERT_TRUE(write_matte(in(name), card_matte(++frame), WriteRule::own()));
    }
    static Zone zone(double value, MatteSource matte) {
        Zone out;
        out.value = value;
        out.matte = std::move(matte);
        return out;
    }
};

TEST_F(AnalysisKeyTest, NamesWhatTheAnalysisDependsOnAndNothingElse) {
    const std::string plain = surface_after([](Region&) {});
    EXPECT_EQ(plain.size(), 32u);
    EXPECT_EQ(surface_after([](Region& r) { r.placement.scale = 3; }), plain);
    EXPECT_EQ(surface_after([](Region& r) { r.light.strength = 0.2; }), plain);
    EXPECT_NE(surface_after([](Region& r) {
                  r.matte = r.matte.with([](MatteSource& m) { m.select.invert = true; });
              }),
              plain);
    EXPECT_NE(surface_after([](Region& r) { r.reference_frames = {3}; }), plain);
}

TEST_F(AnalysisKeyTest, OfZonesItNamesWhatIsPropagated) {
    ASSERT_TRUE(write_matte(in("zone.png"), card_matte(1), WriteRule::own()));
    MatteSource files, painted, elsewhere;
    files.files = in("zone.png");
    painted.keyframes[2] = {in("zone.png")};
    elsewhere.keyframes[3] = {in("zone.png")};
    const auto keys = [&](double value, const MatteSource& matte) {
        return keys_after([&](Region& r) { r.zones = std::vector<Zone>{zone(value, matte)}; });
    };
    const RegionKeys plain_keys = keys_after([](Region&) {});
    const std::string& plain = plain_keys.surface;
    EXPECT_EQ(keys(0, files), plain_keys);
    const RegionKeys of_painted = keys(0, painted);
    EXPECT_EQ(of_painted.surface, plain) << "the surface does not follow its zones";
    EXPECT_EQ(of_painted.mattes.size(), 1u);
    EXPECT_EQ(keys(1.5, painted), of_painted) << "values are applied when a frame is rendered";
    EXPECT_NE(keys(0, elsewhere), of_painted);
}

TEST_F(AnalysisKeyTest, ADraftAndItsFinalShareThePropagatedMattes) {
    write_different_mattes();
    const auto keys = [&](Quality quality) {
        return keys_after(
            [&](Region& r) {
                MatteSource painted;
                painted.keyframes[1] = {in("a.png")};
                r.matte = painted;
            },
            quality);
    };
    const RegionKeys draft = keys(Quality::kDraft), final = keys(Quality::kFinal);
    EXPECT_EQ(draft.mattes, final.mattes);
    EXPECT_NE(draft.surface, final.surface) << "light is estimated more finely";
    EXPECT_NE(draft.focus, final.focus);
}

TEST_F(AnalysisKeyTest, AKeyframeNamesTheMattesUpToItsNeighboursOnly) {
    write_different_mattes();
    const auto keys = [&](const std::map<int, std::string>& painted) {
        return keys_after([&](Region& r) {
            MatteSource matte;
            for (const auto& [frame, name] : painted)
                matte.keyframes[frame] = {in(name)};
            r.matte = matte;
            r.reference_frames = {1};
        });
    };
    const auto matte_on = [](int frame) { return AnalysisKey{0, frame, AnalysisKind::kMatte}; };
    const RegionKeys before = keys({{1, "a.png"}, {3, "a.png"}, {5, "a.png"}});
    const RegionKeys stroke = keys({{1, "a.png"}, {3, "a.png"}, {5, "b.png"}});
    const RegionKeys more = keys({{1, "a.png"}, {3, "a.png"}, {4, "c.png"}, {5, "a.png"}});
    const auto same = [&](const RegionKeys& other) {
        std::vector<int> out;
        for (int frame = 1; frame <= kFrames; ++frame)
            if (before.of(matte_on(frame)) == other.of(matte_on(frame))) out.push_back(frame);
        return out;
    };
    EXPECT_EQ(same(stroke), (std::vector<int>{1, 2}));
    EXPECT_EQ(same(more), (std::vector<int>{1, 2, 5, 6}));
    EXPECT_NE(stroke.surface, before.surface) << "its motion depends on all of them";
    EXPECT_EQ(before.of({0, 3, AnalysisKind::kCoords}), before.surface);
    EXPECT_EQ(before.all().size(), 3u + 4u) << "surface, form, focus and mattes";
}

TEST_F(AnalysisKeyTest, WhatIsConfirmedNamesTheMattesUpToTheKeyframesAround) {
    write_different_mattes();
    const auto keys = [&](const std::map<int, ConfirmedEdge>& confirmed) {
        return keys_after([&](Region& r) {
            MatteSource matte;
            for (const int frame : {1, 3, 5})
                matte.keyframes[frame] = {in("a.png")};
            matte.confirmed = confirmed;
            r.matte = matte;
            r.reference_frames = {1};
        });
    };
    const RegionKeys before = keys({});
    const auto changed = [&](const RegionKeys& other) {
        std::vector<int> out;
        for (int frame = 1; frame <= kFrames; ++frame) {
            const AnalysisKey key{0, frame, AnalysisKind::kMatte};
            if (before.of(key) != other.of(key)) out.push_back(frame);
        }
        return out;
    };
    const RegionKeys four = keys({{4, {in("b.png"), in("c.png")}}});
    EXPECT_EQ(changed(four), (std::vector<int>{3, 4}));
    EXPECT_NE(four.surface, before.surface);
    EXPECT_EQ(changed(keys({{6, {in("b.png"), in("c.png")}}})), (std::vector<int>{5, 6}));
    EXPECT_NE(keys({{4, {in("b.png"), in("b.png")}}}).surface, four.surface) << "another area";
    EXPECT_EQ(keys({{3, {in("b.png"), in("c.png")}}}), before) << "all of a keyframe counts";
}

TEST_F(AnalysisKeyTest, AMatteDependsOnTheHoldoutsInFrontOfItAndNotTheyOnIt) {
    write_different_mattes();
    const auto keys = [&](const char* matte, const char* holdout) {
        return keys_after([&](Region& r) {
            MatteSource painted, front;
            painted.keyframes[1] = {in(matte)};
            front.keyframes[3] = {in(holdout)};
            r.matte = painted;
            r.holdouts = std::vector<MatteSource>{front};
            r.reference_frames = {1};
        });
    };
    const RegionKeys before = keys("a.png", "a.png");
    const RegionKeys holdout = keys("a.png", "b.png"), matte = keys("b.png", "a.png");
    const AnalysisKey behind{0, 2, AnalysisKind::kMatte}, front{0, 2, AnalysisKind::kMatte, 1};
    EXPECT_NE(holdout.of(behind), before.of(behind));
    EXPECT_NE(holdout.of(front), before.of(front));
    EXPECT_NE(matte.of(behind), before.of(behind));
    EXPECT_EQ(matte.of(front), before.of(front));
}

}  // namespace
}  // namespace weft::test
