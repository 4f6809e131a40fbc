// Scribbles on what is painted already, and what is painted on a shot without regions.
#include "app/base/next_region.h"
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

class ScribbleRuns : public SessionByActions {
  protected:
    // The patch of the plate is [24, 64) × [16, 48).
    void fill(float x0, float y0, float x1, float y1, bool subtract = false) {
        act(FillPolygon{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, subtract, false});
        settle();
    }
    void settle() {
        update();
        ASSERT_TRUE(wait([&] { return !view().matte_busy; }));
        update();
    }
    void scribble(const ScribbleSelect& lines) {
        act(lines);
        settle();
    }
    [[nodiscard]] Matte seen() const {
        const ViewU8x1 pixels = view().mattes.back().pixels;
        Matte out(Size{pixels.width(), pixels.height()});
        for (int y = 0; y < pixels.height(); ++y)
            for (int x = 0; x < pixels.width(); ++x)
                out.at(x, y) = pixels.at(x, y);
        return out;
    }
    const std::vector<Vec2> inside_{{28, 20}, {28, 44}}, outside_{{6, 8}, {6, 56}};
};

TEST_F(ScribbleRuns, WhatOtherToolsPaintedStaysWhereNoLineIs) {
    open();
    fill(40, 18, 64, 46);
    fill(52, 28, 60, 38, true);  // the hole around a hand
    scribble({{inside_}, {outside_}});
    EXPECT_GT(seen().at(30, 30), 127) << "added";
    EXPECT_LT(seen().at(56, 33), 128) << "the hole is still there";
    scribble({{inside_}, {outside_, {{46, 16}, {46, 48}}}});
    EXPECT_LT(seen().at(46, 30), 128) << "taken away under the second line";
    EXPECT_GT(seen().at(30, 30), 127);
    EXPECT_LT(seen().at(56, 33), 128);
}

// Each has all lines of those before it; what they made does not count twice.
TEST_F(ScribbleRuns, LinesGiveTheSameOneByOneAndAtOnce) {
    open();
    fill(40, 18, 64, 46);
    const ScribbleSelect all{{inside_, {{44, 20}, {60, 44}}}, {outside_, {{80, 8}, {80, 56}}}};
    scribble({{inside_}, {}});
    scribble({{inside_}, {outside_}});
    act(Undo{});
    settle();
    scribble({{inside_}, {outside_}});
    scribble(all);
    const Matte in_steps = seen();
    while (view().history_position > 2) {
        act(Undo{});
        settle();
    }
    scribble(all);
    EXPECT_EQ(seen(), in_steps);
}

// Esc clears the lines and leaves the matte, on which others begin.
TEST_F(ScribbleRuns, OtherLinesBeginWithWhatTheOnesBeforeHaveMade) {
    open();
    fill(40, 18, 64, 46);
    scribble({{inside_}, {outside_}});
    ASSERT_GT(seen().at(30, 30), 127);
    scribble({{{{44, 20}, {60, 44}}}, {{{80, 8}, {80, 56}}}});
    EXPECT_GT(seen().at(30, 30), 127);
    scribble({{}, {{{56, 24}, {56, 40}}}});
    EXPECT_LT(seen().at(56, 32), 128);
    EXPECT_GT(seen().at(30, 30), 127);
}

TEST_F(ScribbleRuns, ALineOutsideAloneTakesAwayAndIsPreviewed) {
    open();
    fill(24, 16, 90, 48);  // painted too far to the right
    const ScribbleSelect line{{}, {{{80, 18}, {80, 46}}}};
    act(TryScribble{line});
    ASSERT_TRUE(wait([&] { return seen().at(80, 32) < 128; }));
    scribble(line);
    EXPECT_LT(seen().at(80, 32), 128);
    EXPECT_GT(seen().at(30, 32), 127);
}

TEST_F(ScribbleRuns, OnAnEmptyMatteALineOutsideSaysWhatToDo) {
    open();
    const int position = view().history_position;
    scribble({{}, {outside_}});
    EXPECT_EQ(view().history_position, position);
    ASSERT_EQ(view().notices.size(), 1U);
    EXPECT_EQ(view().notices[0].text,
              "Nothing is painted on frame 1 that a line outside could take away. Draw a line "
              "inside the surface first.");
}

TEST_F(ScribbleRuns, PaintingBeginsTheFirstRegion) {
    open();
    const std::vector<Action> all{
        FillPolygon{{{30, 20}, {60, 20}, {60, 40}}, false, true},
        FloodSelect{{30, 30}, 20, false, true}, ScribbleSelect{{inside_}, {outside_}, true},
        SetShape{{{{{30, 20}, {}, {}, 0}, {{60, 20}, {}, {}, 0}, {{60, 40}, {}, {}, 0}}}}};
    const auto begin = [&](const Action& action) {
        act(DoEdit{RemoveRegion{{region().id, {}}}});
        update();
        ASSERT_TRUE(view().project.regions.empty());
        const std::string name = next_region(view().project).name;
        act(action);
        settle();
        ASSERT_EQ(view().project.regions.size(), 1U);
        EXPECT_EQ(region().name, name);
        EXPECT_EQ(view().selected, region().id);
        EXPECT_TRUE(view().notices.empty());
    };
    for (const Action& action : all) {
        begin(action);
        EXPECT_TRUE(wait(
            [&] { return !region().matte->keyframes.empty() || !region().matte->shape.empty(); }));
    }
    begin(BeginStroke{pen(), {30, 30}, 1});
    act(EndStroke{});
    update();
    EXPECT_EQ(region().matte->keyframes.size(), 1U);
    act(Undo{});
    act(Undo{});
    update();
    EXPECT_TRUE(view().project.regions.empty()) << "two steps of the history";
}

}  // namespace
}  // namespace weft::test
