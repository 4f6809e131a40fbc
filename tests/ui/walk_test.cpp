// Nothing that is done quickly is lost: a random walk leaves what its replay at leisure leaves.
#include "tests/ui/walk.h"

namespace weft::test {
namespace {

TEST_F(WalkTest, FiftyStepsLeaveWhatTheirReplayLeaves) {
    const auto steps = random_walk(7, 50, 4);
    begin("quick", {96, 64}, 4);
    const std::string start = document();
    walk(steps, false);
    const std::string quick = document();
    EXPECT_NE(quick, start) << "the walk does something";
    begin("slow", {96, 64}, 4);
    EXPECT_EQ(document(), start);
    walk(steps, true);
    EXPECT_EQ(document(), quick);
}

// What the comparison would find.
TEST_F(WalkTest, OneStrokeLessIsAnotherDocument) {
    auto steps = random_walk(7, 12, 4);
    begin("all", {96, 64}, 4);
    walk(steps, true);
    const std::string all = document();
    for (std::size_t k = steps.size(); k-- > 0;)
        if (steps[k].kind == WalkStep::Kind::kStroke) {
            steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(k));
            break;
        }
    begin("less", {96, 64}, 4);
    walk(steps, true);
    EXPECT_NE(document(), all);
}

}  // namespace
}  // namespace weft::test
