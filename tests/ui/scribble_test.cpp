// Scribbles drawn in the viewer.
#include "engine/media/image_files.h"
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

class Scribbles : public SessionTest {
  protected:
    void open() {
        session->act(OpenAny{(folder / "frames").string()});
        ASSERT_TRUE(wait([&] { return session->view().plate_picture != nullptr; }))
            << session->view().plate.error;
        robot->frames(3);
    }
    [[nodiscard]] const MatteSource& matte() const {
        return *session->view().project.regions.back()->matte;
    }
};

TEST_F(Scribbles, AreOneStepOfTheHistory) {
    open();
    robot->key("Ctrl+Shift+N");
    robot->frames(2);
    session->act(ScribbleSelect{{{{32, 24}, {56, 40}}}, {{{4, 4}, {90, 6}}, {{4, 60}, {90, 60}}}});
    ASSERT_TRUE(wait([&] { return matte().keyframes.contains(1); }));
    session->flush();
    const auto found = read_matte(matte().keyframes.at(1).path, {}, {96, 64});
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_GT(found->at(44, 32), 127);  // on the card
    EXPECT_LT(found->at(8, 8), 127);
    robot->key("Ctrl+Z");
    robot->frames(2);
    EXPECT_TRUE(matte().keyframes.empty());
}

// The first line begins the region, and is refined like any other.
TEST_F(Scribbles, StayOnAShotWithoutRegions) {
    open();
    ASSERT_TRUE(session->view().project.regions.empty());
    robot->key("Shift+Q");
    robot->stroke({at(32, 24), at(56, 40)});
    ASSERT_TRUE(wait([&] {
        return !session->view().project.regions.empty() && matte().keyframes.contains(1) &&
               !session->view().matte_busy;
    }));
    robot->frames(3);
    EXPECT_THAT(shell->state().scribbles.lines, ::testing::SizeIs(1));
    const std::string first = matte().keyframes.at(1).path;
    robot->hold("Ctrl", true);
    robot->stroke({at(8, 8), at(88, 8)});
    robot->hold("Ctrl", false);
    ASSERT_TRUE(
        wait([&] { return matte().keyframes.at(1).path != first && !session->view().matte_busy; }));
    robot->frames(3);
    EXPECT_THAT(shell->state().scribbles.lines, ::testing::SizeIs(2));
    robot->key("Ctrl+Z");
    robot->frames(3);
    EXPECT_THAT(shell->state().scribbles.lines, ::testing::SizeIs(1));
    EXPECT_EQ(matte().keyframes.at(1).path, first);
}

}  // namespace
}  // namespace weft::test
