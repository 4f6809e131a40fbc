// Which channels of an EXR become the picture when nobody names a layer.

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include "engine/media/image_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using PartChoice = MediaTest;
using Names = std::vector<std::string>;

struct Part {
    std::string name;
    Names channels;
    float value = 0;  ///< Of all its channels.
};

constexpr int kPixels = 30;

void put_parts(const std::string& path, const std::vector<Part>& parts) {
    std::vector<OIIO::ImageSpec> specs;
    for (const Part& part : parts) {
        OIIO::ImageSpec spec(6, 5, static_cast<int>(part.channels.size()), OIIO::TypeHalf);
        spec.channelnames = part.channels;
        if (!part.name.empty()) spec.attribute("oiio:subimagename", part.name);
        specs.push_back(spec);
    }
    auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(specs.size() == 1
                    ? output->open(path, specs[0])
                    : output->open(path, static_cast<int>(specs.size()), specs.data()));
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const bool appended =
            k == 0 || output->open(path, specs[k], OIIO::ImageOutput::AppendSubimage);
        ASSERT_TRUE(appended);
        const std::vector<float> data(kPixels * parts[k].channels.size(), parts[k].value);
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
    }
    ASSERT_TRUE(output->close());
}

ImageF3 all(float value) {
    return ImageF3(6, 5, value);
}

const Names kRgb{"R", "G", "B"}, kZ{"Z"};

TEST_F(PartChoice, DepthInFrontOfTheColoursIsPassedOver) {
    put_parts(in("a.exr"), {{"depth", kZ, 7}, {"beauty", kRgb, 2}});
    EXPECT_EQ(read_image(in("a.exr")).value().rgb, all(2));
    EXPECT_EQ(read_image(in("a.exr"), "depth").value().rgb, all(7));
}

TEST_F(PartChoice, PartsNamedAsDataArePassedOverWhateverTheirChannelsAreCalled) {
    for (const char* data : {"N", "P", "position", "id", "motionvector", "crypto_object00"}) {
        put_parts(in("a.exr"), {{data, kRgb, 7}, {"rgba", kRgb, 2}});
        EXPECT_EQ(read_image(in("a.exr")).value().rgb, all(2)) << data;
    }
}

TEST_F(PartChoice, TheLayerNamedAsThePictureIsTaken) {
    put_parts(in("a.exr"), {{"", {"beauty.R", "beauty.G", "beauty.B", "depth.Z"}, 2}});
    EXPECT_EQ(read_image(in("a.exr")).value().rgb, all(2));
    put_parts(in("b.exr"),
              {{"", {"V.Combined.R", "V.Combined.G", "V.Combined.B", "V.Depth.Z"}, 3}});
    EXPECT_EQ(read_image(in("b.exr")).value().rgb, all(3));
    put_parts(in("c.exr"), {{"depth", kZ, 7}, {"grey", {"Y"}, 4}});
    EXPECT_EQ(read_image(in("c.exr")).value().rgb, all(4));
}

void expect_refused(const std::string& path, const Names& parts) {
    const auto read = read_image(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kUnreadable);
    for (const std::string& part : parts)
        EXPECT_THAT(read.error().sentence(), HasSubstr(part));
}

TEST_F(PartChoice, SeveralThatMayBeThePictureAreListed) {
    put_parts(in("a.exr"), {{"",
                             {"left.rgba.R", "left.rgba.G", "left.rgba.B", "right.rgba.R",
                              "right.rgba.G", "right.rgba.B"},
                             2}});
    expect_refused(in("a.exr"), {"several", "plate.layer", "left.rgba, right.rgba"});
}

TEST_F(PartChoice, DataAloneIsNoPicture) {
    put_parts(in("z.exr"), {{"", kZ, 7}});
    expect_refused(in("z.exr"), {"no colours", "Z"});
    put_parts(in("n.exr"), {{"", {"N.X", "N.Y", "N.Z"}, 7}});
    expect_refused(in("n.exr"), {"plate.layer", "N"});
    put_parts(in("parts.exr"), {{"depth", kZ, 7}, {"normal", {"X", "Y", "Z"}, 7}});
    expect_refused(in("parts.exr"), {"plate.layer", "depth, normal"});
}

// One channel of its own name leaves nothing to choose: mattes are often written so.
TEST_F(PartChoice, OneChannelAloneIsTaken) {
    for (const char* name : {"A", "mask", "Y"}) {
        put_parts(in("a.exr"), {{"", {name}, 1}});
        EXPECT_EQ(read_matte(in("a.exr"), {}, {}).value(), Matte(6, 5, 255)) << name;
    }
}

// Krita names the channels of a single paint layer by it.
TEST_F(PartChoice, OneLayerAloneIsTaken) {
    put_parts(in("a.exr"),
              {{"", {"Background.R", "Background.G", "Background.B", "Background.A"}, 1}});
    EXPECT_EQ(read_image(in("a.exr")).value().rgb, all(1));
    put_parts(in("b.exr"), {{"", {"Background.Y", "Background.A"}, 1}});
    EXPECT_EQ(read_image(in("b.exr")).value().rgb, all(1));
    EXPECT_EQ(read_matte(in("b.exr"), {}, {}).value(), Matte(6, 5, 255));
    put_parts(in("n.exr"), {{"", {"Normal.R", "Normal.G", "Normal.B"}, 1}});
    expect_refused(in("n.exr"), {"plate.layer", "Normal"});
    put_parts(in("c.exr"), {{"", {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}, 1}});
    expect_refused(in("c.exr"), {"plate.layer", "a, b", "by itself"});
}

TEST_F(PartChoice, DeepSamplesAreNoPicture) {
    OIIO::ImageSpec spec(4, 3, 5, OIIO::TypeFloat);
    spec.channelnames = {"R", "G", "B", "A", "Z"};
    spec.deep = true;
    auto output = OIIO::ImageOutput::create(in("a.exr"));
    ASSERT_TRUE(output->open(in("a.exr"), spec));
    OIIO::DeepData data(spec);
    for (std::int64_t p = 0; p < 12; ++p)
        data.set_samples(p, 1);
    ASSERT_TRUE(output->write_deep_image(data));
    ASSERT_TRUE(output->close());
    expect_refused(in("a.exr"), {"deep samples", "Flatten"});
}

}  // namespace
}  // namespace weft
