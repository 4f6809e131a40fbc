// Passes as renderers and compositors really write them: parts, File Output nodes, view layers,
// backgrounds.
#include "engine/media/pass_layers.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/media/form_passes.h"
#include "engine/media/image_files.h"
#include "engine/media/light_passes.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Size kPassSize{8, 4};
constexpr auto kBlender = MotionConvention::kBlender;

struct PassPart {
    std::string name;
    std::vector<std::string> channels;
    std::vector<float> pixel;  // the same everywhere
};

class PassLayers : public MediaTest {
  protected:
    void put(const std::string& name, const std::vector<PassPart>& parts,
             const std::string& codec = "zip", const std::vector<std::string>& views = {}) {
        std::vector<OIIO::ImageSpec> specs;
        for (const PassPart& part : parts) {
            OIIO::ImageSpec spec(kPassSize.width, kPassSize.height,
                                 static_cast<int>(part.channels.size()), OIIO::TypeFloat);
            spec.channelnames = part.channels;
            spec.attribute("compression", codec);
            if (!views.empty()) {
                std::vector<OIIO::ustring> names(views.begin(), views.end());
                spec.attribute(
                    "multiView",
                    OIIO::TypeDesc(OIIO::TypeDesc::STRING, static_cast<int>(names.size())),
                    names.data());
            }
            if (!part.name.empty()) spec.attribute("oiio:subimagename", part.name);
            specs.push_back(spec);
        }
        auto output = OIIO::ImageOutput::create(in(name));
        const auto count = static_cast<int>(parts.size());
        ASSERT_TRUE(count == 1 ? output->open(in(name), specs[0])
                               : output->open(in(name), count, specs.data()));
        for (int k = 0; k < count; ++k) {
            const auto at = static_cast<std::size_t>(k);
            if (k > 0) {
                ASSERT_TRUE(output->open(in(name), specs[at], OIIO::ImageOutput::AppendSubimage));
            }
            std::vector<float> data;
            for (int i = 0; i < kPassSize.width * kPassSize.height; ++i)
                data.insert(data.end(), parts[at].pixel.begin(), parts[at].pixel.end());
            ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        }
        ASSERT_TRUE(output->close());
    }
    // d(3, 2), or the error's text.
    std::vector<float> motion(const std::string& name, const MotionSelect& select) {
        const auto flow = read_motion(in(name), select, kPassSize);
        EXPECT_TRUE(flow) << (flow ? "" : flow.error().text());
        if (!flow) return {};
        return {flow->d.at(3, 2, 0), flow->d.at(3, 2, 1), flow->valid.at(3, 2) / 255.0f};
    }
    std::string refusal(const std::string& name, const MotionSelect& select) {
        const auto flow = read_motion(in(name), select, kPassSize);
        EXPECT_FALSE(flow);
        return flow ? "" : flow.error().sentence();
    }
};

// Depth's Z comes first in the file and must not be taken for the vector's.
TEST_F(PassLayers, APartsNameIsTheLayerOfItsPlainChannels) {
    put("parts.exr", {{"Depth", {"Z"}, {7}},
                      {"Position", {"X", "Y", "Z"}, {4, 5, 6}},
                      {"Vector", {"X", "Y", "Z", "W"}, {-3, -1, -2, -1}},
                      {"UV", {"U", "V"}, {0.25f, 0.5f}},
                      {"beauty", {"R", "G", "B", "A"}, {9, 9, 9, 1}}});
    EXPECT_THAT(motion("parts.exr", {kBlender, kForward}), ElementsAre(2, -1, 1));
    EXPECT_THAT(motion("parts.exr", {kBlender, kBackward, "vector"}), ElementsAre(-3, 1, 1));
    EXPECT_EQ(read_positions(in("parts.exr"), "", kPassSize).value().at(1, 1, 2), 6);
    EXPECT_EQ(read_positions(in("parts.exr"), "Position", kPassSize).value().at(1, 1, 0), 4);
    EXPECT_EQ(read_depth(in("parts.exr"), "", kPassSize).value().at(1, 1), 7);
    EXPECT_EQ(read_uv(in("parts.exr"), "UV", kPassSize).value().at(1, 1, 1), 0.5f);
    const auto missing = read_uv(in("parts.exr"), "beauty", kPassSize);
    EXPECT_TRUE(missing) << "any layer with two channels, if it is named";
    EXPECT_THAT(read_normals(in("parts.exr"), "", kPassSize).error().sentence(),
                HasSubstr("Vector: X, Y, Z, W"));
}

TEST_F(PassLayers, UnnamedChannelsCountWhereNoOtherLayerCanBeMeant) {
    put("alone.exr", {{"", {"X", "Y", "Z", "W"}, {-3, -1, -2, -1}}});
    EXPECT_THAT(motion("alone.exr", {kBlender, kForward}), ElementsAre(2, -1, 1));
    // A picture beside other layers is no motion and no texture coordinates.
    put("picture.exr", {{"", {"R", "G", "B", "N.X", "N.Y", "N.Z"}, {3, 1, 0, 0, 0, 1}}});
    refusal("picture.exr", {MotionConvention::kArnold, kForward});
    EXPECT_THAT(read_uv(in("picture.exr"), "", kPassSize).error().sentence(),
                HasSubstr("no UV pass"));
    put("weft.exr",
        {{"", {"R", "G", "B", "A", "stabilize.R", "stabilize.G"}, {.5f, .25f, 1, 1, 0, 0}}});
    EXPECT_EQ(read_uv(in("weft.exr"), "", kPassSize).value().at(0, 0, 1), 0.25f);
}

TEST_F(PassLayers, ForwardVectorsAreNotTakenForBackwardOnes) {
    put("nuke.exr", {{"", {"R", "G", "B", "forward.u", "forward.v"}, {9, 9, 9, 3, 1}}});
    EXPECT_THAT(motion("nuke.exr", {MotionConvention::kNuke, kForward}), ElementsAre(3, -1, 1));
    refusal("nuke.exr", {MotionConvention::kNuke, kBackward});
}

// Layers by slot, vectors by socket: W is lost.
TEST_F(PassLayers, OfBlendersFileOutputNode) {
    put("node.exr", {{"",
                      {"Image.R", "Image.G", "Image.B", "Vector.X", "Vector.Y", "Vector.Z", "UV.X",
                       "UV.Y", "UV.Z", "Depth.V"},
                      {9, 9, 9, -3, -1, -2, 0.25f, 0.5f, 1, 5}}});
    EXPECT_THAT(motion("node.exr", {kBlender, kBackward}), ElementsAre(-3, 1, 1));
    EXPECT_THAT(refusal("node.exr", {kBlender, kForward}), HasSubstr("backward"));
    EXPECT_EQ(read_uv(in("node.exr"), "", kPassSize).value().at(2, 2, 0), 0.25f);
    EXPECT_EQ(read_uv(in("node.exr"), "UV", kPassSize).value().at(2, 2, 1), 0.5f);
    EXPECT_EQ(read_depth(in("node.exr"), "", kPassSize).value().at(2, 2), 5);
}

// Cycles multiplies coordinates by the coverage.
TEST_F(PassLayers, CoordinatesOfPartlyCoveredPixelsAreUnknown) {
    OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeFloat);
    spec.channelnames = {"v.UV.U", "v.UV.V", "v.UV.A"};
    const std::vector<float> data{0.5f, 0.5f, 1, 0.25f, 0.25f, 0.5f};
    auto output = OIIO::ImageOutput::create(in("uv.exr"));
    ASSERT_TRUE(output->open(in("uv.exr"), spec) &&
                output->write_image(OIIO::TypeFloat, data.data()));
    ASSERT_TRUE(output->close());
    const auto uv = read_uv(in("uv.exr"), "", {2, 1});
    EXPECT_EQ(uv.value().at(0, 0, 0), 0.5f);
    EXPECT_TRUE(std::isnan(uv.value().at(1, 0, 0)));
    put("third.exr", {{"", {"uv.X", "uv.Y", "uv.Z"}, {0.25f, 0.5f, 0}}});
    EXPECT_EQ(read_uv(in("third.exr"), "", kPassSize).value().at(1, 0, 0), 0.25f)
        << "a third coordinate is no coverage";
}

TEST_F(PassLayers, OfSeveralRendersThatOfThePlateIsMeant) {
    put("two.exr", {{"",
                     {"bg.Combined.R", "bg.Vector.X", "bg.Vector.Y", "fg.Combined.R", "fg.Vector.X",
                      "fg.Vector.Y"},
                     {0, -1, 0, 0, -3, -1}}});
    const auto found = locate_motion(in("two.exr"), {kBlender, kBackward}, {"fg.Combined"});
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_EQ(found->layer.name, "fg.Vector");
    EXPECT_THAT(found->also_called, ElementsAre("bg.Vector"));
    EXPECT_THAT(motion("two.exr", {kBlender, kBackward, found->layer.name}), ElementsAre(-3, 1, 1));
    EXPECT_EQ(locate_motion(in("two.exr"), {kBlender, kBackward}).value().layer.name, "bg.Vector");
}

class StereoPasses : public PassLayers {
  protected:
    // The depth pass beside a layer of the plate, and why.
    [[nodiscard]] std::string depth(const std::string& beside) const {
        const std::vector<std::string> layers =
            beside.empty() ? std::vector<std::string>() : std::vector<std::string>{beside};
        const auto found = locate_depth(in("stereo.exr"), "", layers);
        EXPECT_TRUE(found) << (found ? "" : found.error().text());
        return found ? found->layer.name + ", " + found->why : "";
    }
};

// OpenEXR's convention: the view is the last but the channel.
TEST_F(StereoPasses, TheViewOfThePlateIsMeant) {
    put("stereo.exr", {{"",
                        {"RenderLayer.Combined.left.R", "RenderLayer.Combined.right.R",
                         "RenderLayer.Depth.left.Z", "RenderLayer.Depth.right.Z"},
                        {0, 0, 5, 6}}});
    EXPECT_EQ(depth("RenderLayer.Combined.right"),
              "RenderLayer.Depth.right, which belongs to RenderLayer.Combined.right");
    EXPECT_EQ(depth("RenderLayer.Combined.left"),
              "RenderLayer.Depth.left, which belongs to RenderLayer.Combined.left");
    EXPECT_EQ(depth("RIGHT"), "RenderLayer.Depth.right, which belongs to RIGHT")
        << "a plate of its own file";
    EXPECT_EQ(depth(""), "RenderLayer.Depth.left, of the file's first view");
    EXPECT_EQ(read_depth(in("stereo.exr"), "RenderLayer.Depth.right", kPassSize).value().at(1, 1),
              6);
    EXPECT_EQ(read_depth(in("stereo.exr"), "", kPassSize).value().at(1, 1), 5);
}

TEST_F(StereoPasses, TheViewMayComeFirst) {
    put("stereo.exr", {{"",
                        {"left.R", "left.Depth.Z", "left.Vector.X", "left.Vector.Y", "right.R",
                         "right.Depth.Z", "right.Vector.X", "right.Vector.Y"},
                        {0, 5, -1, 0, 0, 6, -3, -1}}});
    EXPECT_EQ(depth("right"), "right.Depth, which belongs to right");
    EXPECT_EQ(depth("left"), "left.Depth, which belongs to left");
    EXPECT_EQ(locate_motion(in("stereo.exr"), {kBlender, kBackward}, {"right"}).value().layer.name,
              "right.Vector");
}

// The first view's layers have no name of it where the header names the views.
TEST_F(StereoPasses, LayersWithoutAViewAreOfTheFirst) {
    put("stereo.exr", {{"", {"Depth.Z", "Depth.wit.Z", "R", "wit.R"}, {5, 6, 0, 0}}}, "zip",
        {"main", "wit"});
    EXPECT_EQ(depth("wit"), "Depth.wit, which belongs to wit");
    EXPECT_EQ(depth("rgba"), "Depth, which belongs to rgba");
    EXPECT_EQ(depth(""), "Depth, of the file's first view");
}

TEST_F(PassLayers, IdsMayBeNamedByTheirPart) {
    put("ids.exr", {{"bg.IndexOB", {"X"}, {3}}, {"fg.IndexOB", {"X"}, {4}}, {"rgba", {"R"}, {0}}});
    EXPECT_EQ(find_ids(in("ids.exr"), {"fg.Combined"}).value().layer.name, "fg.IndexOB");
    const auto inside = [&](const std::string& channel, int value) {
        return read_matte(in("ids.exr"), {value, channel, false}, kPassSize).value().at(1, 1) ==
               255;
    };
    EXPECT_TRUE(inside("fg.IndexOB.X", 4));
    EXPECT_TRUE(inside("bg.IndexOB.X", 3));
    EXPECT_TRUE(inside("", 3)) << "the first";
}

TEST_F(PassLayers, WhatIsBesideARenderRegionIsNeitherMotionNorDistance) {
    put("outside.exr", {{"",
                         {"v.Vector.X", "v.Vector.Y", "v.Vector.Z", "v.Vector.W", "v.Position.X",
                          "v.Position.Y", "v.Position.Z"},
                         {1e4f, 1e4f, 1e4f, 1e4f, 0, 0, 0}}});
    EXPECT_THAT(motion("outside.exr", {kBlender, kForward}), ElementsAre(0, 0, 0));
    EXPECT_THAT(motion("outside.exr", {kBlender, kBackward}), ElementsAre(0, 0, 0));
    EXPECT_TRUE(std::isnan(read_positions(in("outside.exr"), "", kPassSize).value().at(1, 1, 1)));
    for (const float nothing :
         {1e10f, 1e11f, 1e30f, 65504.0f, std::numeric_limits<float>::infinity()}) {
        put("depth.exr", {{"", {"v.Depth.Z"}, {nothing}}});
        EXPECT_TRUE(std::isinf(read_depth(in("depth.exr"), "", kPassSize).value().at(1, 1)))
            << nothing;
    }
    put("depth.exr", {{"", {"v.Depth.Z"}, {9e9f}}});
    EXPECT_EQ(read_depth(in("depth.exr"), "", kPassSize).value().at(1, 1), 9e9f);
}

TEST_F(PassLayers, TheCodecOfALayerIsKnown) {
    put("lossy.exr", {{"", {"v.Normal.X", "v.Normal.Y", "v.Normal.Z"}, {0, 0, 1}}}, "dwaa");
    EXPECT_THAT(list_pass_layers(in("lossy.exr")).value().front().codec, HasSubstr("dwaa"));
}

class LightPasses : public PassLayers {
  protected:
    float red(const std::string& name, LightPass pass, const std::string& layer = "") {
        const auto picture = read_light_pass(in(name), pass, layer);
        EXPECT_TRUE(picture) << (picture ? "" : picture.error().text());
        return picture ? picture->rgb.at(1, 1, 0) : -1;
    }
};

TEST_F(LightPasses, AreFoundBesideThePicture) {
    put("cycles.exr", {{"",
                        {"v.Combined.R", "v.Combined.G", "v.Combined.B", "v.DiffCol.R",
                         "v.DiffCol.G", "v.DiffCol.B", "v.DiffDir.R", "v.DiffDir.G", "v.DiffDir.B",
                         "v.DiffInd.R", "v.DiffInd.G", "v.DiffInd.B"},
                        {9, 9, 9, .5f, .5f, .5f, 2, 2, 2, 1, 1, 1}}});
    EXPECT_EQ(red("cycles.exr", LightPass::kAlbedo), 0.5f);
    EXPECT_EQ(red("cycles.exr", LightPass::kLighting), 3);
    EXPECT_EQ(red("cycles.exr", LightPass::kLighting, "v.DiffDir"), 2);
    EXPECT_EQ(red("cycles.exr", LightPass::kLighting, "v.DiffDir + v.DiffInd"), 3);
    EXPECT_EQ(find_light_layer(in("cycles.exr"), LightPass::kLighting).value(),
              "v.DiffDir+v.DiffInd");
    EXPECT_TRUE(is_same_picture(in("cycles.exr"), "v.Combined", ""));
    EXPECT_FALSE(is_same_picture(in("cycles.exr"), "v.DiffCol", ""));
}

TEST_F(LightPasses, ThePictureIsNoneOfThem) {
    put("plain.exr", {{"", {"R", "G", "B", "N.X", "N.Y", "N.Z"}, {9, 9, 9, 0, 0, 1}}});
    for (const LightPass pass : {LightPass::kAlbedo, LightPass::kLighting}) {
        const auto none = read_light_pass(in("plain.exr"), pass, "");
        ASSERT_FALSE(none);
        EXPECT_THAT(none.error().sentence(), HasSubstr("N: X, Y, Z"));
    }
    EXPECT_EQ(red("plain.exr", LightPass::kAlbedo, "rgba"), 9) << "if it is asked for";
    put("own.exr", {{"", {"R", "G", "B"}, {.5f, 0, 0}}});
    EXPECT_EQ(red("own.exr", LightPass::kAlbedo), 0.5f);
    put_frame(in("own.png"), ImageF3(kPassSize, 1.0f));
    EXPECT_EQ(red("own.png", LightPass::kAlbedo), 1);
}

// Nuke's Write node.
TEST_F(PassLayers, ChannelsMayBeWrittenOut) {
    put("nuke.exr", {{"",
                      {"R", "G", "B", "N.red", "N.green", "N.blue", "albedo.red", "albedo.green",
                       "albedo.blue"},
                      {9, 9, 9, 0, 0.6f, 0.8f, 1, 2, 3}}});
    EXPECT_EQ(read_normals(in("nuke.exr"), "", kPassSize).value().at(1, 1, 2), 0.8f);
    EXPECT_EQ(find_light_layer(in("nuke.exr"), LightPass::kAlbedo, {}).value(), "albedo");
}

TEST_F(PassLayers, TextureCoordinatesThatCountPixelsAreRefused) {
    OIIO::ImageSpec spec(kPassSize.width, kPassSize.height, 2, OIIO::TypeFloat);
    spec.channelnames = {"UV.U", "UV.V"};
    const auto put_map = [&](const char* name, float scale) {
        std::vector<float> data;
        for (int y = 0; y < kPassSize.height; ++y)
            for (int x = 0; x < kPassSize.width; ++x)
                data.insert(data.end(),
                            {scale * static_cast<float>(x), scale * static_cast<float>(y)});
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    };
    put_map("pixels.exr", 1);
    EXPECT_THAT(read_uv(in("pixels.exr"), "", kPassSize).error().sentence(),
                HasSubstr("half a texture"));
    put_map("shares.exr", 0.25f);
    EXPECT_EQ(read_uv(in("shares.exr"), "", kPassSize).value().at(3, 1, 0), 0.75f);
}

}  // namespace
}  // namespace weft
