// The question when a project's file was changed by another program.
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class SaveQuestionPanel : public PanelTest {
  protected:
    void SetUp() override {
        PanelTest::SetUp();
        view.path = "/shots/shot.weft";
        view.save_question =
            SaveQuestion{"/shots/shot.weft",
                         {},
                         {{"wall", "placement.scale", {}, "2.0", "3.5"},
                          {"wall", "matte.keyframes", 12, "shot_mattes/a.png", "shot_mattes/b.png"},
                          {"cape", "", {}, "removed", "changed"},
                          {"", "regions", {}, "wall, cape", "cape, wall"}},
                         {}};
        robot->frames(2);
        clear();
    }
};

TEST_F(SaveQuestionPanel, NamesEverySettingAndOffersBothSides) {
    for (const char* setting : {"wall: Scale", "wall: Keyframes, frame 12", "All settings of cape",
                                "Order of the layers"})
        EXPECT_TRUE(robot->find(setting)) << setting;
    ASSERT_TRUE(robot->click("Keep mine"));
    EXPECT_THAT(emitted<AnswerSave>(), ElementsAre(AnswerSave{MergeSide::kMine}));
    clear();
    ASSERT_TRUE(robot->click("Take the file's"));
    EXPECT_THAT(emitted<AnswerSave>(), ElementsAre(AnswerSave{MergeSide::kTheirs}));
}

TEST_F(SaveQuestionPanel, CancelAndEscapeSaveNothing) {
    ASSERT_TRUE(robot->click("Cancel"));
    EXPECT_THAT(emitted<AnswerSave>(), ElementsAre(AnswerSave{}));
    clear();
    robot->key("Esc");
    EXPECT_THAT(emitted<AnswerSave>(), ElementsAre(AnswerSave{}));
    EXPECT_THAT(emitted<Save>(), IsEmpty());
}

TEST_F(SaveQuestionPanel, ACopyAsksForItsName) {
    ASSERT_TRUE(robot->click("Save as a copy…"));
    robot->frames(2);
    EXPECT_FALSE(robot->find("Keep mine")) << "behind the file dialog";
    EXPECT_TRUE(robot->find("Browser/Name"));
    EXPECT_THAT(emitted<AnswerSave>(), IsEmpty());
}

}  // namespace
}  // namespace weft::test
