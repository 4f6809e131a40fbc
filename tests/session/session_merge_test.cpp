// Saving a project that another program has changed since it was opened.
#include <fstream>

#include "app/project/codec/project_file.h"
#include "app/project/codec/update_project.h"
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class SessionMerge : public SessionByActions {
  protected:
    void finish() {
        session_->flush();
        update();
    }
    void open_saved() {
        open();
        act(SaveAs{file()});
        finish();
        ASSERT_EQ(view().path, file());
    }
    void save() {
        act(Save{});
        finish();
    }
    [[nodiscard]] std::string file() const { return in("shot.weft"); }
    [[nodiscard]] static Edit scale(double value) {
        return SetRegionParameter{{1, {}}, "placement.scale", value};
    }
    // Another program, such as `weft region set`.
    void they_do(const Edit& edit) const {
        ASSERT_TRUE(update_project(
            file(), [&](const Project& before) { return apply_edit(before, edit); }));
    }
    void they_add(const std::string& name) const {
        Region region;
        region.name = name;
        they_do(AddRegion{region, {}});
    }
    [[nodiscard]] double scale_in(const std::string& path) const {
        return load_project(path)->regions[0]->placement.scale;
    }
};

TEST_F(SessionMerge, SavingMergesWhatAnotherProgramAdded) {
    open_saved();
    they_add("floor");
    act(DoEdit{scale(2)});
    save();
    const Project there = *load_project(file());
    ASSERT_THAT(there.regions, SizeIs(2));
    EXPECT_EQ(there.regions[0]->placement.scale, 2);
    EXPECT_EQ(there.regions[1]->name, "floor");
    EXPECT_EQ(view().project, there);
    EXPECT_FALSE(view().modified);
    EXPECT_FALSE(view().save_question);
    EXPECT_THAT(view().notices.back().text, HasSubstr("Merged what another program changed"));
    EXPECT_THAT(view().notices.back().text, HasSubstr("floor"));

    they_add("door");
    act(DoEdit{scale(3)});
    save();
    EXPECT_THAT(load_project(file())->regions, SizeIs(3)) << "and again";
}

TEST_F(SessionMerge, WhatBothAddedIsKeptAndStaysSelected) {
    open_saved();
    they_add("floor");
    Region door;
    door.name = "door";
    act(DoEdit{AddRegion{door, {}}});
    update();
    ASSERT_EQ(view().selected_region()->name, "door");
    save();
    ASSERT_THAT(load_project(file())->regions, SizeIs(3));
    ASSERT_TRUE(view().selected_region());
    EXPECT_EQ(view().selected_region()->name, "door");
}

TEST_F(SessionMerge, AConflictIsAskedAboutAndNothingIsLost) {
    open_saved();
    they_do(scale(3));
    act(DoEdit{scale(2)});
    save();
    ASSERT_TRUE(view().save_question);
    ASSERT_THAT(view().save_question->conflicts, SizeIs(1));
    EXPECT_EQ(view().save_question->conflicts[0],
              (MergeConflict{"wall", "placement.scale", {}, "2.0", "3.0"}));
    EXPECT_EQ(scale_in(file()), 3) << "not overwritten";
    EXPECT_TRUE(view().modified);

    act(AnswerSave{});
    finish();
    EXPECT_FALSE(view().save_question);
    EXPECT_EQ(scale_in(file()), 3);
    EXPECT_TRUE(view().modified);

    save();
    ASSERT_TRUE(view().save_question);
    act(AnswerSave{MergeSide::kMine});
    finish();
    EXPECT_EQ(scale_in(file()), 2);
    EXPECT_EQ(scale_in(in("shot_backup_001.weft")), 3);
    EXPECT_FALSE(view().modified);
    EXPECT_THAT(view().notices.back().text, HasSubstr("shot_backup_001.weft"));
}

TEST_F(SessionMerge, TheFilesValuesCanBeTaken) {
    open_saved();
    they_do(scale(3));
    act(DoEdit{scale(2)});
    save();
    act(AnswerSave{MergeSide::kTheirs});
    finish();
    EXPECT_EQ(scale_in(file()), 3);
    EXPECT_EQ(scale_in(in("shot_backup_001.weft")), 2);
    EXPECT_EQ(region().placement.scale, 3);
    EXPECT_FALSE(view().modified);
    act(Undo{});
    update();
    EXPECT_EQ(region().placement.scale, 2) << "as one step of the history";
}

TEST_F(SessionMerge, ACopyLeavesTheirFile) {
    open_saved();
    they_do(scale(3));
    act(DoEdit{scale(2)});
    save();
    ASSERT_TRUE(view().save_question);
    act(SaveAs{in("copy.weft")});
    finish();
    EXPECT_FALSE(view().save_question);
    EXPECT_EQ(scale_in(file()), 3);
    EXPECT_EQ(scale_in(in("copy.weft")), 2);
    EXPECT_EQ(view().path, in("copy.weft"));
}

TEST_F(SessionMerge, SaveAsUnderAnotherSpellingOfTheSameFileMergesToo) {
    open_saved();
    they_add("floor");
    fs::create_directory_symlink(folder_, in("link"));
    act(SaveAs{in("link/shot.weft")});
    finish();
    EXPECT_EQ(view().path, file());
    EXPECT_THAT(load_project(file())->regions, SizeIs(2));
    EXPECT_FALSE(fs::exists(in("shot_backup_001.weft")));
}

TEST_F(SessionMerge, RecoveredWorkIsMergedWithWhatWasSavedSince) {
    open_saved();
    act(DoEdit{scale(2)});
    const std::string kept = in("state/recovery/recovery-" + std::to_string(getpid()) + ".weft");
    ASSERT_TRUE(wait([&] { return fs::exists(kept); }));
    session_->flush();
    // As if the process had gone: no process has this number.
    fs::copy_file(kept, in("state/recovery/recovery-99999999.weft"));
    session_.reset();
    they_add("floor");
    SessionOptions options;
    options.program = "/bin/false";
    options.state_folder = in("state");
    options.cache.folder = in("cache");
    options.trust_file = in("trusted.json");
    session_ = std::make_unique<Session>(options);
    update();
    ASSERT_TRUE(view().recovery);
    act(Recover{true});
    update();
    save();
    const Project there = *load_project(file());
    ASSERT_THAT(there.regions, SizeIs(2)) << "the region that was added after the crash";
    EXPECT_EQ(there.regions[0]->placement.scale, 2);
    EXPECT_TRUE(there.extra.empty()) << "nothing of the snapshot's own";
}

}  // namespace
}  // namespace weft::test
