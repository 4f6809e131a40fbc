// The panels on prepared views: the actions that they emit, and all states.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/ui/ui_harness.h"
#include "ui/canvas/view_map.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST_F(PanelTest, ADraggedSliderPreviewsAndEditsOnce) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    clear();
    ASSERT_TRUE(robot->drag("Placement/Scale", {40, 0}));
    EXPECT_FALSE(emitted<TryEdit>().empty());
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    const auto* set = std::get_if<SetRegionParameter>(&edits[0].edit);
    ASSERT_NE(set, nullptr);
    EXPECT_EQ(set->key, "placement.scale");
    EXPECT_GT(std::get<double>(set->value), 1.0);
}

TEST_F(PanelTest, AClickOnASliderChangesNothing) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    clear();
    ASSERT_TRUE(robot->click("Placement/Scale"));
    EXPECT_THAT(emitted<DoEdit>(), IsEmpty());
    EXPECT_THAT(emitted<TryEdit>(), IsEmpty());
}

TEST_F(PanelTest, ADoubleClickTypesAValueBeyondTheSlider) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    ASSERT_TRUE(robot->click("Placement/Scale", 2));
    robot->key("Ctrl+A");
    robot->type("25");
    clear();
    robot->key("Enter");
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    EXPECT_DOUBLE_EQ(std::get<double>(std::get<SetRegionParameter>(edits[0].edit).value), 25.0);
}

TEST_F(PanelTest, TheDotResetsAChangedValue) {
    view.project.regions[0] =
        view.project.regions[0].with([](Region& r) { r.placement.scale = 3; });
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    clear();
    ASSERT_TRUE(robot->click("Reset Scale"));
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    EXPECT_DOUBLE_EQ(std::get<double>(std::get<SetRegionParameter>(edits[0].edit).value), 1.0);
}

TEST_F(PanelTest, ARegionIsSelectedByAClickOnItsRow) {
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Regions/cape"));
    ASSERT_THAT(emitted<SelectRegion>(), SizeIs(1));
    EXPECT_EQ(emitted<SelectRegion>()[0].region, 2u);
}

TEST_F(PanelTest, AStrokeOnTheCanvasIsInPlatePixels) {
    robot->frames(3);
    const DrawnItem* canvas = robot->find("Viewer/Canvas");
    ASSERT_NE(canvas, nullptr);
    const ImVec2 middle((canvas->min.x + canvas->max.x) / 2, (canvas->min.y + canvas->max.y) / 2);
    clear();
    robot->stroke({middle, {middle.x + 30, middle.y}, {middle.x + 60, middle.y}});
    ASSERT_THAT(emitted<BeginStroke>(), SizeIs(1));
    EXPECT_NEAR(emitted<BeginStroke>()[0].at.x, 160, 0.6);
    EXPECT_NEAR(emitted<BeginStroke>()[0].at.y, 90, 0.6);
    EXPECT_FALSE(emitted<ContinueStroke>().empty());
    EXPECT_THAT(emitted<EndStroke>(), SizeIs(1));
}

TEST_F(PanelTest, AltSubtracts) {
    robot->frames(3);
    const DrawnItem* canvas = robot->find("Viewer/Canvas");
    const ImVec2 middle((canvas->min.x + canvas->max.x) / 2, (canvas->min.y + canvas->max.y) / 2);
    robot->hold("Alt", true);
    robot->stroke({middle, {middle.x + 30, middle.y}});
    robot->hold("Alt", false);
    ASSERT_THAT(emitted<BeginStroke>(), SizeIs(1));
    EXPECT_TRUE(emitted<BeginStroke>()[0].brush.subtract);
}

TEST_F(PanelTest, TheWheelZoomsAboutTheMouse) {
    robot->frames(3);
    const DrawnItem* canvas = robot->find("Viewer/Canvas");
    const ImVec2 at(canvas->min.x + 200, canvas->min.y + 150);
    ViewerState& s = shell->state().viewer;
    robot->move(at);
    const ViewMap before{canvas->min, canvas->max, s.center, s.zoom};
    const Vec2 under = before.to_plate(at);
    robot->wheel(3);
    const DrawnItem* now = robot->find("Viewer/Canvas");
    const ViewMap after{now->min, now->max, s.center, s.zoom};
    EXPECT_GT(after.zoom, before.zoom);
    EXPECT_NEAR(after.to_plate(at).x, under.x, 0.05);
    EXPECT_NEAR(after.to_plate(at).y, under.y, 0.05);
}

TEST_F(PanelTest, KeysRunTheirCommands) {
    robot->frames(2);
    clear();
    robot->key("Right");
    ASSERT_THAT(emitted<StepFrames>(), SizeIs(1));
    EXPECT_EQ(emitted<StepFrames>()[0].count, 1);
    robot->key("Ctrl+Z");
    EXPECT_THAT(emitted<Undo>(), SizeIs(1));
    robot->key("E");
    EXPECT_EQ(shell->state().tool, Tool::kEraser);
    robot->key("F7");
    EXPECT_EQ(shell->state().workspace, Workspace::kMotion);
    robot->key("Space");
    EXPECT_THAT(emitted<Play>(), SizeIs(1));
}

TEST_F(PanelTest, ThePaletteRunsWhatIsTyped) {
    robot->frames(2);
    robot->key("Ctrl+Shift+P");
    robot->frames(3);
    robot->type("side by");
    robot->key("Enter");
    EXPECT_EQ(shell->state().viewer.compare, Compare::kSideBySide);
    EXPECT_FALSE(shell->state().palette_open);
}

TEST_F(PanelTest, ShortcutsAreOffWhileTyping) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    ASSERT_TRUE(robot->click("Search textures"));
    clear();
    robot->key("Space");
    robot->key("Delete");
    EXPECT_THAT(actions, IsEmpty());
}

TEST_F(PanelTest, ClosingWithUnsavedChangesAsks) {
    view.modified = true;
    robot->frames(2);
    robot->key("Ctrl+W");
    robot->frames(2);
    EXPECT_THAT(emitted<CloseProject>(), IsEmpty());
    ASSERT_TRUE(robot->click("Don't save"));
    EXPECT_THAT(emitted<CloseProject>(), SizeIs(1));
}

TEST_F(PanelTest, TheRenderButtonSubmitsTheFramesThatItNames) {
    view.project.plate.path = "/frames/####.png";
    view.issues.clear();
    view.mark_in = 1002;
    view.mark_out = 1005;
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Jobs"));
    ASSERT_TRUE(robot->click("Marked range"));
    clear();
    ASSERT_TRUE(robot->click("Render frames"));
    ASSERT_THAT(emitted<SubmitJob>(), SizeIs(1));
    EXPECT_EQ(emitted<SubmitJob>()[0].frames, "1002-1005");
}

TEST_F(PanelTest, AFormThatCannotBeUsedIsSaidBeforeItIsRendered) {
    view.form_problems[view.project.regions[0]->id] = "The shape does not lie on the region.";
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Jobs"));
    robot->frames(2);
    EXPECT_NE(robot->find("Export/Form problem"), nullptr);
    robot->click("Render frames");
    EXPECT_THAT(emitted<SubmitJob>(), IsEmpty());
}

TEST_F(PanelTest, FramesThatExistAreSaidBeforeTheyAreRendered) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(::testing::TempDir()) / "weft_existing_frames";
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const char* name : {"1002.png", "1003.png", "2000.png"})
        std::ofstream(folder / name) << "x";
    view.project.plate.path = "/frames/####.png";
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Jobs"));
    shell->state().output.output = (folder / "####.png").string();
    const float button = robot->find("Export/Render frames")->min.y;
    const auto said = [&] {
        for (int frame = 0; frame < 500 && !robot->find("Export/Existing: 2"); ++frame) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            robot->frames(1);
        }
        return robot->find("Export/Existing: 2") != nullptr;
    };
    EXPECT_TRUE(said());
    EXPECT_EQ(robot->find("Export/Render frames")->min.y, button) << "while they are written";
    shell->state().output.output = (folder / "none" / "####.png").string();
    robot->frames(2);
    EXPECT_EQ(robot->find("Export/Existing: 2"), nullptr);
    fs::remove_all(folder);
}

TEST_F(PanelTest, APathThatNoFramesCanBeWrittenToIsSaidBeforeTheyAreRendered) {
    view.project.plate.path = "/frames/####.png";
    view.issues.clear();
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Jobs"));
    EXPECT_EQ(robot->find("Export/Output problem"), nullptr);
    for (const char* path : {"/out/shot.mov", "/out/shot.png"}) {
        shell->state().output.output = path;
        robot->frames(2);
        EXPECT_NE(robot->find("Export/Output problem"), nullptr) << path;
        clear();
        robot->click("Render frames");
        robot->frames(2);
        EXPECT_THAT(emitted<SubmitJob>(), IsEmpty()) << path;
    }
    shell->state().output.output = "/out/####.png";
    robot->frames(2);
    EXPECT_EQ(robot->find("Export/Output problem"), nullptr);
}

TEST_F(PanelTest, ScrubbingGoesToTheFrameUnderTheMouse) {
    robot->frames(2);
    const DrawnItem* scrub = robot->find("Timeline/Scrub");
    ASSERT_NE(scrub, nullptr);
    clear();
    robot->move({scrub->max.x - 4, (scrub->min.y + scrub->max.y) / 2});
    robot->press();
    robot->release();
    ASSERT_FALSE(emitted<GoToFrame>().empty());
    EXPECT_EQ(emitted<GoToFrame>().back().frame, 1010);
}

// ---- every panel in every state --------------------------------------------------------------

struct Look {
    const char* name;
    SessionView (*make)();
};

class EveryState : public PanelTest, public ::testing::WithParamInterface<Look> {};

TEST_P(EveryState, IsDrawnWithinTheWindow) {
    view = GetParam().make();
    for (const ImVec2 window : {ImVec2(1280, 720), ImVec2(1600, 900), ImVec2(3840, 2160)}) {
        ImGui::GetIO().DisplaySize = window;
        for (int w = 0; w < kWorkspaceCount; ++w) {
            shell->state().workspace = static_cast<Workspace>(w);
            robot->frames(3);
            for (const char* part : {"Regions/", "Viewer/", "Timeline/", "Top/", "Tools/"}) {
                for (const DrawnItem& item : shell->items()) {
                    if (!item.name.starts_with(part)) continue;
                    EXPECT_LE(item.max.x, window.x + 1) << item.name;
                    EXPECT_GE(item.min.x, -1) << item.name;
                }
            }
        }
    }
}

TEST_P(EveryState, EachSheetOpensAndCloses) {
    view = GetParam().make();
    for (bool UiState::*sheet :
         {&UiState::palette_open, &UiState::shortcuts_open, &UiState::settings_open,
          &UiState::history_open, &UiState::about_open}) {
        shell->state().*sheet = true;
        robot->frames(3);
        robot->key("Esc");
        robot->frames(2);
        EXPECT_FALSE(shell->state().*sheet);
    }
}

INSTANTIATE_TEST_SUITE_P(States, EveryState,
                         testing::Values(Look{"Empty", [] { return SessionView{}; }},
                                         Look{"Normal", normal_view}, Look{"Failing", failing_view},
                                         Look{"Huge", huge_view}),
                         [](const auto& state) { return state.param.name; });

double luminance(ImU32 color) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
    const auto linear = [](float v) {
        return v <= 0.04045f ? static_cast<double>(v) / 12.92
                             : std::pow((static_cast<double>(v) + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
}

// What a picture's state is said in stands on what surrounds the picture (WCAG 2: 4.5).
TEST(Theme, StatesAreLegibleBesideThePictureAndOnPanels) {
    for (const bool dark : {true, false}) {
        const Theme t = make_theme(dark, false, 1);
        for (const ImU32 ground : {t.surround, t.panel})
            for (const ImU32 ink : {t.text, t.good, t.warn}) {
                const double a = luminance(ink), b = luminance(ground);
                EXPECT_GE((std::max(a, b) + 0.05) / (std::min(a, b) + 0.05), 4.5)
                    << std::hex << ink << " on " << ground;
            }
    }
}

TEST_F(PanelTest, ViewTransformsAreListedAndSelectable) {
    view.screens = {{"monitor", "Film"}, {"monitor", "Raw"}, {"projector", "Film"}};
    robot->frames(3);
    ASSERT_TRUE(robot->click("View/Screen"));
    for (const char* name : {"View/Screen sRGB", "View/Screen Video", "View/Screen Raw",
                             "View/Screen monitor Film", "View/Screen monitor Raw"})
        EXPECT_NE(robot->find(name), nullptr) << name;
    ASSERT_TRUE(robot->click("View/Screen projector Film"));
    ASSERT_THAT(emitted<ChooseScreen>(), SizeIs(1));
    EXPECT_EQ(emitted<ChooseScreen>()[0].name, (ScreenName{"projector", "Film"}));
    // What the session has ready is what the pictures are drawn through.
    auto screen = std::make_shared<ScreenView>();
    view.screen_name = screen->name = {"projector", "Film"};
    view.screen = screen;
    pictures.pictures.clear();
    robot->frames(2);
    ASSERT_FALSE(pictures.pictures.empty());
    EXPECT_EQ(pictures.pictures.back().display.screen, view.screen);
    view.screen_name = {"", kScreenVideo};
    view.screen.reset();
    robot->frames(2);
    EXPECT_EQ(pictures.pictures.back().display.curve, DisplaySettings::Curve::kVideo);
    EXPECT_EQ(pictures.pictures.back().display.screen, nullptr);
}

TEST_F(PanelTest, ThePlatesColourSpaceCanBeOneOfTheConfig) {
    view.color_spaces = {"raw", "ACEScg"};
    shell->state().shot_open = true;
    robot->frames(3);
    ASSERT_TRUE(robot->click("Colour space"));
    ASSERT_TRUE(robot->click("Choices/ACEScg"));
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    const auto* set = std::get_if<SetProjectParameter>(&edits[0].edit);
    ASSERT_NE(set, nullptr);
    EXPECT_EQ(set->key, "plate.space");
    EXPECT_EQ(std::get<std::string>(set->value), "ACEScg");
}

TEST_F(PanelTest, ThePixelAspectIsTheFilesOrAnotherOne) {
    view.plate.pixel_aspect = 2;
    shell->state().shot_open = true;
    robot->frames(3);
    EXPECT_EQ(shell->state().viewer.aspect, 2);
    ASSERT_TRUE(robot->click("Automatic pixel aspect"));
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    const auto* set = std::get_if<SetProjectParameter>(&edits[0].edit);
    ASSERT_NE(set, nullptr);
    EXPECT_EQ(set->key, "plate.pixel_aspect");
    EXPECT_EQ(std::get<double>(set->value), 2);
    view.project.plate.pixel_aspect = 2;
    robot->frames(2);
    EXPECT_TRUE(robot->find("Pixel aspect"));
    shell->state().viewer.squeezed = true;
    robot->frames(2);
    EXPECT_EQ(shell->state().viewer.aspect, 1) << "the plate's pixels are squares";
}

TEST_F(PanelTest, ClosingWaitsForTheSaveAndIsCancelledIfItFails) {
    view.modified = true;
    shell->ask_to_leave();
    robot->frames(2);
    ASSERT_TRUE(robot->click("Save"));
    EXPECT_EQ(emitted<Save>().size(), 1u);
    view.saving = true;
    robot->frames(3);
    EXPECT_FALSE(shell->state().leave);
    view.saving = false;  // and still modified: it went wrong
    robot->frames(3);
    EXPECT_FALSE(shell->state().leave);
    EXPECT_FALSE(shell->state().leave_asked);

    shell->ask_to_leave();
    robot->frames(2);
    view.saving = true;
    ASSERT_TRUE(robot->click("Save"));
    view.saving = view.modified = false;
    robot->frames(2);
    EXPECT_TRUE(shell->state().leave);
}

}  // namespace
}  // namespace weft::test
