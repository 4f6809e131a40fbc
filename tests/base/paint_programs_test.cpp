#include "app/base/paint_programs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/base/find_program.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

class PaintPrograms : public ::testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_);
        // NOLINTBEGIN(concurrency-mt-unsafe)
        before_ = std::getenv("PATH");
        setenv("PATH", ("/no/such/folder:" + folder_.string()).c_str(), 1);
        // NOLINTEND(concurrency-mt-unsafe)
    }
    void TearDown() override {
        setenv("PATH", before_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
        fs::remove_all(folder_);
    }
    std::string install(const std::string& name, bool executable = true) {
        const fs::path path = folder_ / name;
        std::ofstream(path) << "#!/bin/sh\n";
        fs::permissions(path, executable ? fs::perms::owner_all : fs::perms::owner_read);
        return path.string();
    }

    fs::path folder_ = fs::temp_directory_path() / ("weft_programs_" + std::to_string(getpid()));
    std::string before_;
};

TEST_F(PaintPrograms, AreThoseThatAreInstalled) {
    EXPECT_TRUE(installed_paint_programs().empty());
    install("gimp");
    install("mypaint", false);
    const auto one = installed_paint_programs();
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0], (PaintProgram{"GIMP", "gimp", ".tif"}));
    install("krita");
    const auto two = installed_paint_programs();
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0], (PaintProgram{"Krita", "krita", ".ora"}));
}

TEST_F(PaintPrograms, AreFoundAsAShellFindsThem) {
    const std::string path = install("painter");
    EXPECT_EQ(find_program("painter"), path);
    EXPECT_EQ(find_program(path), path);
    EXPECT_EQ(find_program(folder_.string() + "/other"), "");
    EXPECT_EQ(find_program(folder_.string()), "") << "a folder";
    EXPECT_EQ(find_program("other"), "");
    EXPECT_EQ(find_program(""), "");
}

TEST_F(PaintPrograms, OfTheUserAreKnownByTheirNames) {
    EXPECT_EQ(paint_program_of("/opt/krita-5.2.appimage"),
              (PaintProgram{"Krita", "/opt/krita-5.2.appimage", ".ora"}));
    EXPECT_EQ(paint_program_of("/opt/own"), (PaintProgram{"own", "/opt/own", ".tif"}));
}

}  // namespace
}  // namespace weft
