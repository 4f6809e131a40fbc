#include "engine/core/keyed_numbers.h"

#include <gmock/gmock.h>

namespace weft {
namespace {

using ::testing::ElementsAre;

TEST(KeyedNumbers, AreLinearBetweenKeysAndConstantOutside) {
    const auto keys = parse_keyed_numbers("1001:1 1011:2");
    ASSERT_TRUE(keys);
    EXPECT_THAT(keys->at(990), ElementsAre(1));
    EXPECT_THAT(keys->at(1006), ElementsAre(1.5));
    EXPECT_THAT(keys->at(2000), ElementsAre(2));
    EXPECT_THAT(keys->float_at(1006), ElementsAre(1.5f));
    EXPECT_TRUE(KeyedNumbers().at(5).empty());
}

TEST(KeyedNumbers, HaveOnAKeysFrameExactlyItsNumbers) {
    // 1 + 1 * (0.1 - 1) is not 0.1 in float.
    const auto keys = parse_keyed_numbers("1:1 24:0.1 48:7");
    ASSERT_TRUE(keys);
    EXPECT_EQ(keys->float_at(24)[0], 0.1f);
    EXPECT_EQ(keys->at(24)[0], 0.1);
}

TEST(KeyedNumbers, KeysAreSetReplacedAndErased) {
    KeyedNumbers keys;
    keys.set(10, {1});
    keys.set(4, {2});
    keys.set(10, {3});
    ASSERT_EQ(keys.keys.size(), 2u);
    EXPECT_EQ(keys.keys[0].first, 4);
    EXPECT_TRUE(keys.has(10));
    EXPECT_THAT(keys.at(10), ElementsAre(3));
    keys.erase(10);
    EXPECT_FALSE(keys.has(10));
}

TEST(KeyedNumbers, TextIsReadBackToTheSameNumbers) {
    const KeyedNumbers keys{{{-3, {1.25, -7}}, {12, {0, 0.1}}, {90, {1e-7, 1.0 / 3}}}};
    const auto again = parse_keyed_numbers(keyed_text(keys), 2);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, keys);
}

TEST(KeyedNumbers, TextThatIsNoneIsAnErrorThatSaysWhy) {
    for (const char* wrong : {"nonsense", "1:1 1:2", "1:1 2", "1:a", "x:1", "1:1,2", "1:nan"})
        EXPECT_EQ(parse_keyed_numbers(wrong).error().code, ErrorCode::kUsage) << wrong;
    EXPECT_TRUE(parse_keyed_numbers("")->empty());
}

}  // namespace
}  // namespace weft
