// A grid warp in the picture: nothing at rest, the texture where the points are put, on every frame
// where the surface has moved, filtered by its own scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "engine/compute/backend_registry.h"
#include "engine/core/parallel.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

const Quad<double> kBox{glm::dvec2(20, 16), glm::dvec2(140, 16), glm::dvec2(140, 96),
                        glm::dvec2(20, 96)};

// A plane, one texel a pixel, with the same value in each column.
std::shared_ptr<const TexturePicture> columns(const std::function<float(int)>& value) {
    auto texture = std::make_shared<TexturePicture>();
    texture->is_plane = true;
    texture->wrap = WrapMode::kClamp;
    texture->pixels = ImageF3(kShotSize);
    for (int y = 0; y < kShotSize.height; ++y)
        for (int x = 0; x < kShotSize.width; ++x)
            std::fill_n(texture->pixels.pixel(x, y), 3, value(x));
    return texture;
}

std::shared_ptr<const TexturePicture> halves() {
    return columns([](int x) { return x < kShotSize.width / 2 ? 0.0f : 1.0f; });
}

ImageF3 rendered_warped(const MemoryShot& shot, RegionPlan region, std::optional<GridWarp> warp,
                        int frame) {
    if (warp) {
        EXPECT_TRUE(check_grid_warp(*warp));
        region.placement.warp = std::make_shared<const PlaneWarp>(*warp, frame);
        region.warp = std::move(warp);
    }
    const ShotPlan plan = make_plan(region, 1, 8);
    MemoryAnalysisStore store;
    EXPECT_TRUE(analyse_shot(shot, plan, store, {}, {}));
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    EXPECT_TRUE(scene);
    std::vector<RegionScene> scenes;
    scenes.push_back(std::move(*scene));
    auto out = render_frame(shot, plan, scenes, store, *make_cpu_backend(), frame);
    EXPECT_TRUE(out);
    return std::move(out->pixels);
}

bool same_bytes(const ImageF3& a, const ImageF3& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

// Where the texture turns from dark to bright in a row.
int edge_in(const ImageF3& picture, int y) {
    for (int x = 24; x < 138; ++x)
        if (picture.at(x, y, 0) > 0.5f) return x;
    return -1;
}

GridWarp middle_moved(double by) {
    GridWarp warp = grid_over(kBox, 2, 2);
    warp.points[4].at.x += by;
    return warp;
}

TEST(GridWarpInThePicture, AtRestEveryByteStays) {
    const MemoryShot shot = make_wall();
    const ImageF3 before = rendered_warped(shot, make_region(halves()), std::nullopt, 3);
    EXPECT_TRUE(
        same_bytes(before, rendered_warped(shot, make_region(halves()), grid_over(kBox, 3, 2), 3)));
    const Quad<double> deep{glm::dvec2(20, 16), glm::dvec2(140, 30), glm::dvec2(130, 80),
                            glm::dvec2(24, 96)};
    EXPECT_TRUE(
        same_bytes(before, rendered_warped(shot, make_region(halves()), grid_over(deep, 3, 2), 3)));
}

TEST(GridWarpInThePicture, TheTextureLiesWhereThePointIsPut) {
    const MemoryShot shot = make_wall(false, false);
    const ImageF3 out = rendered_warped(shot, make_region(halves()), middle_moved(12), 2);
    EXPECT_NEAR(edge_in(out, 56), 92, 1);
    EXPECT_NEAR(edge_in(out, 18), 80, 1);
}

TEST(GridWarpInThePicture, ItSticksToTheSurface) {
    const MemoryShot shot = make_wall();
    const ImageF3 first = rendered_warped(shot, make_region(halves()), middle_moved(12), 1);
    const ImageF3 later = rendered_warped(shot, make_region(halves()), middle_moved(12), 8);
    const Vec2 moved = wall_moved({0, 0}, 8) - wall_moved({0, 0}, 1);
    EXPECT_NEAR(edge_in(later, 56 + static_cast<int>(moved.y)),
                edge_in(first, 56) + static_cast<int>(moved.x), 1.5);
}

TEST(GridWarpInThePicture, KeysMoveItOverTime) {
    const MemoryShot shot = make_wall(false, false);
    GridWarp warp = grid_over(kBox, 2, 2);
    set_key(warp, 2, warp.points);
    set_key(warp, 6, middle_moved(16).points);
    EXPECT_NEAR(edge_in(rendered_warped(shot, make_region(halves()), warp, 1), 56), 80, 1);
    EXPECT_NEAR(edge_in(rendered_warped(shot, make_region(halves()), warp, 4), 56), 88, 1);
    EXPECT_NEAR(edge_in(rendered_warped(shot, make_region(halves()), warp, 7), 56), 96, 1);
}

// Stripes of two texels squeezed to a third: far beyond what the pixels can show. Looked up without
// a filter they would have their whole contrast, 1.
TEST(GridWarpInThePicture, ItsOwnScaleIsFiltered) {
    const MemoryShot shot = make_wall(false, false);
    const auto stripes = columns([](int x) { return x % 2 == 0 ? 0.0f : 1.0f; });
    GridWarp warp = grid_over(kBox, 1, 1);
    for (WarpPoint& point : warp.points)
        point.at.x = 80 + (point.at.x - 80) / 3;
    const ImageF3 out = rendered_warped(shot, make_region(stripes), warp, 2);
    float low = 1, high = 0;
    for (int x = 66; x < 94; ++x) {
        low = std::min(low, out.at(x, 56, 0));
        high = std::max(high, out.at(x, 56, 0));
    }
    EXPECT_LT(high - low, 0.2f);
    EXPECT_GT(low, 0.2f);
    EXPECT_LT(high, 0.85f);
}

TEST(GridWarpInThePicture, IsTheSameForAnyNumberOfThreads) {
    const MemoryShot shot = make_wall();
    set_thread_count(1);
    const ImageF3 one = rendered_warped(shot, make_region(halves()), middle_moved(12), 4);
    set_thread_count(4);
    const ImageF3 four = rendered_warped(shot, make_region(halves()), middle_moved(12), 4);
    set_thread_count(0);
    EXPECT_TRUE(same_bytes(one, four));
}

}  // namespace
}  // namespace weft
