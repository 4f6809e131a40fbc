// What leaves Weft for Blender, in the real program without a screen: node trees, ST-maps, and the
// add-on there and back.
#include <cmath>
#include <cstdlib>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/node_trees.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class BlenderExchange : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        if (std::system("blender --version > /dev/null 2>&1") != 0)
            GTEST_SKIP() << "SKIPPED: there is no blender on this machine (apt install blender)";
    }
    // Runs scripts, the words after them in quotes; WEFT names the program for the add-on.
    void blender(const Words& scripts, const Words& words) const {
        std::string command = "cd '" + folder_.string() + "' && WEFT='" + weft_program() +
                              "' XDG_CACHE_HOME='" + in("home/cache") +
                              "' blender -b --factory-startup";
        for (const std::string& script : scripts)
            command += " --python-exit-code 3 -P '" + script + "'";
        command += " --";
        for (const std::string& word : words)
            command += " '" + word + "'";
        command += " > '" + in("blender.log") + "' 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << bytes("blender.log");
    }
    static std::string script(const std::string& name) {
        return source_folder() + "/tests/data/" + name;
    }
    // A picture whose colours are their own places, 0 to 1 from the lower left.
    void put_ramp(const std::string& name, Size size) const {
        ImageF3 ramp(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ramp.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / static_cast<float>(size.width);
                ramp.at(x, y, 1) =
                    1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height);
                ramp.at(x, y, 2) = 0.5f;
            }
        put_picture(name, ramp, PixelDepth::kFloat);
    }
};

TEST_F(BlenderExchange, TheTreeGivesTheRender) {
    make_shot(2, 1001, ".exr", PixelDepth::kHalf);
    put_picture("tile.png", smooth_plane(), PixelDepth::kU16);
    for (const char* plate : {"frames/####.exr", "png/####.png"}) {
        SCOPED_TRACE(plate);
        if (std::string(plate).ends_with(".png")) {
            fs::create_directories(in("png"));
            for (const int step : {0, 1})
                put_picture("png/" + std::to_string(1001 + step) + ".png", card_plate(step));
        }
        expect_success(run_replace({"--plate", plate, "-o", "out/####.exr", "--depth", "float",
                                    "--quality", "final", "--highlights", "1", "--scale", "2",
                                    "--export-composite", "out/tree.py", "--overwrite"}));
        const Rgba there = read_rgba(in("out/1002.exr"));
        const ImageF1 matte = exr_channel(in("out/1002.exr"), "matte.A");
        for (const int texture : {0, 1}) {
            blender({in("out/tree.py"), script("composite_render.py")},
                    {in("rebuilt.exr"), "1002", std::to_string(texture)});
            const Rgba rebuilt = read_rgba(in("rebuilt.exr"));
            ASSERT_EQ(rebuilt[0].size(), there[0].size());
            float worst = 0;  // steps of a half float
            double off = 0, count = 0;
            for (int y = 0; y < matte.height(); ++y)
                for (int x = 0; x < matte.width(); ++x)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const float a = rebuilt[c].at(x, y), b = there[c].at(x, y);
                        const float size = std::fmax(std::fabs(b), 1.0f / 16);
                        worst = std::fmax(
                            worst, std::fabs(a - b) / std::ldexp(1.0f, std::ilogb(size) - 10));
                        if (matte.at(x, y) < 1) continue;
                        off += std::fabs(a - b);
                        count += 1;
                    }
            std::printf("texture %d: %.2f steps of a half float at most, %.5f in the mean\n",
                        texture, static_cast<double>(worst), off / count);
            EXPECT_GT(count, 10000);
            if (texture == 0) {
                EXPECT_LE(worst, 2.0f);
            }
            EXPECT_LT(off / count, 0.01) << "texture " << texture;
            EXPECT_EQ(off > 0.01 * count * 1e-2, texture == 1) << "the switch does nothing";
        }
    }
}

TEST_F(BlenderExchange, MapUvShowsWhatTheMapsSay) {
    make_shot(3, 1001);
    put_ramp("ramp.exr", Card::kPlate);
    expect_success(run({"new", "shot.weft", "--plate", "frames/####.png"}));
    expect_success(run({"region", "add", "shot.weft", "--name", "card", "--matte", "masks/####.png",
                        "--texture", "sample.png"}));
    expect_success(run(
        {"motion", "shot.weft", "-o", "motion", "--export", "st", "--st-convention", "blender"}));
    for (const char* frame : {"1001", "1003"}) {
        const std::string map = in(std::string("motion/card/st_match_move/") + frame + ".exr");
        blender({script("map_uv.py")}, {in("ramp.exr"), map, in("shown.exr"), "160", "120"});
        const Rgba shown = read_rgba(in("shown.exr")), st = read_rgba(map);
        float worst = 0;
        int compared = 0, same = 0;
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                if (st[3].at(x, y) < 1) continue;  // the rim counts
                ++compared;
                const float dx = 160 * (shown[0].at(x, y) - st[0].at(x, y));
                const float dy = 120 * (shown[1].at(x, y) - st[1].at(x, y));
                worst = std::fmax(worst, std::hypot(dx, dy));
                same += dx == 0 && dy == 0;
            }
        }
        std::printf("frame %s: Map UV is %.5f px off at most\n", frame, static_cast<double>(worst));
        EXPECT_GT(compared, 4700);
        EXPECT_LT(worst, 0.1f);
        if (std::string(frame) == "1001") {
            EXPECT_EQ(same, compared) << "bit for bit";
        }
    }
}

// Unlit and ungraded the patch is the plane through the layer st.
TEST_F(BlenderExchange, MapUvShowsThePatch) {
    make_shot(2, 1001);
    put_ramp("plane.exr", {200, 150});
    expect_success(run_replace(
        {"--plane",       "plane.exr", "--plane-wrap", "clamp",    "--light",   "none",
         "--match-plate", "0",         "--grain",      "0",        "--defocus", "0",
         "--shutter",     "0",         "--light-tint", "0",        "-o",        "out/####.exr",
         "--depth",       "float",     "--layers",     "patch,st", "--quality", "final",
         "--corners",     "10,5",      "150,20",       "140,110",  "20,100"}));
    ImageF3 st(Card::kPlate);
    const std::string frame = in("out/1002.exr");
    for (int c = 0; c < 3; ++c) {
        const ImageF1 channel = exr_channel(frame, std::string("st.") + "RGB"[c]);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x)
                st.at(x, y, c) = channel.at(x, y);
    }
    put_picture("st.exr", st, PixelDepth::kFloat);
    blender({script("map_uv.py")}, {in("plane.exr"), in("st.exr"), in("shown.exr"), "160", "120"});
    const Rgba shown = read_rgba(in("shown.exr"));
    const std::array<ImageF1, 2> patch{exr_channel(frame, "patch.R"),
                                       exr_channel(frame, "patch.G")};
    float worst = 0;
    int compared = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            if (st.at(x, y, 2) < 1) continue;
            ++compared;
            // The plane's colours are places, so what is off is a distance.
            worst = std::fmax(worst, std::hypot(200 * (shown[0].at(x, y) - patch[0].at(x, y)),
                                                150 * (shown[1].at(x, y) - patch[1].at(x, y))));
        }
    std::printf("Map UV is %.4f texels off the patch\n", static_cast<double>(worst));
    EXPECT_GT(compared, 4000);
    EXPECT_LT(worst, 0.1f * 200 / 140) << "a tenth of a pixel, of which there are 140 across";
}

TEST_F(BlenderExchange, TheAddOnGoesThereAndBack) {
    put_picture("old.png", pattern_picture({512, 512}, 31));
    put_picture("new.png", smooth_plane());
    blender({script("addon_round_trip.py")}, {source_folder() + "/packaging/blender", in("weft"),
                                              "144", in("old.png"), in("new.png")});
    EXPECT_THAT(bytes("blender.log"), HasSubstr("round trip done"));
    EXPECT_EQ(names("weft/cg"), (Words{"0001.exr", "0002.exr", "0003.exr"}));
    const std::string project = bytes("weft/shot.weft");
    for (const char* part :
         {"ViewLayer.Vector", "ViewLayer.Position", "ViewLayer.Normal", "ViewLayer.Depth",
          "ViewLayer.DiffDir+ViewLayer.DiffInd", "Wall\\\\, \\\\\\\"left", "\"fov_deg\""})
        EXPECT_THAT(project, HasSubstr(part));
    const std::string result = in("weft/out/0003.exr");
    const ImageF1 matte = exr_channel(in("weft/layers/0003.exr"), "matte.A");
    const Rgba by_nodes = read_rgba(in("weft/by_nodes.exr")),
               by_uvs = read_rgba(in("weft/by_uvs.exr"));
    double nodes = 0, uvs = 0, changed = 0, count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string channel = std::string("ViewLayer.Combined.") + "RGB"[c];
        const ImageF1 weft = exr_channel(result, channel),
                      sent = exr_channel(in("weft/cg/0003.exr"), channel);
        for (int y = 0; y < matte.height(); ++y)
            for (int x = 0; x < matte.width(); ++x) {
                if (matte.at(x, y) < 1) continue;
                nodes += std::fabs(by_nodes[c].at(x, y) - weft.at(x, y));
                uvs += std::fabs(by_uvs[c].at(x, y) - weft.at(x, y));
                changed += std::fabs(sent.at(x, y) - weft.at(x, y));
                count += 1;
            }
    }
    std::printf("of Weft's result: nodes %.5f, texture by UVs %.4f off; the plate %.4f\n",
                nodes / count, uvs / count, changed / count);
    EXPECT_GT(count, 3.0 * 10000);
    EXPECT_LT(nodes / count, 1e-3);
    EXPECT_LT(uvs, 0.2 * changed) << "0.11 was measured, 0.02 with a texture of 512 px";
}

}  // namespace
}  // namespace weft::test
