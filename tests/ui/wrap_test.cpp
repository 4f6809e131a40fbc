#include "ui/widgets/wrap.h"

#include <gtest/gtest.h>

namespace weft::ui {
namespace {

std::string wrapped(std::string_view text, float width) {
    return wrapped_at_words(text, width,
                            [](std::string_view part) { return static_cast<float>(part.size()); });
}

TEST(Wrap, BreaksAtSpacesOnly) {
    EXPECT_EQ(wrapped("steps of (-11.4, 15.6) px", 16), "steps of (-11.4,\n15.6) px");
    EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
    EXPECT_EQ(wrapped("one two three", 100), "one two three");
}

TEST(Wrap, KeepsANumberWithItsUnitAndItsError) {
    EXPECT_EQ(wrapped("repeats every 16 px", 16), "repeats every\n16 px");
    EXPECT_EQ(wrapped("confidence 38 %.", 13), "confidence\n38 %.");
    EXPECT_EQ(wrapped("tilted 15° ± 0.3°, so", 15), "tilted\n15° ± 0.3°,\nso");
}

TEST(Wrap, LeavesWhatIsTooLongAndLineEndsAsTheyAre) {
    EXPECT_EQ(wrapped("in /a/very/long/path there", 8), "in\n/a/very/long/path\nthere");
    EXPECT_EQ(wrapped("a b\n\nc", 20), "a b\n\nc");
    EXPECT_EQ(wrapped("", 20), "");
}

}  // namespace
}  // namespace weft::ui
