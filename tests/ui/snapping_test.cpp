// Snapping to edges of the plate: where it finds them, and that tools use it.
#include <chrono>
#include <cmath>

#include "tests/ui/canvas_fixture.h"
#include "ui/canvas/plate_snap.h"

namespace weft::test {
namespace {

// A bright quadrilateral on dark, its edges smooth over a pixel: half planes by their normals.
PicturePtr quad_picture(Size size, Vec2 middle, float half, float turn) {
    const float c = std::cos(turn), s = std::sin(turn);
    ImageU8x3 out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Vec2 d =
                Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) - middle;
            const Vec2 q(c * d.x + s * d.y, -s * d.x + c * d.y);
            const float inside = std::min(half - std::abs(q.x), half - std::abs(q.y));
            const float share = std::clamp(inside + 0.5f, 0.0f, 1.0f);
            for (int k = 0; k < 3; ++k)
                out.at(x, y, k) = static_cast<std::uint8_t>(40 + 150 * share);
        }
    return make_picture(std::move(out));
}

TEST(PlateSnap, FindsAnEdgeBetweenPixels) {
    const PicturePtr picture = quad_picture({200, 160}, {100.3f, 80}, 40.4f, 0);
    // Its left side is at 59.9.
    const auto found = ui::snapped_to_edge(*picture, {65, 83}, 8);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->corner);
    EXPECT_NEAR(found->at.x, 59.9, 0.15);
    EXPECT_NEAR(found->at.y, 83, 0.5);
}

TEST(PlateSnap, PrefersACorner) {
    for (const float turn : {0.0f, 0.3f, -0.6f}) {
        const PicturePtr picture = quad_picture({200, 160}, {100.3f, 80.2f}, 40, turn);
        const float c = std::cos(turn), s = std::sin(turn);
        const Vec2 corner(100.3f + 40 * c - 40 * s, 80.2f + 40 * s + 40 * c);
        const auto found = ui::snapped_to_edge(*picture, corner + Vec2(-4, 2.5f), 8);
        ASSERT_TRUE(found) << turn;
        EXPECT_TRUE(found->corner) << turn;
        EXPECT_NEAR(found->at.x, corner.x, 0.6) << turn;
        EXPECT_NEAR(found->at.y, corner.y, 0.6) << turn;
    }
}

TEST(PlateSnap, FindsNothingOnAnEvenPictureOrOutOfReach) {
    const PicturePtr picture = quad_picture({200, 160}, {100, 80}, 40, 0);
    EXPECT_FALSE(ui::snapped_to_edge(*picture, {100, 80}, 8));
    EXPECT_FALSE(ui::snapped_to_edge(*picture, {30, 80}, 8));
    EXPECT_FALSE(ui::snapped_to_edge(*picture, {-500, 1e6f}, 8));
    EXPECT_FALSE(ui::snapped_to_line(*picture, {100, 60}, {100, 100}, 8));
}

TEST(PlateSnap, LaysASegmentAlongAnEdgeByAFit) {
    constexpr float kTurn = 0.21f;
    const PicturePtr picture = quad_picture({300, 260}, {150, 130}, 80, kTurn);
    const float c = std::cos(kTurn), s = std::sin(kTurn);
    const auto place = [&](float u, float v) {
        return Vec2(150 + c * u - s * v, 130 + s * u + c * v);
    };
    // Askew and aside of the top side.
    const auto found = ui::snapped_to_line(*picture, place(-70, -75), place(65, -84), 8);
    ASSERT_TRUE(found);
    for (const Vec2 end : {found->first, found->second}) {
        const Vec2 d = end - Vec2(150, 130);
        EXPECT_NEAR(-s * d.x + c * d.y, -80, 0.12);
    }
    // Half of it beyond the end of the edge.
    EXPECT_FALSE(ui::snapped_to_line(*picture, place(10, -80), place(200, -80), 6));
}

TEST(PlateSnap, IsFastEnoughForEveryFrameOfTheWindow) {
    const PicturePtr picture = quad_picture({1920, 1080}, {900, 500}, 400, 0.1f);
    const auto begin = std::chrono::steady_clock::now();
    constexpr int kTimes = 10;
    for (int k = 0; k < kTimes; ++k) {
        static_cast<void>(ui::snapped_to_edge(*picture, {500.0f + static_cast<float>(k), 140}, 32));
        static_cast<void>(ui::snapped_to_line(*picture, {540, 70}, {1300, 150}, 32));
    }
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count() /
        kTimes;
    RecordProperty("ms", std::to_string(ms));
    EXPECT_LT(ms, 200) << "even in a sanitised build on a busy machine";
}

class Snapping : public CanvasTest {
  protected:
    void SetUp() override {
        CanvasTest::SetUp();
        view.plate_picture = quad_picture(view.plate.size, {160, 90}, 50, 0);
        view.project.regions[0] = view.project.regions[0].with([](Region& r) {
            r.placement.corners_px = {PlatePoint{60, 20}, {240, 20}, {240, 150}, {60, 150}};
        });
    }
    std::vector<double> corners() const {
        const auto set = edits<SetRegionParameter>();
        return set.empty() ? std::vector<double>() : std::get<std::vector<double>>(set[0].value);
    }
    void drag_corner() {
        go("Texture", Tool::kPlace);
        robot->stroke({on(60, 20), on(90, 35), on(109, 41)});
    }
};

TEST_F(Snapping, ADraggedCornerComesToLieOnACornerOfThePlate) {
    shell->state().snap = true;
    drag_corner();
    const auto at = corners();
    ASSERT_EQ(at.size(), 8U);
    EXPECT_NEAR(at[0], 110, 0.6);
    EXPECT_NEAR(at[1], 40, 0.6);
}

TEST_F(Snapping, WithoutTheSwitchItStaysAtTheMouse) {
    drag_corner();
    const auto at = corners();
    ASSERT_EQ(at.size(), 8U);
    EXPECT_NEAR(at[0], 109, 0.5);
    EXPECT_NEAR(at[1], 41, 0.5);
}

TEST_F(Snapping, TheSwitchIsACommandAndAButton) {
    go("Texture", Tool::kPlace);
    EXPECT_FALSE(shell->state().snap);
    robot->key("Shift+Tab");
    robot->frames(2);
    EXPECT_TRUE(shell->state().snap);
    EXPECT_EQ(shell->state().tool, Tool::kPlace) << "no tool of its own";
}

}  // namespace
}  // namespace weft::test
