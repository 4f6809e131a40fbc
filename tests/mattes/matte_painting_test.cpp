// The cost of a stroke depends on what it touches, not on the size of the matte.
#include "app/mattes/matte_painting.h"

#include <gtest/gtest.h>
#include <time.h>

#include <thread>

namespace weft::test {
namespace {

constexpr MattePlace kPlace{1, 0, 12};

double thread_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Brush pen() {
    Brush out;
    out.radius_px = 6;
    out.hardness = 1;
    return out;
}

Matte painted_by_hand(const Matte& before, const std::vector<Vec2>& way) {
    Matte out = before;
    Stroke stroke(std::make_shared<const Matte>(before), pen());
    for (const Vec2 at : way)
        (void)stroke.move_to(at, 1, out);
    return out;
}

Matte patterned(Size size) {
    Matte out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.at(x, y) = static_cast<std::uint8_t>((x * 7 + y * 13) % 200);
    return out;
}

const std::vector<Vec2> kWay{{40, 50}, {90, 60}, {200, 300}, {500, 320}};

TEST(MattePainting, TheCallingThreadCopiesNoLargeMatte) {
    const Size size{12000, 8000};
    auto before = std::make_shared<const Matte>(size, std::uint8_t{3});
    const double start = thread_ms();
    { const Matte copy = *before; }
    const double copying = thread_ms() - start;

    MattePainting painting;
    painting.prepare(before, size);
    const double begun = thread_ms();
    painting.begin(kPlace, size, pen());
    painting.begin_on(before);
    for (const Vec2 at : kWay)
        painting.move_to(at, 1);
    const double painted = thread_ms() - begun;
    EXPECT_LT(painted, copying / 4) << "copying takes " << copying << " ms";
    // Points that arrived before the copy was ready are painted in the end.
    const auto done = painting.end();
    ASSERT_TRUE(done);
    for (const Vec2 at : kWay)
        EXPECT_EQ(done->matte->at(static_cast<int>(at.x), static_cast<int>(at.y)), 255);
    EXPECT_EQ(done->matte->at(6000, 7000), 3);
    EXPECT_EQ(before->at(40, 50), 3) << "the history keeps it";
}

TEST(MattePainting, EqualsAStrokeThroughTheSamePoints) {
    for (const Size size : {Size{700, 500}, Size{300, 400}}) {
        const auto before = std::make_shared<const Matte>(patterned(size));
        for (const bool prepared : {true, false}) {
            MattePainting painting;
            if (prepared) painting.prepare(before, size);
            painting.begin(kPlace, size, pen());
            painting.begin_on(before);
            for (const Vec2 at : kWay)
                painting.move_to(at, 1);
            const auto done = painting.end();
            ASSERT_TRUE(done);
            EXPECT_EQ(done->place, kPlace);
            EXPECT_EQ(*done->matte, painted_by_hand(*before, kWay));
            EXPECT_FALSE(painting.active());
        }
    }
}

TEST(MattePainting, AStrokeWithoutAMatteBeginsOnAnEmptyOne) {
    const Size size{800, 600};
    MattePainting painting;
    painting.prepare(nullptr, size);
    painting.begin(kPlace, size, pen());
    painting.begin_on(nullptr);
    for (const Vec2 at : kWay)
        painting.move_to(at, 1);
    const auto done = painting.end();
    ASSERT_TRUE(done);
    EXPECT_EQ(*done->matte, painted_by_hand(Matte(size), kWay));
}

// As after an undo: the same matte is begun on again.
TEST(MattePainting, TwoStrokesOnOneMatteShareNothing) {
    const Size size{700, 500};
    const auto before = std::make_shared<const Matte>(patterned(size));
    MattePainting painting;
    const auto stroke = [&](Vec2 at) {
        painting.prepare(before, size);
        painting.begin(kPlace, size, pen());
        painting.begin_on(before);
        painting.move_to(at, 1);
        return painting.end()->matte;
    };
    const MattePtr first = stroke({100, 100}), second = stroke({400, 300});
    EXPECT_EQ(*first, painted_by_hand(*before, {{100, 100}}));
    EXPECT_EQ(*second, painted_by_hand(*before, {{400, 300}}));
}

TEST(MattePainting, ShowsWhatIsPaintedAndWhere) {
    const Size size{700, 500};
    const auto before = std::make_shared<const Matte>(patterned(size));
    MattePainting painting;
    EXPECT_FALSE(painting.at(kPlace));
    painting.prepare(before, size);
    painting.begin(kPlace, size, pen());
    painting.begin_on(before);
    const auto begun = painting.at(kPlace);
    ASSERT_TRUE(begun);
    EXPECT_EQ(begun->changed, rect_of(size)) << "it is another texture's first version";
    EXPECT_FALSE(painting.at({2, 0, 12}));
    painting.shown();
    painting.move_to({100, 120}, 1);
    // The copy may be on its way still.
    while (painting.at(kPlace)->changed.empty())
        painting.update();
    const auto shown = painting.at(kPlace);
    EXPECT_NE(shown->version, begun->version);
    EXPECT_EQ(shown->pixels.at(100, 120), 255);
    EXPECT_TRUE(shown->changed.contains(100, 120));
    EXPECT_LT(shown->changed.width(), 40);
}

TEST(MattePainting, WithoutAPointNothingIsFinished) {
    const Size size{700, 500};
    MattePainting painting;
    EXPECT_FALSE(painting.end());
    painting.begin(kPlace, size, pen());
    painting.begin_on(nullptr);
    EXPECT_TRUE(painting.active());
    EXPECT_FALSE(painting.end());
    painting.begin(kPlace, size, pen());
    painting.begin_on(nullptr);
    painting.move_to({50, 50}, 1);
    painting.cancel();
    EXPECT_FALSE(painting.active());
    EXPECT_FALSE(painting.end());
}

// The number of pixels of a dot along a row and a column through its middle.
Size extent_of(const Matte& matte) {
    Recti box{};
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            if (matte.at(x, y) >= 128) box = box.united({x, y, x + 1, y + 1});
    return box.size();
}

TEST(Brush, IsRoundOnTheUnsqueezedPicture) {
    const auto before = std::make_shared<const Matte>(Size{200, 200});
    Brush brush;
    brush.radius_px = 40;
    brush.hardness = 1;
    const auto dot = [&](PixelAspect aspect) {
        brush.aspect = aspect;
        Matte out = *before;
        Stroke stroke(before, brush);
        (void)stroke.move_to({100, 100}, 1, out);
        return extent_of(out);
    };
    EXPECT_EQ(dot({}), (Size{80, 80}));
    EXPECT_EQ(dot(PixelAspect(2)), (Size{40, 80}));
    EXPECT_EQ(dot(PixelAspect(0.5)), (Size{160, 80}));
}

TEST(Brush, AStrokeIsAsWideInAllDirectionsOfTheUnsqueezedPicture) {
    const PixelAspect aspect(2);
    const auto before = std::make_shared<const Matte>(Size{200, 300});
    Brush brush;
    brush.radius_px = 20;
    brush.hardness = 1;
    brush.aspect = aspect;
    Matte out = *before;
    Stroke stroke(before, brush);
    (void)stroke.move_to({60, 70}, 1, out);
    (void)stroke.move_to({120, 190}, 1, out);  // at 45 degrees of the picture unsqueezed
    int inside = 0;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const Vec2 p = aspect.unsqueezed(Vec2(x + 0.5f, y + 0.5f)) - Vec2(120, 70);
            const float t = std::clamp((p.x + p.y) / 240, 0.0f, 1.0f);
            const float off = std::hypot(p.x - 120 * t, p.y - 120 * t);
            inside += out.at(x, y) >= 128;
            if (std::abs(off - 20) < 1.5f) continue;
            EXPECT_EQ(out.at(x, y) >= 128, off < 20) << x << ", " << y;
        }
    }
    EXPECT_GT(inside, 2000);
}

}  // namespace
}  // namespace weft::test
