#include "engine/core/progress.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Progress, EveryStageIsFoundByItsName) {
    for (int k = 0; k < static_cast<int>(WorkStage::kOther); ++k) {
        const auto stage = static_cast<WorkStage>(k);
        EXPECT_EQ(work_stage(name_of(stage)), stage) << name_of(stage);
    }
    EXPECT_FALSE(work_stage(""));
    EXPECT_FALSE(work_stage("download bricks"));
}

TEST(Progress, ATitleStandsForTheStagesName) {
    EXPECT_EQ((ProgressEvent{WorkStage::kRender, 1, 2, 7, 0.5}).name(), "render");
    const ProgressEvent other = ProgressEvent::titled("download bricks", 1, 2);
    EXPECT_EQ(other.name(), "download bricks");
    EXPECT_EQ(other.stage, WorkStage::kOther);
    ProgressEvent named{WorkStage::kRender, 1, 2, 7, 0.5};
    named.title = "locked " + named.name();
    EXPECT_EQ(named.name(), "locked render");
}

}  // namespace
}  // namespace weft
