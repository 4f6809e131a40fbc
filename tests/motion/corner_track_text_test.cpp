// A planar track out and in again, through each format.
#include "engine/motion/corner_track_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

using ::testing::HasSubstr;

constexpr Size kShown{854, 480};

CornerTrack turning_track() {
    CornerTrack track;
    for (int frame = 1001; frame <= 1024; ++frame) {
        const double t = frame - 1001, c = std::cos(0.02 * t), s = std::sin(0.02 * t);
        Quad<double> quad{{{-13.37, 20.5}, {611.1, 33.25}, {590, 470.001}, {7.5, 433}}};
        for (glm::dvec2& p : quad)
            p = {c * p.x - s * p.y + 1.7 * t, s * p.x + c * p.y - 0.3 * t};
        track[frame] = quad;
    }
    return track;
}

CornerTextContext text_context() {
    CornerTextContext context;
    context.plate = kShown;
    context.first_frame = 1001;
    context.reference = 1010;
    context.fps = 23.976;
    return context;
}

double worst_corner(const CornerTrack& a, const CornerTrack& b) {
    double worst = a.size() == b.size() ? 0 : 1e9;
    for (const auto& [frame, quad] : a)
        for (std::size_t k = 0; k < 4 && b.count(frame) == 1; ++k)
            worst = std::max(worst, glm::length(quad[k] - b.at(frame)[k]));
    return worst;
}

TEST(CornerTrackText, ComesBackFromNuke) {
    const std::string text = nuke_corner_pin(turning_track(), text_context());
    EXPECT_THAT(text, HasSubstr("CornerPin2D {\n to1 {{curve x1001 "));
    const auto back = parse_corner_track(text, {kShown, 1001});
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_LT(worst_corner(turning_track(), *back), 1e-3);
}

// from1 to from4 are the corners on the reference frame: there the node changes nothing.
TEST(CornerTrackText, NukeStartsFromTheReferenceFrame) {
    std::string text = nuke_corner_pin(turning_track(), text_context());
    for (std::size_t at = 0; (at = text.find(" to", at)) != std::string::npos; ++at)
        text.replace(at, 3, " at");
    for (std::size_t at = 0; (at = text.find(" from", at)) != std::string::npos; ++at)
        text.replace(at, 5, " to");
    const auto from = parse_corner_track(text, {kShown, 1001});
    ASSERT_TRUE(from) << from.error().text();
    const CornerTrack track = turning_track();
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LT(glm::length(from->begin()->second[k] - track.at(1010)[k]), 1e-3) << k;
}

TEST(CornerTrackText, ComesBackFromAfterEffects) {
    const std::string text = after_effects_corner_pin(turning_track(), text_context());
    EXPECT_THAT(text, HasSubstr("Adobe After Effects 8.0 Keyframe Data\r\n"));
    EXPECT_THAT(text, HasSubstr("\tUnits Per Second\t23.976\r\n"));
    EXPECT_THAT(text, HasSubstr("\r\n\t0\t-13.37\t20.5\t\r\n"));
    const auto back = parse_corner_track(text, {kShown, 1001});
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_LT(worst_corner(turning_track(), *back), 1e-3);
}

// Blender counts from 0 to 1 with its origin at the bottom left.
TEST(CornerTrackText, TellsBlenderInSharesOfThePicture) {
    CornerTrack track;
    track[-7] = {{{0, 0}, {854, 0}, {427, 480}, {0, 240}}};
    CornerTextContext context = text_context();
    context.reference = -7;
    const std::string text = blender_corner_pin(track, context);
    EXPECT_THAT(text, HasSubstr("\n    -7: ((0, 1), (1, 1), (0, 0.5), (0.5, 0), ),\n"));
    EXPECT_THAT(text, HasSubstr("nodes.new('CompositorNodeCornerPin')"));
}

TEST(CornerTrackText, WritesNoNegativeZero) {
    CornerTrack track;
    track[1] = {{{-1e-9, 0}, {10, -1e-9}, {10, 10}, {0, 10}}};
    CornerTextContext context = text_context();
    context.reference = context.first_frame = 1;
    EXPECT_THAT(after_effects_corner_pin(track, context), HasSubstr("\t0\t0\t0\t\r\n"));
}

}  // namespace
}  // namespace weft
