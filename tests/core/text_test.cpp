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

TEST(Text, ASizeIsWidthByHeight) {
    EXPECT_EQ(size_text({1920, 1080}), "1920x1080");
    EXPECT_EQ(size_text({}), "0x0");
}

}  // namespace
}  // namespace weft
