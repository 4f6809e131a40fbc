// Two thousand steps on three shots.
#include "tests/ui/walk.h"

namespace weft::test {
namespace {

class LongWalk : public WalkTest {};

TEST_F(LongWalk, TwoThousandStepsOnThreeShotsLeaveWhatTheirReplayLeaves) {
    struct Shot {
        Size size;
        int frames, steps;
    };
    const Shot kShots[] = {{{96, 64}, 4, 700}, {{240, 135}, 9, 700}, {{64, 160}, 6, 600}};
    unsigned seed = 20261;
    for (const Shot& shot : kShots) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const auto steps = random_walk(seed, shot.steps, shot.frames);
        begin("quick" + std::to_string(seed), shot.size, shot.frames);
        walk(steps, false);
        const std::string quick = document();
        begin("slow" + std::to_string(seed), shot.size, shot.frames);
        walk(steps, true);
        ASSERT_EQ(document(), quick);
        ++seed;
    }
}

}  // namespace
}  // namespace weft::test
