#include "engine/temporal/part_islands.h"

#include <gtest/gtest.h>

#include "engine/core/geometry.h"

namespace weft {
namespace {

void fill(Matte& matte, const Recti& box, std::uint8_t code = 255) {
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x)
            matte.at(x, y) = code;
    }
}

TEST(PartIslands, WhatHangsTogetherHasNone) {
    Matte part(40, 30);
    EXPECT_TRUE(part_islands(part).empty()) << "nor has nothing";
    fill(part, {5, 5, 20, 15});
    fill(part, {20, 15, 22, 17});  // at a corner
    EXPECT_TRUE(part_islands(part).empty());
}

TEST(PartIslands, SmallPiecesAreTold) {
    Matte part(40, 30);
    fill(part, {2, 2, 22, 12});         // 200 px
    fill(part, {26, 2, 32, 10});        // 48: less than a quarter
    fill(part, {2, 18, 12, 24});        // 60: the arm behind a bar
    fill(part, {30, 20, 38, 28}, 127);  // not inside
    const Matte islands = part_islands(part);
    ASSERT_EQ(islands.size(), part.size());
    for (int y = 0; y < islands.height(); ++y) {
        for (int x = 0; x < islands.width(); ++x) {
            const bool in_island = x >= 26 && x < 32 && y >= 2 && y < 10;
            EXPECT_EQ(islands.at(x, y), in_island ? 255 : 0) << x << ", " << y;
        }
    }
}

}  // namespace
}  // namespace weft
