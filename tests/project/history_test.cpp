#include "app/project/history.h"

#include <gtest/gtest.h>

#include "app/project/edit.h"
#include "tests/project/sample_project.h"

namespace weft {
namespace {

Project named(const std::string& name) {
    Project project;
    project.name = name;
    return project;
}

TEST(History, UndoAndRedoWalkTheStates) {
    History history(named("a"));
    history.push(named("b"), "To b");
    history.push(named("c"), "To c");
    EXPECT_EQ(history.undo_label(), "To c");
    EXPECT_TRUE(history.undo());
    EXPECT_EQ(history.current().name, "b");
    EXPECT_EQ(history.redo_label(), "To c");
    EXPECT_TRUE(history.undo());
    EXPECT_FALSE(history.undo());
    EXPECT_EQ(history.current().name, "a");
    EXPECT_EQ(history.undo_label(), "");
    EXPECT_TRUE(history.redo());
    EXPECT_TRUE(history.redo());
    EXPECT_FALSE(history.redo());
    EXPECT_EQ(history.current().name, "c");
    EXPECT_EQ(history.labels(), (std::vector<std::string>{"Open", "To b", "To c"}));
}

TEST(History, ANewStateForgetsWhatWasUndone) {
    History history(named("a"));
    history.push(named("b"), "To b");
    history.undo();
    history.push(named("c"), "To c");
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.labels(), (std::vector<std::string>{"Open", "To c"}));
    history.push(named("c"), "Nothing");
    EXPECT_EQ(history.labels().size(), 2u) << "a state like the current one is no step";
}

TEST(History, KnowsWhatIsSaved) {
    History history(named("a"));
    EXPECT_FALSE(history.modified());
    history.push(named("b"), "To b");
    EXPECT_TRUE(history.modified());
    history.mark_saved();
    EXPECT_FALSE(history.modified());
    history.undo();
    EXPECT_TRUE(history.modified());
    history.redo();
    EXPECT_FALSE(history.modified());
    // The saved state is undone and then lost: nothing that comes after it is saved.
    history.undo();
    history.push(named("b2"), "To b2");
    EXPECT_TRUE(history.modified());
    history.undo();
    EXPECT_TRUE(history.modified());
}

TEST(History, StaysWithinItsBytesAndKeepsTheCurrent) {
    constexpr std::size_t kMax = 100'000;
    History history(named("start"), kMax);
    for (int i = 0; i < 1000; ++i) {
        history.push(named(std::string(1000, static_cast<char>('a' + i % 26)) + std::to_string(i)),
                     "Step");
        ASSERT_LE(history.bytes(), kMax);
    }
    EXPECT_GT(history.labels().size(), 20u);
    EXPECT_LT(history.labels().size(), 100u);
    EXPECT_TRUE(history.current().name.ends_with("999"));
    while (history.undo()) {
    }
    EXPECT_TRUE(history.modified()) << "the saved state was forgotten";

    History tiny(named("start"), 1);
    tiny.push(named("b"), "To b");
    EXPECT_EQ(tiny.current().name, "b");
    EXPECT_FALSE(tiny.can_undo());
}

TEST(History, SharedPartsAreCountedOnceAndGivenBack) {
    Region painted;
    MatteSource matte;
    for (int frame = 0; frame < 5000; ++frame)
        matte.keyframes[frame].path = "mattes/a_rather_long_name_" + std::to_string(frame);
    painted.matte = matte;
    const Project project = apply_edit(Project{}, AddRegion{painted, {}}).value();
    History history(project);
    const std::size_t one = history.bytes();
    EXPECT_GT(one, 5000u * 30u);
    Project current = project;
    for (int i = 0; i < 100; ++i) {
        current =
            apply_edit(current, SetRegionParameter{{1, {}}, "placement.scale", 2.0 + i}).value();
        history.push(current, "Scale");
    }
    EXPECT_LT(history.bytes(), one + 100 * 4000)
        << "a hundred slider steps must not copy the mattes";
    while (history.undo()) {
    }
    history.push(named("x"), "x");
    EXPECT_LT(history.bytes(), one + 4000) << "forgotten states must give their bytes back";
    EXPECT_GE(history.bytes(), one) << "the first state is still there";
}

TEST(History, GoesToAnyState) {
    History history(named("a"));
    history.push(named("b"), "To b");
    history.push(named("c"), "To c");
    EXPECT_TRUE(history.go_to(0));
    EXPECT_EQ(history.current().name, "a");
    EXPECT_FALSE(history.go_to(3));
    EXPECT_EQ(history.position(), 0u);
}

}  // namespace
}  // namespace weft
