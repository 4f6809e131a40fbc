#include "engine/motion/corner_track.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

constexpr CornerTrackContext kContext{{200, 100}, 1001};

void expect_quad(const CornerTrack& track, int frame, const Quad<double>& quad) {
    const auto found = track.find(frame);
    ASSERT_NE(found, track.end()) << frame;
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(found->second[k].x, quad[k].x, 1e-9) << frame << " corner " << k;
        EXPECT_NEAR(found->second[k].y, quad[k].y, 1e-9) << frame << " corner " << k;
    }
}

const Quad<double> kFirst{{{10, 20}, {110, 20}, {110, 80}, {10, 80}}};
const Quad<double> kThird{{{14, 22}, {114, 22}, {114, 82}, {14, 82}}};
const Quad<double> kSecond{{{12, 21}, {112, 21}, {112, 81}, {12, 81}}};

TEST(CornerTrack, ReadsLinesAndFillsGapsInStraightLines) {
    const auto track = parse_corner_track(
        "# frame  TL  TR  BR  BL\n1001 10 20 110 20 110 80 10 80\n\n"
        "1003, 14, 22; 114, 22; 114, 82; 14, 82  # the last\r\n",
        kContext);
    ASSERT_TRUE(track) << track.error().text();
    EXPECT_EQ(track->size(), 3u);
    expect_quad(*track, 1001, kFirst);
    expect_quad(*track, 1002, kSecond);
    expect_quad(*track, 1003, kThird);
}

TEST(CornerTrack, ReadsNukesCornersFromTheBottomUp) {
    const auto track = parse_corner_track(
        "CornerPin2D {\n inputs 0\n to1 {{curve x1001 10 x1003 14} {curve x1001 20 L x1003 18}}\n"
        " to2 {{curve x1001 110 112 114} {curve x1001 20 19 18}}\n"
        " to3 {{curve x1001 110 112 114} {curve x1001 80 79 78}}\n"
        " to4 {{curve x1001 10 12 14} {curve x1001 80 79 78}}\n invert false\n"
        " from1 {0 0}\n from2 {200 0}\n}\n",
        kContext);
    ASSERT_TRUE(track) << track.error().text();
    expect_quad(*track, 1001, kFirst);
    expect_quad(*track, 1002, kSecond);
    expect_quad(*track, 1003, kThird);
}

TEST(CornerTrack, ReadsNukesFixedCorners) {
    const auto track = parse_corner_track(
        "CornerPin2D {\n to1 {10 20}\n to2 {110 20}\n to3 {110 80}\n"
        " to4 {{curve i x1 10 12} {80}}\n}",
        kContext);
    ASSERT_TRUE(track) << track.error().text();
    EXPECT_NEAR(track->at(1)[0].x, 10, 1e-9);
    EXPECT_NEAR(track->at(1)[0].y, 20, 1e-9);
    EXPECT_NEAR(track->at(1)[2].y, 80, 1e-9);
}

std::string after_effects(const std::vector<std::string>& names) {
    std::string text =
        "Adobe After Effects 8.0 Keyframe Data\r\n\r\n\tUnits Per Second\t24\r\n"
        "\tSource Width\t100\r\n\tSource Height\t50\r\n\r\n";
    const char* const rows[] = {"\t0\t5\t10\t\r\n\t2\t7\t11\t\r\n",
                                "\t0\t55\t10\r\n\t2\t57\t11\r\n", "\t0\t5\t40\r\n\t2\t7\t41\r\n",
                                "\t0\t55\t40\r\n\t2\t57\t41\r\n"};
    for (std::size_t k = 0; k < 4; ++k)
        text += "Effects\t" + names[k] + "\r\n\tFrame\tX pixels\tY pixels\r\n" + rows[k] + "\r\n";
    return text + "End of Keyframe Data\r\n";
}

TEST(CornerTrack, ReadsAfterEffectsInThePlatesSizeAndNumbers) {
    const auto adobe =
        parse_corner_track(after_effects({"ADBE Corner Pin #1\tADBE Corner Pin-0001",
                                          "ADBE Corner Pin #1\tADBE Corner Pin-0002",
                                          "ADBE Corner Pin #1\tADBE Corner Pin-0003",
                                          "ADBE Corner Pin #1\tADBE Corner Pin-0004"}),
                           kContext);
    const auto power = parse_corner_track(
        after_effects({"CC Power Pin #1\tCC Power Pin-0002", "CC Power Pin #1\tCC Power Pin-0003",
                       "CC Power Pin #1\tCC Power Pin-0004", "CC Power Pin #1\tCC Power Pin-0005"}),
        kContext);
    for (const auto& track : {adobe, power}) {
        ASSERT_TRUE(track) << track.error().text();
        expect_quad(*track, 1001, kFirst);
        expect_quad(*track, 1002, kSecond);
        expect_quad(*track, 1003, kThird);
    }
}

TEST(CornerTrack, SaysWhatIsWrong) {
    const auto message = [](const char* text) {
        const auto track = parse_corner_track(text, kContext);
        EXPECT_FALSE(track) << text;
        return track ? std::string() : track.error().sentence();
    };
    EXPECT_NE(message("1001 10 20 110 20 110 80 10").find("Line 1 is not a frame"),
              std::string::npos);
    EXPECT_NE(message("1.5 10 20 110 20 110 80 10 80").find("Line 1 is not a frame"),
              std::string::npos);
    EXPECT_NE(message("7 10 20 110 80 110 20 10 80").find("frame 7"), std::string::npos);
    EXPECT_NE(message("7 0 0 9 0 9 9 0 9\n7 0 0 9 0 9 9 0 9").find("7"), std::string::npos);
    EXPECT_NE(message("").find("no frames"), std::string::npos);
    EXPECT_NE(message("CornerPin2D {\n to1 {10 20}\n}").find("to4"), std::string::npos);
    EXPECT_NE(message("CornerPin2D {\n to4 {{{{").find("to4"), std::string::npos);
    EXPECT_NE(
        message("Keyframe Data\nEffects\tADBE Corner Pin-0001\n\t0\t1\t2\n").find("upper right"),
        std::string::npos);
}

TEST(CornerTrack, MovesThePlaneExactlyBetweenCorners) {
    const Quad<double> from{{{20, 10}, {180, 15}, {170, 90}, {25, 85}}};
    const Quad<double> to{{{40, 5}, {190, 30}, {160, 95}, {10, 70}}};
    const LatticeField there = plane_motion(from, to, {200, 100}, 8);
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 p(from[k]), q(to[k]), d = there.at(p);
        EXPECT_NEAR(p.x + d.x, q.x, 0.02f);
        EXPECT_NEAR(p.y + d.y, q.y, 0.02f);
    }
    // Where the diagonals cross is no mean of the corners, but stays where the diagonals cross.
    const LatticeField round = compose(there, plane_motion(to, from, {200, 100}, 8));
    for (const Vec2 p : {Vec2(60, 30), Vec2(100, 50), Vec2(150, 70)}) {
        EXPECT_NEAR(round.at(p).x, 0, 0.02f);
        EXPECT_NEAR(round.at(p).y, 0, 0.02f);
    }
}

TEST(PointTrack, IsASquareThatMovesWithThePoint) {
    const CornerTrackContext context{{200, 100}, 10, true};
    const auto lines = parse_corner_track("# frame x y\n1 50 40\n3, 60, 44\n", context);
    ASSERT_TRUE(lines) << lines.error().text();
    EXPECT_EQ(lines->at(2)[0] - lines->at(1)[0], glm::dvec2(5, 2));
    EXPECT_EQ(lines->at(1)[2] - lines->at(1)[0], lines->at(3)[2] - lines->at(3)[0]);
    const auto effects = parse_corner_track(
        "Adobe After Effects 8.0 Keyframe Data\n\n\tSource Width\t400\n\tSource Height\t200\n\n"
        "Transform\tPosition\n\tFrame\tX pixels\tY pixels\n\t0\t100\t80\t0\n\t1\t110\t84\t0\n"
        "Transform\tScale\n\t0\t7\t7\n",
        context);
    ASSERT_TRUE(effects) << effects.error().text();
    EXPECT_EQ(effects->at(11)[3] - effects->at(10)[3], glm::dvec2(5, 2));
    EXPECT_EQ(effects->size(), 2u);
}

TEST(PointTrack, IsNoTrackOfAPlane) {
    EXPECT_FALSE(parse_corner_track("1 50 40\n", {{200, 100}, 10}));
    const auto wrong = parse_corner_track("1 50\n", {{200, 100}, 10, true});
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().sentence().find("three for a point"), std::string::npos);
}

}  // namespace
}  // namespace weft
