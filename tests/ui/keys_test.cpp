#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ui/base/commands.h"
#include "ui/base/theme.h"
#include "ui/canvas/view_map.h"
#include "ui/shell/command_table.h"

namespace weft {
namespace {

TEST(Keys, EveryDefaultCanBeReadAndComesBackAsItWas) {
    const Commands commands(all_commands());
    for (const Command& command : commands.all()) {
        const auto chord = parse_chord(command.default_key);
        ASSERT_TRUE(chord) << command.name << ": " << command.default_key;
        EXPECT_EQ(chord_text(*chord), command.default_key) << command.name;
    }
}

TEST(Keys, NoTwoCommandsShareADefault) {
    EXPECT_THAT(Commands(all_commands()).collisions(), testing::IsEmpty());
}

TEST(Keys, ACollisionIsFound) {
    Commands commands(all_commands());
    commands.bind({{"view.fit", "Ctrl+S"}});
    ASSERT_EQ(commands.collisions().size(), 1u);
    EXPECT_THAT(commands.collisions()[0], testing::HasSubstr("Ctrl+S"));
}

TEST(Keys, AnUnreadableBindingLeavesTheDefault) {
    Commands commands(all_commands());
    commands.bind({{"view.fit", "Hyper+Q"}});
    EXPECT_EQ(commands.key_of("view.fit"), "F");
}

TEST(Keys, IdsAreUnique) {
    std::set<std::string> ids;
    const Commands commands(all_commands());
    for (const Command& command : commands.all())
        EXPECT_TRUE(ids.insert(command.id).second) << command.id;
}

float theme_luminance(ImU32 color) {
    const auto linear = [](int code) {
        const float v = static_cast<float>(code) / 255.0f;
        return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    };
    return 0.2126f * linear(color & 255) + 0.7152f * linear((color >> 8) & 255) +
           0.0722f * linear((color >> 16) & 255);
}

float contrast(ImU32 a, ImU32 b) {
    const float x = theme_luminance(a), y = theme_luminance(b);
    return (std::max(x, y) + 0.05f) / (std::min(x, y) + 0.05f);
}

TEST(ThemeTokens, TextCanBeReadOnEverySurface) {
    for (const bool dark : {true, false}) {
        const Theme t = make_theme(dark, false, 1);
        for (const ImU32 surface : {t.panel, t.raised, t.field}) {
            EXPECT_GE(contrast(t.text, surface), 4.5f) << dark;
            EXPECT_GE(contrast(t.quiet, surface), 4.5f) << dark;
        }
        EXPECT_GE(contrast(t.on_accent, t.accent), 4.5f) << dark;
    }
}

TEST(ThemeTokens, HeatGrowsLighterAllTheWay) {
    for (int k = 1; k <= 64; ++k)
        EXPECT_GE(theme_luminance(heat_color(static_cast<float>(k) / 64)),
                  theme_luminance(heat_color(static_cast<float>(k - 1) / 64)) - 1e-4f);
}

TEST(Canvas, CoordinatesRoundTrip) {
    const ViewMap map{{100, 50}, {900, 650}, {320, 180}, 2.5f};
    const Vec2 p = map.to_plate(map.to_screen({12.25f, 99.5f}));
    EXPECT_NEAR(p.x, 12.25f, 1e-3);
    EXPECT_NEAR(p.y, 99.5f, 1e-3);
}

}  // namespace
}  // namespace weft
