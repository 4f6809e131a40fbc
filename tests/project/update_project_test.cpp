#include "app/project/codec/update_project.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "app/project/codec/project_file.h"
#include "app/project/edit.h"
#include "tests/project/sample_project.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

class UpdateProject : public testing::Test {
  protected:
    void SetUp() override {
        dir_ = fs::temp_directory_path() / ("weft_update_" + std::to_string(getpid()));
        fs::create_directories(dir_);
        ASSERT_TRUE(save_project(file(), test::full_project(), in_place()));
    }
    void TearDown() override { fs::remove_all(dir_); }
    [[nodiscard]] std::string file() const { return (dir_ / "shot.weft").string(); }
    [[nodiscard]] std::string bytes() const {
        std::ifstream in(file(), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    [[nodiscard]] auto files() const {
        return std::distance(fs::directory_iterator(dir_), fs::directory_iterator());
    }
    fs::path dir_;
};

Expected<Project> with_region(const Project& before, const std::string& name) {
    Region region;
    region.name = name;
    return apply_edit(before, AddRegion{region, {}});
}

// A writer that knows nothing of the lock.
void rename_project(const std::string& path, const std::string& name) {
    Project other = *load_project(path);
    other.name = name;
    ASSERT_TRUE(save_project(path, other, in_place()));
}

TEST_F(UpdateProject, KeepsTheWorkOfAllThatWriteAtOnce) {
    constexpr int kWriters = 12;
    std::vector<std::thread> writers;
    std::atomic<int> failed = 0;
    for (int k = 0; k < kWriters; ++k)
        writers.emplace_back([&, k] {
            const std::string name = "r" + std::to_string(k);
            if (!update_project(file(),
                                [&](const Project& before) { return with_region(before, name); }))
                ++failed;
        });
    for (std::thread& writer : writers)
        writer.join();
    EXPECT_EQ(failed, 0);
    const auto all = load_project(file());
    ASSERT_TRUE(all);
    std::set<std::string> names;
    std::set<RegionId> ids;
    for (const Leaf<Region>& region : all->regions) {
        names.insert(region->name);
        ids.insert(region->id);
    }
    EXPECT_EQ(all->regions.size(), test::full_project().regions.size() + kWriters);
    EXPECT_EQ(ids.size(), all->regions.size());
    for (int k = 0; k < kWriters; ++k)
        EXPECT_TRUE(names.contains("r" + std::to_string(k))) << k;
    EXPECT_EQ(files(), 1) << "no lock and no temporary file stays";
}

TEST_F(UpdateProject, OneWriterWritesTheBytesOfASave) {
    const auto saved =
        update_project(file(), [](const Project& before) { return with_region(before, "floor"); });
    ASSERT_TRUE(saved);
    const std::string updated = bytes();
    ASSERT_TRUE(save_project(file(), *saved, in_place()));
    EXPECT_EQ(bytes(), updated);
}

TEST_F(UpdateProject, AProgramWithoutTheLockIsNotOverwritten) {
    int calls = 0;
    const auto saved = update_project(file(), [&](const Project& before) {
        if (++calls == 1) rename_project(file(), "theirs");
        return with_region(before, "floor");
    });
    ASSERT_TRUE(saved);
    EXPECT_EQ(calls, 2);
    const auto now = load_project(file());
    ASSERT_TRUE(now);
    EXPECT_EQ(now->name, "theirs");
    EXPECT_EQ(now->regions.back()->name, "floor");

    calls = 0;
    const auto never = update_project(file(), [&](const Project& before) {
        rename_project(file(), "theirs " + std::to_string(++calls));
        return with_region(before, "door");
    });
    ASSERT_FALSE(never);
    EXPECT_THAT(never.error().text(), HasSubstr("again and again"));
    EXPECT_EQ(load_project(file())->name, "theirs " + std::to_string(calls));
}

TEST_F(UpdateProject, AFailedEditAndALongWaitWriteNothing) {
    const std::string before = bytes();
    EXPECT_FALSE(update_project(
        file(), [](const Project&) -> Expected<Project> { return fail(ErrorCode::kUsage, "no"); }));
    const auto held = lock_project(file());
    ASSERT_TRUE(held);
    const auto waited = update_project(
        file(), [](const Project& project) { return with_region(project, "late"); }, 20ms);
    ASSERT_FALSE(waited);
    EXPECT_THAT(waited.error().text(), HasSubstr("is being written by another program"));
    EXPECT_EQ(bytes(), before);
    EXPECT_EQ(files(), 1);
}

TEST_F(UpdateProject, OnlyWhatWasReadIsReplaced) {
    const auto read = read_project(file());
    ASSERT_TRUE(read);
    EXPECT_EQ(*project_hash(file()), read->hash);
    Project mine = read->project;
    mine.name = "mine";
    const auto saved = replace_project(file(), mine, read->hash);
    ASSERT_TRUE(saved && *saved);
    EXPECT_EQ(*saved, *project_hash(file()));
    const auto late = replace_project(file(), test::full_project(), read->hash);
    ASSERT_TRUE(late);
    EXPECT_FALSE(*late) << "another version is there now";
    EXPECT_EQ(load_project(file())->name, "mine");

    fs::remove(file());
    EXPECT_EQ(*project_hash(file()), std::nullopt);
    EXPECT_FALSE(*replace_project(file(), mine, read->hash));
    EXPECT_FALSE(fs::exists(file()));
    EXPECT_TRUE(*replace_project(file(), mine, std::nullopt)) << "as a new file";
    EXPECT_FALSE(*replace_project(file(), mine, std::nullopt)) << "which is not new any more";
}

}  // namespace
}  // namespace weft
