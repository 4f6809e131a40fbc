// What is said where light and paint were not told apart.
#include "app/render/light_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace weft {
namespace {

using testing::HasSubstr;

TEST(LightReport, SaysNothingWhereItIsLittle) {
    const LightReport light{"wall", 0.04, 0.2, 7};
    EXPECT_FALSE(unsure_light_text(light));
    EXPECT_FALSE(unsure_light_warning(light));
}

TEST(LightReport, SaysHowMuchAndWhatToDo) {
    const LightReport light{"wall", 0.12, 0.35, 9};
    EXPECT_EQ(unsure_light_text(light),
              "Light and paint cannot be told apart on 12 % of this surface: paint \"this is "
              "light\" or \"this is paint\" there");
    const auto warning = unsure_light_warning(light);
    ASSERT_TRUE(warning);
    EXPECT_THAT(*warning, HasSubstr("12 % of the surface of region 'wall' (35 % on frame 9)"));
}

TEST(LightReport, IsPartOfTheReport) {
    EXPECT_EQ(light_json({"wall", 0.12345, 0.35, 9}).dump(),
              R"({"region":"wall","unsure":0.123,"worst":0.35,"worst_frame":9})");
}

}  // namespace
}  // namespace weft
