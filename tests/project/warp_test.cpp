// Grid warps in the document, its file, edits and on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/project/codec/edit_json.h"
#include "app/project/codec/project_json.h"
#include "app/project/edit.h"
#include "app/project/parameters.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

const Parameter<Region>& warp_parameter() {
    return **find_parameter(region_parameters(), "--warp");
}

TEST(Warp, IsReadFromAFlagAndTakenAwayByNone) {
    Region region;
    ASSERT_TRUE(set_parameter_text(region, warp_parameter(),
                                   "1x1 corners 0,0 90,0 90,60 0,60 falloff 40 "
                                   "points 0,0 95,-3:l-30,1 0,60 90,60"));
    ASSERT_TRUE(region.placement.warp);
    EXPECT_EQ(region.placement.warp->falloff_px, 40);
    EXPECT_EQ(region.placement.warp->points[1].at, glm::dvec2(95, -3));
    const std::string text = format_parameter(warp_parameter(), warp_parameter().read(region));
    Region other;
    ASSERT_TRUE(set_parameter_text(other, warp_parameter(), text));
    EXPECT_EQ(other.placement, region.placement);
    ASSERT_TRUE(set_parameter_text(region, warp_parameter(), "none"));
    EXPECT_FALSE(region.placement.warp);
}

TEST(Warp, AFoldIsRefusedByItsPlace) {
    Region region;
    const Status set = set_parameter_text(region, warp_parameter(),
                                          "1x1 corners 0,0 90,0 90,60 0,60 points 0,0 -90,0 0,60 "
                                          "90,60");
    ASSERT_FALSE(set);
    EXPECT_THAT(set.error().text(), HasSubstr("placement.warp"));
    EXPECT_THAT(set.error().text(), HasSubstr("folds at column 1, row 1"));
}

TEST(Warp, SurvivesTheProjectFileAndActions) {
    Project project;
    Region region;
    region.id = 1;
    region.placement.warp = grid_over(
        {glm::dvec2(1, 2), glm::dvec2(300, 5), glm::dvec2(290, 200), glm::dvec2(3, 190)}, 3, 2);
    region.placement.warp->points[4].up = glm::dvec2(0.1, -20);
    set_key(*region.placement.warp, 12, region.placement.warp->points);
    project.regions.push_back(region);
    const auto text = project_to_json(project);
    ASSERT_TRUE(text);
    const auto back = project_from_json(*text);
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(back->regions[0]->placement, region.placement);

    const std::vector<Edit> edits{
        SetRegionParameter{{1, {}}, "placement.warp", *region.placement.warp},
        SetRegionParameter{{1, {}}, "placement.warp", {}}};
    const auto written = edits_to_json(edits);
    ASSERT_TRUE(written);
    const auto read = edits_from_json(*written);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(*read, edits);
    const auto without = apply_edits(*back, edits);
    ASSERT_TRUE(without) << without.error().text();
    EXPECT_FALSE(without->regions[0]->placement.warp);
}

TEST(Warp, AFileMayLeaveOutPointsAtRest) {
    const auto rest =
        grid_warp_from_json(R"({"columns":2,"rows":1,"corners":[[0,0],[90,0],[90,60],[0,60]]})");
    ASSERT_TRUE(rest) << rest.error().text();
    EXPECT_EQ(*rest, grid_over({glm::dvec2(0, 0), glm::dvec2(90, 0), glm::dvec2(90, 60),
                                glm::dvec2(0, 60)},
                               2, 1));
    const auto wrong = grid_warp_from_json(R"({"columns":2,"rows":1,"corners":[[0,0]]})");
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().text(), HasSubstr("four corners"));
    EXPECT_FALSE(grid_warp_from_json("{"));
    EXPECT_FALSE(grid_warp_from_json(R"({"columns":2,"rows":1,"corner":[]})"));
}

}  // namespace
}  // namespace weft
