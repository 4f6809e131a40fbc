// Saving a document over a file that others may have changed.
#include "app/exchange/save_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/project/codec/project_file.h"
#include "app/project/edit.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class SaveDocument : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("weft_save_" + std::to_string(getpid()));
        fs::create_directories(folder_);
        Project project;
        project.name = "shot";
        project = with_region(project, "wall");
        ASSERT_TRUE(save_project(file(), project, in_place()));
        known_ = *read_project(file());
    }
    void TearDown() override { fs::remove_all(folder_); }
    static Project with_region(const Project& before, const std::string& name) {
        Region region;
        region.name = name;
        return *apply_edit(before, AddRegion{region, {}});
    }
    static Project scaled(const Project& before, double scale) {
        return *apply_edit(before, SetRegionParameter{{1, {}}, "placement.scale", scale});
    }
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }
    [[nodiscard]] std::string file() const { return in("shot.weft"); }
    [[nodiscard]] DocumentSave saving(const Project& mine) const {
        DocumentSave what;
        what.path = what.from = file();
        what.project = mine;
        what.known = known_;
        what.unsaved = in("unsaved/");
        return what;
    }
    void they_save(const Project& theirs) const {
        ASSERT_TRUE(save_project(file(), theirs, in_place()));
    }
    [[nodiscard]] auto files() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }
    fs::path folder_;
    ProjectOnDisk known_;
};

TEST_F(SaveDocument, AnUnchangedFileIsReplaced) {
    const Project mine = scaled(known_.project, 2);
    const auto done = save_document(saving(mine));
    ASSERT_TRUE(done) << done.error().text();
    EXPECT_EQ(done->now.project, mine);
    EXPECT_EQ(done->now.hash, *project_hash(file()));
    EXPECT_THAT(done->merged, IsEmpty());
    EXPECT_EQ(*load_project(file()), mine);
    EXPECT_EQ(files(), 1);
}

TEST_F(SaveDocument, WhatOthersAddedIsMerged) {
    they_save(with_region(known_.project, "floor"));
    const auto done = save_document(saving(scaled(known_.project, 2)));
    ASSERT_TRUE(done) << done.error().text();
    EXPECT_THAT(done->merged, ElementsAre("floor"));
    EXPECT_THAT(done->conflicts, IsEmpty());
    const Project there = *load_project(file());
    EXPECT_EQ(there, done->now.project);
    EXPECT_EQ(there, scaled(with_region(known_.project, "floor"), 2));
    EXPECT_EQ(files(), 1) << "nothing was replaced, so there is no backup";
}

TEST_F(SaveDocument, AConflictIsAskedAboutAndWhatLosesIsKept) {
    const Project mine = with_region(scaled(known_.project, 2), "door");
    const Project theirs = with_region(scaled(known_.project, 3), "floor");
    they_save(theirs);
    DocumentSave what = saving(mine);
    const auto asked = save_document(what);
    ASSERT_TRUE(asked);
    EXPECT_THAT(asked->conflicts, SizeIs(1));
    EXPECT_EQ(*load_project(file()), theirs) << "nothing is written yet";
    EXPECT_EQ(files(), 1);

    what.answer = SaveAnswer{MergeSide::kMine, asked->now.hash};
    const auto kept = save_document(what);
    ASSERT_TRUE(kept);
    EXPECT_THAT(kept->backup, EndsWith("shot_backup_001.weft"));
    EXPECT_EQ(*load_project(kept->backup), theirs);
    const Project there = *load_project(file());
    EXPECT_EQ(there.regions[0]->placement.scale, 2);
    ASSERT_THAT(there.regions, SizeIs(3)) << "floor and door";
    EXPECT_THAT(kept->renumbered, ElementsAre(std::pair(2u, 3u)));

    they_save(theirs);
    what.answer->wins = MergeSide::kTheirs;
    const auto taken = save_document(what);
    ASSERT_TRUE(taken);
    EXPECT_THAT(taken->backup, EndsWith("shot_backup_002.weft"));
    EXPECT_EQ(*load_project(taken->backup), mine);
    EXPECT_EQ(load_project(file())->regions[0]->placement.scale, 3);
    EXPECT_THAT(load_project(file())->regions, SizeIs(3));
}

TEST_F(SaveDocument, AnAnswerCountsForTheVersionThatWasShown) {
    they_save(scaled(known_.project, 3));
    DocumentSave what = saving(scaled(known_.project, 2));
    what.answer = SaveAnswer{MergeSide::kMine, save_document(what)->now.hash};
    they_save(scaled(known_.project, 4));
    const auto again = save_document(what);
    ASSERT_TRUE(again);
    ASSERT_THAT(again->conflicts, SizeIs(1));
    EXPECT_EQ(again->conflicts[0].theirs, "4.0");
    EXPECT_EQ(load_project(file())->regions[0]->placement.scale, 4);
}

TEST_F(SaveDocument, AFileThatWentOrCannotBeReadIsNotTrustedBlindly) {
    const Project mine = scaled(known_.project, 2);
    std::ofstream(file()) << "{ \"half";
    const auto refused = save_document(saving(mine));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text(), HasSubstr("Save under another name"));
    fs::remove(file());
    ASSERT_TRUE(save_document(saving(mine)));
    EXPECT_EQ(*load_project(file()), mine);
}

TEST_F(SaveDocument, AnotherProjectThatIsReplacedIsKept) {
    std::ofstream(in("other.weft")) << "another artist's";
    DocumentSave what = saving(scaled(known_.project, 2));
    what.path = in("other.weft");
    const auto done = save_document(what);
    ASSERT_TRUE(done) << done.error().text();
    std::ifstream kept(in("other_backup_001.weft"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), "another artist's");
    EXPECT_EQ(done->backup, in("other_backup_001.weft"));

    what.new_only = true;
    EXPECT_FALSE(save_document(what)) << "a new version never replaces one";
}

TEST_F(SaveDocument, WhatWasChangedMeanwhileStaysWithTheMerge) {
    const Project before = with_region(known_.project, "door");
    they_save(with_region(known_.project, "floor"));
    const auto done = save_document(saving(before));
    ASSERT_TRUE(done);
    EXPECT_EQ(*with_merged(before, before, *done), done->now.project);
    const Project current =
        *apply_edit(before, SetRegionParameter{{2, {}}, "placement.scale", 5.0});
    const auto now = with_merged(before, current, *done);
    ASSERT_TRUE(now);
    ASSERT_THAT(now->regions, SizeIs(3));
    EXPECT_EQ(now->regions[1]->name, "floor");
    EXPECT_EQ(now->regions[1]->placement.scale, 1);
    EXPECT_EQ(now->regions[2]->name, "door");
    EXPECT_EQ(now->regions[2]->id, 3u);
    EXPECT_EQ(now->regions[2]->placement.scale, 5);
}

}  // namespace
}  // namespace weft::test
