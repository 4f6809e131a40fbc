#include "engine/temporal/joined_field.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kHalvesFrame{64, 48};
constexpr int kSpacing_px = 2;

// The left half is of the first part, the right one of the second, the lower quarter of nobody.
Image<std::uint8_t, 1> halves() {
    Image<std::uint8_t, 1> owner(kHalvesFrame);
    for (int y = 0; y < kHalvesFrame.height; ++y) {
        for (int x = 0; x < kHalvesFrame.width; ++x)
            owner.at(x, y) = y >= 36 ? kNobody : x < 32 ? 0 : 1;
    }
    return owner;
}

TEST(JoinedField, EachPartHasItsOwnUpToItsEdge) {
    const LatticeField field = joined_field(
        {moved_by(kHalvesFrame, {5, 0}), moved_by(kHalvesFrame, {0, -7})}, halves(), kSpacing_px);
    EXPECT_EQ(field.spacing(), kSpacing_px);
    EXPECT_LT(distance(field.at({27.5f, 20}), {5, 0}), 1e-4f);
    EXPECT_LT(distance(field.at({36.5f, 20}), {0, -7}), 1e-4f);
}

TEST(JoinedField, WhatNobodyOwnsGoesWithTheNearest) {
    const LatticeField field = joined_field(
        {moved_by(kHalvesFrame, {5, 0}), moved_by(kHalvesFrame, {0, -7})}, halves(), kSpacing_px);
    EXPECT_LT(distance(field.at({10, 45}), {5, 0}), 1e-4f);
    EXPECT_LT(distance(field.at({55, 60}), {0, -7}), 1e-4f);
}

TEST(JoinedField, WithoutAnyOwnerItIsTheFirst) {
    const Image<std::uint8_t, 1> nobody(kHalvesFrame, kNobody);
    const LatticeField field = joined_field(
        {moved_by(kHalvesFrame, {5, 0}), moved_by(kHalvesFrame, {0, -7})}, nobody, kSpacing_px);
    EXPECT_LT(distance(field.at({30, 20}), {5, 0}), 1e-4f);
}

}  // namespace
}  // namespace weft
