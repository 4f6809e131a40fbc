// The line that says what a form was found from.
#include "app/shot/form_text.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

using Source = FormFinding::Source;

TEST(FormText, SaysWhatAMotionShowsAndHowSureItIs) {
    EXPECT_EQ(form_text({}, {Source::kMotion, true, 38, 1, 71.2f, 1.8f, 40}),
              "Plane, from 38 frames of motion, tilted 71° ± 2°");
    EXPECT_EQ(form_text({}, {Source::kMotion, false, 20, 0.6f, 30, 4, 40}),
              "Curved surface, from 20 frames of motion, ± 4°, 60 % of it used");
}

TEST(FormText, NamesWhatWasDrawn) {
    FormParams form;
    form.shape = {{FormGuideKind::kBall, {10, 10, 5}}};
    EXPECT_EQ(form_text(form, {Source::kShape, false, 1}), "Ball, as drawn");
    form.shape.clear();
    EXPECT_EQ(form_text(form, {Source::kShape, true, 1, 1, 60, 0, 40}),
              "Plane, from parallel strokes, tilted 60°");
}

TEST(FormText, NamesThePassAndSaysWhereNothingWasFound) {
    FormParams form;
    form.position = "P.####.exr";
    EXPECT_EQ(form_text(form, {Source::kPass, false, 1}), "From the position pass on 1 frame");
    form.source = FormSource::kDepth;
    EXPECT_EQ(form_text(form, {Source::kPass, false, 3}), "From the depth pass on 3 frames");
    EXPECT_EQ(form_text({}, {}), "Nothing shows the form: the surface stays flat");
}

}  // namespace
}  // namespace weft
