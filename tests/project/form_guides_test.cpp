// Shapes and strokes in the document, its file and on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/project/codec/project_json.h"
#include "app/project/parameters.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

const Parameter<Region>& of(std::string_view name) {
    return **find_parameter(region_parameters(), name);
}

TEST(FormGuides, AreReadFromFlags) {
    Region region;
    ASSERT_TRUE(set_parameter_text(region, of("--form-shape"), "cylinder:40,10,42,90,20,21,-5"));
    ASSERT_TRUE(set_parameter_text(region, of("--form-stroke"),
                                   "parallel:1,2,30,4,5,60,7,8;level:1,2,30,4"));
    ASSERT_EQ(region.form.shape.size(), 1U);
    EXPECT_EQ(region.form.shape[0].kind, FormGuideKind::kCylinder);
    EXPECT_EQ(region.form.shape[0].numbers.back(), -5);
    EXPECT_EQ(region.form.strokes.size(), 2U);
    const auto& shape = of("form.shape");
    EXPECT_EQ(format_parameter(shape, shape.read(region)), "cylinder:40,10,42,90,20,21,-5");
}

TEST(FormGuides, WrongOnesAreRefusedWithWhatToDo) {
    Region region;
    for (const auto& [text, why] : {std::pair{"plane:0,0,9,9,9,0,0,9", "collapses"},
                                    {"level:1,2,3,4", "none of plane"},
                                    {"ball:1,2,0", "radius is below 1 px"},
                                    {"ball:1,2,3;ball:1,2,4", "more than 1"},
                                    {"box:1,2", "plane:"}}) {
        const Status set = set_parameter_text(region, of("--form-shape"), text);
        ASSERT_FALSE(set) << text;
        EXPECT_THAT(set.error().text(), HasSubstr(why));
    }
    EXPECT_TRUE(region.form.shape.empty());
}

TEST(FormGuides, SurviveTheProjectFile) {
    Project project;
    Region region;
    region.id = 1;
    region.form.source = FormSource::kShape;
    region.form.shape = {{FormGuideKind::kBall, {320, 180, 90.5}}};
    region.form.strokes = {{FormGuideKind::kLevel, {300, 150, 340, 160}}};
    project.regions.push_back(region);
    const auto text = project_to_json(project);
    ASSERT_TRUE(text);
    const auto back = project_from_json(*text);
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(back->regions[0]->form, region.form);
}

}  // namespace
}  // namespace weft
