// The grade of a texture, and the quality beside the picture.
#include "app/project/edit.h"
#include "tests/ui/ui_harness.h"

namespace weft::test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class GradePanel : public PanelTest {
  protected:
    void SetUp() override {
        size.y = 1800;  // All sections are in view.
        PanelTest::SetUp();
    }
    void set_first(const std::function<void(Region&)>& change) {
        view.project.regions[0] = view.project.regions[0].with(change);
        robot->frames(2);
    }
    void go() {
        robot->frames(2);
        ASSERT_TRUE(robot->click("Top/Seams & Light"));
        robot->frames(2);
        clear();
    }
    // The first region after what the only emitted action does to it.
    [[nodiscard]] Region after() const {
        const auto steps = emitted<DoEdits>();
        EXPECT_THAT(steps, SizeIs(1));
        Project project = view.project;
        if (!steps.empty()) {
            auto next = apply_edits(project, steps[0].edits);
            EXPECT_TRUE(next) << next.error().text();
            if (next) project = std::move(*next);
        }
        return *project.regions[0];
    }
};

TEST_F(GradePanel, MatchPlateMatchesExposureAndTintInOneStep) {
    set_first([](Region& r) {
        r.grade.match = 0.2;
        r.grade.exposure = 1;
        r.light.cast = 0.5;
    });
    go();
    ASSERT_TRUE(robot->click("Grade/Match plate"));
    const Region region = after();
    EXPECT_EQ(region.grade.match, 1);
    EXPECT_EQ(region.light.cast, std::nullopt);
    EXPECT_EQ(region.grade.exposure, 1) << "the artist's own exposure stays";
}

TEST_F(GradePanel, MatchPlateHasNothingToDoForANewRegion) {
    go();
    ASSERT_TRUE(robot->click("Grade/Match plate"));
    EXPECT_THAT(emitted<DoEdits>(), IsEmpty());
}

TEST_F(GradePanel, ResetGivesEveryControlOfTheSectionBackInOneStep) {
    set_first([](Region& r) {
        r.grade.hue_deg = 20;
        r.grade.multiply = {1, 0.5, 0.25};
        r.layer.opacity = 0.5;
        r.layer.blend = BlendMode::kScreen;
        r.light.strength = 0.5;
    });
    go();
    ASSERT_TRUE(robot->click("Grade/Reset"));
    const Region region = after();
    EXPECT_EQ(region.grade, GradeParams());
    EXPECT_EQ(region.layer, LayerParams());
    EXPECT_EQ(region.light.strength, 0.5);
}

TEST_F(GradePanel, QualityIsSwitchedBesideThePicture) {
    view.preview_quality = Quality::kDraft;
    robot->frames(3);
    clear();
    ASSERT_TRUE(robot->click("View/Final"));
    ASSERT_THAT(emitted<SetPreviewQuality>(), SizeIs(1));
    EXPECT_EQ(emitted<SetPreviewQuality>()[0].quality, Quality::kFinal);
    view.preview_quality = Quality::kFinal;
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("View/Draft"));
    ASSERT_THAT(emitted<SetPreviewQuality>(), SizeIs(1));
    EXPECT_EQ(emitted<SetPreviewQuality>()[0].quality, Quality::kDraft);
}

}  // namespace
}  // namespace weft::test
