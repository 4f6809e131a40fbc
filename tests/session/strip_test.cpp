// The cards of the strip: what they show, what choosing one does, and who works them out.
#include "app/session/viewer/strip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace weft::test {
namespace {

using ::testing::ElementsAre;

StripSubject subject() {
    StripSubject out;
    Region region;
    region.id = 4;
    region.name = "wall";
    region.matte = [] {
        MatteSource matte;
        matte.keyframes[1001] = {"/shot/m.png"};
        return matte;
    }();
    region.texture.sample = "/shot/brick.png";
    region.placement.scale = 2;
    out.project.plate.path = "/shot/####.png";
    out.project.regions.emplace_back(region);
    out.shown = true;
    out.folder = "/shot";
    return out;
}

StripQuery question(StripKind kind) {
    StripQuery out;
    out.document = 1;
    out.kind = kind;
    out.region = 4;
    out.frame = 1002;
    return out;
}

std::vector<std::string> labels(const StripCards& cards) {
    std::vector<std::string> out;
    for (const CardRequest& request : cards.requests)
        out.push_back(request.label);
    return out;
}

TEST(StripCards, ScalesAroundTheCurrentOne) {
    const StripCards cards = make_strip_cards(question(StripKind::kScale), subject());
    EXPECT_THAT(labels(cards),
                ElementsAre("Scale 1.00", "Scale 1.42", "Scale 2.00", "Scale 2.82", "Scale 4.00"));
    ASSERT_EQ(cards.choices.size(), 5u);
    EXPECT_TRUE(cards.requests[2].current);
    EXPECT_FALSE(cards.requests[1].current);
    EXPECT_EQ(cards.requests[0].project.regions[0]->placement.scale, 1);
    EXPECT_EQ(cards.requests[0].frame, 1002);
    EXPECT_NE(cards.requests[0].key, cards.requests[1].key);
    const Action chosen = DoEdit{SetRegionParameter{{4, {}}, "placement.scale", 4.0}};
    EXPECT_EQ(cards.choices[4], chosen);
    EXPECT_EQ(cards.columns, 0);
}

TEST(StripCards, ASheetShowsEachSettingOnEachFrame) {
    StripQuery asked = question(StripKind::kLight);
    asked.over_time = true;
    asked.frames = {1001, 1003, 1005};
    const StripCards cards = make_strip_cards(asked, subject());
    EXPECT_EQ(cards.columns, 3);
    ASSERT_EQ(cards.requests.size(), 12u);
    ASSERT_EQ(cards.choices.size(), 12u);
    EXPECT_EQ(cards.requests[4].frame, 1003);
    EXPECT_EQ(cards.requests[4].label, cards.requests[3].label);
    EXPECT_EQ(cards.choices[4], cards.choices[3]);
    EXPECT_NE(cards.requests[4].key, cards.requests[3].key);
}

TEST(StripCards, TexturesAreAppliedAndLieBesideTheProject) {
    StripQuery asked = question(StripKind::kTextures);
    asked.textures = {"new/slate.png", "db:0123"};
    const StripCards cards = make_strip_cards(asked, subject());
    EXPECT_THAT(labels(cards), ElementsAre("Current", "slate", "db:0123"));
    EXPECT_EQ(cards.choices[0], std::nullopt);
    EXPECT_EQ(cards.choices[1], Action(ApplyTexture{"new/slate.png", 0}));
    EXPECT_EQ(cards.requests[1].project.regions[0]->texture.sample, "/shot/new/slate.png");
    EXPECT_EQ(cards.requests[2].project.regions[0]->texture.sample, "db:0123");
    EXPECT_EQ(cards.requests[1].note, "new/slate.png");
    EXPECT_EQ(cards.requests[1].around, 0u);
    asked.kind = StripKind::kSuggested;
    EXPECT_EQ(make_strip_cards(asked, subject()).requests[0].around, 4u) << "and no card as it is";
}

// It is disabled in the preview's project, since nothing of it can be rendered.
TEST(StripCards, ATextureIsShownOnARegionThatHasNone) {
    StripSubject bare = subject();
    bare.project.regions[0] = bare.project.regions[0].with([](Region& r) { r.enabled = false; });
    StripQuery asked = question(StripKind::kTextures);
    asked.textures = {"slate.png"};
    EXPECT_TRUE(make_strip_cards(asked, bare).requests[1].project.regions[0]->enabled);
    bare.shown = false;
    EXPECT_FALSE(make_strip_cards(asked, bare).requests[1].project.regions[0]->enabled);
}

TEST(StripCards, KeyframesGoToTheirFrames) {
    StripQuery asked = question(StripKind::kKeyframes);
    asked.frames = {1001, 1010};
    const StripCards cards = make_strip_cards(asked, subject());
    EXPECT_THAT(labels(cards), ElementsAre("Frame 1001", "Frame 1010"));
    EXPECT_EQ(cards.choices[1], Action(GoToFrame{1010}));
}

TEST(StripFrames, AreSpreadOverTheShotOrTheMarks) {
    std::vector<int> frames;
    for (int f = 1; f <= 100; ++f)
        frames.push_back(f);
    EXPECT_THAT(strip_frames(frames, 0, 99, false), ElementsAre(1, 10, 20, 40));
    EXPECT_THAT(strip_frames(frames, 9, 39, true), ElementsAre(10, 20, 30, 40));
    EXPECT_THAT(strip_frames({5, 6}, 0, 1, false), ElementsAre(5, 6));
    EXPECT_THAT(sheet_frames(frames, 0, 99), testing::SizeIs(8));
    EXPECT_THAT(sheet_frames(frames, 3, 4), ElementsAre(4, 5));
}

TEST(Strip, AnswersTheNewestQueryOnly) {
    Strip strip;
    strip.show(StripKind::kScale, {}, false);
    EXPECT_EQ(strip.cards(), nullptr);
    strip.ask(question(StripKind::kScale), subject());
    EXPECT_TRUE(strip.asked(question(StripKind::kScale)));
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!strip.update() && std::chrono::steady_clock::now() < end)
        std::this_thread::yield();
    ASSERT_NE(strip.cards(), nullptr);
    EXPECT_EQ(strip.cards()->requests.size(), 5u);
    EXPECT_FALSE(strip.update()) << "nothing new";
    strip.show(StripKind::kLight, {}, false);
    EXPECT_EQ(strip.cards(), nullptr) << "those are of another kind";
    EXPECT_TRUE(strip.clear());
    EXPECT_FALSE(strip.clear());
    EXPECT_FALSE(strip.asked(question(StripKind::kScale)));
}

}  // namespace
}  // namespace weft::test
