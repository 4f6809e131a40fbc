#include "engine/mask/flat_fills.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr Size kSkyFrame{160, 100};
using Color = std::array<std::uint8_t, 3>;
constexpr Color kSky{150, 170, 200}, kCoat{60, 70, 160}, kSash{200, 60, 60}, kInk{10, 10, 10};
constexpr float kLimit_px = 30;

ImageU8x3 sky() {
    ImageU8x3 out(kSkyFrame);
    for (int y = 0; y < kSkyFrame.height; ++y) {
        for (int x = 0; x < kSkyFrame.width; ++x)
            std::copy(kSky.begin(), kSky.end(), out.pixel(x, y));
    }
    return out;
}

// A fill under a line of 2 px.
void paint_box(ImageU8x3& into, const Recti& box, const Color& color) {
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const bool line =
                x < box.x0 + 2 || y < box.y0 + 2 || x >= box.x1 - 2 || y >= box.y1 - 2;
            const Color& c = line ? kInk : color;
            std::copy(c.begin(), c.end(), into.pixel(x, y));
        }
    }
}

Matte box_matte(const Recti& box) {
    Matte out(kSkyFrame);
    for (int y = box.y0; y < box.y1; ++y)
        std::fill(out.row(y) + box.x0, out.row(y) + box.x1, std::uint8_t{1});
    return out;
}

ImageF1 box_distance(const Recti& box) {
    return signed_distance(box_matte(box), kLimit_px);
}

struct Share {
    double of_box = 0, elsewhere = 0;
};

Share shares_found(const Matte& found, const Recti& box) {
    Share out;
    for (int y = 0; y < kSkyFrame.height; ++y) {
        for (int x = 0; x < kSkyFrame.width; ++x) {
            const bool in = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
            (in ? out.of_box : out.elsewhere) += found.at(x, y) != 0;
        }
    }
    const double area = static_cast<double>(box.width()) * box.height();
    return {out.of_box / area, out.elsewhere / area};
}

// The key: a coat, and a sash beside it that is not the coat's.
const Recti kKeyCoat{20, 20, 70, 80}, kKeySash{90, 20, 110, 80};

ImageU8x3 key() {
    ImageU8x3 out = sky();
    paint_box(out, kKeyCoat, kCoat);
    paint_box(out, kKeySash, kSash);
    return out;
}

TEST(FlatFills, TakesOwnPaintWholeAndLeavesForeignPaintOut) {
    const FlatFills fills(key(), box_distance(kKeyCoat));
    // The coat jumped, and the matte found half of it and half of the sash.
    const Recti coat{60, 10, 110, 70}, sash{112, 10, 132, 70};
    ImageU8x3 frame = sky();
    paint_box(frame, coat, kCoat);
    paint_box(frame, sash, kSash);
    const Matte found = fills.corrected(frame, box_distance({85, 10, 122, 70}));
    ASSERT_FALSE(found.empty());
    const Share share = shares_found(found, coat);
    EXPECT_GT(share.of_box, 0.97);
    EXPECT_LT(share.elsewhere, 0.06);
}

// A matte without the lines, as a selection by colour gives it, stays one.
TEST(FlatFills, TakesLinesAsTheKeyframeDid) {
    const auto inner = [](const Recti& box) { return box.grown(-2); };
    const FlatFills fills(key(), box_distance(inner(kKeyCoat)));
    const Recti coat{60, 10, 110, 70};
    ImageU8x3 frame = sky();
    paint_box(frame, coat, kCoat);
    const Matte found = fills.corrected(frame, box_distance(coat));
    ASSERT_FALSE(found.empty());
    const Share share = shares_found(found, inner(coat));
    EXPECT_EQ(share.of_box, 1);
    EXPECT_EQ(share.elsewhere, 0);
    // And one that goes around them, too.
    const FlatFills around(key(), box_distance(kKeyCoat));
    const Share whole = shares_found(around.corrected(frame, box_distance(inner(coat))), coat);
    EXPECT_EQ(whole.of_box, 1);
    EXPECT_EQ(whole.elsewhere, 0);
}

TEST(FlatFills, LeavesAnotherThingOfThePaintWhereNoneOfItWasFound) {
    const FlatFills fills(key(), box_distance(kKeyCoat));
    const Recti coat{20, 20, 70, 80}, twin{90, 20, 140, 80};
    ImageU8x3 frame = sky();
    paint_box(frame, coat, kCoat);
    paint_box(frame, twin, kCoat);
    const Matte found = fills.corrected(frame, box_distance({20, 20, 60, 80}));
    ASSERT_FALSE(found.empty());
    EXPECT_GT(shares_found(found, coat).of_box, 0.97);
    EXPECT_EQ(shares_found(found, twin).of_box, 0);
}

TEST(FlatFills, LeavesAFillThatTheKeyDivides) {
    const FlatFills fills(key(), box_distance({20, 20, 70, 50}));
    const Matte found = fills.corrected(key(), box_distance({20, 20, 70, 40}));
    if (found.empty()) return;
    for (int y = 22; y < 78; ++y) {
        for (int x = 22; x < 68; ++x)
            EXPECT_EQ(found.at(x, y) != 0, y < 40) << x << " " << y;
    }
}

TEST(FlatFills, SaysNothingOfAPictureWithGrainOrWhereNothingDiffers) {
    const FlatFills fills(key(), box_distance(kKeyCoat));
    EXPECT_TRUE(fills.corrected(key(), box_distance(kKeyCoat)).empty());
    ImageU8x3 grainy = key();
    for (int y = 0; y < kSkyFrame.height; ++y) {
        for (int x = 0; x < kSkyFrame.width; ++x) {
            for (int c = 0; c < 3; ++c)
                grainy.pixel(x, y)[c] = static_cast<std::uint8_t>(grainy.pixel(x, y)[c] / 2 +
                                                                  (7 * x + 13 * y * y) % 60);
        }
    }
    const FlatFills none(grainy, box_distance(kKeyCoat));
    EXPECT_TRUE(none.corrected(key(), box_distance({20, 20, 60, 80})).empty());
}

// A rendering without grain: neighbours are equal, and all the same it is no fill.
TEST(FlatFills, AGradientIsNoFill) {
    ImageU8x3 frame = sky();
    for (int y = 20; y < 80; ++y) {
        for (int x = 20; x < 140; ++x) {
            for (int c = 0; c < 3; ++c)
                frame.pixel(x, y)[c] = static_cast<std::uint8_t>(60 + x / 2 + y / 3);
        }
    }
    const FlatFills none(frame, box_distance({20, 20, 140, 80}));
    EXPECT_TRUE(none.corrected(frame, box_distance({20, 20, 80, 80})).empty());
}

// As H.264 leaves a fill: blocks a level or two off, and ringing beside the lines.
TEST(FlatFills, ACompressedFillIsOne) {
    const auto compressed = [](const Recti& coat) {
        ImageU8x3 out = sky();
        paint_box(out, coat, kCoat);
        for (int y = 0; y < kSkyFrame.height; ++y) {
            for (int x = 0; x < kSkyFrame.width; ++x) {
                const int block = (x / 8 * 5 + y / 8 * 3) % 3 - 1;
                const int from_line =
                    std::min({x - coat.x0, coat.x1 - x, y - coat.y0, coat.y1 - y});
                const int ringing = from_line > 2 && from_line < 6 ? (x + y) % 3 * 3 - 3 : 0;
                for (int c = 0; c < 3; ++c)
                    out.pixel(x, y)[c] =
                        static_cast<std::uint8_t>(out.pixel(x, y)[c] + block + ringing);
            }
        }
        return out;
    };
    const FlatFills fills(compressed(kKeyCoat), box_distance(kKeyCoat));
    const Recti coat{60, 10, 110, 70};
    const Matte found = fills.corrected(compressed(coat), box_distance({85, 10, 110, 70}));
    ASSERT_FALSE(found.empty());
    EXPECT_GT(shares_found(found, coat).of_box, 0.95);
    EXPECT_LT(shares_found(found, coat).elsewhere, 0.03);
}

// A patterned card on a flat ground, painted with much of the ground.
TEST(FlatFills, LeavesWhatIsNeitherFillNorLine) {
    const Recti card{50, 30, 100, 70}, painted{30, 25, 120, 75}, later{34, 25, 124, 75};
    ImageU8x3 frame = sky();
    for (int y = card.y0; y < card.y1; ++y) {
        for (int x = card.x0; x < card.x1; ++x) {
            for (int c = 0; c < 3; ++c)
                frame.pixel(x, y)[c] = static_cast<std::uint8_t>(60 + (x + y) % 7 * 9);
        }
    }
    const FlatFills fills(frame, box_distance(painted));
    const Matte found = fills.corrected(frame, box_distance(later));
    if (found.empty()) return;
    for (int y = card.y0 + 2; y < card.y1 - 2; ++y) {
        for (int x = card.x0 + 2; x < card.x1 - 2; ++x)
            EXPECT_NE(found.at(x, y), 0) << x << " " << y;
    }
}

// A white shirt before a table of the same white, as a phone films it: hardly any grain, and a
// shading that falls into pieces of nearly one colour.
TEST(FlatFills, TakesTheShadingOfFilmForNoFills) {
    const Recti shirt{40, 10, 120, 60};
    ImageU8x3 frame(kSkyFrame);
    for (int y = 0; y < kSkyFrame.height; ++y) {
        for (int x = 0; x < kSkyFrame.width; ++x) {
            const double shade =
                9 * std::sin(0.11 * x + 0.7 * std::sin(0.09 * y)) * std::cos(0.13 * y);
            const bool wall = y < 60 && !(x >= shirt.x0 && x < shirt.x1 && y >= shirt.y0);
            for (int c = 0; c < 3; ++c)
                frame.pixel(x, y)[c] =
                    static_cast<std::uint8_t>(wall ? 90 : std::lround(225 + shade));
        }
    }
    const FlatFills fills(frame, box_distance(shirt));
    EXPECT_TRUE(fills.corrected(frame, box_distance({40, 12, 120, 62})).empty());
}

}  // namespace
}  // namespace weft
