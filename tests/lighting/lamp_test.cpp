#include "engine/lighting/lamp.h"

#include <gmock/gmock.h>

namespace weft {
namespace {

using ::testing::SizeIs;

constexpr const char* kTwo = "point 10,20 30 1.5; gradient 1: 0,0 0,9 1 2 | 11: 0,0 0,9 1 4";

TEST(Lamps, TextIsReadBackToTheSameLamps) {
    const auto lamps = parse_lamps(kTwo);
    ASSERT_TRUE(lamps) << lamps.error().sentence();
    ASSERT_THAT(*lamps, SizeIs(2));
    EXPECT_EQ((*lamps)[1].kind, LampKind::kGradient);
    EXPECT_EQ((*lamps)[1].numbers.at(6)[5], 3);
    EXPECT_EQ(*parse_lamps(lamps_text(*lamps)), *lamps);
}

TEST(Lamps, OneWithSeveralKeysGetsAKeyAndOneWithoutChangesEverywhere) {
    std::vector<Lamp> lamps = *parse_lamps(kTwo);
    set_numbers(lamps[1], 6, {0, 0, 0, 9, 1, 10});
    EXPECT_EQ(lamps[1].numbers.at(6)[5], 10);
    EXPECT_EQ(lamps[1].numbers.at(11)[5], 4);
    set_numbers(lamps[0], 6, {50, 20, 30, 1.5});
    EXPECT_THAT(lamps[0].numbers.keys, SizeIs(1));
    EXPECT_EQ(lamps[0].numbers.at(1)[0], 50);
}

}  // namespace
}  // namespace weft
