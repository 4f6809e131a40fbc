// Renderers' passes of places, normals and depth, and the camera in a header.
#include "engine/media/form_passes.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FormPasses : public MediaTest {
  protected:
    // One pixel's values everywhere in 8×4.
    void put(const std::string& name, const std::vector<std::string>& channels,
             const std::vector<float>& pixel,
             const std::function<void(OIIO::ImageSpec&)>& header = {}) {
        OIIO::ImageSpec spec(8, 4, static_cast<int>(channels.size()), OIIO::TypeFloat);
        spec.channelnames = channels;
        if (header) header(spec);
        std::vector<float> data;
        for (int i = 0; i < 32; ++i)
            data.insert(data.end(), pixel.begin(), pixel.end());
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    }
    HeaderCamera camera_with(const std::function<void(OIIO::ImageSpec&)>& header) {
        put("camera.exr", {"R"}, {0}, header);
        return read_camera(in("camera.exr")).value();
    }
};

TEST_F(FormPasses, PositionPassesAreFoundByTheirNames) {
    const auto at = [&](const char* file, const std::string& layer = "") {
        return read_positions(in(file), layer, {8, 4});
    };
    put("cycles.exr",
        {"shot.Normal.X", "shot.Normal.Y", "shot.Normal.Z", "shot.Position.X", "shot.Position.Y",
         "shot.Position.Z"},
        {9, 9, 9, 1, -2, 3e10f});
    EXPECT_EQ(at("cycles.exr").value().at(2, 1, 1), -2);
    EXPECT_TRUE(std::isnan(at("cycles.exr").value().at(2, 1, 2))) << "the background";
    EXPECT_EQ(at("cycles.exr", "shot.Normal").value().at(2, 1, 0), 9);
    put("arnold.exr", {"R", "G", "B", "P.R", "P.G", "P.B"}, {9, 9, 9, 4, 5, 6});
    EXPECT_EQ(at("arnold.exr").value().at(0, 0, 2), 6);
    put("nuke.exr", {"R", "G", "B", "P_World.R", "P_World.G", "P_World.B"}, {9, 9, 9, 7, 5, 6});
    EXPECT_EQ(at("nuke.exr").value().at(0, 0, 0), 7);
    put("alone.exr", {"R", "G", "B"}, {1, 2, 3});
    EXPECT_EQ(at("alone.exr").value().at(7, 3, 1), 2);
    EXPECT_FALSE(read_positions(in("alone.exr"), "", {8, 5}));
    put("none.exr", {"R", "G", "B", "A", "AP.R"}, {0, 0, 0, 1, 0});
    const auto none = at("none.exr");
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().sentence(), HasSubstr("AP: R"));
}

TEST_F(FormPasses, NormalsAreVectorsOrCodes) {
    const auto at = [&](const char* file, const std::string& layer = "") {
        return read_normals(in(file), layer, {8, 4});
    };
    put("cycles.exr",
        {"shot.Normal.X", "shot.Normal.Y", "shot.Normal.Z", "shot.Position.X", "shot.Position.Y",
         "shot.Position.Z"},
        {0.5f, -1, 0, 9, 9, 9});
    EXPECT_EQ(at("cycles.exr").value().at(2, 1, 1), -1);
    put("arnold.exr", {"R", "G", "B", "N.R", "N.G", "N.B"}, {9, 9, 9, 0, 0, 1});
    EXPECT_EQ(at("arnold.exr").value().at(0, 0, 2), 1);
    ImageF3 codes(Size{8, 4}, 1.0f);
    codes.pixel(3, 2)[0] = 0;
    WriteOptions options;
    options.depth = PixelDepth::kU8;
    ASSERT_TRUE(write_image(in("map.png"), codes, {}, options));
    EXPECT_EQ(at("map.png").value().at(3, 2, 0), -1);
    EXPECT_EQ(at("map.png").value().at(3, 2, 1), 1);
    put("none.exr", {"R", "G", "B", "A", "IN.R"}, {0, 0, 0, 1, 0});
    ASSERT_FALSE(at("none.exr"));
    EXPECT_THAT(at("none.exr").error().sentence(), HasSubstr("no normal pass"));
    EXPECT_FALSE(read_normals(in("map.png"), "", {9, 4})) << "of another size";
    EXPECT_EQ(at("not there.exr").error().code, ErrorCode::kMissingFrames);
}

TEST_F(FormPasses, DepthIsInAChannelOfItsName) {
    const auto at = [&](const char* file) { return read_depth(in(file), "", {8, 4}); };
    put("cycles.exr",
        {"shot.Combined.R", "shot.Depth.Z", "shot.Normal.X", "shot.Normal.Y", "shot.Normal.Z"},
        {9, 2.5f, 9, 9, 9});
    EXPECT_EQ(at("cycles.exr").value().at(2, 1), 2.5f) << "not the normal's Z";
    put("nuke.exr", {"R", "G", "B", "A", "depth.Z"}, {9, 9, 9, 9, 4});
    EXPECT_EQ(at("nuke.exr").value().at(2, 1), 4);
    put("beside.exr", {"R", "G", "B", "A", "Z"}, {9, 9, 9, 9, 6});
    EXPECT_EQ(at("beside.exr").value().at(2, 1), 6);
    put("alone.exr", {"R", "G", "B"}, {7, 9, 9});
    EXPECT_EQ(at("alone.exr").value().at(2, 1), 7);
    put("none.exr", {"R", "G", "B", "A", "N.X", "N.Y", "N.Z"}, {0, 0, 0, 1, 0, 0, 1});
    ASSERT_FALSE(at("none.exr"));
    EXPECT_THAT(at("none.exr").error().sentence(), HasSubstr("no depth pass"));
    ASSERT_TRUE(write_image(in("view.png"), ImageF3(Size{8, 4}, 0.5f), {}, {}));
    ASSERT_FALSE(at("view.png"));
    EXPECT_THAT(at("view.png").error().sentence(), HasSubstr("distances"));
    EXPECT_FALSE(read_depth(in("alone.exr"), "", {8, 5}));
}

TEST_F(FormPasses, TheHeaderHasTheFieldOfView) {
    EXPECT_FALSE(camera_with({}).fov_deg);
    EXPECT_NEAR(*camera_with([](auto& s) { s.attribute("cameraFov", 40.5f); }).fov_deg, 40.5, 1e-4);
    const HeaderCamera lens = camera_with([](auto& s) {
        s.attribute("cameraAperture", 36.0f);
        s.attribute("cameraFocalLength", 18.0f);
    });
    EXPECT_NEAR(*lens.fov_deg, 90, 1e-4);
    for (const float wrong : {-1.0f, 0.0f, 180.0f, 1e30f})
        EXPECT_FALSE(camera_with([&](auto& s) { s.attribute("cameraFov", wrong); }).fov_deg);
    EXPECT_FALSE(camera_with([](auto& s) { s.attribute("cameraFov", "wide"); }).fov_deg);
}

// A camera whose x is the world's y, y the world's z and z the world's x.
TEST_F(FormPasses, TheHeaderHasTheCamerasAxes) {
    const auto with = [&](const char* name, const std::array<float, 16>& m) {
        return camera_with(
                   [&](auto& s) { s.attribute(name, OIIO::TypeDesc::TypeMatrix44, m.data()); })
            .camera_from_world;
    };
    const auto axes = ElementsAre(0, 1, 0, 0, 0, 1, 1, 0, 0);
    // OpenEXR's matrices act on rows: translation is in the last one.
    EXPECT_THAT(with("worldToCamera", {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 6, 7, 1}).value(),
                axes);
    EXPECT_THAT(with("worldToCamera", {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}).value(),
                axes);
    // V-Ray's, from the camera to the world, acts on columns; here with a scale of 2.
    EXPECT_THAT(with("cameraTransform", {0, 0, 2, 5, 2, 0, 0, 6, 0, 2, 0, 7, 0, 0, 0, 1}).value(),
                axes);
    EXPECT_FALSE(with("worldToCamera", {}));
    EXPECT_FALSE(camera_with({}).camera_from_world);
}

// As V-Ray and Redshift can write them.
TEST_F(FormPasses, NormalsInFloatsMayBeCodes) {
    const auto at = [&](const char* file) { return read_normals(in(file), "", {8, 4}).value(); };
    put("codes.exr", {"N.X", "N.Y", "N.Z"}, {0.8f, 0.5f, 0.9f});
    EXPECT_NEAR(at("codes.exr").at(1, 1, 0), 0.6f, 1e-6);
    EXPECT_NEAR(at("codes.exr").at(1, 1, 1), 0, 1e-6);
    EXPECT_NEAR(at("codes.exr").at(1, 1, 2), 0.8f, 1e-6);
    put("vectors.exr", {"N.X", "N.Y", "N.Z"}, {0.6f, 0, 0.8f});
    EXPECT_EQ(at("vectors.exr").at(1, 1, 2), 0.8f);
    put("short.exr", {"N.X", "N.Y", "N.Z"}, {0.5f, -1, 0});
    EXPECT_EQ(at("short.exr").at(1, 1, 1), -1) << "vectors of any length";
}

}  // namespace
}  // namespace weft
