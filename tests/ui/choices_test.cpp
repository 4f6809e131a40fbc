// Locking, correcting, picking and exporting: the actions that the panels emit.
#include "app/mattes/paint.h"
#include "app/session/where_to_correct.h"
#include "app/textures/patch_pick.h"
#include "tests/ui/canvas_fixture.h"
#include "ui/input/pen.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A plane of 64 × 48 texels with two patches that meet at x = 20.
std::shared_ptr<const Provenance> two_pieces() {
    auto plane = std::make_shared<PlaneMap>();
    plane->source = Image<std::int32_t, 2>(64, 48);
    plane->energy = Matte(64, 48);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            std::int32_t* from = plane->source.pixel(x, y);
            from[0] = x < 20 ? x + 5 : x + 30;
            from[1] = y;
        }
    }
    plane->samples = {"brick.png"};
    auto out = std::make_shared<Provenance>();
    out->ref_from_cur = LatticeField({320, 180}, 16);
    out->plane = plane;
    return out;
}

class Choices : public CanvasTest {
  protected:
    void show_pieces() {
        auto picture = std::make_shared<OverlayPicture>();
        picture->kind = Overlay::kSourceMap;
        picture->frame = 1003;
        picture->id = next_picture_id();
        picture->value = picture->where = Matte(320, 180, 255);
        picture->provenance = two_pieces();
        view.overlay = Overlay::kSourceMap;
        view.overlay_picture = picture;
    }
    [[nodiscard]] static int texels(const PlaneAmendment& amendment) {
        int sum = 0;
        for (const TexelRun& run : amendment.runs)
            sum += run.count;
        return sum;
    }
    void set_amendments(std::vector<PlaneAmendment> amendments) {
        view.project.regions[0] =
            view.project.regions[0].with([&](Region& r) { r.amendments = std::move(amendments); });
    }
};

TEST_F(Choices, AClickLocksThePatch) {
    show_pieces();
    go("Seams & Light", Tool::kKeep);
    click_at(on(10.5f, 10.5f));
    const auto set = edits<SetAmendments>();
    ASSERT_THAT(set, SizeIs(1));
    ASSERT_THAT(set[0].amendments, SizeIs(1));
    const PlaneAmendment& kept = set[0].amendments[0];
    EXPECT_EQ(kept.kind, PlaneAmendment::Kind::kKeep);
    EXPECT_EQ(texels(kept), 20 * 48);
    ASSERT_THAT(kept.runs, SizeIs(48));
    EXPECT_EQ(kept.runs[3], (TexelRun{0, 3, 20, 5, 3, 0, 0}));
}

TEST_F(Choices, AltDeselects) {
    show_pieces();
    set_amendments({*patch_at(*two_pieces(), {10.5f, 10.5f})});
    go("Seams & Light", Tool::kKeep);
    robot->hold("Alt", true);
    click_at(on(40.5f, 10.5f));
    EXPECT_THAT(edits<SetAmendments>(), IsEmpty()) << "the other piece is not kept";
    click_at(on(5.5f, 30.5f));
    robot->hold("Alt", false);
    const auto set = edits<SetAmendments>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_THAT(set[0].amendments, IsEmpty());
}

TEST_F(Choices, RegeneratingAgainUsesAnotherSeed) {
    show_pieces();
    go("Seams & Light", Tool::kKeep);
    ASSERT_TRUE(robot->click("Keep/Regenerate"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Keep/Seam"));
    robot->frames(2);
    clear();
    click_at(on(20.5f, 20.5f));
    auto set = edits<SetAmendments>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_EQ(set[0].amendments[0].kind, PlaneAmendment::Kind::kAgain);
    const std::uint32_t seed = set[0].amendments[0].seed;
    set_amendments(set[0].amendments);
    clear();
    click_at(on(20.5f, 20.5f));
    set = edits<SetAmendments>();
    ASSERT_THAT(set, SizeIs(1));
    ASSERT_THAT(set[0].amendments, SizeIs(1));
    EXPECT_EQ(set[0].amendments[0].seed, seed + 1);
}

TEST_F(Choices, ADragLocksARectangle) {
    show_pieces();
    go("Seams & Light", Tool::kKeep);
    robot->stroke({on(12, 8), on(20, 14), on(28, 18)});
    const auto set = edits<SetAmendments>();
    ASSERT_THAT(set, SizeIs(1));
    // 16 × 10 texels of both patches.
    EXPECT_NEAR(texels(set[0].amendments[0]), 160, 30);
    EXPECT_GT(set[0].amendments[0].runs.size(), 10u);
}

TEST_F(Choices, TheToolShowsTheSourceMap) {
    go("Seams & Light", Tool::kKeep);
    robot->frames(1);
    ASSERT_FALSE(emitted<ShowOverlay>().empty());
    EXPECT_EQ(emitted<ShowOverlay>().back().overlay, Overlay::kSourceMap);
}

TEST_F(Choices, TheSourceMapIsHiddenWithTheTool) {
    go("Seams & Light", Tool::kKeep);
    robot->frames(1);
    view.overlay = Overlay::kSourceMap;
    shell->state().tool = Tool::kPan;
    clear();
    robot->frames(2);
    ASSERT_FALSE(emitted<ShowOverlay>().empty());
    EXPECT_EQ(emitted<ShowOverlay>().front().overlay, Overlay::kNone);
}

TEST_F(Choices, SimilarTexturesToAnImageFileAreFound) {
    go("Texture", Tool::kPan);
    ASSERT_TRUE(robot->click("Materials/Find by picture…"));
    robot->frames(1);
    EXPECT_EQ(shell->state().browser.purpose, BrowserState::Purpose::kSimilar);
}

TEST_F(Choices, HintsGoToTheirFrame) {
    view.to_correct = {{1006, CorrectionHint::Kind::kDrift, 0.7f},
                       {1009, CorrectionHint::Kind::kStretch, 2.4f}};
    go("Motion", Tool::kPan);
    ASSERT_TRUE(robot->click("Hints/Hint 1009"));
    robot->frames();
    ASSERT_THAT(emitted<GoToFrame>(), SizeIs(1));
    EXPECT_EQ(emitted<GoToFrame>()[0].frame, 1009);
}

TEST_F(Choices, OneKeyGoesThroughTheSuggestedFrames) {
    view.to_correct = {{1009, CorrectionHint::Kind::kMatte, 0.2f},
                       {1003, CorrectionHint::Kind::kDrift, 0.7f}};
    go("Mask", Tool::kPan);
    const auto pressed_at = [&](int frame) {
        view.frame = frame;
        clear();
        robot->key("Ctrl+Right");
        robot->frames();
        const auto sent = emitted<GoToFrame>();
        return sent.size() == 1 ? sent[0].frame : 0;
    };
    EXPECT_EQ(pressed_at(1001), 1009) << "where a look pays most";
    EXPECT_EQ(pressed_at(1009), 1003);
    EXPECT_EQ(pressed_at(1003), 1009) << "around";
    view.to_correct.clear();
    EXPECT_EQ(pressed_at(1001), 0);
}

TEST_F(Choices, WorstFramesAreListedBySeamsAndDrift) {
    view.marks[1].drift = 0.2f;
    view.marks[7].drift = 0.8f;
    view.marks[4].seam = 0.5f;
    go("Review", Tool::kPan);
    ASSERT_TRUE(robot->click("Worst/Drift"));
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Worst/Worst 1008"));
    robot->frames();
    ASSERT_THAT(emitted<GoToFrame>(), SizeIs(1));
    EXPECT_EQ(emitted<GoToFrame>()[0].frame, 1008);
    ASSERT_TRUE(robot->click("Worst/Seams"));
    robot->frames(2);
    EXPECT_NE(robot->find("Worst/Worst 1005"), nullptr);
    EXPECT_EQ(robot->find("Worst/Worst 1008"), nullptr);
}

TEST_F(Choices, LayersAreChosenForAJob) {
    go("Jobs", Tool::kPan);
    ASSERT_TRUE(robot->click("Layers for compositing"));
    robot->frames(2);
    ASSERT_TRUE(robot->click("Layers/patch"));
    ASSERT_TRUE(robot->click("Layers/st"));
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Export/Render frames"));
    robot->frames();
    const auto jobs = emitted<SubmitJob>();
    ASSERT_THAT(jobs, SizeIs(1));
    EXPECT_EQ(jobs[0].layers, (std::vector{LayerKind::kPatch, LayerKind::kSt}));
    EXPECT_THAT(jobs[0].layers_path, testing::EndsWith("/layers/####.exr"))
        << "PNG frames cannot hold them";
}

TEST_F(Choices, PenPressureControlsTheBrush) {
    go("Mask", Tool::kBrush);
    shell->state().pen_pressure = 0.4f;
    robot->stroke({on(100, 80), on(110, 90)});
    ASSERT_FALSE(emitted<BeginStroke>().empty());
    EXPECT_FLOAT_EQ(emitted<BeginStroke>()[0].pressure, 0.4f);
    ASSERT_FALSE(emitted<ContinueStroke>().empty());
    EXPECT_FLOAT_EQ(emitted<ContinueStroke>().back().pressure, 0.4f);
    // Without one it falls back to full pressure.
    shell->state().pen_pressure.reset();
    clear();
    robot->stroke({on(100, 80), on(110, 90)});
    EXPECT_FLOAT_EQ(emitted<BeginStroke>()[0].pressure, 1.0f);
}

TEST_F(Choices, ACryptomatteObjectIsPickedInTheViewer) {
    go("Mask", Tool::kCrypto);
    click_at(on(50.5f, 60.5f));
    robot->hold("Alt", true);
    click_at(on(50.5f, 60.5f));
    robot->hold("Alt", false);
    EXPECT_THAT(emitted<PickCryptomatte>(),
                ElementsAre(PickCryptomatte{{50, 60}, false}, PickCryptomatte{{50, 60}, true}));
}

TEST(PenPressure, ControlsSizeOrOpacityOrNothing) {
    const auto dab = [](bool size, bool opacity) {
        Matte matte(64, 64);
        Brush brush;
        brush.radius_px = 20;
        brush.hardness = 1;
        brush.pressure_size = size;
        brush.pressure_opacity = opacity;
        Stroke stroke(std::make_shared<const Matte>(matte), brush);
        (void)stroke.move_to({32, 32}, 0.5f, matte);
        return std::pair<int, int>(matte.at(32, 32), matte.at(32 + 15, 32));
    };
    EXPECT_EQ(dab(true, false), std::make_pair(255, 0));
    EXPECT_EQ(dab(false, false), std::make_pair(255, 255));
    const auto faint = dab(false, true);
    EXPECT_NEAR(faint.first, 128, 2);
    EXPECT_NEAR(faint.second, 128, 2);
}

TEST(PenDevices, ReportPressureOfPensOnly) {
    PenDevices pens;
    EXPECT_FALSE(pens.pressure());
    pens.report(9, {{2, 500}});
    EXPECT_FALSE(pens.pressure()) << "no pen is known";
    pens.add(9, 2, 0, 2000);
    pens.report(9, {{0, 12}, {1, 40}});
    EXPECT_FALSE(pens.pressure()) << "it moves above the tablet";
    pens.report(9, {{2, 500}});
    EXPECT_FLOAT_EQ(pens.pressure().value_or(-1), 0.25f);
    pens.report(4, {{2, 1900}});
    EXPECT_FLOAT_EQ(pens.pressure().value_or(-1), 0.25f) << "a mouse says nothing";
    pens.report(9, {{2, 2600}});
    EXPECT_FLOAT_EQ(pens.pressure().value_or(-1), 1.0f);
    pens.report(9, {{2, 0}});
    EXPECT_FALSE(pens.pressure());
    pens.add(7, 0, 5, 5);
    pens.report(7, {{0, 5}});
    EXPECT_FALSE(pens.pressure()) << "a range of nothing";
}

TEST(WhereToCorrect, NamesTheWorstFrameAndItsProblem) {
    std::vector<int> frames;
    std::vector<FrameMarks> marks(40);
    for (int k = 0; k < 40; ++k) {
        frames.push_back(k + 1);
        FrameMarks& mark = marks[static_cast<std::size_t>(k)];
        mark.confidence = k > 20 && k < 30 ? 0.2f : 0.95f;
        mark.drift = k > 33 ? 0.9f : 0.05f;
        mark.stretch = 1.05f;
    }
    const auto hints = where_to_correct(frames, marks, {1}, {1});
    ASSERT_FALSE(hints.empty());
    bool matte = false, drift = false;
    for (const CorrectionHint& hint : hints) {
        matte |= hint.kind == CorrectionHint::Kind::kMatte && hint.frame > 20 && hint.frame < 31;
        drift |= hint.kind == CorrectionHint::Kind::kDrift && hint.frame > 33;
        EXPECT_NE(hint.kind, CorrectionHint::Kind::kStretch);
    }
    EXPECT_TRUE(matte);
    EXPECT_TRUE(drift);
    for (FrameMarks& mark : marks)
        mark = {};
    EXPECT_THAT(where_to_correct(frames, marks, {1}, {1}), IsEmpty()) << "nothing is known";
}

}  // namespace
}  // namespace weft::test
