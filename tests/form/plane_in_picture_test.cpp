#include "engine/form/plane_in_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "engine/form/surface_distance.h"
#include "tests/form/room_picture.h"

namespace weft {
namespace {

// Between two directions, whichever way they point.
double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    const double cosine = std::abs(glm::dot(glm::normalize(a), glm::normalize(b)));
    return std::acos(std::min(1.0, cosine)) * 180 / 3.14159265358979;
}

// n with n · P = 1 on a plane.
glm::dvec3 normal_of(const RigidSurface& s) {
    const double by = s.long_side / (s.tangent * s.radius);
    const glm::dvec2 off = glm::dvec2(s.middle - s.centre) / s.radius;
    return {s.slope_x * by, s.slope_y * by, 1 + s.slope_x * off.x + s.slope_y * off.y};
}

std::optional<PictureFit> found_on(const Matte& luma, const Matte& matte,
                                   const TangentBelief& lens = {}) {
    const std::vector<PictureLine> lines = picture_lines(luma);
    return plane_in_picture(scene_perspective(lines, luma.size(), lens), lines_on(lines, matte),
                            matte);
}

TEST(PictureLines, PiecesThatOtherLinesCrossAreOneLine) {
    Matte grid(400, 300);
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 400; ++x)
            grid.at(x, y) = x % 20 < 2 || y % 20 < 2 ? 230 : 30;
    const std::vector<PictureLine> lines = picture_lines(grid);
    ASSERT_GT(lines.size(), 20u);
    EXPECT_GT(lines.front().length(), 300);
    EXPECT_TRUE(std::is_sorted(
        lines.begin(), lines.end(),
        [](const PictureLine& a, const PictureLine& b) { return a.length() > b.length(); }));
    // Between two crossings there are 18 px.
    const auto whole = std::count_if(lines.begin(), lines.end(),
                                     [](const PictureLine& line) { return line.length() > 250; });
    EXPECT_GT(whole, 20);
    for (const PictureLine& line : lines) {
        const glm::dvec2 d = line.to - line.from;
        EXPECT_LT(std::min(std::abs(d.x), std::abs(d.y)), 0.02 * line.length());
    }
}

TEST(PictureLines, OnlyThoseOnTheSurfaceAreIts) {
    const RoomPicture room;
    const std::vector<PictureLine> lines = picture_lines(room.luma);
    const auto on_floor = lines_on(lines, room.floor), on_wall = lines_on(lines, room.wall);
    EXPECT_GT(on_floor.size(), 10u);
    EXPECT_GT(on_wall.size(), 10u);
    for (const PictureLine& line : on_floor) {
        const glm::dvec2 middle = 0.5 * (line.from + line.to);
        const int x = static_cast<int>(middle.x), y = std::min(static_cast<int>(middle.y) + 5, 359);
        EXPECT_GE(room.floor.at(x, y), 128) << middle.x << ", " << middle.y;
    }
    EXPECT_TRUE(lines_on(lines, Matte(RoomPicture::kSize)).empty());
}

TEST(PictureLines, OfOneSquareAndDirectionTheLongestStay) {
    std::vector<PictureLine> lines;
    for (int k = 0; k < 10; ++k)
        lines.push_back({{10, 10 + k}, {40 - k, 10 + k}});
    lines.push_back({{20, 5}, {20, 25}});
    const auto few = thinned(lines, {640, 360});
    ASSERT_EQ(few.size(), 3u);
    EXPECT_EQ(few[0].length(), 30);
    EXPECT_EQ(few[1].length(), 29);
    EXPECT_EQ(few[2].length(), 20);
}

TEST(PlaneInPicture, FloorAndWallOfARoomAreFoundWithTheLens) {
    const RoomPicture room;
    const double fov = fov_of_tangent(640 / room.focal_px, RoomPicture::kSize);
    for (const auto& [matte, normal] :
         {std::pair(&room.floor, glm::dvec3(0, 1, 0)), {&room.wall, glm::dvec3(0, 0, 1)}}) {
        const auto fit = found_on(room.luma, *matte);
        ASSERT_TRUE(fit);
        EXPECT_TRUE(fit->holds(0.9));
        EXPECT_LT(degrees_between(normal_of(fit->surface), room.seen(normal)), 1.5);
        EXPECT_NEAR(fit->fov_deg, fov, 4);
        EXPECT_LT(fit->error, 0.1);
        EXPECT_GT(fit->explained, 0.6);
    }
}

TEST(PlaneInPicture, TheLensIsFoundWhetherLongOrShort) {
    for (const double focal : {450.0, 1000.0}) {
        const RoomPicture room(focal, 0.25, 0.5);
        const auto fit = found_on(room.luma, room.floor);
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->surface.tangent, 640 / focal, 0.08 * 640 / focal);
        EXPECT_LT(degrees_between(normal_of(fit->surface), room.seen({0, 1, 0})), 2);
    }
}

TEST(PlaneInPicture, AGivenLensIsKept) {
    const RoomPicture room;
    const double given = 640 / room.focal_px;
    const auto fit = found_on(room.luma, room.floor, {given, kGivenTangentDeviation});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->surface.tangent, given, 0.01);
}

// Longer than any that would be found.
TEST(PlaneInPicture, AGivenTelephotoIsKept) {
    constexpr double kFocal_px = 2600;
    const RoomPicture room(kFocal_px, 0.3, 0.4);
    const double given = 640 / kFocal_px;
    const auto fit = found_on(room.luma, room.floor, {given, kGivenTangentDeviation});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->surface.tangent, given, 0.005);
    EXPECT_LT(degrees_between(normal_of(fit->surface), room.seen({0, 1, 0})), 3);
}

// Nothing above its horizon is a floor's, whatever the lines say.
TEST(PlaneInPicture, NoFloorReachesAboveItsHorizon) {
    const RoomPicture room;
    Matte all(RoomPicture::kSize);
    std::fill(all.data(), all.data() + all.size_bytes(), std::uint8_t{255});
    const auto fit = found_on(room.luma, all);
    ASSERT_TRUE(fit);
    EXPECT_GT(degrees_between(normal_of(fit->surface), room.seen({0, 1, 0})), 30);
}

TEST(PlaneInPicture, LinesAtAnyAngleShowNone) {
    std::mt19937 random(5);
    const auto number = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
    };
    std::vector<PictureLine> lines;
    for (int k = 0; k < 80; ++k) {
        const glm::dvec2 from(number(40, 600), number(40, 320));
        const double angle = number(0, 6.2832), length = number(20, 60);
        lines.push_back({from, from + length * glm::dvec2(std::cos(angle), std::sin(angle))});
    }
    std::sort(lines.begin(), lines.end(),
              [](const PictureLine& a, const PictureLine& b) { return a.length() > b.length(); });
    Matte all(RoomPicture::kSize);
    std::fill(all.data(), all.data() + all.size_bytes(), std::uint8_t{255});
    const auto scene = scene_perspective(lines, RoomPicture::kSize, {});
    const auto fit = plane_in_picture(scene, lines, all);
    EXPECT_FALSE(fit && fit->holds(0.6));
}

// The courses of a column are no plane's, though they run in about two directions.
TEST(PlaneInPicture, WhatIsCurvedShowsNone) {
    std::vector<PictureLine> lines;
    for (int course = 0; course < 12; ++course) {
        for (int k = -5; k < 5; ++k) {
            const auto place = [&](double turn) {
                return glm::dvec2(320 + 100 * std::sin(turn),
                                  40 + 24 * course + 30 * (1 - std::cos(turn)));
            };
            lines.push_back({place(0.28 * k), place(0.28 * (k + 1))});
        }
    }
    Matte column(RoomPicture::kSize);
    for (int y = 40; y < 340; ++y)
        std::fill(column.row(y) + 220, column.row(y) + 420, std::uint8_t{255});
    const auto scene = scene_perspective(lines, RoomPicture::kSize, {});
    const auto fit = plane_in_picture(scene, lines, column);
    EXPECT_FALSE(fit && fit->log_stretch > 0.1 && fit->holds(0.6));
}

TEST(PlaneInPicture, WithoutLinesOrMatteThereIsNone) {
    const RoomPicture room;
    const std::vector<PictureLine> lines = picture_lines(room.luma);
    const auto scene = scene_perspective(lines, RoomPicture::kSize, {});
    ASSERT_FALSE(scene.ways.empty());
    EXPECT_FALSE(plane_in_picture(scene, {}, Matte(RoomPicture::kSize)));
    const auto blank = scene_perspective({}, RoomPicture::kSize, {});
    EXPECT_TRUE(blank.ways.empty());
    EXPECT_FALSE(plane_in_picture(blank, {}, room.floor));
}

}  // namespace
}  // namespace weft
