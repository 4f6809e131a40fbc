// Frames that are only read to measure on, and cannot be.
#include "app/render/unreadable_evidence.h"

#include <fstream>

#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class UnreadableEvidence : public ShotTest {
  protected:
    // Of a render of frame 3, which takes its light from the frames around it.
    [[nodiscard]] std::vector<int> found() const {
        Project project = spec("out").project;
        project.settings.frames = "3";
        project.settings.quality = Quality::kFinal;
        const auto shot = open_shot(project);
        EXPECT_TRUE(shot) << shot.error().text();
        return shot ? unreadable_evidence(**shot) : std::vector<int>{-1};
    }
    void spoil(const std::string& name) const {
        std::ofstream(in(name), std::ios::binary) << "no picture";
    }
};

TEST_F(UnreadableEvidence, IsThePlateOrTheMatteOfAFrameThatIsNotRendered) {
    EXPECT_THAT(found(), IsEmpty());
    spoil("masks/0006.png");
    EXPECT_THAT(found(), ElementsAre(6));
    spoil("frames/0005.png");
    EXPECT_THAT(found(), ElementsAre(5, 6));
}

TEST_F(UnreadableEvidence, IsNoneOfTheFramesThatARenderNeeds) {
    spoil("frames/0003.png");
    EXPECT_THAT(found(), IsEmpty());
}

}  // namespace
}  // namespace weft::test
