// Which edges of the plate say how far it is out of focus.
#include "engine/pipeline/frame_focus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "engine/color/color_space.h"
#include "engine/compute/backend_registry.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kFocusFrame = 1;

// Stripes of two greys, 12 px wide, with one blur or with one that differs from stripe to stripe.
MemoryShot unevenly_striped_wall(float blur_px, float differing_by_px) {
    MemoryShot shot(kShotSize);
    auto plate = std::make_shared<ImageF3>(kShotSize);
    for (int y = 0; y < kShotSize.height; ++y) {
        for (int x = 0; x < kShotSize.width; ++x) {
            const float edge = std::round(static_cast<float>(x) / 12);
            const float away = static_cast<float>(x) + 0.5f - 12 * edge;
            const float blur =
                blur_px + differing_by_px * static_cast<float>(static_cast<int>(edge) % 4);
            const float sign = static_cast<int>(edge) % 2 == 0 ? 1.0f : -1.0f;
            const float v = 0.5f + 0.2f * sign * std::erf(away / (blur * std::sqrt(2.0f)));
            std::fill_n(plate->pixel(x, y), 3, linear_to_srgb(v * v));
        }
    }
    shot.plates[kFocusFrame] = std::move(plate);
    shot.mattes[{0, kFocusFrame}] = box_matte(kRegionBox);
    return shot;
}

RegionPlan checked_region() {
    auto texture = std::make_shared<TexturePicture>();
    texture->is_plane = true;
    texture->pixels = ImageF3(16, 16);
    for (int k = 0; k < 256; ++k)
        std::fill_n(texture->pixels.data() + 3 * k, 3, (k / 4 + k / 64) % 2 == 0 ? 0.4f : 0.7f);
    RegionPlan region = make_region(std::move(texture));
    region.focus_frames = {kFocusFrame};
    return region;
}

// Energy of the texture's gradients down the stripes, where the plate has none.
double detail(const MemoryShot& shot, const RegionPlan& region) {
    const ShotPlan plan = make_plan(region, kFocusFrame, kFocusFrame);
    MemoryAnalysisStore store;
    EXPECT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene);
    const std::vector<RegionScene> scenes{std::move(*scene)};
    const auto frame = render_frame(shot, plan, scenes, store, *make_cpu_backend(), kFocusFrame);
    EXPECT_TRUE(frame);
    double sum = 0;
    for (int y = kRegionBox.y0 + 6; y < kRegionBox.y1 - 6; ++y) {
        for (int x = kRegionBox.x0 + 6; x < kRegionBox.x1 - 6; ++x) {
            const auto step = static_cast<double>(frame->pixels.pixel(x, y + 1)[1] -
                                                  frame->pixels.pixel(x, y)[1]);
            sum += step * step;
        }
    }
    return sum;
}

// Of the texture's detail, what its focus leaves.
double left(const MemoryShot& shot, RegionPlan region) {
    region.focus = 0;
    const double sharp = detail(shot, region);
    region.focus = 1;
    return detail(shot, region) / sharp;
}

TEST(FrameFocus, ATextureIsAsSoftAsThePaintOfThePlate) {
    EXPECT_LT(left(unevenly_striped_wall(1.8f, 0), checked_region()), 0.5);
    EXPECT_NEAR(left(unevenly_striped_wall(0.2f, 0), checked_region()), 1, 0.02);
}

TEST(FrameFocus, ThePenumbraOfAShadowIsNoFocus) {
    RegionPlan region = checked_region();
    region.light_source = LightSource::kPlate;
    region.detail = 1;  // all that the plate shows is light
    EXPECT_NEAR(left(unevenly_striped_wall(1.8f, 0), region), 1, 0.02);
}

TEST(FrameFocus, BlursThatDifferAreNotThoseOfOneLens) {
    EXPECT_NEAR(left(unevenly_striped_wall(0.7f, 1), checked_region()), 1, 0.05);
}

}  // namespace
}  // namespace weft
