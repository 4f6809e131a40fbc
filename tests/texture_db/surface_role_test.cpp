#include "texture_db/describe/surface_role.h"

#include <gtest/gtest.h>

#include <numeric>

#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

float weight(const RoleWeights& weights, SurfaceRole role) {
    return weights[static_cast<std::size_t>(role)];
}

SurfaceRole likeliest(const RoleWeights& weights) {
    return static_cast<SurfaceRole>(std::max_element(weights.begin(), weights.end()) -
                                    weights.begin());
}

Matte box(int x0, int y0, int x1, int y1) {
    Matte matte(160, 90);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            matte.at(x, y) = 255;
    return matte;
}

TEST(SurfaceRole, KnowsEveryMaterialOfTheVocabulary) {
    for (const MaterialEntry& entry : material_table()) {
        const RoleWeights roles = roles_of_material(entry.name);
        const float most = *std::max_element(roles.begin(), roles.end());
        EXPECT_GE(most, 0.6f) << entry.name << " serves as nothing";
        EXPECT_NE(roles, roles_of_material("no such material")) << entry.name;
    }
}

TEST(SurfaceRole, PlaceTellsTheGroundFromAWallAndFromAFigure) {
    EXPECT_EQ(likeliest(roles_of_place(place_of_region(box(0, 50, 160, 90).view()))),
              SurfaceRole::kGround);
    EXPECT_EQ(likeliest(roles_of_place(place_of_region(box(0, 0, 160, 50).view()))),
              SurfaceRole::kWall);
    // A star of thin arms in the middle of the frame: limbs.
    Matte figure = box(78, 20, 84, 70);
    for (int x = 60; x < 100; ++x)
        figure.at(x, 40) = figure.at(x, 41) = 255;
    const RegionPlace place = place_of_region(figure.view());
    EXPECT_LT(place.solidity, 0.5f);
    const RoleWeights roles = roles_of_place(place);
    EXPECT_GT(weight(roles, SurfaceRole::kGarment), 2 * weight(roles, SurfaceRole::kWall));
    EXPECT_GT(weight(roles, SurfaceRole::kCoat), 2 * weight(roles, SurfaceRole::kGround));
}

TEST(SurfaceRole, MeasuresAPlainBoxExactly) {
    const RegionPlace place = place_of_region(box(0, 45, 80, 90).view());
    EXPECT_FLOAT_EQ(place.bottom, 0.5f);
    EXPECT_FLOAT_EQ(place.left, 0.5f);
    EXPECT_FLOAT_EQ(place.top, 0);
    EXPECT_FLOAT_EQ(place.right, 0);
    EXPECT_FLOAT_EQ(place.area, 0.25f);
    EXPECT_FLOAT_EQ(place.solidity, 1);
    EXPECT_FLOAT_EQ(place.first_row, 0.5f);
}

TEST(SurfaceRole, ReadsNamesAndThePathsOfMattes) {
    const auto named = [](const char* name) { return likeliest(roles_of_name(name)); };
    EXPECT_EQ(named("left sleeve"), SurfaceRole::kGarment);
    EXPECT_EQ(named("Curtains"), SurfaceRole::kGarment);
    EXPECT_EQ(named("bedroom_bedspread_1.png"), SurfaceRole::kGarment);
    EXPECT_EQ(named("white T-shirt"), SurfaceRole::kGarment);
    EXPECT_EQ(named("dragon_tail"), SurfaceRole::kCoat);
    EXPECT_EQ(named("shots/010/mattes/floor/0001.png"), SurfaceRole::kGround);
    EXPECT_EQ(named("walls/fox.png"), SurfaceRole::kCoat) << "the file's name before its folder's";
    EXPECT_EQ(named("old plaster"), SurfaceRole::kWall) << "what plaster is used as";
    const RoleWeights nothing = roles_of_name("region 2");
    EXPECT_FLOAT_EQ(std::accumulate(nothing.begin(), nothing.end(), 0.0f), kSurfaceRoles);
}

}  // namespace
}  // namespace weft
