// EXR layers, parts and windows.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <array>

#include "engine/media/frame_reader.h"
#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Exr = MediaTest;

// Channel c holds c + 0.5 everywhere.
std::vector<float> numbered_channels(int pixels, int channels) {
    std::vector<float> data;
    for (int i = 0; i < pixels * channels; ++i)
        data.push_back(0.5f + static_cast<float>(i % channels));
    return data;
}

void put_layers(const std::string& path, const std::vector<std::string>& channels) {
    OIIO::ImageSpec spec(6, 5, static_cast<int>(channels.size()), OIIO::TypeHalf);
    spec.channelnames = channels;
    auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output->open(path, spec));
    const auto data = numbered_channels(30, spec.nchannels);
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());
}

ImageF3 constant(float r, float g, float b) {
    ImageF3 image(6, 5);
    for (int i = 0; i < 30; ++i) {
        image.data()[3 * i] = r;
        image.data()[3 * i + 1] = g;
        image.data()[3 * i + 2] = b;
    }
    return image;
}

TEST_F(Exr, LayersAreTakenByName) {
    put_layers(in("a.exr"), {"R", "G", "B", "A", "beauty.R", "beauty.G", "beauty.B", "depth.Z"});
    const PlateFrame plain = read_image(in("a.exr")).value();
    EXPECT_EQ(plain.rgb, constant(0.5f, 1.5f, 2.5f));
    EXPECT_EQ(plain.alpha, ImageF1(6, 5, 3.5f));
    const PlateFrame beauty = read_image(in("a.exr"), "beauty").value();
    EXPECT_EQ(beauty.rgb, constant(4.5f, 5.5f, 6.5f));
    EXPECT_TRUE(beauty.alpha.empty());
    EXPECT_EQ(read_image(in("a.exr"), "depth").value().rgb, constant(7.5f, 7.5f, 7.5f));

    ReadOptions options;
    options.layer = "beauty";
    EXPECT_EQ(open_plate(in("a.exr"), options).value()->read(1001).value().rgb, beauty.rgb);
}

TEST_F(Exr, AStereoPlateSaysWhichViewIsUsed) {
    OIIO::ImageSpec spec(6, 5, 6, OIIO::TypeHalf);
    spec.channelnames = {"R", "G", "B", "right.R", "right.G", "right.B"};
    const std::array<const char*, 2> views{"left", "right"};
    spec.attribute("multiView", OIIO::TypeDesc(OIIO::TypeDesc::STRING, 2), views.data());
    auto output = OIIO::ImageOutput::create(in("a.exr"));
    ASSERT_TRUE(output->open(in("a.exr"), spec));
    const auto data = numbered_channels(30, 6);
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());
    const auto plate = open_plate(in("a.exr"), {}).value();
    EXPECT_THAT(plate->warnings(), ElementsAre(HasSubstr("its first view, left, is used")));
    ReadOptions options;
    options.layer = "right";
    const auto right = open_plate(in("a.exr"), options).value();
    EXPECT_THAT(right->warnings(), IsEmpty());
    EXPECT_EQ(right->read(1001).value().rgb, constant(3.5f, 4.5f, 5.5f));
}

TEST_F(Exr, UnknownLayerListsThoseThereAre) {
    put_layers(in("a.exr"), {"spec.R", "spec.G", "spec.B", "sky.left.R"});
    for (const char* layer : {"", "albedo"}) {
        const auto frame = read_image(in("a.exr"), layer);
        ASSERT_FALSE(frame);
        EXPECT_EQ(frame.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(frame.error().sentence(), HasSubstr("sky.left, spec"));
    }
    EXPECT_THAT(read_image(in("a.exr"), "albedo").error().sentence(), HasSubstr("'albedo'"));
}

TEST_F(Exr, PartsAreLayersToo) {
    std::vector<OIIO::ImageSpec> specs;
    for (const char* part : {"rgba", "spec"}) {
        OIIO::ImageSpec spec(6, 5, 3, OIIO::TypeHalf);
        spec.attribute("oiio:subimagename", part);
        specs.push_back(spec);
    }
    auto output = OIIO::ImageOutput::create(in("a.exr"));
    ASSERT_TRUE(output->open(in("a.exr"), 2, specs.data()));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, std::vector<float>(90, 1.0f).data()));
    ASSERT_TRUE(output->open(in("a.exr"), specs[1], OIIO::ImageOutput::AppendSubimage));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, std::vector<float>(90, 2.0f).data()));
    ASSERT_TRUE(output->close());
    EXPECT_EQ(read_image(in("a.exr")).value().rgb, ImageF3(6, 5, 1.0f));
    EXPECT_EQ(read_image(in("a.exr"), "spec").value().rgb, ImageF3(6, 5, 2.0f));
}

TEST_F(Exr, FrameIsTheDisplayWindow) {
    // Data covers x −2…5, y 3…6 of a display window at (1, 1) of size 10 × 8.
    OIIO::ImageSpec spec(8, 4, 3, OIIO::TypeFloat);
    spec.x = -2;
    spec.y = 3;
    spec.full_x = spec.full_y = 1;
    spec.full_width = 10;
    spec.full_height = 8;
    std::vector<float> data;
    for (int y = 3; y < 7; ++y) {
        for (int x = -2; x < 6; ++x)
            data.insert(data.end(), {float(x), float(y), 9.0f});
    }
    auto output = OIIO::ImageOutput::create(in("a.exr"));
    ASSERT_TRUE(output->open(in("a.exr"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());

    ImageF3 expected(10, 8);
    for (int y = 3; y < 7; ++y) {
        for (int x = 1; x < 6; ++x) {
            expected.at(x - 1, y - 1, 0) = static_cast<float>(x);
            expected.at(x - 1, y - 1, 1) = static_cast<float>(y);
            expected.at(x - 1, y - 1, 2) = 9.0f;
        }
    }
    const auto plate = open_plate(in("a.exr"), {}).value();
    EXPECT_EQ(plate->size(), (Size{10, 8}));
    EXPECT_FALSE(plate->display_encoded());
    EXPECT_EQ(plate->read(1001).value().rgb, expected);
}

TEST_F(Exr, RateAndDepthComeFromTheHeader) {
    OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeHalf);
    const int rate[2] = {25, 1};
    spec.attribute("FramesPerSecond", OIIO::TypeRational, rate);
    auto output = OIIO::ImageOutput::create(in("p.0001.exr"));
    ASSERT_TRUE(output->open(in("p.0001.exr"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, std::vector<float>(48, 1.0f).data()));
    ASSERT_TRUE(output->close());
    const auto plate = open_plate(in("p.####.exr"), {}).value();
    EXPECT_EQ(plate->fps(), 25.0);
    EXPECT_EQ(plate->depth(), PixelDepth::kHalf);
}

TEST_F(Exr, LuminanceWithChromaIsNotGrey) {
    put_layers(in("yc.exr"), {"Y", "RY", "BY"});
    const auto frame = read_image(in("yc.exr"));
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame.error().sentence(), HasSubstr("chroma"));
    put_layers(in("y.exr"), {"Y"});
    EXPECT_EQ(read_image(in("y.exr")).value().rgb, constant(0.5f, 0.5f, 0.5f));
}

// Karma and Mantra.
TEST_F(Exr, TheLayerCIsThePicture) {
    put_layers(in("c.exr"), {"C.r", "C.g", "C.b", "C.a", "depth.Z"});
    EXPECT_EQ(read_image(in("c.exr")).value().rgb, constant(0.5f, 1.5f, 2.5f));
}

}  // namespace
}  // namespace weft
