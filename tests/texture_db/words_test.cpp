#include <gtest/gtest.h>

#include "tests/texture_db/scratch.h"
#include "texture_db/describe/attributes.h"
#include "texture_db/describe/material_words.h"
#include "texture_db/search/wordnet.h"
#include "texture_db/sources/import.h"

namespace weft {
namespace {

TEST(Words, OfFileNames) {
    EXPECT_EQ(words_of_name("wall_bricks005.jpg"), "wall bricks 005");
    EXPECT_EQ(words_of_name("BrickOldRound-01.PNG"), "brick old round 01");
    EXPECT_EQ(singular("bricks"), "brick");
    EXPECT_EQ(singular("grass"), "grass");
    EXPECT_EQ(singular("leaves"), "leaf");
    EXPECT_EQ(singular("cherries"), "cherry");
}

struct PathCase {
    const char* path;
    const char* material;
};
class MaterialOfPath : public testing::TestWithParam<PathCase> {};
TEST_P(MaterialOfPath, IsReadFromTheName) {
    EXPECT_EQ(material_of_path(GetParam().path), GetParam().material);
}
INSTANTIATE_TEST_SUITE_P(Names, MaterialOfPath,
                         testing::Values(PathCase{"textures/tex_buildings/carpet020.png", "carpet"},
                                         PathCase{"stk_generic_brickRoad_a.jpg", "brick"},
                                         PathCase{"evil1_metals/x17.tga", "metal"},
                                         PathCase{"metal/rusty_plate.png", "rust"},
                                         PathCase{"nature/grass002.png", "grass"},
                                         PathCase{"a/glass01.png", ""},
                                         PathCase{"a/cobblestones.jpg", "cobblestone"},
                                         PathCase{"stonewall3.jpg", "stone"},
                                         PathCase{"walls/x1.jpg", ""},
                                         PathCase{"roof/tiles.jpg", "tiles"}));

TEST(Words, MapsOtherThanColour) {
    for (const char* name :
         {"Bricks059_1K_NormalGL.jpg", "rock_wall_rough_2k.png", "Wood_Roughness.png",
          "wall1_nm.png", "x_Displacement.exr", "Tiles_AmbientOcclusion.jpg"})
        EXPECT_TRUE(is_other_map(name)) << name;
    for (const char* name : {"Bricks059_1K_Color.jpg", "rock_wall_diff_2k.png", "rough.png",
                             "wall_bricks005.jpg", "metal.png"})
        EXPECT_FALSE(is_other_map(name)) << name;
}

TEST(Attributes, AreSeenInThePixels) {
    // Stripes upright, 8 px apart.
    ImageU8x3 stripes(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            for (int c = 0; c < 3; ++c)
                stripes.at(x, y, c) = x / 4 % 2 ? 220 : 60;
    const MeasuredTexture striped = measure_texture(stripes),
                          noisy = measure_texture(noise_picture(96, 4)),
                          green = measure_texture(noise_picture(96, 5, 40, 90, 35, 10)),
                          calm = measure_texture(noise_picture(96, 6, 128, 128, 128, 2));
    EXPECT_GT(attribute_match("striped", striped), 0.8f);
    EXPECT_LT(attribute_match("striped", noisy), 0.3f);
    EXPECT_GT(attribute_match("vertical", striped), 0.8f);
    EXPECT_LT(attribute_match("horizontal", striped), 0.2f);
    EXPECT_GT(attribute_match("regular", striped), 0.8f);
    EXPECT_LT(attribute_match("regular", noisy), 0.3f);
    EXPECT_GT(attribute_match("rough", noisy), 0.8f);
    EXPECT_GT(attribute_match("smooth", calm), 0.8f);
    EXPECT_LT(attribute_match("smooth", noisy), 0.2f);
    EXPECT_GT(attribute_match("green", green), 0.8f);
    EXPECT_GT(attribute_match("greenish", green), 0.8f);
    EXPECT_LT(attribute_match("red", green), 0.2f);
    EXPECT_GT(attribute_match("grey", noisy), 0.8f);
    EXPECT_LT(attribute_match("dark", noisy), 0.5f);
    EXPECT_LT(attribute_match("gravelly", noisy), 0.0f) << "no attribute word";
    EXPECT_EQ(colour_name({30, -20, 18}), "dark green");
    EXPECT_EQ(colour_name({96, 0, 1}), "white");
}

TEST(WordNetFiles, KnowWiderWords) {
    auto net = WordNet::open();
    if (!net) GTEST_SKIP() << "WordNet (wordnet-base) is not installed";
    const auto has = [&](const std::string& noun, const std::string& word) {
        for (const RelatedWord& r : net->related(noun))
            if (r.word == word) return true;
        return false;
    };
    EXPECT_TRUE(has("mahogany", "wood"));
    EXPECT_TRUE(has("gneiss", "rock"));
    EXPECT_TRUE(net->related("qwertzuiop").empty());
    EXPECT_FALSE(net->related("zebrawood").empty()) << "the end of the index is reached";
}

}  // namespace
}  // namespace weft
