#include "engine/core/printable.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Printable, LeavesTextAsItIs) {
    for (const char* text : {"", "plate.####.exr", "Straße 中文 😀 é", "a\\b \"c\" 'd'"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatSteersATerminal) {
    EXPECT_EQ(printable("a\x1b[31mred\x07"), "a\\u001b[31mred\\u0007");
    EXPECT_EQ(printable("a\rb\x7f"), "a\\u000db\\u007f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\u0000b");
    EXPECT_EQ(printable("\xC2\x9B"
                        "31m"),
              "\\u009b31m");  // CSI as one character
}

TEST(Printable, EscapesWhatTurnsTheDirectionOfWriting) {
    EXPECT_EQ(printable("a\xE2\x80\xAE"
                        "b"),
              "a\\u202eb");
    EXPECT_EQ(printable("\xE2\x81\xA6\xE2\x80\x8F\xE2\x80\xA8"), "\\u2066\\u200f\\u2028");
}

TEST(Printable, KeepsLineBreaksOnlyWhereAskedTo) {
    EXPECT_EQ(printable("a\n\tb\r", LineBreaks::kKeep), "a\n\tb\\u000d");
    EXPECT_EQ(printable("a\n\tb"), "a\\u000a\\u0009b");
}

TEST(Printable, ReplacesWhatIsNotUtf8) {
    EXPECT_EQ(printable("a\xFF"
                        "b"),
              "a\xEF\xBF\xBD"
              "b");
    EXPECT_EQ(printable("\x9B"
                        "31m"),
              "\xEF\xBF\xBD"
              "31m");                                              // CSI of a Latin-1 terminal
    EXPECT_EQ(printable("\xC0\x9B"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // overlong
    EXPECT_EQ(printable("\xE2\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // cut off
}

}  // namespace
}  // namespace weft
