// What comes in front of a surface faster than its boundary is followed.
#include "engine/mask/foreign_entries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr Size kPicture{120, 90};
constexpr Recti kSurface{0, 40, 120, 90};  // reaches the picture's border below and at the sides
constexpr Recti kArm{50, 70, 70, 90};      // enters from below

struct Entering {
    Recti box = kArm;
    bool as_surface = false;  // has the surface's colours
    bool has_past = false;    // was seen there on the frame before
};

ImageU8x3 picture(const Entering* entering) {
    ImageU8x3 out(kPicture);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const bool inside = kSurface.contains(x, y);
            const bool foreign =
                entering != nullptr && entering->box.contains(x, y) && !entering->as_surface;
            const auto grain = static_cast<std::uint8_t>((7 * x + 13 * y) % 9);
            // A face above has the arm's colour; the wall around it another.
            const bool skin = foreign || (!inside && x > 30 && x < 70);
            const auto base = skin ? Vec3(190, 130, 100) : inside ? Vec3(180, 180, 170) : Vec3(60);
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>(base[c] + grain);
        }
    }
    return out;
}

std::int64_t found(const Entering& entering) {
    Matte matte(kPicture);
    for (int y = kSurface.y0; y < kSurface.y1; ++y)
        std::fill(matte.row(y), matte.row(y) + matte.width(), std::uint8_t{255});
    const ImageF1 phi = signed_distance(inside_of(matte), 30);
    const SurfacePalette palette(picture(nullptr), phi);
    const ImageU8x3 now = picture(&entering);
    FlowField flow(kPicture);
    const Recti& box = entering.box;
    for (int y = box.y0; y < box.y1 && !entering.has_past; ++y)
        std::fill(flow.valid.row(y) + box.x0, flow.valid.row(y) + box.x1, std::uint8_t{0});
    const ImageF2 still(kPicture);
    const Matte out = foreign_entries({now, flow, phi, still, rect_of(kPicture), palette});
    return std::count(out.data(), out.data() + out.size_bytes(), std::uint8_t{255});
}

constexpr std::int64_t kArmPixels = 20 * 20;

TEST(ForeignEntries, AnArmThatEntersOverThePicturesBorderIsFound) {
    EXPECT_GT(found({}), kArmPixels * 9 / 10);
    EXPECT_LE(found({}), kArmPixels);
}

TEST(ForeignEntries, WhatComesFromBesideTheSurfaceIsFound) {
    EXPECT_GT(found({{50, 40, 70, 60}}), kArmPixels * 9 / 10);
}

TEST(ForeignEntries, WhatHasTheSurfacesColoursMayBeTheSurface) {
    EXPECT_EQ(found({kArm, true}), 0);
}

TEST(ForeignEntries, WhatWasThereBeforeDoesNotEnter) {
    EXPECT_EQ(found({kArm, false, true}), 0);
}

// A flash or a black frame tells nothing.
TEST(ForeignEntries, WhatCoversMostOfTheSurfaceAtOnceDoesNotEnter) {
    EXPECT_EQ(found({{10, 40, 110, 90}}), 0);
}

// A print or a button, where motion is hard to measure.
TEST(ForeignEntries, WhatLiesInTheMiddleDoesNotEnter) {
    EXPECT_EQ(found({{50, 55, 70, 75}}), 0);
}

}  // namespace
}  // namespace weft
