#include "app/base/output_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

TEST(OutputProblem, PatternsOfPicturesHaveNone) {
    for (const char* path :
         {"out/####.png", "/shots/a.%04d.exr", "x.@@@@.tif", "y_#.jpg", "####.dpx"})
        EXPECT_EQ(output_problem(path, 40), std::nullopt) << path;
    EXPECT_EQ(output_problem("one.png", 1), std::nullopt) << "a single frame needs no number";
}

TEST(OutputProblem, SaysWhatIsMissing) {
    EXPECT_THAT(output_problem("", 40), Optional(HasSubstr("where")));
    EXPECT_THAT(output_problem("one.png", 40), Optional(HasSubstr("no frame number")));
    EXPECT_THAT(output_problem("out.mov", 40), Optional(HasSubstr("image sequence")));
    EXPECT_THAT(output_problem("out/####", 40), Optional(HasSubstr("image sequence")));
    EXPECT_NE(output_problem("####_%04d.png", 40), std::nullopt) << "two frame numbers";
}

}  // namespace
}  // namespace weft
