// Mattes drawn from a shape that follows a track: no file holds them.
#include "app/shot/drawn_mattes.h"

#include <fstream>

#include "app/exchange/track_file.h"
#include "app/shot/project_source.h"
#include "app/shot/shot.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::HasSubstr;

class Drawn : public ShotTest {
  protected:
    // A square on frame 1 that follows a point to the right.
    [[nodiscard]] KeyedShape shape() const {
        KeyedShape out;
        for (const Vec2 at : {Vec2{20, 20}, Vec2{40, 20}, Vec2{40, 40}, Vec2{20, 40}})
            out.keys[1].points.push_back({at, {0, 0}, {0, 0}, 0});
        out.follow = ShapeFollow::kPosition;
        out.track = in("point.txt");
        return out;
    }
    [[nodiscard]] Project project() const {
        Project out = spec("out").project;
        out.regions[0] = out.regions[0].with([&](Region& region) {
            MatteSource matte;
            matte.shape = shape();
            region.matte = matte;
        });
        return out;
    }
    void SetUp() override {
        ShotTest::SetUp();
        std::ofstream(in("point.txt")) << "1 50 50\n6 60 50\n";
    }
};

TEST_F(Drawn, MattesComeFromTheShapeOnEveryFrame) {
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_FALSE((*shot)->plan.regions[0].propagated());
    EXPECT_EQ((*shot)->plan.regions[0].reference_frames.front(), 1);
    for (int frame = 1; frame <= kFrames; ++frame) {
        const auto matte = (*shot)->source->matte(0, frame);
        ASSERT_TRUE(matte) << matte.error().text();
        const int left = 20 + 2 * (frame - 1);
        EXPECT_EQ(matte->at(left + 2, 30), 255) << frame;
        EXPECT_EQ(matte->at(left + 18, 30), 255) << frame;
        EXPECT_EQ(matte->at(left - 2, 30), 0) << frame;
        EXPECT_EQ(matte->at(left + 22, 30), 0) << frame;
    }
}

TEST_F(Drawn, HoldoutsAndZonesAreDrawnToo) {
    Project drawn = project();
    drawn.regions[0] = drawn.regions[0].with([&](Region& region) {
        MatteSource matte;
        matte.shape = shape();
        matte.select.invert = true;
        region.holdouts = std::vector<MatteSource>{matte};
        matte.select.invert = false;
        Zone zone;
        zone.value = 0.5;
        zone.matte = matte;
        region.zones = std::vector<Zone>{zone};
    });
    const auto shot = open_shot(drawn);
    ASSERT_TRUE(shot) << shot.error().text();
    const auto holdout = (*shot)->source->holdout(0, 1);
    ASSERT_TRUE(holdout && *holdout);
    EXPECT_EQ((*holdout)->at(30, 30), 0);
    EXPECT_EQ((*holdout)->at(5, 5), 255);
    const auto zone = (*shot)->source->zone(0, 0, 6);
    ASSERT_TRUE(zone) << zone.error().text();
    EXPECT_EQ(zone->at(45, 30), 255);
}

TEST_F(Drawn, AProjectWithOneRendersWithoutTheEditor) {
    JobSpec job = spec("out");
    job.project = project();
    job.project.output = spec("out").project.output;
    const auto done = run_job(job, {}, {});
    ASSERT_TRUE(done) << done.error().text();
    // The same mattes from files give the same pixels; the recipes in the headers differ.
    const DrawnMattes drawn((*open_shot(project()))->plate->size(), 1);
    JobSpec files = spec("files");
    for (int frame = 1; frame <= kFrames; ++frame) {
        const auto matte = drawn.matte(shape(), false, frame);
        ASSERT_TRUE(matte);
        const std::string number = std::to_string(frame);
        std::filesystem::create_directories(in("drawn"));
        ASSERT_TRUE(write_matte(in("drawn/000" + number + ".png"), *matte, WriteRule::own()));
    }
    files.project.regions[0] = files.project.regions[0].with([&](Region& region) {
        MatteSource matte;
        matte.files = in("drawn/####.png");
        region.matte = matte;
        region.reference_frames = {1};
    });
    ASSERT_TRUE(run_job(files, {}, {}));
    for (int frame = 1; frame <= kFrames; ++frame) {
        const std::string name = "/000" + std::to_string(frame) + ".png";
        const auto here = read_image(in("out" + name)), there = read_image(in("files" + name));
        ASSERT_TRUE(here && there) << frame;
        EXPECT_TRUE(here->rgb == there->rgb) << frame;
    }
}

TEST_F(Drawn, ATrackThatIsMissingOrWrongIsSaidBeforeAnyWork) {
    std::ofstream(in("point.txt")) << "1 50\n";
    auto shot = open_shot(project());
    ASSERT_FALSE(shot);
    EXPECT_EQ(shot.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(shot.error().text(), HasSubstr("three for a point"));
    std::filesystem::remove(in("point.txt"));
    shot = open_shot(project());
    ASSERT_FALSE(shot);
    EXPECT_THAT(shot.error().text(), HasSubstr("point.txt"));
    Project none = project();
    none.regions[0] = none.regions[0].with([&](Region& region) {
        region.matte = region.matte.with([](MatteSource& m) { m.shape.track.clear(); });
    });
    shot = open_shot(none);
    ASSERT_FALSE(shot);
    EXPECT_EQ(shot.error().code, ErrorCode::kUsage);
    EXPECT_THAT(shot.error().text(), HasSubstr("none is set"));
}

TEST_F(Drawn, TheEditorsShapeIsKnownWithoutReading) {
    const DrawnMattes drawn({100, 80}, 1);
    EXPECT_FALSE(drawn.known_shape(shape(), 6)) << "its track has not been read";
    ASSERT_TRUE(drawn.matte(shape(), false, 6));
    const auto known = drawn.known_shape(shape(), 6);
    ASSERT_TRUE(known);
    EXPECT_NEAR(known->points[0].at.x, 30, 1e-3);
    EXPECT_EQ(drawn.shape(shape(), 6).value(), *known);
}

TEST_F(Drawn, ATrackIsWrittenAndReadBack) {
    const CornerTrack track{{1, {{{0, 0}, {10, 0}, {10, 10.25}, {0, 10}}}},
                            {2, {{{1, 0}, {11, 0}, {11, 10}, {1, 10}}}}};
    ASSERT_TRUE(write_corner_track(in("t.json"), track, WriteRule::own()));
    const auto again = read_corner_track(in("t.json"), {{100, 80}, 1});
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(*again, track);
}

TEST(ShapeHash, TellsShapesApart) {
    KeyedShape shape;
    shape.keys[1].points.resize(3);
    const auto hash = [&] {
        Hasher hasher;
        add_shape(hasher, shape);
        return hasher.finish();
    };
    const Hash128 before = hash();
    EXPECT_EQ(before, hash());
    shape.keys[1].points[1].feather_px = 1;
    EXPECT_NE(before, hash());
}

}  // namespace
}  // namespace weft::test
