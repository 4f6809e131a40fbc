#include "app/project/codec/project_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/project/sample_project.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ProjectFile : public testing::Test {
  protected:
    void SetUp() override {
        dir_ = fs::temp_directory_path() /
               ("weft_project_test_" + std::to_string(getpid()) + "_" +
                testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(dir_);
    }
    void TearDown() override { fs::remove_all(dir_); }
    [[nodiscard]] std::string path(const std::string& name) const { return (dir_ / name).string(); }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(dir_), fs::directory_iterator()));
    }
    fs::path dir_;
};

TEST_F(ProjectFile, SavesAndLoadsPathsAsTheyAreWritten) {
    const Project project = test::full_project();
    ASSERT_TRUE(save_project(path("shot.weft"), project, in_place()));
    ASSERT_TRUE(save_project(path("shot.weft"), project, in_place()))
        << "saving again replaces the file";
    EXPECT_EQ(files(), 1u) << "no temporary file may stay";
    const auto loaded = load_project(path("shot.weft"));
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(*loaded, project);
}

TEST_F(ProjectFile, AFailedSaveLeavesTheOldFile) {
    ASSERT_TRUE(save_project(path("shot.weft"), test::full_project(), in_place()));
    Project bad = test::full_project();
    bad.name = "\xff";
    EXPECT_FALSE(save_project(path("shot.weft"), bad, in_place()));
    EXPECT_EQ(load_project(path("shot.weft")).value(), test::full_project());
    EXPECT_FALSE(save_project(path("nowhere/shot.weft"), test::full_project(), in_place()));
    EXPECT_EQ(files(), 1u);
}

TEST_F(ProjectFile, WhatCannotBeReadIsNamed) {
    const auto says = [](const std::string& file) {
        const auto project = load_project(file);
        EXPECT_FALSE(project);
        EXPECT_EQ(project ? ErrorCode::kUsage : project.error().code, ErrorCode::kUnreadable);
        return project ? std::string() : project.error().text();
    };
    EXPECT_THAT(says(path("none.weft")), HasSubstr("no such file"));
    EXPECT_THAT(says(dir_.string()), HasSubstr("it is a folder"));
    EXPECT_THAT(says("/dev/zero"), HasSubstr("/dev/zero"));
    std::ofstream(path("newer.weft")) << R"({"schema": "weft.project/9"})";
    EXPECT_THAT(says(path("newer.weft")),
                HasSubstr("newer.weft: schema: The project has version 9"));
    std::ofstream(path("large.weft")) << std::string(40'000'000, ' ');
    EXPECT_THAT(says(path("large.weft")), HasSubstr("MB"));
}

TEST(ProjectPaths, ResolveAgainstTheProjectsFolder) {
    EXPECT_EQ(resolve_path("/shots/010", "frames/####.png"), "/shots/010/frames/####.png");
    EXPECT_EQ(resolve_path("/shots/010", "../lib/brick.jpg"), "/shots/010/../lib/brick.jpg");
    EXPECT_EQ(resolve_path("/shots/010", "/lib/brick.jpg"), "/lib/brick.jpg");
    EXPECT_EQ(resolve_path("", "frames/####.png"), "frames/####.png");
    EXPECT_EQ(resolve_path("/shots/010", ""), "");
    EXPECT_EQ(project_dir("/shots/010/a.weft"), "/shots/010");
    EXPECT_EQ(project_dir("a.weft"), "");
}

TEST(ProjectPaths, EveryPathOfTheDocumentIsResolved) {
    const Project resolved = resolve_paths(test::full_project(), "/p");
    const Region& region = *resolved.regions[0];
    for (const std::string& path :
         {resolved.plate.path, resolved.output.path, resolved.output.movie, region.texture.sample,
          region.texture.also.at(1), region.texture.plane, region.motion.files, region.light.image,
          region.matte->keyframes.at(-5).path, region.matte->keyframes.at(100).path,
          region.holdouts->at(0).files})
        EXPECT_TRUE(path.starts_with("/p/")) << path;
    EXPECT_EQ(resolved.regions[1]->texture.sample, "") << "an empty path stays empty";
}

}  // namespace
}  // namespace weft
