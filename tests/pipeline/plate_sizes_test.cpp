// What a surface is, and how it moves, must not depend on the size in which its plate is delivered.
#include <gtest/gtest.h>

#include <vector>

#include "engine/motion/follow_size.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr Size kSmallest{640, 360};
constexpr Recti kSurface{120, 70, 520, 300};
constexpr int kFrames = 3;
constexpr Vec2 kStep_px{2.4f, -1.1f};

// A faint wall under grain: seen pixel by pixel, nearly a flat fill.
Matte wall_frame(int t, float contrast, float grain_levels) {
    static const WaveTexture texture(17);
    Rng rng(70 + static_cast<std::uint64_t>(t));
    return draw(kSmallest, [&](Vec2 p) {
        const float value = texture(p - static_cast<float>(t) * kStep_px) - 0.5f;
        const auto grain = static_cast<float>(rng.uniform() + rng.uniform() - 1);
        return 0.5f + contrast * value + grain_levels / 255 * grain;
    });
}

// The same picture in another size, bilinear: soft, as large plates are.
std::shared_ptr<const ImageF3> enlarged(const Matte& small, Size to) {
    auto out = std::make_shared<ImageF3>(to);
    const auto place = [](int at, int from, int count, int& cell, float& f) {
        const float g =
            (static_cast<float>(at) + 0.5f) * static_cast<float>(from) / static_cast<float>(count) -
            0.5f;
        const float inside = std::clamp(g, 0.0f, static_cast<float>(from - 1));
        cell = std::min(static_cast<int>(inside), from - 2);
        f = inside - static_cast<float>(cell);
    };
    for (int y = 0; y < to.height; ++y) {
        int iy = 0, ix = 0;
        float fy = 0, fx = 0;
        place(y, small.height(), to.height, iy, fy);
        for (int x = 0; x < to.width; ++x) {
            place(x, small.width(), to.width, ix, fx);
            const auto at = [&](int dx, int dy) {
                return static_cast<float>(small.at(ix + dx, iy + dy)) / 255;
            };
            const float top = at(0, 0) + fx * (at(1, 0) - at(0, 0));
            const float low = at(0, 1) + fx * (at(1, 1) - at(0, 1));
            std::fill_n(out->pixel(x, y), 3, top + fy * (low - top));
        }
    }
    return out;
}

MemoryShot shot_of(Size size, float contrast, float grain_levels) {
    MemoryShot shot(size);
    const auto scaled = [](int v, int to, int from) { return v * to / from; };
    for (int t = 0; t < kFrames; ++t) {
        shot.plates[t] = enlarged(wall_frame(t, contrast, grain_levels), size);
        Matte matte(size);
        for (int y = scaled(kSurface.y0, size.height, kSmallest.height);
             y < scaled(kSurface.y1, size.height, kSmallest.height); ++y) {
            std::fill(matte.row(y) + scaled(kSurface.x0, size.width, kSmallest.width),
                      matte.row(y) + scaled(kSurface.x1, size.width, kSmallest.width), 255);
        }
        shot.mattes[{0, t}] = std::move(matte);
    }
    return shot;
}

// Where places of the surface lay on the first frame, in pixels of the smallest plate.
std::vector<Vec2> followed(Size size, FlowQuality quality, float contrast, float grain_levels) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.reference_frames = {0};
    ShotPlan plan = make_plan(std::move(region), 0, kFrames - 1);
    plan.quality = quality;
    MemoryAnalysisStore store;
    const Status done = analyse_shot(shot_of(size, contrast, grain_levels), plan, store, {}, {});
    EXPECT_TRUE(done) << (done ? "" : done.error().text());
    const LatticeField field = stored_coords(store, kFrames - 1);
    EXPECT_EQ(field.full_size(), size);
    const float scale = static_cast<float>(size.width) / static_cast<float>(kSmallest.width);
    std::vector<Vec2> places;
    for (const Vec2 p : {Vec2(160, 110), Vec2(320, 180), Vec2(480, 260), Vec2(200, 250)})
        places.push_back(p + field.at(scale * p) / scale);
    return places;
}

class PlateSizes : public testing::TestWithParam<FlowQuality> {};

TEST_P(PlateSizes, FollowTheSameMotion) {
    for (const auto& [contrast, grain_levels] : {std::pair(0.8f, 1.0f), std::pair(0.06f, 0.8f)}) {
        const auto smallest = followed(kSmallest, GetParam(), contrast, grain_levels);
        const float gone = kFrames - 1;
        EXPECT_LT(distance(smallest[1], Vec2(320, 180) - gone * kStep_px), 0.3f) << contrast;
        for (const Size size :
             {Size{960, 540}, Size{1280, 720}, Size{1920, 1080}, Size{2560, 1440}}) {
            const auto places = followed(size, GetParam(), contrast, grain_levels);
            for (std::size_t k = 0; k < places.size(); ++k)
                EXPECT_LT(distance(places[k], smallest[k]), 0.1f) << size.width << " " << contrast;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Qualities, PlateSizes,
                         testing::Values(FlowQuality::kDraft, FlowQuality::kFinal),
                         [](const auto& of) {
                             return of.param == FlowQuality::kDraft ? "Draft" : "Final";
                         });

}  // namespace
}  // namespace weft
