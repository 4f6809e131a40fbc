// Edge tools of mattes: they change where the picture shows a region, and nothing that is analysed.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/compute/backend_registry.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_zones.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

class EdgedWall : public MemoryShot {
  public:
    explicit EdgedWall(bool disc = false) : MemoryShot(make_wall(disc)) {}
    [[nodiscard]] Expected<Matte> zone(int, int, int) const override { return box_matte(kZoneBox); }
};

// A shot that is analysed once, whatever edge tools its frames are rendered with.
class AnalysedOnce {
  public:
    AnalysedOnce(const MemoryShot& shot, const RegionPlan& region)
        : shot_(shot), plan_(make_plan(region)) {
        const Status status = analyse_shot(shot_, plan_, store_, {}, {});
        EXPECT_TRUE(status) << (status ? "" : status.error().text());
        auto scene = make_scene(shot_, plan_, store_, 0, {}, {});
        EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
        scenes_.push_back(std::move(*scene));
    }
    [[nodiscard]] RenderedFrame frame(int frame, const RegionPlan& region,
                                      bool layers = false) const {
        ShotPlan plan = make_plan(region);
        plan.layers = layers;
        auto out = render_frame(shot_, plan, scenes_, store_, *backend_, frame);
        EXPECT_TRUE(out) << (out ? "" : out.error().text());
        return out ? std::move(*out) : RenderedFrame{};
    }
    [[nodiscard]] const AnalysisStore& store() const { return store_; }

  private:
    const MemoryShot& shot_;
    ShotPlan plan_;
    MemoryAnalysisStore store_;
    std::vector<RegionScene> scenes_;
    std::shared_ptr<const Backend> backend_ = make_cpu_backend();
};

RegionPlan with_matte_edge(RegionPlan region, const MatteEdge& edge) {
    region.matte_edge.edge = edge;
    return region;
}

bool same_colour(const float* a, const float* b) {
    return std::equal(a, a + 3, b);
}

TEST(MatteEdges, AGrownMatteShowsTheTextureBeyondTheSurface) {
    const EdgedWall shot;
    const Vec3 colour(0.25f, 0.5f, 0.75f);
    const RegionPlan plain = make_region(flat_texture(colour));
    const AnalysedOnce shown(shot, plain);
    const RenderedFrame out = shown.frame(4, with_matte_edge(plain, {.choke_px = 10}));
    const Recti grown = kRegionBox.grown(9);
    for (int x = kRegionBox.x0; x < kRegionBox.x1; ++x) {
        for (const int y :
             {grown.y0, kRegionBox.y0 - 1, kRegionBox.y0, kRegionBox.y1, grown.y1 - 1})
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(out.pixels.at(x, y, c), colour[c], 1e-4f) << x << ' ' << y;
    }
    EXPECT_EQ(out.touched.at(60, kRegionBox.y0 - 12), 0);
}

TEST(MatteEdges, TheTextureGoesOnBeyondTheSurface) {
    const EdgedWall shot;
    const RegionPlan plain = make_region(sample_texture());
    const AnalysedOnce shown(shot, plain);
    const RenderedFrame out = shown.frame(7, with_matte_edge(plain, {.choke_px = 10}));
    // As varied in the rim as inside.
    const auto variance = [&](const Recti& box) {
        double sum = 0, squares = 0, n = 0;
        for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; ++x) {
                const auto v = static_cast<double>(out.pixels.at(x, y, 1));
                sum += v, squares += v * v, ++n;
            }
        }
        return squares / n - sum / n * sum / n;
    };
    const Recti rim{kRegionBox.x0, kRegionBox.y0 - 9, kRegionBox.x1, kRegionBox.y0 - 1};
    const Recti inside{kRegionBox.x0, kRegionBox.y0 + 8, kRegionBox.x1, kRegionBox.y1 - 8};
    EXPECT_GT(variance(rim), 0.3 * variance(inside));
    EXPECT_LT(variance(rim), 3 * variance(inside));
}

TEST(MatteEdges, AShrunkMatteLeavesThePlateAtItsRim) {
    const EdgedWall shot;
    const RegionPlan plain = make_region(flat_texture({0.25f, 0.5f, 0.75f}));
    const AnalysedOnce shown(shot, plain);
    const RenderedFrame out = shown.frame(4, with_matte_edge(plain, {.choke_px = -8}));
    const Recti left = kRegionBox.grown(-9);
    for (int y = 0; y < kShotSize.height; ++y) {
        for (int x = 0; x < kShotSize.width; ++x) {
            const int touched = out.touched.at(x, y);
            const bool same = same_colour(out.pixels.pixel(x, y), shot.plates.at(4)->pixel(x, y));
            ASSERT_TRUE(same || touched > 0) << x << ' ' << y;
            ASSERT_TRUE(touched == 0 || kRegionBox.grown(-7).contains(x, y)) << x << ' ' << y;
            ASSERT_TRUE(touched == 255 || !left.contains(x, y)) << x << ' ' << y;
        }
    }
}

TEST(MatteEdges, KeysAndLayersFollow) {
    const EdgedWall shot;
    RegionPlan region = make_region(flat_texture({0.25f, 0.5f, 0.75f}));
    const AnalysedOnce shown(shot, region);
    region.matte_edge.choke_keys = {{{1, {0}}, {5, {8}}}};
    const Recti first = matte_bounds(shown.frame(1, region).touched);
    EXPECT_EQ(first, kRegionBox);
    const RenderedFrame last = shown.frame(5, region, true);
    EXPECT_EQ(matte_bounds(last.touched), kRegionBox.grown(8));
    ASSERT_TRUE(last.layers);
    EXPECT_EQ(last.layers->alpha.at(60, kRegionBox.y0 - 5), 1.0f);
    const auto matte = shown_matte(shot, make_plan(region), shown.store(), 0, 3);
    ASSERT_TRUE(matte);
    EXPECT_EQ(matte_bounds(*matte), kRegionBox.grown(4));
}

TEST(MatteEdges, HoldoutsHaveTheirOwn) {
    const EdgedWall shot(true);
    RegionPlan region = make_region(flat_texture({0.25f, 0.5f, 0.75f}));
    region.has_holdout = true;
    const AnalysedOnce shown(shot, region);
    EXPECT_EQ(shown.frame(4, region).touched.at(62 + 18, 56), 255);
    EXPECT_TRUE(shows_as_followed(region, 4));
    region.given_holdout_edges.emplace_back().edge.choke_px = 6;
    EXPECT_FALSE(shows_as_followed(region, 4));
    const Matte touched = shown.frame(4, region).touched;
    EXPECT_EQ(touched.at(62 + 18, 56), 0) << "4 px beside the disc";
    EXPECT_EQ(touched.at(62 + 26, 56), 255);
}

TEST(MatteEdges, ZonesHaveTheirOwn) {
    const EdgedWall shot;
    RegionPlan region = make_region(flat_texture({1, 1, 1}));
    region.zones.emplace_back().value = 0;
    region.zones[0].edge.edge.choke_px = -5;
    const MemoryAnalysisStore store;
    const auto factor = zone_factor(shot, make_plan(region), store, 0, ZoneKind::kLight, 2);
    ASSERT_TRUE(factor);
    EXPECT_EQ(factor->at(60, 50), 0);
    EXPECT_EQ(factor->at(42, 50), 1);
}

}  // namespace
}  // namespace weft
