// What people saw in pictures whose names mislead.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "texture_db/describe/material_words.h"
#include "texture_db/sources/picture_corrections.h"

namespace weft::test {
namespace {

TEST(PictureCorrections, NameTheMaterialThatWasSeenOrNone) {
    EXPECT_EQ(corrected_material("nexuiz-textures", "textures/terraintex/sand01.tga"), "snow");
    EXPECT_EQ(corrected_material("nexuiz-textures", "textures/terraintex/grass2.tga"), "-");
    EXPECT_EQ(corrected_material("nexuiz-textures", "textures/nowhere/brick.jpg"), std::nullopt);
    EXPECT_EQ(corrected_material("other", "textures/terraintex/sand01.tga"), std::nullopt);
    EXPECT_TRUE(was_inspected("ufoai-textures"));
    EXPECT_FALSE(was_inspected("redeclipse-data"));
}

TEST(PictureCorrections, AreWellFormedAndOfKnownMaterials) {
    std::istringstream lines{std::string(pictures_looked_at())};
    int count = 0;
    std::string before;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        ++count;
        EXPECT_EQ(std::count(line.begin(), line.end(), '\t'), 2) << line;
        const std::string material = line.substr(line.rfind('\t') + 1);
        const auto& table = material_table();
        const bool known = std::any_of(table.begin(), table.end(),
                                       [&](const MaterialEntry& m) { return m.name == material; });
        EXPECT_TRUE(known || material == "-") << line;
        EXPECT_LT(before, line) << "sorted, so that each is there once";
        before = line;
    }
    EXPECT_GT(count, 300);
}

}  // namespace
}  // namespace weft::test
