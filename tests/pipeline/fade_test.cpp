// Light that goes to zero and back.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "engine/color/color_space.h"
#include "engine/compute/backend_registry.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// The standing wall, frame `frame` in linear light times gains[frame - 1].
MemoryShot faded(const std::vector<float>& gains) {
    MemoryShot shot = make_wall(false, false);
    for (std::size_t k = 0; k < gains.size(); ++k) {
        auto plate = std::make_shared<ImageF3>(*shot.plates.at(kFirst + static_cast<int>(k)));
        for (std::size_t i = 0; i < plate->size_bytes() / sizeof(float); ++i) {
            float& v = plate->data()[i];
            v = std::round(255 * linear_to_srgb(gains[k] * srgb_to_linear(v))) / 255;
        }
        shot.plates[kFirst + static_cast<int>(k)] = plate;
    }
    return shot;
}

// The surface's mean linear light on each frame.
std::vector<double> levels(const MemoryShot& shot, RegionPlan region, int frames) {
    const ShotPlan plan = make_plan(std::move(region), kFirst, kFirst + frames - 1);
    MemoryAnalysisStore store;
    EXPECT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene);
    std::vector<RegionScene> scenes;
    scenes.push_back(std::move(*scene));
    std::vector<double> out;
    for (int f = kFirst; f < kFirst + frames; ++f) {
        const auto frame = render_frame(shot, plan, scenes, store, *make_cpu_backend(), f);
        EXPECT_TRUE(frame);
        const Recti box = kRegionBox.grown(-4);
        double sum = 0;
        for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; ++x)
                sum += srgb_to_linear(frame->pixels.at(x, y, 1));
        }
        out.push_back(sum / (static_cast<double>(box.width()) * box.height()));
    }
    return out;
}

TEST(Fade, TheTextureGoesToBlackWithThePlate) {
    const std::vector<float> gains{1, 0.5f, 0.2f, 0.05f, 0};
    const std::vector<double> seen = levels(faded(gains), plate_lit(), 5);
    for (std::size_t k = 0; k < gains.size(); ++k)
        EXPECT_NEAR(seen[k] / seen[0], gains[k], 0.05 * gains[k] + 1e-3) << k;
}

TEST(Fade, ATextureThatTakesLessLightVanishesToo) {
    RegionPlan region = plate_lit();
    region.light.strength = 0.5f;
    const std::vector<double> seen = levels(faded({1, 0.5f, 0.05f, 0}), region, 4);
    EXPECT_NEAR(seen[1] / seen[0], 0.75, 0.02);  // 1 + λ (g − 1)
    EXPECT_LT(seen[2] / seen[0], 0.4);
    EXPECT_LT(seen[3] / seen[0], 1e-3);
}

TEST(Fade, AFlashIsFollowedBeyondTheLimits) {
    RegionPlan region = make_region(flat_texture({0.1f, 0.1f, 0.1f}));
    region.light_source = LightSource::kPlate;
    const std::vector<double> seen = levels(faded({0.05f, 0.05f, 0.6f}), region, 3);
    EXPECT_NEAR(seen[2] / seen[0], 12, 1.5);
}

TEST(Fade, TheLightIsRelativeToAFrameThatShowsTheSurface) {
    RegionPlan region = plate_lit();
    region.light_frame = kFirst + 3;
    const std::vector<float> gains{0, 0.25f, 0.5f, 1};
    const std::vector<double> seen = levels(faded(gains), region, 4);
    for (std::size_t k = 0; k < gains.size(); ++k)
        EXPECT_NEAR(seen[k] / seen[3], gains[k], 0.05 * gains[k] + 1e-3) << k;
}

// As in a compositor, what is not relit stays as it is.
TEST(Fade, ATextureWithoutLightIsLeftAsItIs) {
    RegionPlan region = plate_lit();
    region.light_source = LightSource::kNone;
    const std::vector<double> seen = levels(faded({1, 0.5f, 0.05f, 0}), region, 4);
    for (const double level : seen)
        EXPECT_NEAR(level, srgb_to_linear(0.5f), 0.005);
}

// White over the plate lies over the texture, too.
TEST(Fade, TheTextureGoesToWhiteWithThePlate) {
    MemoryShot shot = make_wall(false, false);
    const std::vector<float> white{0, 0.25f, 0.6f, 1};
    for (std::size_t k = 0; k < white.size(); ++k) {
        auto plate = std::make_shared<ImageF3>(*shot.plates.at(kFirst + static_cast<int>(k)));
        for (std::size_t i = 0; i < plate->size_bytes() / sizeof(float); ++i) {
            float& v = plate->data()[i];
            v = linear_to_srgb((1 - white[k]) * srgb_to_linear(v) + white[k]);
        }
        shot.plates[kFirst + static_cast<int>(k)] = plate;
    }
    const std::vector<double> seen = levels(shot, plate_lit(), 4);
    for (std::size_t k = 0; k < white.size(); ++k)
        EXPECT_NEAR(seen[k], (1 - white[k]) * seen[0] + white[k], 0.05) << k;
    EXPECT_EQ(seen[3], 1);
}

}  // namespace
}  // namespace weft
