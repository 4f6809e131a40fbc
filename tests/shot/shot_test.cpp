// A project opened: its frames, its files, its plan.
#include "app/shot/shot.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/exchange/region_matte_sources.h"
#include "app/shot/frame_plan.h"
#include "app/shot/matte_channel.h"
#include "app/shot/missing_frames.h"
#include "app/shot/project_source.h"
#include "app/shot/scene_cuts.h"
#include "app/shot/shot_inputs.h"
#include "app/shot/texture_file.h"
#include "app/shot/trimmed_frames.h"
#include "engine/media/frame_writer.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OpenShot : public ShotTest {
  protected:
    [[nodiscard]] Project project() const { return spec("out").project; }
};

TEST_F(OpenShot, TurnsTheProjectIntoAPlan) {
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_EQ((*shot)->plan.regions.size(), 1u);
    EXPECT_THAT((*shot)->region_index, ElementsAre(0u));
    ASSERT_EQ((*shot)->textures.size(), 1u);
    EXPECT_TRUE((*shot)->textures[0].is_plane);
    EXPECT_EQ((*shot)->textures[0].size, (Size{128, 128}));
    EXPECT_EQ(output_depth(Output{}, PixelDepth::kU8), PixelDepth::kU8);
}

TEST_F(OpenShot, NamesTheFrameThatIsMissing) {
    std::filesystem::remove(in("masks/0004.png"));
    const auto shot = open_shot(project());
    ASSERT_FALSE(shot);
    EXPECT_EQ(shot.error().code, ErrorCode::kMissingFrames);
    EXPECT_THAT(shot.error().text(), HasSubstr("4"));
    Project other = project();
    other.settings.frames = "40";
    EXPECT_EQ(open_shot(other).error().code, ErrorCode::kMissingFrames);
}

TEST_F(OpenShot, TheFramesAreTheListOrAllOfThePlate) {
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot);
    EXPECT_THAT(*frames_to_render(project(), *(*shot)->plate), ElementsAre(1, 2, 3, 4, 5, 6));
    Project some = project();
    some.settings.frames = "1-5x2";
    EXPECT_THAT(*frames_to_render(some, *(*shot)->plate), ElementsAre(1, 3, 5));
    some.settings.frames = "five";
    EXPECT_EQ(frames_to_render(some, *(*shot)->plate).error().code, ErrorCode::kUsage);
    EXPECT_EQ(frames_text({4, 5, 6, 12}), "frames 4-6,12");
}

// Editorial trims a shot; what was set for the frames that are gone waits for them.
TEST_F(OpenShot, WhatIsSetBeyondATrimmedPlateIsLeftOut) {
    const auto painted_on = [&](std::vector<int> frames) {
        Project trimmed = project();
        trimmed.regions[0] = trimmed.regions[0].with([&](Region& region) {
            MatteSource matte;
            for (const int frame : frames)
                matte.keyframes[frame] = {in("masks/0003.png"), {}};
            region.matte = std::move(matte);
            region.reference_frames = {3, 8};
        });
        return open_shot(trimmed);
    };
    const auto shot = painted_on({-1, 3, 9});
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_THAT((*shot)->plan.regions[0].matte_keys, ElementsAre(3));
    EXPECT_THAT((*shot)->plan.regions[0].reference_frames, ElementsAre(3));
    EXPECT_THAT((*shot)->warnings, Contains(HasSubstr("-1,8-9 is left out")));
    EXPECT_EQ(painted_on({-1, 9}).error().code, ErrorCode::kMissingFrames);
}

TEST(ShotTexture, ATransparentOneGivesAWarning) {
    ImageF1 alpha(Size{4, 4}, 1.0f);
    EXPECT_EQ(transparency_warning("t.png", alpha), "");
    EXPECT_EQ(transparency_warning("t.png", {}), "");
    alpha.at(2, 1) = 0;
    EXPECT_THAT(transparency_warning("t.png", alpha), HasSubstr("transparent in 1 pixel"));
}

// The element fills frame 1, where its alpha is opaque everywhere.
TEST_F(OpenShot, MattesOfASequenceHaveOneChannel) {
    std::filesystem::create_directory(in("rgba"));
    ImageF1 alpha(Size{4, 4}, 1.0f);
    for (const char* name : {"rgba/0001.png", "rgba/0002.png"}) {
        const auto written = write_image(in(name), ImageF3(Size{4, 4}, 0.0f), alpha, {});
        ASSERT_TRUE(written) << written.error().text();
        alpha.at(2, 1) = 0;
    }
    Region region;
    MatteSource files;
    files.files = in("rgba/####.png");
    region.matte = files;
    region.holdouts = std::vector<MatteSource>{files};
    ASSERT_TRUE(choose_matte_channels(region, {1, 2}));
    ASSERT_EQ(matte_sources(region).size(), 2u);
    for (const MatteSource* matte : matte_sources(region))
        EXPECT_EQ(matte->select.channel, "A");
}

TEST_F(OpenShot, WhatIsNoMatteIsRefusedUnlessItsChannelIsNamed) {
    ImageF3 colours(Size{4, 4}, 0.0f);
    colours.at(1, 1, 0) = colours.at(2, 2, 1) = 1;
    ASSERT_TRUE(write_image(in("rgb.png"), colours, {}, {}));
    const auto warnings_of = [&](const MatteSource& matte) {
        Region region;
        region.holdouts = std::vector<MatteSource>{matte};
        return choose_matte_channels(region, {1});
    };
    MatteSource matte;
    matte.files = in("rgb.png");
    const auto refused = warnings_of(matte);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(refused.error().text(), HasSubstr("rgb.png has colours"));
    matte.select.channel = "R";
    EXPECT_THAT(warnings_of(matte).value(), IsEmpty());
    MatteSource painted;
    painted.keyframes[1].path = in("rgb.png");
    EXPECT_FALSE(warnings_of(painted));
    ASSERT_TRUE(write_image(in("levels.png"), ImageF3(Size{4, 4}, 0.1f), {}, {}));
    MatteSource faint;
    faint.files = in("levels.png");
    EXPECT_FALSE(warnings_of(faint)) << "below an eighth";
    ASSERT_TRUE(write_image(in("grey.png"), ImageF3(Size{4, 4}, 0.4f), {}, {}));
    faint.files = in("grey.png");
    EXPECT_THAT(warnings_of(faint).value(), ElementsAre(HasSubstr("by more than 40 %")));
}

// A renderer's file begins with the picture; its depth is in a channel of its own.
TEST_F(OpenShot, TheDepthOfARenderIsItsDepthChannel) {
    const ImageF3 plate = card_plate(0);
    const Size size = plate.size();
    OIIO::ImageSpec spec(size.width, size.height, 4, OIIO::TypeFloat);
    spec.channelnames = {"R", "G", "B", "ViewLayer.Depth.Z"};
    std::vector<float> data;
    for (int i = 0; i < size.width * size.height; ++i)
        data.insert(data.end(), {0.8f, 0.1f, 0.1f, 4.0f});
    auto output = OIIO::ImageOutput::create(in("depth.exr"));
    ASSERT_TRUE(output->open(in("depth.exr"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());
    Project with_depth = project();
    with_depth.regions[0] =
        with_depth.regions[0].with([&](Region& region) { region.finish.depth = in("depth.exr"); });
    const auto shot = open_shot(with_depth);
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_FLOAT_EQ((*shot)->source->depth(0, 1).value().at(3, 3), 0.25f);
}

TEST_F(OpenShot, AGapIsHeldAndSaysWhichFrameIsShown) {
    std::filesystem::remove(in("frames/0003.png"));
    Project holding = project();
    holding.plate.missing = MissingFrames::kHold;
    const auto shot = open_shot(holding);
    ASSERT_TRUE(shot) << shot.error().text();
    const auto held = with_missing_frames((*shot)->plate, MissingFrames::kHold, {});
    EXPECT_EQ(held->shown_frame(3), 2);
    EXPECT_EQ(held->shown_frame(4), 4);
    EXPECT_EQ(held->read(3)->rgb, held->read(2)->rgb);
}

TEST_F(OpenShot, TheSourceReadsPlateAndMatte) {
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot);
    const auto cuts = std::make_shared<CutWatch>();
    const auto source = make_project_source((*shot)->plate, (*shot)->project.regions, cuts);
    ASSERT_NE(source, nullptr);
    const auto plate = source->plate(2);
    ASSERT_TRUE(plate) << plate.error().text();
    EXPECT_EQ((*plate)->size(), Card::kPlate);
}

TEST_F(OpenShot, ListsEveryFileThatItIsMadeFrom) {
    const auto shot = open_shot(project());
    ASSERT_TRUE(shot);
    const auto files = input_files(**shot);
    ASSERT_TRUE(files) << files.error().text();
    std::vector<std::string> expected;
    for (const char* folder : {"frames", "masks"})
        for (int frame = 1; frame <= kFrames; ++frame)
            expected.push_back(in(std::string(folder) + "/000" + std::to_string(frame) + ".png"));
    expected.push_back(in("tile.png"));
    EXPECT_EQ(*files, expected);
    std::filesystem::remove(in("masks/0006.png"));
    expected.erase(std::find(expected.begin(), expected.end(), in("masks/0006.png")));
    EXPECT_EQ(*input_files(**shot), expected);
}

TEST(CutWatch, SeesAnotherSceneAndNoSlowChange) {
    CutWatch watch;
    for (int frame = 1; frame <= 8; ++frame) {
        ImageF3 picture = pattern_picture(Card::kPlate, frame < 5 ? 1 : 9);
        if (frame >= 5)
            for (int y = 0; y < picture.height(); ++y)
                for (int k = 0; k < 3 * picture.width(); ++k)
                    picture.row(y)[k] = y < 60 ? 0.05f : 0.15f * picture.row(y)[k];
        watch.look_at(frame, picture.view(), true);
    }
    EXPECT_THAT(watch.cuts(), ElementsAre(5));
}

TEST(CutWatch, AFrameThatShowsNothingIsNoCut) {
    CutWatch watch;
    for (int frame = 1; frame <= 8; ++frame) {
        const bool blank = frame == 4 || frame == 5;
        const ImageF3 picture =
            blank ? ImageF3(Card::kPlate, 1.0f) : pattern_picture(Card::kPlate, 1);
        watch.look_at(frame, picture.view(), true);
    }
    EXPECT_THAT(watch.cuts(), ElementsAre());
}

}  // namespace
}  // namespace weft::test
