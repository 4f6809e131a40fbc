// Habits of the hand: menus, modifiers, the wipe's line, and another shot.
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/ui/canvas_fixture.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class Habits : public CanvasTest {};

TEST_F(Habits, APressOutsideOfAMenuClosesItAndActs) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/File"));
    ASSERT_NE(robot->find("Menu/Save"), nullptr);
    ASSERT_TRUE(robot->click("Top/Motion"));
    EXPECT_EQ(shell->state().workspace, Workspace::kMotion);
    EXPECT_EQ(robot->find("Menu/Save"), nullptr);
}

TEST_F(Habits, EachWorkspaceIsLeftAsItWas) {
    robot->frames(2);
    robot->key("Shift+Q");
    ASSERT_EQ(shell->state().tool, Tool::kScribble);
    ImGui::GetIO().DisplaySize = {1280, 600};
    robot->frames(2);
    const DrawnItem* add = robot->find("Regions/Add region");
    ASSERT_NE(add, nullptr);
    const float top = add->min.y;
    robot->move({1150, 500});
    for (int k = 0; k < 5; ++k) {
        robot->wheel(-1);
        robot->frames(2);
    }
    ASSERT_LT(robot->find("Regions/Add region")->min.y, top) << "it is scrolled";
    const float scrolled = robot->find("Regions/Add region")->min.y;
    robot->key("F6");
    robot->frames(3);
    EXPECT_EQ(robot->find("Regions/Add region")->min.y, top);
    EXPECT_EQ(shell->state().tool, Tool::kPan) << "no brush by accident";
    robot->key("F5");
    robot->frames(3);
    EXPECT_EQ(robot->find("Regions/Add region")->min.y, scrolled);
    EXPECT_EQ(shell->state().tool, Tool::kScribble);
}

TEST_F(Habits, AKeyAfterARenameActs) {
    robot->frames(2);
    shell->state().renaming = view.project.regions[0]->id;
    shell->state().rename_text = "arch";
    robot->frames(3);
    robot->key("Enter");
    robot->frames(2);
    ASSERT_EQ(shell->state().renaming, RegionId{0});
    robot->key("F6");
    EXPECT_EQ(shell->state().workspace, Workspace::kTexture);
}

TEST_F(Habits, TheQuestionBeforeLeavingIsAsTallAsItsText) {
    view.modified = true;
    robot->frames(2);
    robot->key("Ctrl+Q");
    robot->frames(3);
    const ImGuiWindow* dialog = ImGui::FindWindowByName("Save first?");
    ASSERT_NE(dialog, nullptr);
    const DrawnItem* save = robot->find("Save first?/Save");
    ASSERT_NE(save, nullptr);
    const float below = dialog->Pos.y + dialog->Size.y - save->max.y;
    EXPECT_GT(below, 8);
    EXPECT_LT(below, 28);
}

TEST_F(Habits, WhatIsTypedInTheSaveDialogReplacesTheProposedName) {
    robot->frames(2);
    robot->key("Ctrl+Shift+S");
    robot->frames(3);
    const BrowserState& browser = shell->state().browser;
    ASSERT_EQ(browser.purpose, BrowserState::Purpose::kSaveProject);
    ASSERT_TRUE(browser.name.ends_with(".weft")) << browser.name;
    robot->type("arch");
    robot->frames(2);
    EXPECT_EQ(browser.name, "arch") << "without a click into the field";
}

TEST_F(Habits, TheFileDialogListsEveryRecentFolderOnce) {
    settings.recent = {"/a/shots/1.weft", "/a/shots/2.weft", "/b/shots/3.weft"};
    robot->frames(2);
    robot->key("Ctrl+Shift+S");
    robot->frames(3);
    const std::vector<DrawnItem>& items = shell->items();
    EXPECT_EQ(std::count_if(items.begin(), items.end(),
                            [](const DrawnItem& item) { return item.name.ends_with("/shots"); }),
              2);
    ASSERT_TRUE(robot->click("shots"));  // the last one
    EXPECT_EQ(shell->state().browser.folder, "/b/shots");
}

// Every file dialog takes a path that is typed or pasted.
TEST_F(Habits, AFileThatIsTypedInTheOpenDialogIsOpened) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(::testing::TempDir()) / "weft_typed_file";
    fs::create_directories(folder);
    std::ofstream(folder / "shot.weft") << "{}";
    robot->frames(2);
    robot->key("Ctrl+O");
    robot->frames(3);
    ASSERT_EQ(shell->state().browser.purpose, BrowserState::Purpose::kOpen);
    ASSERT_TRUE(robot->click("Browser/Folder"));
    robot->key("Ctrl+A");
    robot->type((folder / "shot.weft").string());
    robot->key("Enter");
    for (int k = 0; k < 500 && emitted<OpenAny>().empty(); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        robot->frames(1);
    }
    ASSERT_THAT(emitted<OpenAny>(), SizeIs(1));
    EXPECT_EQ(emitted<OpenAny>()[0].path, (folder / "shot.weft").string());
    fs::remove_all(folder);
}

// As in a shell: the beginning of a name is enough.
TEST_F(Habits, TheBeginningOfANameListsWhatBeginsLikeIt) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(::testing::TempDir()) / "weft_typed_name";
    fs::create_directories(folder / "Shots");
    for (const char* name : {"a.weft", "b.weft"})
        std::ofstream(folder / "Shots" / name) << "{}";
    const auto wait = [&](auto&& done) {
        for (int k = 0; k < 500 && !done(); ++k) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            robot->frames(1);
        }
        EXPECT_TRUE(done());
    };
    const auto type = [&](const fs::path& path) {
        ASSERT_TRUE(robot->click("Browser/Folder"));
        robot->key("Ctrl+A");
        robot->type(path.string());
    };
    robot->frames(2);
    robot->key("Ctrl+O");
    robot->frames(3);
    type(folder / "sho");
    wait([&] { return robot->find("Browser/Shots") != nullptr; });
    robot->key("Enter");
    wait([&] { return robot->find("Browser/a.weft") != nullptr; });
    EXPECT_EQ(shell->state().browser.folder, (folder / "Shots").string());
    type(folder / "Shots" / "b");
    robot->key("Enter");  // at once, before it is looked up
    wait([&] { return !emitted<OpenAny>().empty(); });
    ASSERT_THAT(emitted<OpenAny>(), SizeIs(1));
    EXPECT_EQ(emitted<OpenAny>()[0].path, (folder / "Shots" / "b.weft").string());
    fs::remove_all(folder);
}

TEST_F(Habits, AMenuIsClosedByItsNameAndByEsc) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/File"));
    ASSERT_TRUE(robot->click("Top/File"));
    EXPECT_EQ(robot->find("Menu/Save"), nullptr);
    ASSERT_TRUE(robot->click("Top/File"));
    ASSERT_NE(robot->find("Menu/Save"), nullptr);
    robot->key("Esc");
    EXPECT_EQ(robot->find("Menu/Save"), nullptr);
    ASSERT_TRUE(robot->click("Top/File"));
    robot->hover("Top/View");
    robot->frames(2);
    EXPECT_NE(robot->find("Menu/Fit to window"), nullptr) << "with a menu open, the next one opens";
}

TEST_F(Habits, APolygonSubtractsAsItBegan) {
    go("Mask", Tool::kPolygon);
    ImGui::GetIO().KeyCtrl = true;
    click_at(on(40, 40));
    ImGui::GetIO().KeyCtrl = false;
    click_at(on(80, 40));
    click_at(on(80, 80));
    robot->key("Enter");
    ASSERT_THAT(emitted<FillPolygon>(), SizeIs(1));
    EXPECT_TRUE(emitted<FillPolygon>()[0].subtract);
}

TEST_F(Habits, TheWipeIsDraggedByItsLineAndNeverPaints) {
    go("Mask", Tool::kBrush);
    shell->state().viewer.compare = Compare::kWipe;
    robot->frames(2);
    clear();
    const ImVec2 from = on(160, 90), to = on(220, 90);
    robot->stroke({from, to});
    EXPECT_THAT(emitted<BeginStroke>(), IsEmpty());
    EXPECT_NEAR(shell->state().viewer.wipe, 220.0f / 320.0f, 0.01f);
    // A stroke across the line goes on.
    clear();
    robot->stroke({on(200, 60), on(221, 60), on(240, 60)});
    EXPECT_THAT(emitted<BeginStroke>(), SizeIs(1));
    EXPECT_THAT(emitted<EndStroke>(), SizeIs(1));
    EXPECT_NEAR(shell->state().viewer.wipe, 220.0f / 320.0f, 0.01f);
}

TEST_F(Habits, AnotherShotHasAnOutputAndAViewOfItsOwn) {
    view.render_folder = "/shots/a_render_v001";
    go("Jobs", Tool::kPan);
    UiState& state = shell->state();
    EXPECT_EQ(state.output.output, "/shots/a_render_v001/Shot_v001.####.png");
    state.output.output = "/elsewhere/####.png";
    state.viewer.fit = false;
    state.viewer.zoom = 8;
    state.drawer.search = "brick";
    state.measured = {Vec2{0, 0}, Vec2{4, 0}};
    ++view.document;
    view.render_folder = "/shots/b_render_v001";
    robot->frames(2);
    EXPECT_EQ(state.output.output, "/shots/b_render_v001/Shot_v001.####.png");
    EXPECT_TRUE(state.viewer.fit);
    EXPECT_EQ(state.drawer.search, "");
    EXPECT_FALSE(state.measured);
    // Saved under another name: what was proposed follows, what was typed stays.
    view.render_folder = "/shots/c_render_v001";
    robot->frames(2);
    EXPECT_EQ(state.output.output, "/shots/c_render_v001/Shot_v001.####.png");
}

TEST_F(Habits, AnAutomaticReferenceFrameStaysWhenOneIsAdded) {
    view.preview.references[1] = 1001;
    robot->frames(2);
    clear();
    robot->key("Ctrl+E");
    const auto set = edits<SetRegionParameter>();
    ASSERT_THAT(set, SizeIs(1));
    EXPECT_EQ(std::get<std::vector<double>>(set[0].value), (std::vector<double>{1001, 1003}));
}

TEST_F(Habits, ARegionsRowHasAMenu) {
    robot->frames(2);
    const Region& first = *view.project.regions.front();
    const auto open_menu = [&] {
        const DrawnItem* row = robot->find("Regions/" + first.name);
        ASSERT_NE(row, nullptr);
        robot->move({(row->min.x + row->max.x) / 2, (row->min.y + row->max.y) / 2});
        robot->press(1);
        robot->release(1);
        robot->frames(3);
    };
    view.selected = 0;
    clear();
    open_menu();
    ASSERT_THAT(emitted<SelectRegion>(), SizeIs(1));
    EXPECT_EQ(emitted<SelectRegion>()[0].region, first.id);
    view.selected = first.id;
    robot->frames(1);
    clear();
    ASSERT_TRUE(robot->click("Region menu/Delete"));
    ASSERT_THAT(edits<RemoveRegion>(), SizeIs(1));
    EXPECT_EQ(edits<RemoveRegion>()[0].region.id, first.id);
    open_menu();
    ASSERT_TRUE(robot->click("Region menu/Rename"));
    robot->frames(2);
    robot->key("Ctrl+A");
    robot->type("door");
    clear();
    robot->key("Enter");
    ASSERT_THAT(edits<RenameRegion>(), SizeIs(1));
    EXPECT_EQ(edits<RenameRegion>()[0].name, "door");
}

}  // namespace
}  // namespace weft::test
