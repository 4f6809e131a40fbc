#include "engine/core/text.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Text, CaseIsThatOfAsciiLetters) {
    EXPECT_EQ(lower_case("Plate_0001.EXR"), "plate_0001.exr");
    EXPECT_EQ(lower_case("@[`{ \xC3\x84"), "@[`{ \xC3\x84");
    EXPECT_TRUE(same_ignoring_case("Linear", "lINEAR"));
    EXPECT_FALSE(same_ignoring_case("linear", "linea"));
    EXPECT_FALSE(same_ignoring_case("@", "`"));
    EXPECT_TRUE(same_ignoring_case("", ""));
}

TEST(Text, XmlHasNoMarkupAndNoControlCharacters) {
    EXPECT_EQ(xml_text("a<b> & \"c\"\x01\t"), "a&lt;b&gt; &amp; &quot;c&quot;\t");
}

TEST(Text, ASizeIsWidthByHeight) {
    EXPECT_EQ(size_text({1920, 1080}), "1920x1080");
    EXPECT_EQ(size_text({}), "0x0");
}

TEST(Text, LongWordsAreShortenedInTheMiddle) {
    const std::string word(5000, 'n');
    EXPECT_EQ(shortened_words("a short text."), "a short text.");
    const std::string out = shortened_words("Unknown '" + word + "' here\nand on");
    EXPECT_LT(out.size(), 1000u);
    EXPECT_TRUE(out.starts_with("Unknown 'nnn"));
    EXPECT_TRUE(out.ends_with("nnn' here\nand on"));
    EXPECT_NE(out.find("n…n"), std::string::npos);
    // No character is cut in two.
    std::string umlauts;
    for (int k = 0; k < 3000; ++k)
        umlauts += "ä";
    std::string left = shortened_words(umlauts);
    for (std::size_t at; (at = left.find("ä")) != std::string::npos;)
        left.erase(at, 2);
    EXPECT_EQ(left, "…");
}

}  // namespace
}  // namespace weft
