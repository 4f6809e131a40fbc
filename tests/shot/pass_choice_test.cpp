// The layers of passes that are left open, and what is said before a render.
#include "app/shot/pass_choice.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <functional>

#include "app/shot/form_files.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PassChoosing : public MediaTest {
  protected:
    void put(const std::string& name, const std::vector<std::string>& channels,
             const std::function<void(OIIO::ImageSpec&)>& header = {}) {
        OIIO::ImageSpec spec(8, 4, static_cast<int>(channels.size()), OIIO::TypeFloat);
        spec.channelnames = channels;
        if (header) header(spec);
        const std::vector<float> data(32 * channels.size(), 0.5f);
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    }
    PassChoice choose() {
        auto choice = choose_pass_layers(region_, plate_, {1, 2});
        EXPECT_TRUE(choice) << (choice ? "" : choice.error().text());
        return choice.value_or(PassChoice());
    }

    Region region_;
    Plate plate_;
};

const std::vector<std::string> kTwoRenders{
    "bg.Combined.R", "bg.Combined.G", "bg.Combined.B", "bg.Vector.X",   "bg.Vector.Y",
    "bg.Vector.Z",   "bg.Vector.W",   "fg.Combined.R", "fg.Combined.G", "fg.Combined.B",
    "fg.Vector.X",   "fg.Vector.Y",   "fg.Vector.Z",   "fg.Vector.W",   "fg.DiffCol.R",
    "fg.DiffCol.G",  "fg.DiffCol.B"};

TEST_F(PassChoosing, TheRenderOfThePlateIsTaken) {
    put("0002.exr", kTwoRenders);
    plate_.path = region_.motion.files = region_.light.albedo = in("####.exr");
    region_.motion.convention = MotionConvention::kBlender;
    plate_.layer = "fg.Combined";
    const PassChoice choice = choose();
    EXPECT_EQ(region_.motion.layer, "fg.Vector");
    EXPECT_EQ(region_.light.pass_layer, "fg.DiffCol");
    EXPECT_THAT(choice.notes, ElementsAre(HasSubstr("belongs to fg.Combined, not bg.Vector")));
    EXPECT_THAT(choice.warnings, IsEmpty());
    // Nothing tells which: the first, with a warning.
    region_.motion.layer.clear();
    plate_.layer.clear();
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("the first in the file")));
    EXPECT_EQ(region_.motion.layer, "bg.Vector");
}

TEST_F(PassChoosing, IdsAreThoseOfTheRenderOfThePlate) {
    put("0001.exr", {"bg.Combined.R", "bg.Combined.G", "bg.Combined.B", "bg.IndexOB.X",
                     "fg.Combined.R", "fg.Combined.G", "fg.Combined.B", "fg.IndexOB.X"});
    MatteSource ids;
    ids.files = plate_.path = in("####.exr");
    ids.select.value = 3;
    region_.matte = ids;
    plate_.layer = "fg.Combined";
    EXPECT_THAT(choose().notes, ElementsAre(HasSubstr("belongs to fg.Combined, not bg.IndexOB")));
    EXPECT_EQ(region_.matte->select.channel, "fg.IndexOB.X");
    EXPECT_THAT(choose().notes, IsEmpty()) << "it is chosen";
    region_.matte = ids;
    plate_.layer.clear();
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("matte.channel")));
    EXPECT_EQ(region_.matte->select.channel, "bg.IndexOB.X");
}

TEST_F(PassChoosing, TheViewOfThePlateIsTaken) {
    put("0001.exr", {"left.R", "left.G", "left.B", "left.Depth.Z", "right.R", "right.G", "right.B",
                     "right.Depth.Z"});
    plate_.path = region_.finish.depth = in("####.exr");
    region_.finish.focus = 1;
    plate_.layer = "right";
    EXPECT_THAT(choose().notes, ElementsAre(HasSubstr("belongs to right, not left.Depth")));
    EXPECT_EQ(region_.finish.depth_layer, "right.Depth");
    // Both are of the first view.
    region_.finish.depth_layer.clear();
    plate_.layer.clear();
    const PassChoice both = choose();
    EXPECT_EQ(region_.finish.depth_layer, "left.Depth");
    EXPECT_THAT(both.notes, ElementsAre(HasSubstr("of the file's first view, not right.Depth")));
    EXPECT_THAT(both.warnings, IsEmpty());
    // Of a plate elsewhere it is not known.
    region_.finish.depth_layer.clear();
    plate_.path = in("plate.png");
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("first view")));
}

// A slanted wall, of which 1/z is straight.
TEST_F(PassChoosing, ADepthPassOfReciprocalsIsNamed) {
    const auto put_wall = [&](const std::string& name, bool reciprocal) {
        OIIO::ImageSpec spec(96, 64, 1, OIIO::TypeHalf);
        spec.channelnames = {"Z"};
        std::vector<float> data;
        for (int i = 0; i < 96 * 64; ++i) {
            const float inverse = 0.1f + 0.002f * static_cast<float>(i % 96);
            data.push_back(reciprocal ? inverse : 1 / inverse);
        }
        auto output = OIIO::ImageOutput::create(in(name));
        ASSERT_TRUE(output->open(in(name), spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    };
    put_wall("z.0001.exr", false);
    put_wall("inverse.0001.exr", true);
    region_.finish.focus = 1;
    region_.finish.depth = in("z.####.exr");
    EXPECT_THAT(choose().warnings, IsEmpty());
    region_.finish.depth = in("inverse.####.exr");
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("reciprocal distances (1/z)")));
}

TEST_F(PassChoosing, APassThatOnlyTheOtherViewHasIsNamed) {
    put("0001.exr",
        {"left.R", "left.G", "left.B", "right.R", "right.G", "right.B", "right.Depth.Z"});
    plate_.path = region_.finish.depth = in("####.exr");
    region_.finish.focus = 1;
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("has the view 'right' only")));
    region_.finish.depth_layer.clear();
    plate_.layer = "right";
    EXPECT_THAT(choose().warnings, IsEmpty());
}

TEST_F(PassChoosing, ThePlateIsNotItsOwnAlbedo) {
    put("0001.exr", {"R", "G", "B"});
    plate_.path = region_.light.albedo = in("####.exr");
    const auto choice = choose_pass_layers(region_, plate_, {1, 2});
    ASSERT_FALSE(choice);
    EXPECT_EQ(choice.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(choice.error().sentence(), HasSubstr("the plate's own picture"));
    region_.light.albedo = in("elsewhere/####.exr");
    EXPECT_TRUE(choose_pass_layers(region_, plate_, {1, 2})) << "missing files are told elsewhere";
}

TEST_F(PassChoosing, ALossyCodecIsNamed) {
    put("0001.exr", {"v.Position.X", "v.Position.Y", "v.Position.Z"},
        [](OIIO::ImageSpec& spec) { spec.attribute("compression", "dwaa"); });
    region_.form.position = in("####.exr");
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("DWAA, which changes its channel Y")));
    EXPECT_EQ(region_.form.position_layer, "v.Position");
}

TEST_F(PassChoosing, TheAxesOfNormalsAreThoseThatTheFileTells) {
    const std::vector<std::string> normals{"v.Normal.X", "v.Normal.Y", "v.Normal.Z"};
    put("0001.exr", normals);
    region_.form.normal = in("####.exr");
    EXPECT_THAT(choose().warnings, ElementsAre(HasSubstr("taken for the camera's")));
    region_.form.normal_space = NormalSpace::kCamera;
    EXPECT_THAT(choose().warnings, IsEmpty());
    region_.form.normal_space = NormalSpace::kAuto;
    put("0001.exr", normals, [](OIIO::ImageSpec& spec) {
        spec.attribute("BlenderMultiChannel", "Blender V2.55.1 and newer");
    });
    EXPECT_THAT(choose().warnings, IsEmpty());
    EXPECT_EQ(axes_of_normals(region_.form, in("0001.exr")), NormalAxes::kWorld);
    region_.form.fov_deg = 48.5;
    const auto refused = read_form_normals(region_, in("0001.exr"), {8, 4});
    ASSERT_FALSE(refused) << "nothing tells the camera's axes";
    EXPECT_THAT(refused.error().sentence(), HasSubstr("world's axes"));
    put("0001.exr", {"nCamera.X", "nCamera.Y", "nCamera.Z"});
    region_.form.normal_layer.clear();
    EXPECT_THAT(choose().warnings, IsEmpty());
    EXPECT_EQ(axes_of_normals(region_.form, in("0001.exr")), NormalAxes::kCamera);
}

}  // namespace
}  // namespace weft
