#include "texture_db/sources/copyright_file.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Copyright, TheLastParagraphThatFitsWins) {
    const auto file = CopyrightFile::parse(
        "Format: x\n\nFiles: *\nCopyright: 2002-2014, The Team\nLicense: GPL-2+\n\n"
        "Files:\n base/textures/a/wall1.png\n base/textures/a/wall2.png\nCopyright:\n \"bart\"\n "
        "2010 Jane Doe <j@x>\nLicense: CC-BY-3.0\n text\n\n"
        "Files: data/karts/*\nCopyright: © 2011 Kart Maker\nLicense: CC-BY-SA-4.0\n");
    EXPECT_EQ(file.of("textures/b/floor.png").licence, "GPL-2+");
    EXPECT_EQ(file.of("textures/b/floor.png").author, "The Team");
    EXPECT_EQ(file.of("textures/a/wall2.png").licence, "CC-BY-3.0");
    EXPECT_EQ(file.of("textures/a/wall2.png").author, "\"bart\", Jane Doe");
    EXPECT_EQ(file.of("usr/share/games/x/data/karts/tux/wood.png").licence, "CC-BY-SA-4.0");
    EXPECT_EQ(file.of("usr/share/games/x/data/karts/tux/wood.png").author, "Kart Maker");
}

TEST(Copyright, FreeTextTellsTheLicenceItNames) {
    const auto file = CopyrightFile::parse(
        "It was downloaded.\nNexuiz is © 2002 - 2009 Alientrap\nunder the GNU General Public "
        "License\nversion 2, "
        "or (at your option) any later version.\n");
    EXPECT_EQ(file.of("textures/x.tga").licence, "GPL-2+");
    EXPECT_EQ(file.of("textures/x.tga").author, "Alientrap");
}

TEST(Copyright, NothingKnownIsUnknown) {
    EXPECT_EQ(CopyrightFile::parse("").of("a.png").licence, "unknown");
    EXPECT_EQ(CopyrightFile::parse("Files: b*\nLicense: MIT\n").of("a.png").licence, "unknown");
}

}  // namespace
}  // namespace weft
