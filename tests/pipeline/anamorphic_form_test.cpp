// The form of surfaces on a plate whose pixels are twice as wide as high.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/form/view_camera.h"
#include "engine/pipeline/region_form.h"
#include "engine/pipeline/region_scene.h"
#include "tests/pipeline/column_shot.h"

namespace weft {
namespace {

// The column as an anamorphic plate shows it: its true places are those of square pixels.
class WideColumn : public Column {
  public:
    [[nodiscard]] Expected<ImageF3> positions(int region, int frame) const override {
        WEFT_TRY(out, Column::positions(region, frame));
        for (int y = 0; y < out.height(); ++y)
            for (int x = 0; x < out.width(); ++x)
                out.pixel(x, y)[1] *= 0.5f;
        return out;
    }
};

RegionPlan on_wide_plate(RegionPlan region) {
    region.placement.aspect = PixelAspect(2);
    return region;
}

// Texels for a pixel to the side and one down.
Vec2 steps_at(const TextureMapping& mapping, Vec2 at) {
    const Vec2 x(1, 0), y(0, 1);
    return {distance(mapping.texel(at + x), mapping.texel(at - x)) / 2,
            distance(mapping.texel(at + y), mapping.texel(at - y)) / 2};
}

Expected<RegionScene> scene_of(const ShotSource& shot, const RegionPlan& region,
                               MemoryAnalysisStore& store) {
    const ShotPlan plan = make_plan(region, kFirst, kFirst);
    WEFT_CHECK_OK(analyse_shot(shot, plan, store, {}, {}));
    return make_scene(shot, plan, store, 0, {}, {});
}

// Where the column faces the camera a pixel of the plate is twice as wide as high.
TEST(AnamorphicForm, APassLiesSquareOnAnAnamorphicPlate) {
    MemoryAnalysisStore store;
    const auto scene = scene_of(WideColumn(), on_wide_plate(formed()), store);
    ASSERT_TRUE(scene) << scene.error().text();
    const Vec2 axis = steps_at(scene->mapping, {80, 56});
    EXPECT_NEAR(axis.x / axis.y, 2, 0.06f);
    const Vec2 side = steps_at(scene->mapping, {30, 56});
    EXPECT_NEAR(side.x / side.y, 2 / 0.78f, 0.12f);
    EXPECT_EQ(scene->form->aspect, PixelAspect(2));
    EXPECT_EQ(decode_form(*store.get({0, kFirst, AnalysisKind::kForm}))->aspect, PixelAspect(2));
}

// As wide as the picture unsqueezed shows it: a radius of 160 is one of 80 pixels of the plate.
TEST(AnamorphicForm, ADrawnShapeIsSeenUnsqueezed) {
    const RegionPlan region = on_wide_plate(
        drawn(unsqueezed({FormGuideKind::kCylinder, {80, 0, 80, 112, 160, 160}}, PixelAspect(2))));
    MemoryAnalysisStore store;
    const Column shot;
    const auto scene = scene_of(shot, region, store);
    ASSERT_TRUE(scene) << scene.error().text();
    const Vec2 axis = steps_at(scene->mapping, {80, 56}), side = steps_at(scene->mapping, {30, 56});
    EXPECT_NEAR(axis.x / axis.y, 2, 0.06f);
    EXPECT_NEAR(side.x / axis.x, 1 / 0.78f, 0.04f);
    const Matte all(kShotSize, 255);
    const auto shown = region_form_on(*scene, store, 0, kFirst, all, rect_of(kShotSize));
    ASSERT_TRUE(shown);
    EXPECT_NEAR(shown->normal.at(80, 56, 2), 1, 0.03f);
    EXPECT_NEAR(shown->normal.at(120, 56, 0), 0.5f, 0.06f);
}

// A tilted square before a camera with square pixels, whose picture is squeezed to half its width:
// the lens and the square are found as they are.
TEST(AnamorphicForm, APlaneIsFoundByTheRightCameraOnAnAnamorphicPlate) {
    const PixelAspect aspect(2);
    const ViewCamera camera = camera_with(50, aspect.unsqueezed(kShotSize));
    FormGuide guide{FormGuideKind::kPlane, {}};
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        const glm::dvec3 place(0.6 * corner.x - 0.35 * corner.y, 0.7 * corner.y,
                               5 + 0.7 * corner.x + 0.3 * corner.y);
        guide.numbers.push_back(place.x / place.z * camera.focal_px +
                                static_cast<double>(camera.centre.x));
        guide.numbers.push_back(place.y / place.z * camera.focal_px +
                                static_cast<double>(camera.centre.y));
    }
    RegionPlan region = on_wide_plate(drawn(guide));
    region.form_fov_deg = 50;
    MemoryAnalysisStore store;
    const Column shot;
    const auto scene = scene_of(shot, region, store);
    ASSERT_TRUE(scene) << scene.error().text();
    const FormGuide on_plate = squeezed(guide, aspect);
    std::vector<Vec2> flat;
    for (std::size_t k = 0; k < 8; k += 2)
        flat.push_back(scene->mapping.texel(Vec2(on_plate.place(k))));
    const double wide = std::sqrt(1.2 * 1.2 + 1.4 * 1.4);
    const double high = std::sqrt(0.7 * 0.7 + 1.4 * 1.4 + 0.6 * 0.6);
    const Vec2 along = flat[1] - flat[0], down = flat[3] - flat[0];
    const auto side = static_cast<double>(distance(flat[1], flat[0]));
    const auto other = static_cast<double>(distance(flat[3], flat[0]));
    EXPECT_NEAR(side / other, wide / high, 0.01);
    EXPECT_NEAR(static_cast<double>(distance(flat[2], flat[3])), side, 0.01 * side);
    EXPECT_NEAR((along.x * down.x + along.y * down.y) / (side * other), 0, 0.01);
    region.form_fov_deg.reset();
    MemoryAnalysisStore other_store;
    const auto found = scene_of(shot, region, other_store);
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_NEAR(found->form->finding.fov_deg, 50, 5);
    EXPECT_NEAR(found->form->finding.tilt_deg, scene->form->finding.tilt_deg, 4);
}

TEST(AnamorphicForm, AnOutlineIsInflatedAsItIsSeenUnsqueezed) {
    RegionPlan region = formed();
    region.form_from = RegionPlan::FormFrom::kOutline;
    MemoryAnalysisStore store;
    const auto scene = scene_of(Column(), on_wide_plate(region), store);
    ASSERT_TRUE(scene) << scene.error().text();
    const Vec2 middle = steps_at(scene->mapping, {80, 56});
    EXPECT_NEAR(middle.x / middle.y, 2, 0.1f);
}

}  // namespace
}  // namespace weft
