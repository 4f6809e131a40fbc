// Animated values, proxies of a shot, and provenance.
#include "app/preview/proxy_shot.h"
#include "app/textures/patch_pick.h"
#include "app/textures/provenance.h"
#include "tests/ui/ui_harness.h"
#include "ui/canvas/view_map.h"

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(Proxy, AFieldOfMotionIsTheSameButSmaller) {
    LatticeField field({101, 75}, 8);
    for (int j = 0; j < field.nodes().height(); ++j)
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, {static_cast<float>(i * i) * 0.3f, static_cast<float>(j) * -1.5f});
    for (const int factor : {2, 4, 8}) {
        const LatticeField small = shrunk(field, factor);
        const auto by = static_cast<float>(factor);
        for (const Vec2 p : {Vec2(3, 5), Vec2(50.5f, 30), Vec2(99, 70)}) {
            const Vec2 full = field.at(p), here = small.at(p / by);
            EXPECT_NEAR(here.x * by, full.x, 1e-3f);
            EXPECT_NEAR(here.y * by, full.y, 1e-3f);
        }
    }
}

TEST(Proxy, BlocksAreMeansAndTheLastOnesMayBeSmaller) {
    ImageF3 picture(5, 3, 0.0f);
    picture.pixel(4, 2)[0] = 1;
    picture.pixel(0, 0)[1] = 1;
    const ImageF3 small = shrunk(picture, 2);
    ASSERT_EQ(small.size(), (Size{3, 2}));
    EXPECT_FLOAT_EQ(small.pixel(2, 1)[0], 1);
    EXPECT_FLOAT_EQ(small.pixel(0, 0)[1], 0.25f);
}

TEST(Proxy, OnlyLargePlatesAreShrunk) {
    EXPECT_EQ(proxy_factor({960, 540}, 640'000), 1);
    EXPECT_EQ(proxy_factor({1920, 1080}, 640'000), 2);
    EXPECT_EQ(proxy_factor({3840, 2160}, 640'000), 4);
}

TEST(Provenance, NamesThePlaceInTheSampleTheSeamAndTheLight) {
    auto plane = std::make_shared<PlaneMap>();
    plane->source = Image<std::int32_t, 2>(8, 8);
    plane->energy = Matte(8, 8);
    plane->source.pixel(2, 3)[0] = 41;
    plane->source.pixel(2, 3)[1] = 77;
    plane->energy.at(2, 3) = 60;
    Provenance from;
    from.ref_from_cur = LatticeField({32, 32}, 8);
    from.plane = plane;
    from.texture = "brick.png";
    from.shading = Shading{ImageF1(16, 16, 0.5f), 2, {32, 32}, {}};
    from.reference_shading = 0.25f;
    // The plane repeats every 8 texels.
    const Provenance::Answer found = from.at({10.5f, 19.5f});
    ASSERT_TRUE(found.in_sample);
    EXPECT_EQ(found.in_sample->x, 41);
    EXPECT_EQ(found.in_sample->y, 77);
    EXPECT_EQ(found.seam, 12);
    EXPECT_FLOAT_EQ(found.light.value_or(0), 2);
    EXPECT_FALSE(from.at({12.5f, 19.5f}).seam);
}

// A plane of 8 × 8 texels: the left half shows one place of the sample, the right half another.
std::shared_ptr<PlaneMap> two_patches() {
    auto plane = std::make_shared<PlaneMap>();
    plane->source = Image<std::int32_t, 2>(8, 8);
    plane->energy = Matte(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            plane->source.pixel(x, y)[0] = x < 4 ? x : 100 + x;
            plane->source.pixel(x, y)[1] = x < 4 ? y : 40 + y;
        }
    return plane;
}

TEST(Provenance, PatchesAreNumberedInTheOrderOfTheRows) {
    const auto plane = two_patches();
    const auto patch = number_patches(*plane);
    EXPECT_EQ(patch.at(0, 0), 1);
    EXPECT_EQ(patch.at(3, 7), 1);
    EXPECT_EQ(patch.at(4, 0), 2);
    EXPECT_EQ(patch.at(7, 7), 2);
}

TEST(Provenance, TheSeamDecidesBetweenTwoTracks) {
    Provenance from;
    from.ref_from_cur = LatticeField({32, 32}, 8);
    from.plane = two_patches();
    from.frame = 5;
    from.two = TwoTracks{1, 9, 0.25f, {}};
    auto found = from.at({1.5f, 1.5f});
    ASSERT_THAT(found.tracks, SizeIs(2));
    EXPECT_EQ(found.tracks[0].frame, 1);
    EXPECT_FLOAT_EQ(found.tracks[0].weight, 0.75f);
    EXPECT_EQ(found.tracks[1].frame, 9);
    EXPECT_FLOAT_EQ(found.tracks[1].weight, 0.25f);
    // With a seam, each side shows its own track.
    TwoTracks::Seam seam;
    seam.before = LatticeField({32, 32}, 8);
    seam.after = LatticeField({32, 32}, 8);
    for (int j = 0; j < seam.after.nodes().height(); ++j)
        for (int i = 0; i < seam.after.nodes().width(); ++i)
            seam.after.set_node(i, j, {4, 0});
    Image<std::uint8_t, 1> after(8, 8, 0);
    for (int y = 0; y < 8; ++y)
        for (int x = 4; x < 8; ++x)
            after.at(x, y) = 1;
    seam.labels = {4, 6, 4, {0, 0}, {after}};
    from.two->seam = std::move(seam);
    found = from.at({2.5f, 16.5f});
    ASSERT_THAT(found.tracks, SizeIs(1));
    EXPECT_EQ(found.tracks[0].frame, 1);
    EXPECT_EQ(found.in_sample->x, 2);
    found = from.at({26.5f, 16.5f});
    ASSERT_THAT(found.tracks, SizeIs(1));
    EXPECT_EQ(found.tracks[0].frame, 9);
    EXPECT_EQ(found.in_sample->x, 106);
}

TEST(Provenance, ThePaperModeTracksWhatIsNotFresh) {
    Provenance from;
    from.ref_from_cur = LatticeField({32, 32}, 8);
    from.temporal = TemporalMode::kPaper;
    from.fresh = 0.25f;
    from.frame = 5;
    from.track_frame = 9;
    auto found = from.at({1.5f, 1.5f});
    ASSERT_THAT(found.tracks, SizeIs(1));
    EXPECT_EQ(found.tracks[0].frame, 6);
    EXPECT_FLOAT_EQ(found.tracks[0].weight, 0.75f);
    EXPECT_FLOAT_EQ(found.made_anew, 0.25f);
    from.frame = 9;
    found = from.at({1.5f, 1.5f});
    EXPECT_THAT(found.tracks, SizeIs(0));
    EXPECT_FLOAT_EQ(found.made_anew, 1);
}

TEST_F(PanelTest, ThePixelUnderTheMouseIsReadOut) {
    auto from = std::make_shared<Provenance>();
    from->ref_from_cur = LatticeField({320, 180}, 8);
    auto plane = two_patches();
    plane->patch = number_patches(*plane);
    from->plane = plane;
    from->texture = "brick.png";
    from->texture_id = "0123456789ab";
    from->reference_frame = from->track_frame = 1001;
    from->frame = 1003;
    auto over = std::make_shared<OverlayPicture>();
    over->kind = Overlay::kSourceMap;
    over->frame = 1003;
    over->value = Matte(view.plate.size);
    over->where = Matte(view.plate.size, 255);
    over->provenance = from;
    view.overlay = Overlay::kSourceMap;
    view.overlay_picture = over;
    robot->frames(3);
    const DrawnItem* canvas = robot->find("Viewer/Canvas");
    ASSERT_NE(canvas, nullptr);
    const ViewerState& viewer = shell->state().viewer;
    const ViewMap map{canvas->min, canvas->max, viewer.center, viewer.zoom};
    robot->move(map.to_screen({46.5f, 35.5f}));  // 46 % 8 = 6, 35 % 8 = 3
    robot->frames(2);
    EXPECT_THAT(viewer.provenance,
                ElementsAre("brick.png", "Texture 0123456789ab", "Patch 2, sample at 106, 43",
                            "Inside a patch", "From 46, 35 on frame 1001",
                            "Track from frame 1001, weight 1.00"));
    // A seam has the numbers of the patches that it joins.
    plane->energy.at(4, 3) = 60;
    robot->move(map.to_screen({44.5f, 35.5f}));
    robot->frames(2);
    ASSERT_THAT(viewer.provenance, SizeIs(6));
    EXPECT_EQ(viewer.provenance[3], "Seam 1|2, difference 12");
    // Outside the surface there is no provenance.
    robot->move({canvas->min.x + 2, canvas->min.y + 2});
    robot->frames(2);
    EXPECT_THAT(viewer.provenance, SizeIs(0));
}

TEST_F(PanelTest, AKeyframeIsSetAndRemoved) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    clear();
    ASSERT_TRUE(robot->click("Key Scale"));
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    const auto* set = std::get_if<SetRegionParameter>(&edits[0].edit);
    ASSERT_NE(set, nullptr);
    EXPECT_EQ(set->key, "placement.scale_keys");
    EXPECT_EQ(std::get<KeyedNumbers>(set->value), *parse_keyed_numbers("1003:1"));
    view.project.regions[0] =
        view.project.regions[0].with([](Region& r) { r.placement.scale_keys.set(1003, {1}); });
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Unkey Scale"));
    const auto after = emitted<DoEdit>();
    ASSERT_THAT(after, SizeIs(1));
    EXPECT_TRUE(std::get<KeyedNumbers>(std::get<SetRegionParameter>(after[0].edit).value).empty());
}

TEST_F(PanelTest, AKeyedSliderChangesTheKeyOfThisFrame) {
    view.project.regions[0] = view.project.regions[0].with(
        [](Region& r) { r.placement.scale_keys = *parse_keyed_numbers("1001:1 1005:3"); });
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    clear();
    ASSERT_TRUE(robot->drag("Placement/Scale", {30, 0}));
    const auto edits = emitted<DoEdit>();
    ASSERT_THAT(edits, SizeIs(1));
    const auto& set = std::get<SetRegionParameter>(edits[0].edit);
    EXPECT_EQ(set.key, "placement.scale_keys");
    const auto& keys = std::get<KeyedNumbers>(set.value);
    ASSERT_TRUE(keys.has(1003));
    EXPECT_GT(keys.at(1003)[0], 2);
    EXPECT_THAT(keys.at(1001), ElementsAre(1));
}

TEST_F(PanelTest, CornersInPerspectiveAreDraggedOnTheCanvas) {
    view.project.regions[0] = view.project.regions[0].with([](Region& r) {
        r.placement.corners_px = {{{80, 40}, {240, 40}, {240, 140}, {80, 140}}};
    });
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    robot->key("R");
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->drag("Handle corner 2", {20, 0}));
    const auto edits = emitted<DoEdit>();
    ASSERT_FALSE(edits.empty());
    const auto& set = std::get<SetRegionParameter>(edits.back().edit);
    EXPECT_EQ(set.key, "placement.corners_px");
    const auto& numbers = std::get<std::vector<double>>(set.value);
    ASSERT_THAT(numbers, SizeIs(8));
    EXPECT_GT(numbers[2], 241);
    EXPECT_NEAR(numbers[0], 80, 0.01);
}

TEST_F(PanelTest, AReferenceLineSetsTheScale) {
    robot->frames(2);
    ASSERT_TRUE(robot->click("Top/Texture"));
    ASSERT_TRUE(robot->click("Scale by reference line"));
    robot->frames(2);
    const DrawnItem* canvas = robot->find("Viewer/Canvas");
    const ImVec2 middle((canvas->min.x + canvas->max.x) / 2, (canvas->min.y + canvas->max.y) / 2);
    robot->stroke({middle, {middle.x + 40, middle.y}, {middle.x + 80, middle.y}});
    robot->frames(2);
    clear();
    ASSERT_TRUE(robot->click("Scale to fit"));
    ASSERT_THAT(emitted<ScaleByLine>(), SizeIs(1));
    const ScaleByLine line = emitted<ScaleByLine>()[0];
    EXPECT_GT(line.to.x, line.from.x + 10);
    EXPECT_DOUBLE_EQ(line.count, 4);
}

}  // namespace
}  // namespace weft::test
