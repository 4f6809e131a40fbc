#include "engine/core/keyed_numbers.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

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
    EXPECT_EQ(keys.keys[0].frame, 4);
    EXPECT_TRUE(keys.has(10));
    EXPECT_THAT(keys.at(10), ElementsAre(3));
    keys.erase(10);
    EXPECT_FALSE(keys.has(10));
}

TEST(KeyedNumbers, TextIsReadBackToTheSameNumbers) {
    const KeyedNumbers keys{{{-3, {1.25, -7}}, {12, {0, 0.1}}, {90, {1e-7, 1.0 / 3}}}};
    const auto again = parse_keyed_numbers(keyed_text(keys), 2);
    ASSERT_TRUE(again) << again.error().sentence();
    EXPECT_EQ(*again, keys);
}

TEST(KeyedNumbers, TextThatIsNoneIsAnErrorThatSaysWhy) {
    for (const char* wrong : {"nonsense", "1:1 1:2", "1:1 2", "1:a", "x:1", "1:1,2", "1:nan",
                              "1:1:", "1:1:bezier", "1:1:smooth:hold", "1::smooth", ":1:smooth"})
        EXPECT_EQ(parse_keyed_numbers(wrong).error().code, ErrorCode::kUsage) << wrong;
    EXPECT_TRUE(parse_keyed_numbers("")->empty());
}

TEST(KeyedNumbers, HoldKeepsItsNumbersUpToTheNextKey) {
    const auto keys = parse_keyed_numbers("1:2:hold 11:4");
    ASSERT_TRUE(keys);
    EXPECT_EQ(keys->at(10)[0], 2);
    EXPECT_EQ(keys->at(11)[0], 4);
}

TEST(KeyedNumbers, SmoothBeginsAndEndsLevelAndPassesThroughItsKeys) {
    const auto keys = parse_keyed_numbers("0:0:smooth 10:1");
    ASSERT_TRUE(keys);
    EXPECT_DOUBLE_EQ(keys->at(5)[0], 0.5);
    EXPECT_LT(keys->at(1)[0], 0.05);
    EXPECT_GT(keys->at(9)[0], 0.95);
    EXPECT_EQ(keys->at(0)[0], 0);
    EXPECT_EQ(keys->at(10)[0], 1);
}

// A steep stretch beside a level one, a turning point, far frames: no value leaves its two keys.
TEST(KeyedNumbers, SmoothNeverOvershoots) {
    for (const char* text :
         {"0:0:smooth 10:0:smooth 12:1:smooth 30:1", "0:1:smooth 7:-3:smooth 9:5:smooth 40:4.9",
          "-3:1e-9:smooth 1:0:smooth 5:1e9:smooth 1000:1e9",
          "0:0:smooth 1:1:smooth 90:1.01:smooth 91:9",
          "-90000000:0:smooth 5:1:smooth 90000000:2"}) {
        const KeyedNumbers keys = *parse_keyed_numbers(text);
        for (std::size_t k = 0; k + 1 < keys.keys.size(); ++k) {
            const NumberKey &a = keys.keys[k], &b = keys.keys[k + 1];
            const auto [low, high] = std::minmax(a.numbers[0], b.numbers[0]);
            const int step = std::max(1, (b.frame - a.frame) / 40);
            double before = a.numbers[0];
            for (int f = a.frame; f < b.frame; f += step) {
                const double v = keys.at(f)[0];
                EXPECT_GE(v, low) << text << " on " << f;
                EXPECT_LE(v, high) << text << " on " << f;
                EXPECT_GE((v - before) * (b.numbers[0] - a.numbers[0]), -1e-12) << text;
                EXPECT_NEAR(keys.float_at(f)[0], v, 1e-5 * std::max(1.0, std::abs(high)));
                before = v;
            }
        }
    }
}

// No kink on a key between two smooth stretches of different slopes.
TEST(KeyedNumbers, SmoothHasOneSlopeOnAKey) {
    const KeyedNumbers keys = *parse_keyed_numbers("0:0:smooth 1000:1:smooth 2000:4:smooth 3000:5");
    const double before = keys.at(1000)[0] - keys.at(999)[0];
    const double after = keys.at(1001)[0] - keys.at(1000)[0];
    EXPECT_NEAR(before, after, 0.01 * after);
    EXPECT_GT(after, 0.001);
}

TEST(KeyedNumbers, SmoothAfterAHoldBeginsLevel) {
    const KeyedNumbers keys = *parse_keyed_numbers("0:0:hold 10:1:smooth 20:2");
    EXPECT_LT(keys.at(11)[0] - 1, 0.05);
}

TEST(KeyedNumbers, InterpolationIsReadBackFromText) {
    const KeyedNumbers keys{{{-3, {1.25, -7}, KeyInterpolation::kSmooth},
                             {12, {0, 0.1}, KeyInterpolation::kHold},
                             {90, {2, 3}}}};
    EXPECT_EQ(keyed_text(keys), "-3:1.25,-7:smooth 12:0,0.1:hold 90:2,3");
    EXPECT_EQ(parse_keyed_numbers(keyed_text(keys), 2).value(), keys);
    EXPECT_EQ(parse_key("12:1:linear", true, 1)->after, KeyInterpolation::kLinear);
    EXPECT_EQ(name_of(*parse_interpolation("hold")), "hold");
    EXPECT_NE(parse_interpolation("bezier").error().sentence().find("linear, smooth or hold"),
              std::string::npos);
}

TEST(KeyedNumbers, ANewKeyInterpolatesAsItsStretchDoes) {
    KeyedNumbers keys = *parse_keyed_numbers("1:0:smooth 11:1:hold");
    keys.set(5, {0.5});
    EXPECT_EQ(keys.key(5)->after, KeyInterpolation::kSmooth);
    keys.set(1, {0.2});
    EXPECT_EQ(keys.key(1)->after, KeyInterpolation::kSmooth);
    EXPECT_EQ(keys.key(7), nullptr);
    keys.set(-5, {0.5});
    EXPECT_EQ(keys.key(-5)->after, KeyInterpolation::kLinear);
}

}  // namespace
}  // namespace weft
