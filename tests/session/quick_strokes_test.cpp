// Strokes drawn faster than their mattes are propagated: each builds on all the strokes before it.
#include <random>
#include <variant>

#include "app/session/mattes/propagated_mattes.h"
#include "engine/media/image_files.h"
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

constexpr int kFrame = 3;

// What an artist does, one thing after another.
using Deed = std::variant<std::vector<Vec2>, FillPolygon, Undo, Redo>;

struct Walk {
    std::vector<Deed> deeds;
    std::vector<Brush> brushes;  // of strokes, one for each deed
};

// `strokes` brush strokes and outlines, and some going back and forth among them.
Walk walk_of(int strokes, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto number = [&](int below) { return static_cast<int>(random() % below); };
    const auto place = [&] {
        return Vec2{static_cast<float>(20 + number(50)), static_cast<float>(12 + number(40))};
    };
    Walk out;
    while (strokes > 0) {
        Brush brush;
        brush.radius_px = static_cast<float>(2 + number(6));
        brush.hardness = 0.1f * static_cast<float>(number(11));
        brush.opacity = 0.5f + 0.1f * static_cast<float>(number(6));
        brush.subtract = number(3) == 0;
        out.brushes.push_back(brush);
        const int kind = number(8);
        if (kind == 0) {
            out.deeds.emplace_back(Undo{});
        } else if (kind == 1) {
            out.deeds.emplace_back(Redo{});
        } else if (kind < 4) {
            const Vec2 at = place();
            out.deeds.emplace_back(
                FillPolygon{{at, at + Vec2{9, 2}, at + Vec2{5, 8}}, brush.subtract, true});
            --strokes;
        } else {
            const Vec2 from = place(), to = place();
            out.deeds.emplace_back(std::vector<Vec2>{from, (from + to) / 2.0f, to});
            --strokes;
        }
    }
    return out;
}

// What is confirmed on the frame.
struct Confirmed {
    Matte matte, area;
    bool operator==(const Confirmed&) const = default;
};

class QuickStrokes : public SessionByActions {
  protected:
    enum class Pace { kQuick, kSlow };

    void open_propagated() {
        open();
        paint();
        act(GoToFrame{kFrame});
        ASSERT_TRUE(wait([&] { return is_propagated(); }));
    }
    [[nodiscard]] bool is_propagated() const {
        return view().frame == kFrame && view().mattes.size() == 1 && view().mattes[0].keep &&
               view().mattes[0].kind == RegionMatteView::Kind::kPropagated;
    }
    // Some frames of the window, in real time.
    void rest(int ms) {
        constexpr int kFrameMs = 10;
        for (int passed = 0; passed < ms; passed += kFrameMs) {
            update();
            std::this_thread::sleep_for(std::chrono::milliseconds(kFrameMs));
        }
    }
    void settle() {
        ASSERT_TRUE(wait([&] { return !session_->busy() && is_propagated(); }));
        session_->flush();
        rest(20);
        ASSERT_TRUE(wait([&] { return !session_->busy() && is_propagated(); }));
    }
    void stroke(const std::vector<Vec2>& way, const Brush& brush) {
        act(BeginStroke{brush, way.front(), 1, StrokeKind::kHere});
        for (const Vec2 at : way)
            session_->act_now({ContinueStroke{at, 1}});
        act(EndStroke{});
    }
    void outline(Vec2 around) {
        const float r = 5;
        act(FillPolygon{{around + Vec2{-r, -r}, around + Vec2{r, -r}, around + Vec2{r, r},
                         around + Vec2{-r, r}},
                        false,
                        true});
    }
    void draw(const Walk& walk, Pace pace) {
        for (std::size_t k = 0; k < walk.deeds.size(); ++k) {
            std::visit(
                [&](const auto& deed) {
                    if constexpr (std::is_same_v<std::decay_t<decltype(deed)>, std::vector<Vec2>>)
                        stroke(deed, walk.brushes[k]);
                    else
                        act(deed);
                },
                walk.deeds[k]);
            if (pace == Pace::kSlow)
                settle();
            else
                rest(100);
        }
        settle();
    }
    [[nodiscard]] Confirmed confirmed() {
        session_->flush();
        const auto found = region().matte->confirmed.find(kFrame);
        if (found == region().matte->confirmed.end()) return {};
        const auto matte = read_matte(found->second.path, {}, {96, 64});
        const auto area = read_matte(found->second.area, {}, {96, 64});
        EXPECT_TRUE(matte && area);
        return matte && area ? Confirmed{*matte, *area} : Confirmed{};
    }
    // What each step of the history leaves on the frame, from the newest back.
    [[nodiscard]] std::vector<Confirmed> all_steps() {
        std::vector<Confirmed> out;
        while (view().history_position > 2) {  // the region and its keyframe
            out.push_back(confirmed());
            act(Undo{});
            update();
        }
        return out;
    }
    [[nodiscard]] std::vector<Confirmed> drawn(const Walk& walk, Pace pace) {
        draw(walk, pace);
        return all_steps();
    }
};

TEST_F(QuickStrokes, OneBuildsOnAnotherThatIsStillWorkedOut) {
    open_propagated();
    const int before = view().history_position;
    outline({80, 50});
    outline({12, 8});
    stroke({{20, 50}, {24, 50}}, pen());
    settle();
    EXPECT_EQ(view().history_position, before + 3);
    const Confirmed now = confirmed();
    ASSERT_FALSE(now.matte.empty());
    for (const Vec2i at : {Vec2i{80, 50}, Vec2i{12, 8}, Vec2i{22, 50}}) {
        EXPECT_EQ(now.matte.at(at.x, at.y), 255) << at.x;
        EXPECT_EQ(now.area.at(at.x, at.y), 255) << at.x;
        EXPECT_EQ(view().mattes[0].pixels.at(at.x, at.y), 255) << at.x;
    }
    EXPECT_THAT(view().notices, ::testing::IsEmpty()) << "nothing is refused";
}

TEST_F(QuickStrokes, WhatIsStillWorkedOutIsUndoneAndRedone) {
    open_propagated();
    outline({80, 50});
    settle();
    const int position = view().history_position;
    outline({12, 8});
    outline({40, 58});
    act(Undo{});
    act(Undo{});
    act(Undo{});
    settle();
    EXPECT_EQ(view().history_position, position - 1);
    for (int k = 0; k < 3; ++k)
        act(Redo{});
    settle();
    EXPECT_EQ(view().history_position, position + 2);
    const Confirmed now = confirmed();
    for (const Vec2i at : {Vec2i{80, 50}, Vec2i{12, 8}, Vec2i{40, 58}})
        EXPECT_EQ(now.matte.at(at.x, at.y), 255) << at.x;
    // Something new leaves nothing to redo.
    outline({60, 6});
    act(Undo{});
    stroke({{20, 50}, {24, 50}}, pen());
    act(Redo{});
    settle();
    EXPECT_EQ(view().history_position, position + 3);
    EXPECT_EQ(confirmed().area.at(60, 6), 0);
}

TEST_F(QuickStrokes, AFrameThatWasNotReachedIsNotPaintedOver) {
    open();
    act(PauseAnalysis{true});
    paint();
    act(GoToFrame{kFrame});
    ASSERT_TRUE(wait([&] {
        return view().frame == kFrame && view().mattes[0].kind == RegionMatteView::Kind::kUnreached;
    }));
    for (const StrokeKind kind : {StrokeKind::kKeyframe, StrokeKind::kHere}) {
        act(BeginStroke{pen(), {40, 30}, 1, kind});
        act(EndStroke{});
        update();
        EXPECT_FALSE(region().matte->keyframes.contains(kFrame));
        EXPECT_TRUE(region().matte->confirmed.empty());
        ASSERT_FALSE(view().notices.empty());
        EXPECT_THAT(view().notices.back().text,
                    ::testing::HasSubstr("has not been propagated to frame 3"));
    }
    act(ClearMatte{});
    ASSERT_TRUE(wait([&] { return region().matte->keyframes.contains(kFrame); }));
    act(BeginStroke{pen(), {40, 30}, 1, StrokeKind::kKeyframe});
    act(EndStroke{});
    update();
    EXPECT_EQ(view().mattes[0].pixels.at(40, 30), 255);
}

// What says where all of the surface is needs nothing from the frames before, and is not lost.
TEST_F(QuickStrokes, AnOutlineOnAFrameThatWasNotReachedBeginsAKeyframe) {
    open();
    act(PauseAnalysis{true});
    paint();
    act(GoToFrame{kFrame});
    const auto unreached = [&] {
        return view().frame == kFrame && view().mattes[0].kind == RegionMatteView::Kind::kUnreached;
    };
    ASSERT_TRUE(wait(unreached));
    const FillPolygon around{{{30, 18}, {60, 18}, {60, 44}, {30, 44}}, false, true};
    FillPolygon hole = around;
    hole.subtract = true;
    act(hole);
    ASSERT_TRUE(wait([&] { return !view().matte_busy; }));
    EXPECT_FALSE(region().matte->keyframes.contains(kFrame)) << "there is nothing to take away";
    const std::vector<Vec2> inside{{30, 20}, {60, 44}}, outside{{6, 8}, {6, 56}};
    const std::vector<Action> outlines{around, ScribbleSelect{{inside}, {outside}, true}};
    for (const Action& outline : outlines) {
        act(outline);
        ASSERT_TRUE(wait([&] { return region().matte->keyframes.contains(kFrame); }));
        update();
        EXPECT_EQ(view().mattes[0].pixels.at(44, 32), 255);
        EXPECT_TRUE(region().matte->confirmed.empty());
        EXPECT_THAT(view().notices.back().text, ::testing::HasSubstr("a new keyframe"));
        act(Undo{});
        ASSERT_TRUE(wait(unreached));
    }
}

// Another keyframe changes: the frame shows what was seen there until it is propagated again.
TEST_F(QuickStrokes, AnOutdatedMatteSaysSoAndIsReplacedWithoutSteppingAway) {
    open_propagated();
    const MattePtr seen = view().mattes[0].keep;
    EXPECT_FALSE(view().mattes[0].outdated);
    act(GoToFrame{1});
    update();
    act(PauseAnalysis{true});
    act(BeginStroke{pen(), {56, 42}, 1});
    act(EndStroke{});
    act(GoToFrame{kFrame});
    ASSERT_TRUE(wait([&] { return view().frame == kFrame && view().mattes[0].keep != nullptr; }));
    rest(30);
    EXPECT_TRUE(view().mattes[0].outdated);
    EXPECT_EQ(*view().mattes[0].keep, *seen);
    stroke({{20, 50}, {24, 50}}, pen());
    rest(30);
    EXPECT_TRUE(view().mattes[0].outdated);
    EXPECT_EQ(view().mattes[0].pixels.at(22, 50), 255);
    EXPECT_LT(view().mattes[0].pixels.at(58, 42), 128);
    act(PauseAnalysis{false});
    ASSERT_TRUE(wait([&] { return !view().mattes[0].outdated; }));
    EXPECT_EQ(view().mattes[0].pixels.at(22, 50), 255) << "the stroke";
    EXPECT_GT(view().mattes[0].pixels.at(58, 42), 127) << "the keyframe's change";
}

TEST_F(QuickStrokes, TheyAreKeptWhileATextureIsLaid) {
    open_propagated();
    act(ApplyTexture{in("tile.png"), 0});
    settle();
    for (const Vec2 at : {Vec2{80, 50}, Vec2{12, 8}, Vec2{40, 58}}) {
        outline(at);
        rest(30);
    }
    settle();
    const Confirmed now = confirmed();
    for (const Vec2i at : {Vec2i{80, 50}, Vec2i{12, 8}, Vec2i{40, 58}})
        EXPECT_EQ(now.matte.at(at.x, at.y), 255) << at.x;
}

TEST_F(QuickStrokes, FiftyAreTheSameAtAnyPace) {
    const Walk walk = walk_of(50, 7);
    open_propagated();
    const std::vector<Confirmed> quick = drawn(walk, Pace::kQuick);
    session_.reset();
    fs::remove_all(folder_ / "cache");
    fs::remove_all(folder_ / "state");
    open_propagated();
    const std::vector<Confirmed> slow = drawn(walk, Pace::kSlow);
    ASSERT_EQ(quick.size(), slow.size());
    ASSERT_GT(quick.size(), 20u);
    for (std::size_t k = 0; k < quick.size(); ++k) {
        EXPECT_TRUE(quick[k].area == slow[k].area) << "what is confirmed, " << k << " steps back";
        EXPECT_TRUE(quick[k].matte == slow[k].matte) << "the matte, " << k << " steps back";
    }
}

}  // namespace
}  // namespace weft::test
