#include "app/render/memory_plan.h"

#include <gmock/gmock.h>

#include <limits>

namespace weft {
namespace {

constexpr Size k4k{3840, 2160};
constexpr std::int64_t kGib = 1ll << 30;

TEST(MemoryPlan, MoreMemoryNeverMeansFewerFrames) {
    EXPECT_EQ(*frames_at_once(k4k, 0, true), std::numeric_limits<std::size_t>::max());
    std::size_t before = 1;
    for (std::int64_t gib = 2; gib <= 32; gib *= 2) {
        const std::size_t now = *frames_at_once(k4k, gib * kGib, false);
        EXPECT_GE(now, before) << gib;
        EXPECT_LE(now, *frames_at_once({1920, 1080}, gib * kGib, false)) << gib;
        if (const auto layered = frames_at_once(k4k, gib * kGib, true)) {
            EXPECT_LE(*layered, now) << gib;
        }
        before = now;
    }
    EXPECT_GT(before, 32u);
}

TEST(MemoryPlan, TooLittleForOneFrameSaysHowMuchItTakes) {
    const auto refused = frames_at_once(k4k, kGib, false);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kNoSpace);
    const std::string message = refused.error().sentence();
    EXPECT_THAT(message, testing::HasSubstr("3840x2160"));
    const std::size_t at = message.find("at least ") + 9;
    const auto needed = parse_bytes(message.substr(at, message.find('M', at) + 1 - at));
    ASSERT_TRUE(needed) << message;
    EXPECT_EQ(*frames_at_once(k4k, *needed, false), 1u);
    const auto layered = frames_at_once(k4k, *needed, true);
    ASSERT_FALSE(layered);
    EXPECT_THAT(layered.error().sentence(), testing::HasSubstr("without layers"));
}

TEST(MemoryPlan, BytesAreReadWithTheirUnits) {
    EXPECT_EQ(*parse_bytes("3G"), 3 * kGib);
    EXPECT_EQ(*parse_bytes("1.5GiB"), 3 * kGib / 2);
    EXPECT_EQ(*parse_bytes("800mb"), 800ll << 20);
    EXPECT_EQ(*parse_bytes("2000000"), 2000000);
    for (const char* wrong : {"", "lots", "-1G", "3X", "3GX", "1e30", "nan", "inf"})
        EXPECT_FALSE(parse_bytes(wrong)) << wrong;
}

}  // namespace
}  // namespace weft
