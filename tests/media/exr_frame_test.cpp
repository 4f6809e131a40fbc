// What an EXR frame keeps of its plate's file.
#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "engine/core/setting.h"
#include "engine/media/exr_frame.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
using ::testing::HasSubstr;

class ExrFrameTest : public MediaTest {
  protected:
    // Half R, G, B, A and float Z; the data window is larger than the display window on the left
    // and smaller on the right. Native samples; the first pixel of the display is a NaN with a
    // payload.
    void put_source(const std::string& name, const std::string& compression = "piz") {
        ImageSpec spec(14, 8, 5, TypeDesc::HALF);
        spec.x = -2;
        spec.y = 1;
        spec.full_x = 0;
        spec.full_y = 0;
        spec.full_width = 16;
        spec.full_height = 10;
        spec.channelnames = {"R", "G", "B", "A", "depth.Z"};
        spec.channelformats = {TypeDesc::HALF, TypeDesc::HALF, TypeDesc::HALF, TypeDesc::HALF,
                               TypeDesc::FLOAT};
        spec.attribute("compression", compression);
        spec.attribute("PixelAspectRatio", 2.0f);
        const unsigned int code[2] = {0x01020304, 0};
        spec.attribute("smpte:TimeCode", OIIO::TypeTimeCode, code);
        spec.attribute("studio/shot", "sq010_sh020");
        spec.attribute("DateTime", "2020:02:02 02:02:02");
        samples_.assign(12u * 14 * 8, 0);
        for (std::size_t i = 0; i < 14 * 8; ++i) {
            for (std::size_t c = 0; c < 4; ++c) {
                const half h(static_cast<float>(i + 100 * c) / 64.0f);
                std::memcpy(samples_.data() + 12 * i + 2 * c, &h, 2);
            }
            const float z = 1.0f / static_cast<float>(i + 3);
            std::memcpy(samples_.data() + 12 * i + 8, &z, 4);
        }
        const std::uint16_t nan = 0x7E55;
        std::memcpy(samples_.data() + 12 * 2, &nan, 2);
        auto output = ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(TypeDesc::UNKNOWN, samples_.data()));
        ASSERT_TRUE(output->close());
    }

    std::vector<unsigned char> native(const std::string& name, ImageSpec& spec) {
        const auto input = ImageInput::open(in(name));
        EXPECT_TRUE(input);
        spec = input->spec();
        std::vector<unsigned char> out(spec.image_bytes(true));
        EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, out.data()));
        return out;
    }

    std::vector<unsigned char> samples_;
};

TEST_F(ExrFrameTest, KeepsEveryBitOutsideOfWhatWasTouched) {
    put_source("plate.exr");
    const ImageF3 rgb(16, 10, 0.25f);
    Matte touched(16, 10);
    touched.at(5, 4) = 255;
    touched.at(6, 4) = 1;
    ExrFrame frame{rgb, {}, in("plate.exr"), "", touched, {}};
    WriteOptions options;
    options.exr_compression = "auto";
    options.metadata = {{"weft:version", "1"}, {"weft:settings", "abc"}};
    ASSERT_TRUE(write_exr(in("out.exr"), frame, options));

    ImageSpec spec;
    const auto out = native("out.exr", spec);
    EXPECT_EQ(spec.x, -2);
    EXPECT_EQ(spec.y, 1);
    EXPECT_EQ(spec.width, 14);
    EXPECT_EQ(spec.full_width, 16);
    EXPECT_EQ(spec.get_string_attribute("compression"), "piz");
    EXPECT_EQ(spec.get_float_attribute("PixelAspectRatio"), 2.0f);
    EXPECT_EQ(spec.get_string_attribute("studio/shot"), "sq010_sh020");
    EXPECT_EQ(spec.get_string_attribute("DateTime"), "2020:02:02 02:02:02");
    EXPECT_EQ(spec.get_string_attribute("weft:settings"), "abc");
    EXPECT_NE(spec.find_attribute("smpte:TimeCode"), nullptr);
    ASSERT_EQ(spec.channelnames.back(), "depth.Z");
    ASSERT_EQ(out.size(), samples_.size());
    // Pixel (5, 4) of the display is (7, 3) of the data.
    for (std::size_t i = 0; i < 14 * 8; ++i) {
        const bool changed = i == 3 * 14 + 7 || i == 3 * 14 + 8;
        for (std::size_t b = 0; b < 12; ++b) {
            if (changed && b < 6) continue;
            ASSERT_EQ(out[12 * i + b], samples_[12 * i + b]) << "pixel " << i << " byte " << b;
        }
    }
    EXPECT_EQ(read_image(in("out.exr")).value().rgb.at(5, 4, 1), 0.25f);
    EXPECT_EQ(read_recipe_metadata(in("out.exr"))["weft:settings"], "abc");
}

// What the project says of the plate's pixels is in the output, whatever the source's header says.
TEST_F(ExrFrameTest, AGivenPixelAspectReplacesTheSources) {
    put_source("plate.exr");
    const ImageF3 rgb(16, 10, 0.25f);
    const auto written = [&](std::optional<double> aspect) {
        WriteOptions options;
        options.pixel_aspect = aspect;
        std::filesystem::remove(in("out.exr"));
        EXPECT_TRUE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", {}, {}}, options));
        ImageSpec spec;
        native("out.exr", spec);
        return spec.get_float_attribute("PixelAspectRatio", 1.0f);
    };
    EXPECT_EQ(written({}), 2.0f);
    EXPECT_EQ(written(2.0), 2.0f);
    EXPECT_EQ(written(1.5), 1.5f);
    EXPECT_EQ(written(1.0), 1.0f);
}

TEST_F(ExrFrameTest, APlateMayBeOpenedWithAnotherPixelAspect) {
    put_source("plate.0001.exr");
    const auto aspect = [&](std::optional<double> given) {
        ReadOptions options;
        options.pixel_aspect = given;
        const auto plate = open_plate(in("plate.####.exr"), options);
        EXPECT_TRUE(plate);
        EXPECT_EQ((*plate)->frames().size(), 1u);
        EXPECT_TRUE((*plate)->read(1));
        return (*plate)->pixel_aspect();
    };
    EXPECT_EQ(aspect({}), 2);
    EXPECT_EQ(aspect(1.0), 1);
    EXPECT_EQ(aspect(1.8), 1.8);
}

TEST_F(ExrFrameTest, TheDataWindowGrowsWithWhatIsPainted) {
    put_source("plate.exr");
    const ImageF3 rgb(16, 10, 0.5f);
    Matte touched(16, 10);
    touched.at(15, 9) = 255;
    ASSERT_TRUE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", touched, {}}, {}));
    ImageSpec spec;
    native("out.exr", spec);
    EXPECT_EQ(spec.x, -2);
    EXPECT_EQ(spec.x + spec.width, 16);
    EXPECT_EQ(spec.y + spec.height, 10);
    EXPECT_EQ(read_image(in("out.exr")).value().rgb.at(15, 9, 2), 0.5f);
}

// The plate's own time is kept; where it says none, the time of day does not take its place.
TEST_F(ExrFrameTest, NothingTellsTheTime) {
    put_source("plate.exr");
    const ImageF3 rgb(16, 10);
    const Matte touched(16, 10, 255);
    ASSERT_TRUE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", touched, {}}, {}));
    ASSERT_TRUE(write_exr(in("new.exr"), {rgb, {}, "", "", touched, {}}, {}));
    ImageSpec kept, fresh;
    native("out.exr", kept);
    native("new.exr", fresh);
    EXPECT_EQ(kept.get_string_attribute("DateTime"), "2020:02:02 02:02:02");
    EXPECT_EQ(fresh.get_string_attribute("DateTime"), "1970:01:01 00:00:00");
}

TEST_F(ExrFrameTest, LossyCompressionIsNotKept) {
    put_source("plate.exr", "b44");
    const ImageF3 rgb(16, 10);
    const Matte touched(16, 10);
    WriteOptions options;
    options.exr_compression = "auto";
    ASSERT_TRUE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", touched, {}}, options));
    ImageSpec spec;
    native("out.exr", spec);
    EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
}

TEST_F(ExrFrameTest, LayersComeBackAtTheirOwnDepth) {
    const ImageF3 rgb(6, 5, 0.5f);
    std::vector<float> st;
    for (int i = 0; i < 60; ++i)
        st.push_back(0.1f + static_cast<float>(i) / 777.0f);
    ExrFrame frame{
        rgb, {}, "",
        "",  {}, {{{"st.R", "st.G"}, true, st}, {{"seam.A"}, false, std::vector<float>(30, 0.1f)}}};
    WriteOptions options;
    options.depth = PixelDepth::kHalf;
    ASSERT_TRUE(write_exr(in("out.exr"), frame, options));
    const PlateFrame plain = read_image(in("out.exr")).value();
    EXPECT_EQ(plain.rgb.at(2, 2, 0), 0.5f);
    EXPECT_EQ(plain.depth, PixelDepth::kHalf);
    const auto input = ImageInput::open(in("out.exr"));
    std::vector<float> all(30u * static_cast<std::size_t>(input->spec().nchannels));
    ASSERT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeFloat, all.data()));
    for (int c = 0; c < input->spec().nchannels; ++c) {
        const std::string name = input->spec().channel_name(c);
        for (std::size_t i = 0; i < 30; ++i) {
            const float v = all[i * static_cast<std::size_t>(input->spec().nchannels) +
                                static_cast<std::size_t>(c)];
            if (name == "st.R") {
                ASSERT_EQ(v, st[2 * i]);
            }
            if (name == "seam.A") {
                ASSERT_EQ(v, static_cast<float>(half(0.1f)));
            }
        }
    }
}

TEST_F(ExrFrameTest, ANamedLayerIsReplacedAndTheOthersStay) {
    put_source("plate.exr");
    const ImageF3 rgb(16, 10, 2.0f);
    const auto bad = write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "beauty", {}, {}}, {});
    ASSERT_FALSE(bad);
    EXPECT_THAT(bad.error().sentence(), HasSubstr("beauty"));
    EXPECT_FALSE(is_exr_with_colour(in("plate.exr"), "beauty"));
    EXPECT_TRUE(is_exr_with_colour(in("plate.exr"), ""));
}

// Beauty and depth in parts of their own, as renderers and `oiiotool --siappend` write them.
TEST_F(ExrFrameTest, SeveralPartsAreWrittenWhole) {
    ImageSpec beauty(16, 10, 3, TypeDesc::HALF), depth(16, 10, 1, TypeDesc::HALF);
    beauty.attribute("oiio:subimagename", "beauty");
    depth.attribute("oiio:subimagename", "depth");
    depth.channelnames = {"Z"};
    const std::vector<ImageSpec> specs{beauty, depth};
    const std::vector<float> half_grey(16u * 10 * 3, 0.5f), far(16u * 10, 7.0f);
    auto output = ImageOutput::create(in("plate.exr"));
    ASSERT_TRUE(output->open(in("plate.exr"), 2, specs.data()));
    ASSERT_TRUE(output->write_image(TypeDesc::FLOAT, half_grey.data()));
    ASSERT_TRUE(output->open(in("plate.exr"), depth, ImageOutput::AppendSubimage));
    ASSERT_TRUE(output->write_image(TypeDesc::FLOAT, far.data()));
    ASSERT_TRUE(output->close());
    const ImageF3 rgb(16, 10, 0.25f);
    ASSERT_TRUE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", {}, {}}, {}));
    EXPECT_GT(bytes_of(in("out.exr")).size(), 300u);
    const auto input = ImageInput::open(in("out.exr"));
    ASSERT_TRUE(input);
    std::vector<float> colour(16u * 10 * 3), z(16u * 10);
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, TypeDesc::FLOAT, colour.data()));
    ASSERT_TRUE(input->read_image(1, 0, 0, 1, TypeDesc::FLOAT, z.data()));
    EXPECT_THAT(colour, ::testing::Each(0.25f));
    EXPECT_THAT(z, ::testing::Each(7.0f));
    // One that is there stays whole when it may not be replaced.
    const auto before = bytes_of(in("out.exr"));
    EXPECT_FALSE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", {}, {}}, {}));
    EXPECT_TRUE(bytes_of(in("out.exr")) == before);
    EXPECT_EQ(names(), (std::vector<std::string>{"out.exr", "plate.exr"}));
}

TEST_F(ExrFrameTest, ASecondPassReplacesTheLayersOfTheFirst) {
    const ImageF3 rgb(6, 5, 0.5f);
    const auto layers = [](float value) {
        return std::vector<ExrLayer>{{{"st.R", "st.G"}, true, std::vector<float>(60, value)},
                                     {{"seam.A"}, false, std::vector<float>(30, value)}};
    };
    WriteOptions options;
    options.depth = PixelDepth::kHalf;
    ASSERT_TRUE(write_exr(in("first.exr"), {rgb, {}, "", "", {}, layers(0.1f)}, options));
    auto again = layers(0.7f);
    again.push_back({{"id.Y"}, true, std::vector<float>(30, 3.0f)});
    Matte touched(6, 5);
    touched.at(2, 2) = 255;
    ASSERT_TRUE(
        write_exr(in("second.exr"), {rgb, {}, in("first.exr"), "", touched, again}, options));
    const auto input = ImageInput::open(in("second.exr"));
    ASSERT_TRUE(input);
    const ImageSpec& spec = input->spec();
    EXPECT_THAT(spec.channelnames,
                ::testing::UnorderedElementsAre("R", "G", "B", "st.R", "st.G", "seam.A", "id.Y"));
    const auto count = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> all(30 * count);
    ASSERT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeFloat, all.data()));
    for (std::size_t c = 0; c < count; ++c) {
        const std::string name = spec.channel_name(static_cast<int>(c));
        const float wanted = name == "id.Y"            ? 3.0f
                             : name == "seam.A"        ? static_cast<float>(half(0.7f))
                             : name.starts_with("st.") ? 0.7f
                                                       : 0.5f;
        for (std::size_t i = 0; i < 30; ++i)
            ASSERT_EQ(all[i * count + c], wanted) << name;
    }
}

TEST_F(ExrFrameTest, AnotherDepthKeepsMetadataAndLayers) {
    put_source("plate.exr");
    const ImageF3 rgb(16, 10, 0.1f);
    Matte touched(16, 10);
    touched.at(5, 4) = 255;
    WriteOptions options;
    options.depth = PixelDepth::kFloat;
    ASSERT_TRUE(write_exr(in("out.exr"), {rgb, {}, in("plate.exr"), "", touched, {}}, options));
    const auto input = ImageInput::open(in("out.exr"));
    ASSERT_TRUE(input);
    const ImageSpec& spec = input->spec();
    EXPECT_EQ(spec.get_string_attribute("studio/shot"), "sq010_sh020");
    EXPECT_NE(spec.find_attribute("smpte:TimeCode"), nullptr);
    EXPECT_EQ(spec.x, -2);
    ASSERT_EQ(spec.nchannels, 5);
    for (int c = 0; c < 5; ++c)
        EXPECT_EQ(spec.channelformat(c), TypeDesc::FLOAT) << spec.channel_name(c);
    std::vector<float> out(5u * 14 * 8);
    ASSERT_TRUE(input->read_image(0, 0, 0, 5, TypeDesc::FLOAT, out.data()));
    // Pixel (5, 4) of the display is (7, 3) of the data.
    const std::size_t painted = 3 * 14 + 7;
    EXPECT_EQ(out[5 * painted], 0.1f);
    for (std::size_t i = 0; i < 14 * 8; ++i) {
        EXPECT_EQ(out[5 * i + 4], 1.0f / static_cast<float>(i + 3));
        if (i != painted && i != 2) {
            EXPECT_EQ(out[5 * i], static_cast<float>(half(static_cast<float>(i) / 64.0f)));
        }
    }
}

TEST_F(ExrFrameTest, ALayerIsNotThePicture) {
    const ImageF3 rgb(6, 5, 0.5f);
    const std::vector<ExrLayer> layers{
        {{"light.R", "light.G", "light.B"}, false, std::vector<float>(90, 0.1f)}};
    ASSERT_TRUE(write_exr(in("first.exr"), {rgb, {}, "", "", {}, layers}, {}));
    const auto bad =
        write_exr(in("second.exr"), {rgb, {}, in("first.exr"), "light", {}, layers}, {});
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().code, ErrorCode::kUsage);
    EXPECT_THAT(bad.error().sentence(), HasSubstr(std::string(setting::kLayersOutput)));
}

}  // namespace
}  // namespace weft
