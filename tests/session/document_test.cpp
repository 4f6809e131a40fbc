// The parts below a session by themselves: the document with its history, its background work, the
// selection and the notices.
#include "app/session/document/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "app/base/background.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class DocumentByItself : public testing::Test, private DocumentFollower {
  protected:
    void SetUp() override { keep_thread_priority(); }
    void TearDown() override {
        document_.flush_recovery();  // a snapshot is still written into the folder
        fs::remove_all(folder_);
    }

    static Edit add(const std::string& name) {
        Region region;
        region.name = name;
        return AddRegion{region, {}};
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> out;
        for (const Leaf<Region>& region : document_.project().regions)
            out.push_back(region->name);
        return out;
    }

    std::vector<std::string> told_;
    const fs::path folder_ =
        fs::temp_directory_path() / ("weft_document_" + std::to_string(getpid()));
    Notices notices_;
    Document document_{folder_.string(), [] {}, *this, notices_};

  private:
    void document_replaced() override { told_.emplace_back("replaced"); }
    void document_changed() override { told_.emplace_back("changed"); }
};

TEST_F(DocumentByItself, TakesEditsOnceItIsOpenAndTellsItsFollower) {
    EXPECT_FALSE(document_.edit(add("wall")));
    EXPECT_THAT(told_, testing::IsEmpty());
    document_.start(Project{}, "");
    EXPECT_TRUE(document_.edit(add("wall")));
    EXPECT_THAT(names(), ElementsAre("wall"));
    EXPECT_THAT(told_, ElementsAre("replaced", "changed", "changed"));
    EXPECT_TRUE(document_.modified());
    EXPECT_TRUE(document_.undo());
    EXPECT_THAT(names(), testing::IsEmpty());
    EXPECT_FALSE(document_.undo());
}

TEST_F(DocumentByItself, WhatIsTriedIsNoStepOfTheHistory) {
    document_.start(Project{}, "");
    document_.try_edit(add("wall"));
    EXPECT_TRUE(document_.trying());
    EXPECT_THAT(names(), ElementsAre("wall"));
    EXPECT_THAT(document_.committed().regions, testing::IsEmpty());
    EXPECT_TRUE(document_.edit(add("floor")));
    EXPECT_FALSE(document_.trying());
    EXPECT_THAT(names(), ElementsAre("floor"));
}

TEST_F(DocumentByItself, AnEditThatFailsIsANotice) {
    document_.start(Project{}, "");
    EXPECT_FALSE(document_.commit(SetMatte{{7, {}}, MatteSource{}}, "Paint"));
    ASSERT_EQ(notices_.all().size(), 1u);
    EXPECT_EQ(notices_.all()[0].kind, NoticeKind::kError);
    EXPECT_FALSE(document_.modified());
}

TEST_F(DocumentByItself, WorkEndsInTheDocumentInWhichItBegan) {
    DocumentTasks tasks(document_);
    std::vector<std::string> ended;
    const auto note = [&](const std::string& what) {
        return [&ended, what]() -> DocumentTasks::Finish {
            return [&ended, what] { ended.push_back(what); };
        };
    };
    document_.start(Project{}, "");
    tasks.start_for_document(note("of the first"));
    tasks.start(note("of any"));
    document_.start(Project{}, "");
    tasks.start_for_document(note("of the second"));
    tasks.finish(true);
    EXPECT_THAT(ended, ElementsAre("of any", "of the second"));
}

TEST_F(DocumentByItself, TheSelectionFollowsItsRegions) {
    Selection selection;
    document_.start(Project{}, "");
    document_.edit(add("wall"));
    document_.edit(add("floor"));
    selection.follow(document_.project());
    EXPECT_EQ(selection.region, document_.project().regions.back()->id);
    selection.layer = 4;
    selection.keep_layer(document_.project());
    EXPECT_EQ(selection.layer, 0);
    document_.undo();
    document_.undo();
    selection.layer = -1;
    selection.follow(document_.project());
    EXPECT_EQ(selection.layer, 0);
    EXPECT_EQ(selection.region, 0u);
    EXPECT_EQ(selection.of(document_.project()), nullptr);
}

TEST(NoticesByThemselves, ErrorsStayAndRepeatedOnesReplaceEachOther) {
    Notices notices;
    notices.set_time(1);
    notices.add(NoticeKind::kError, "No space.");
    notices.add(NoticeKind::kInfo, "Rendering.");
    notices.add(NoticeKind::kInfo, "Rendering.");
    EXPECT_EQ(notices.all().size(), 2u);
    notices.set_time(100);
    notices.expire();
    ASSERT_EQ(notices.all().size(), 1u);
    EXPECT_EQ(notices.all()[0].text, "No space.");
    notices.dismiss(notices.all()[0].id);
    EXPECT_TRUE(notices.all().empty());
}

TEST(NoticesByThemselves, RefusalsGoWithTheStateInWhichTheyHold) {
    Notices notices;
    notices.keep_refusals_of("frame 1");
    notices.add(NoticeKind::kWarning, "The disk is nearly full.");
    notices.refuse("Nothing can be painted on frame 2.");
    notices.keep_refusals_of("frame 2");  // it has just come there
    EXPECT_EQ(notices.all().size(), 2u);
    notices.keep_refusals_of("frame 2");
    EXPECT_EQ(notices.all().size(), 2u);
    notices.keep_refusals_of("frame 3");
    ASSERT_EQ(notices.all().size(), 1u);
    EXPECT_EQ(notices.all()[0].text, "The disk is nearly full.");
}

}  // namespace
}  // namespace weft
