// A drawn form that a render would refuse says so before anything is rendered.
#include "app/session/mattes/form_check.h"

#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class FormChecks : public SessionByActions {
  protected:
    void draw(std::vector<double> ball) {
        act(DoEdit{
            SetRegionParameter{{region().id, {}},
                               "form.shape",
                               std::vector<FormGuide>{{FormGuideKind::kBall, std::move(ball)}}}});
    }
    [[nodiscard]] std::string problem() const {
        const auto found = view().form_problems.find(region().id);
        return found == view().form_problems.end() ? "" : found->second;
    }
};

TEST_F(FormChecks, OnTheShapeAndBeforeItIsRendered) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    ASSERT_TRUE(wait([&] { return view().result_current; })) << view().preview.error;
    EXPECT_EQ(problem(), "");
    draw({90, 6, 4});
    ASSERT_TRUE(wait([&] { return !problem().empty(); }));
    EXPECT_THAT(problem(), HasSubstr("does not lie on the region"));
    SubmitJob job;
    job.output = in("out/####.png");
    act(job);
    update();
    ASSERT_FALSE(view().notices.empty());
    EXPECT_THAT(view().notices.back().text, HasSubstr("Region 'wall': The shape does not lie"));
    EXPECT_THAT(view().jobs, IsEmpty());
    draw({40, 32, 20});
    EXPECT_TRUE(wait([&] { return problem().empty(); }));
}

}  // namespace
}  // namespace weft::test
