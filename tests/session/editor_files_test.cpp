// Settings between sessions, and recovery after a crash.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/base/editor_settings.h"
#include "app/base/recovery.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

class EditorFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_editor_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_;
};

TEST_F(EditorFiles, SettingsRoundTrip) {
    const std::string path = (folder_ / "a" / "editor.json").string();
    EXPECT_EQ(load_editor_settings(path), EditorSettings{});
    EditorSettings settings;
    settings.dark = false;
    settings.ui_scale = 1.5;
    settings.keys["play"] = "Space";
    settings.recent = {"/a/shot.weft"};
    settings.places["/a/shot.weft"] = {-3, std::nullopt, 12};
    settings.collections["walls"] = {"db:1234"};
    ASSERT_TRUE(save_editor_settings(path, settings));
    EXPECT_EQ(load_editor_settings(path), settings);
    std::ofstream(path) << R"({"marked": {"/a/shot.weft": [2, 5]}})";
    EXPECT_EQ(load_editor_settings(path).places.at("/a/shot.weft"), (ProjectPlace{2, 5, {}}));
    std::ofstream(path) << "{ \"dark\": ";
    EXPECT_EQ(load_editor_settings(path), EditorSettings{}) << "a damaged file gives the defaults";
}

TEST_F(EditorFiles, TheNewestSnapshotIsKeptAndGoesWhenItIsNotNeeded) {
    int before = 0;
    Project project;
    project.plate.path = "/shot/####.png";
    RecoveryWriter writer(folder_.string(), [&] { ++before; });
    writer.note({project, "/shot/a.weft"});
    writer.flush();
    EXPECT_GE(before, 1);
    EXPECT_EQ(writer.take_error(), "");
    const auto files = [&] {
        int count = 0;
        for (const auto& entry : fs::directory_iterator(folder_))
            count += entry.path().extension() == ".weft" ? 1 : 0;
        return count;
    };
    EXPECT_EQ(files(), 1);
    EXPECT_TRUE(find_recoverable(folder_.string()).empty()) << "this process still runs";
    writer.clear();
    writer.flush();
    EXPECT_EQ(files(), 0);
}

TEST_F(EditorFiles, ASnapshotRemembersWhatItsFileHeld) {
    Project opened;
    opened.name = "opened";
    Project project = opened;
    project.name = "edited";
    {
        RecoveryWriter writer(folder_.string(), {});
        writer.note({project, "/shot/a.weft", ProjectOnDisk{opened, {0xfedcba9876543210, 7}}});
    }
    const std::string own = "recovery-" + std::to_string(getpid()) + ".weft";
    // As if the process had gone: no process has this number.
    fs::rename(folder_ / own, folder_ / "recovery-99999999.weft");
    const auto found = find_recoverable(folder_.string());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].project, project);
    EXPECT_EQ(found[0].project_path, "/shot/a.weft");
    ASSERT_TRUE(found[0].known);
    EXPECT_EQ(found[0].known->project, opened);
    EXPECT_EQ(found[0].known->hash, (Hash128{0xfedcba9876543210, 7}));
}

}  // namespace
}  // namespace weft
