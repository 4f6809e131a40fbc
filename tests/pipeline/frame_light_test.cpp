// What the artist asks of the light, and of the new surface's colour and its way over the old one.
#include "engine/pipeline/frame_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "engine/color/color_space.h"
#include "engine/compute/backend_registry.h"
#include "engine/pipeline/region_zones.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kLitFrame = 5;
constexpr Vec2i kInZone{60, 50}, kBeside{120, 80};

class Wall : public MemoryShot {
  public:
    Wall() : MemoryShot(make_wall(false, false)) {}
    [[nodiscard]] Expected<Matte> zone(int, int, int) const override { return box_matte(kZoneBox); }
};

ZonePlan detail_zone(float value) {
    ZonePlan zone;
    zone.kind = ZoneKind::kDetail;
    zone.value = value;
    return zone;
}

RegionPlan lamp_lit() {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.light_source = LightSource::kPainted;
    region.lamps = {{LampKind::kPoint, {{{0, {80, 56, 200, 2}}}}}};
    return region;
}

RenderedFrame frame_of(const MemoryShot& shot, const ShotPlan& plan) {
    MemoryAnalysisStore store;
    const Status done = analyse_shot(shot, plan, store, {}, {});
    EXPECT_TRUE(done) << (done ? "" : done.error().text());
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
    const std::vector<RegionScene> scenes{std::move(*scene)};
    auto frame = render_frame(shot, plan, scenes, store, *make_cpu_backend(), kLitFrame);
    EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
    return std::move(*frame);
}

ImageF3 rendered_wall(const RegionPlan& region) {
    return frame_of(Wall(), make_plan(region, kLitFrame, kLitFrame)).pixels;
}

float linear_at(const ImageF3& picture, Vec2i at, int channel = 1) {
    return srgb_to_linear(picture.pixel(at.x, at.y)[channel]);
}

// The texture's own light is that of the reference: without strength there is no gain.
TEST(FrameLight, AStrengthAboveOneRaisesTheContrast) {
    RegionPlan region = lamp_lit();
    const float once = linear_at(rendered_wall(region), kBeside);
    region.light.strength = 0;
    const float none = linear_at(rendered_wall(region), kBeside);
    region.light.strength = 1.5f;
    const float more = linear_at(rendered_wall(region), kBeside);
    ASSERT_GT(once, 1.05f * none);
    EXPECT_NEAR(std::log(more / none), 1.5f * std::log(once / none), 0.02f);
}

// How far the lit texture's detail goes with the plate's, over a line of the surface.
float detail_of(const ImageF3& picture, int x0, int x1, int y) {
    float sum = 0;
    for (int x = x0 + 1; x < x1; ++x)
        sum += std::abs(std::log(linear_at(picture, {x, y}) / linear_at(picture, {x - 1, y})));
    return sum;
}

TEST(FrameLight, LightDetailGoesFromBroadLightToAllThatThePlateShows) {
    RegionPlan region = plate_lit();
    const auto detail = [&](float amount) {
        region.detail = amount;
        return detail_of(rendered_wall(region), 30, 130, 60);
    };
    const float broad = detail(0), estimated = detail(0.5f), all = detail(1);
    EXPECT_LT(broad, estimated);
    EXPECT_GT(all, 1.5f * estimated);
}

TEST(FrameLight, AZoneSaysWhatIsLightAndWhatIsPaint) {
    RegionPlan region = plate_lit();
    const ImageF3 before = rendered_wall(region);
    region.zones = {detail_zone(1)};
    const ImageF3 light = rendered_wall(region);
    region.zones = {detail_zone(1), detail_zone(0)};
    const ImageF3 paint = rendered_wall(region);
    const auto inside = [](const ImageF3& p) { return detail_of(p, 42, 88, 50); };
    EXPECT_GT(inside(light), 1.3f * inside(before));
    EXPECT_LT(inside(paint), inside(before)) << "the last one counts";
    EXPECT_NEAR(light.pixel(kBeside.x, kBeside.y)[1], before.pixel(kBeside.x, kBeside.y)[1], 2e-3f);
}

TEST(FrameLight, KeptDetailIsAFactorOfItsOwn) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    const float flat = detail_of(rendered_wall(region), 30, 130, 60);
    EXPECT_LT(flat, 1e-3f);
    region.keep_detail = 1;
    EXPECT_GT(detail_of(rendered_wall(region), 30, 130, 60), 0.5f) << "without any light";
}

TEST(FrameLight, GlossIsALayerOfItsOwn) {
    Wall shot;
    auto plate = std::make_shared<ImageF3>(*shot.plates.at(kLitFrame));
    for (int k = 0; k < 9; ++k)
        std::fill_n(plate->pixel(kBeside.x + k % 3, kBeside.y + k / 3), 3, 4.0f);
    shot.plates[kLitFrame] = std::move(plate);
    RegionPlan region = plate_lit();
    region.detail = 0;  // the spot is not in the light
    region.highlights = 1;
    region.keep_detail = 0.5f;
    ShotPlan plan = make_plan(region, kLitFrame, kLitFrame);
    plan.layers = true;
    const RenderedFrame frame = frame_of(shot, plan);
    ASSERT_TRUE(frame.layers);
    const float texture = srgb_to_linear(0.5f);
    for (const Vec2i at : {kBeside + Vec2i(1, 1), kInZone, Vec2i{30, 80}}) {
        const float light = frame.layers->light.at(at.x, at.y, 1);
        const float gloss = frame.layers->gloss.at(at.x, at.y, 1);
        EXPECT_NEAR(frame.layers->patch.at(at.x, at.y, 1), light * texture + gloss, 1e-4f);
        EXPECT_EQ(gloss > 0.5f, at == kBeside + Vec2i(1, 1));
    }
    EXPECT_EQ(frame.layers->gloss.at(2, 2, 0), 0.0f);
}

TEST(FrameLight, TheGradeAndTheMatchAreOnTheTexture) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    const float before = linear_at(rendered_wall(region), kBeside);
    region.grade.exposure = -1;
    region.grade.multiply = {1, 0.5f, 1};
    EXPECT_NEAR(linear_at(rendered_wall(region), kBeside), before / 4, 1e-3f);
    EXPECT_NEAR(linear_at(rendered_wall(region), kBeside, 0), before / 2, 1e-3f);
    region.grade = {};
    region.match = 1;
    const float matched = linear_at(rendered_wall(region), kBeside);
    region.match = 0.5f;
    EXPECT_NE(matched, before);
    EXPECT_NEAR(linear_at(rendered_wall(region), kBeside), std::sqrt(before * matched), 2e-3f);
}

// A white cloth with soft folds in front of a window: its paint reflects 0.8.
TEST(FrameLight, WhiteIsAsBrightAsThePlatesAndKeepsItsFolds) {
    Wall shot;
    auto plate = std::make_shared<ImageF3>(kShotSize, 1.0f);
    const auto fold_at = [](int x) { return 0.6f + 0.12f * std::sin(static_cast<float>(x) / 9); };
    for (int y = 0; y < kShotSize.height; ++y)
        for (int x = 0; x < kShotSize.width - 12; ++x)
            std::fill_n(plate->pixel(x, y), 3, linear_to_srgb(fold_at(x)));
    for (auto& [frame, shown] : shot.plates)
        shown = plate;
    RegionPlan region = plate_lit();
    region.texture = flat_texture({0.97f, 0.97f, 0.97f});
    region.match = 1;
    const RenderedFrame frame = frame_of(shot, make_plan(region, kLitFrame, kLitFrame));
    float darkest = 1, brightest = 0;
    for (int x = kRegionBox.x0 + 8; x < kRegionBox.x1 - 8; ++x) {
        const float code = frame.pixels.at(x, 60, 1);
        darkest = std::min(darkest, code), brightest = std::max(brightest, code);
    }
    EXPECT_LT(brightest, 250 / 255.0f);
    EXPECT_GT(brightest, linear_to_srgb(0.72f));
    EXPECT_GT(srgb_to_linear(brightest) / srgb_to_linear(darkest), 0.85f * 0.72f / 0.48f);
    EXPECT_EQ(frame.above_one, 0);
}

TEST(FrameLight, OpacityAndBlendModeGoOverTheOldSurface) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    const Wall shot;
    const float plate = srgb_to_linear(shot.plates.at(kLitFrame)->pixel(kBeside.x, kBeside.y)[1]);
    const float texture = linear_at(rendered_wall(region), kBeside);
    region.opacity = 0.25f;
    EXPECT_NEAR(linear_at(rendered_wall(region), kBeside), plate + 0.25f * (texture - plate),
                1e-3f);
    region.opacity = 1;
    region.blend_mode = BlendMode::kMultiply;
    EXPECT_NEAR(linear_at(rendered_wall(region), kBeside), plate * texture, 1e-3f);
}

TEST(FrameLight, DetailIsEmptyWhereItIsAsEstimated) {
    const Wall shot;
    const MemoryAnalysisStore store;
    RegionPlan region = plate_lit();
    EXPECT_TRUE(light_detail(shot, make_plan(region), store, 0, kLitFrame)->empty());
    region.zones = {detail_zone(3)};
    const auto found = light_detail(shot, make_plan(region), store, 0, kLitFrame);
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_EQ(found->at(kInZone.x, kInZone.y), 1.0f) << "at most all of it";
    EXPECT_EQ(found->at(kBeside.x, kBeside.y), kEstimatedDetail);
}

}  // namespace
}  // namespace weft
