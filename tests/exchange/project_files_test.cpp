// A project under another name, and files that are no longer where it says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/exchange/move_project.h"
#include "app/exchange/relink.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ProjectFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("weft_files_" + std::to_string(getpid()));
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string put(const std::string& name, const std::string& text = "x") {
        const fs::path path = folder_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text;
        return path.string();
    }
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }
    static Project with_region(const std::string& matte, const std::string& texture) {
        Project project;
        Region region;
        region.id = 1;
        region.name = "wall";
        MatteSource source;
        source.keyframes[1] = {matte, {}};
        region.matte = source;
        region.texture.sample = texture;
        project.regions.emplace_back(region);
        return project;
    }
    fs::path folder_;
};

TEST_F(ProjectFiles, OutputsOfTwoProjectsAreApart) {
    EXPECT_EQ(moved_output("", "/a/x.weft", "/b/y.weft"), "");
    EXPECT_EQ(moved_output("/a/x_render_v001/####.png", "/a/x.weft", "/b/y.weft"),
              "/b/y_render_v001/####.png");
    EXPECT_EQ(moved_output("/a/out/####.png", "/a/x.weft", "/a/y.weft"), "/a/y/out/####.png");
    EXPECT_EQ(moved_output("/renders/v001/####.exr", "/a/x.weft", "/b/y.weft"),
              "/renders/y/v001/####.exr");
    EXPECT_EQ(moved_output("/renders/v001/####.exr", "", "/b/y.weft"), "/renders/v001/####.exr")
        << "chosen before the first save";
}

TEST_F(ProjectFiles, OwnMattesAndTexturesGoAlong) {
    put("a/x_mattes/m.png", "matte");
    put("a/x_textures/t.png", "texture");
    put("a/x_textures/t.png.credit.json", "credit");
    const Project project = with_region("x_mattes/m.png", "x_textures/t.png");
    const auto moved = copy_own_files(project, in("a/x.weft"), in("b/y.weft"), in("unsaved/"));
    ASSERT_TRUE(moved) << moved.error().text();
    const Project now = rebased(project, in("a/x.weft"), in("b/y.weft"), *moved);
    EXPECT_EQ(now.regions[0]->matte->keyframes.at(1).path, "y_mattes/m.png");
    EXPECT_EQ(now.regions[0]->texture.sample, "y_textures/t.png");
    EXPECT_TRUE(fs::exists(in("b/y_mattes/m.png")));
    EXPECT_TRUE(fs::exists(in("b/y_textures/t.png.credit.json")));
    EXPECT_TRUE(fs::exists(in("a/x_mattes/m.png"))) << "the old project keeps its own";
}

TEST_F(ProjectFiles, AnotherProjectsMatteIsNeverReplaced) {
    put("a/x_mattes/m.png", "new");
    put("b/y_mattes/m.png", "old");
    const Project project = with_region("x_mattes/m.png", "/elsewhere/t.png");
    const auto moved = copy_own_files(project, in("a/x.weft"), in("b/y.weft"), in("unsaved/"));
    ASSERT_TRUE(moved) << moved.error().text();
    EXPECT_THAT(*moved,
                ElementsAre(std::pair(in("a/x_mattes/m.png"), std::string("y_mattes/m_2.png"))));
    std::string text;
    std::ifstream(in("b/y_mattes/m.png")) >> text;
    EXPECT_EQ(text, "old");
}

TEST_F(ProjectFiles, MissingFilesAreFoundByNameAndNearestFolder) {
    put("new/textures/brick.png");
    put("new/other/brick.png");
    put("new/plates/0001.png");
    put("new/plates/0002.png");
    Project project = with_region(put("m.png"), in("old/textures/brick.png"));
    project.plate.path = in("old/plates/####.png");
    project.output.path = in("out/####.png");
    EXPECT_THAT(missing_inputs(project),
                ElementsAre(in("old/plates/####.png"), in("old/textures/brick.png")));
    const auto linked = relink_inputs(project, in("new"), CancelToken());
    ASSERT_TRUE(linked) << linked.error().text();
    EXPECT_THAT(linked->missing, IsEmpty());
    EXPECT_EQ(linked->project.plate.path, in("new/plates/####.png"));
    EXPECT_EQ(linked->project.regions[0]->texture.sample, in("new/textures/brick.png"));
    EXPECT_EQ(linked->project.regions[0]->matte->keyframes.at(1).path, in("m.png"));
    EXPECT_EQ(linked->project.output.path, in("out/####.png")) << "no input";
}

TEST_F(ProjectFiles, WhatIsNotFoundStaysAndIsNamed) {
    put("new/else.png");
    const Project project = with_region(in("gone.png"), "db:0123");
    const auto linked = relink_inputs(project, in("new"), CancelToken());
    ASSERT_TRUE(linked) << linked.error().text();
    EXPECT_THAT(linked->found, IsEmpty());
    EXPECT_THAT(linked->missing, ElementsAre(in("gone.png")));
    EXPECT_FALSE(relink_inputs(project, in("nowhere"), CancelToken()));
}

}  // namespace
}  // namespace weft::test
