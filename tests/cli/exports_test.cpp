// The texture plane and the ST-maps, which other programs rebuild the texture from.
#include <cmath>
#include <cstdlib>

#include "engine/color/color_space.h"
#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

// Nothing but the texture: no light, grain, blur or exposure.
const Words kUnlit{"--light",   "none", "--match-plate", "0", "--grain",      "0",
                   "--defocus", "0",    "--shutter",     "0", "--light-tint", "0"};

Words unlit(const Words& more) {
    Words words = kUnlit;
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

class Exports : public CliTest {
  protected:
    ImageF3 plane_in_linear_light(const std::string& name) const {
        ImageF3 out = picture(name).rgb;
        const auto linear = make_color_transform({"srgb"}, {"linear"});
        EXPECT_TRUE(linear);
        (*linear)->apply(out);
        return out;
    }
    ImageF2 st(const std::string& name, const std::string& layer) const {
        const auto found = read_uv(in(name), layer, Card::kPlate);
        EXPECT_TRUE(found) << (found ? "" : found.error().text());
        return found ? *found : ImageF2(Card::kPlate);
    }
};

// Between the centres of four texels, repeating.
float texel(const ImageF3& plane, float s, float t, int c) {
    const float x = s * static_cast<float>(plane.width()) - 0.5f,
                y = (1 - t) * static_cast<float>(plane.height()) - 0.5f;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    const auto at = [&](int a, int b) {
        const int w = plane.width(), h = plane.height();
        return plane.at(((a % w) + w) % w, ((b % h) + h) % h, c);
    };
    return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) +
           v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

struct Difference {
    int pixels = 0, above_one = 0;  ///< Compared; off by more than a level.
    float worst = 0;                ///< Levels of 255 in sRGB.
};

// The patch of a frame against what the plane and its layer st give.
Difference rebuilt(const ImageF3& plane, const ImageF2& st, const PlateFrame& patch) {
    const auto srgb = make_color_transform({"linear"}, {"srgb"});
    EXPECT_TRUE(srgb);
    ImageF3 again(patch.rgb.size()), shown = patch.rgb;
    for (int y = 0; y < again.height(); ++y)
        for (int x = 0; x < again.width(); ++x)
            for (int c = 0; c < 3; ++c)
                again.at(x, y, c) = texel(plane, st.at(x, y, 0), st.at(x, y, 1), c);
    (*srgb)->apply(again);
    (*srgb)->apply(shown);
    Difference out;
    for (int y = 0; y < again.height(); ++y) {
        for (int x = 0; x < again.width(); ++x) {
            if (patch.alpha.at(x, y) < 1) continue;
            float off = 0;
            for (int c = 0; c < 3; ++c)
                off = std::max(off, 255 * std::abs(again.at(x, y, c) - shown.at(x, y, c)));
            ++out.pixels;
            out.above_one += off > 1;
            out.worst = std::max(out.worst, off);
        }
    }
    return out;
}

TEST_F(Exports, ThePlaneAndTheLayerStGiveThePatchAgain) {
    make_shot(3);
    put_picture("waves.png", smooth_plane(), PixelDepth::kU16);
    for (const char* format : {"png", "exr"}) {
        SCOPED_TRACE(format);
        const std::string plane = std::string("plane.") + format;
        expect_success(run_replace(unlit(
            {"--plane", "waves.png", "--scale", "2", "--layers", "st,patch", "--layers-output",
             "layers/####.exr", "--form-shape", "plane:50,40,90,40,105,75,35,75", "--export-plane",
             plane, "--overwrite", "--quality", "final"})));
        EXPECT_EQ(read_recipe_metadata(in(plane))["weft:plane"], "128x128");
        const auto patch = read_image(in("layers/0003.exr"), "patch");
        ASSERT_TRUE(patch) << patch.error().text();
        const Difference off =
            rebuilt(plane_in_linear_light(plane), st("layers/0003.exr", "st"), *patch);
        EXPECT_GT(off.pixels, 4000);
        EXPECT_LE(off.worst, 1.0f);
    }
}

TEST_F(Exports, AGrownPlaneIsWrittenAsItIsLookedUp) {
    make_shot(2);
    put_picture("waves.png", smooth_plane(32), PixelDepth::kU16);
    expect_success(run_replace(
        unlit({"--plane", "", "--texture", "waves.png", "--texture-mode", "synthesize", "--layers",
               "st,patch", "--layers-output", "layers/####.exr", "--export-plane", "plane.exr"})));
    const ImageF3 plane = plane_in_linear_light("plane.exr");
    EXPECT_EQ(read_recipe_metadata(in("plane.exr"))["weft:plane"],
              std::to_string(plane.width()) + "x" + std::to_string(plane.height()));
    EXPECT_GE(plane.width(), 512);
    const auto patch = read_image(in("layers/0002.exr"), "patch");
    ASSERT_TRUE(patch) << patch.error().text();
    const Difference off = rebuilt(plane, st("layers/0002.exr", "st"), *patch);
    EXPECT_GT(off.pixels, 4000);
    EXPECT_LT(off.above_one, off.pixels / 20) << "beside seams";
}

TEST_F(Exports, StMapsPointToTheReferenceFrameAndBack) {
    make_shot(3);
    expect_success(run_replace({"--quality", "final", "--export-st-maps", "st/####.exr"}));
    EXPECT_EQ(names("st"), (Words{"0001.exr", "0002.exr", "0003.exr"}));
    const ImageF2 warp = st("st/0003.exr", ""), back = st("st/0003.exr", "stabilize");
    const auto shown = read_image(in("st/0003.exr"));
    ASSERT_TRUE(shown) << shown.error().text();
    const Vec2i c = Card::corner(2);
    int compared = 0;
    for (int y = c.y + 8; y < c.y + Card::kHeight - 8; ++y) {
        for (int x = c.x + 8; x < c.x + Card::kWidth - 8; ++x) {
            ASSERT_EQ(shown->alpha.at(x, y), 1.0f);
            ASSERT_EQ(shown->rgb.at(x, y, 2), 1.0f) << "Blender's Map UV multiplies by blue";
            EXPECT_NEAR(warp.at(x, y, 0) * 160, static_cast<float>(x) + 0.5f - 4, 0.1f);
            EXPECT_NEAR((1 - warp.at(x, y, 1)) * 120, static_cast<float>(y) + 0.5f - 2, 0.1f);
            EXPECT_NEAR(back.at(x - 4, y - 2, 0) * 160, static_cast<float>(x) + 0.5f, 0.1f);
            EXPECT_NEAR((1 - back.at(x - 4, y - 2, 1)) * 120, static_cast<float>(y) + 0.5f, 0.1f);
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000);
    EXPECT_EQ(shown->alpha.at(4, 4), 0.0f);
    EXPECT_EQ(shown->rgb.at(4, 4, 2), 0.0f);
}

// oiiotool counts t from the top unless it is told otherwise. The rim counts, too.
TEST_F(Exports, OiiotoolShowsWhatTheMapsSay) {
    if (std::system("oiiotool --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "SKIPPED: there is no oiiotool (apt install openimageio-tools)";
    make_shot(3);
    expect_success(run_replace({"--quality", "final", "--export-st-maps", "st/####.exr"}));
    ImageF3 ramp(Card::kPlate);  // colours that are their own places
    for (int y = 0; y < ramp.height(); ++y) {
        for (int x = 0; x < ramp.width(); ++x) {
            ramp.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / 160;
            ramp.at(x, y, 1) = 1 - (static_cast<float>(y) + 0.5f) / 120;
        }
    }
    put_picture("ramp.exr", ramp, PixelDepth::kFloat);
    const std::string command = "cd '" + folder_.string() +
                                "' && oiiotool ramp.exr st/0003.exr --st_warp:flip_t=1 "
                                "-d float -o shown.exr";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const PlateFrame shown = picture("shown.exr"), map = picture("st/0003.exr");
    float worst = 0;
    int compared = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            if (map.alpha.at(x, y) < 1) continue;
            ++compared;
            worst =
                std::max(worst, std::hypot(160 * (shown.rgb.at(x, y, 0) - map.rgb.at(x, y, 0)),
                                           120 * (shown.rgb.at(x, y, 1) - map.rgb.at(x, y, 1))));
        }
    }
    EXPECT_GT(compared, 4700);
    EXPECT_LT(worst, 0.1f);
}

TEST_F(Exports, WhatCannotBeWrittenIsRefusedBeforeAnyWork) {
    make_shot(2);
    const auto refused = [&](const Words& more, const Words& parts) {
        expect_failure(run_replace(more), 2, parts);
        EXPECT_FALSE(fs::exists(in("out")));
    };
    refused({"--export-plane", "plane.jpg"}, {"plane.jpg", ".png"});
    refused({"--export-plane", "tile.png"}, {"tile.png"});
    refused({"--plane", "", "--texture", "sample.png", "--temporal", "none", "--export-plane",
             "plane.png"},
            {"no texture plane", "--temporal locked"});
    refused({"--export-st-maps", "st/####.png"}, {"st/####.png", "EXR"});
    refused({"--export-st-maps", "st.exr"}, {"st.exr", "frame number"});
    refused({"--plane", "", "--texture", "sample.png", "--temporal", "none", "--export-st-maps",
             "st/####.exr"},
            {"ST-maps", "--temporal locked"});
    put("plane.png", "mine");
    refused({"--export-plane", "plane.png"}, {"plane.png exists already"});
    EXPECT_EQ(bytes("plane.png"), "mine");
    EXPECT_FALSE(fs::exists(in("st")));
}

TEST_F(Exports, AProjectOfTwoRegionsHasNoOnePlane) {
    make_shot(2);
    expect_success(run({"new", "shot.weft", "--plate", "frames/####.png", "-o", "out/####.png"}));
    for (const char* name : {"wall", "floor"})
        expect_success(run({"region", "add", "shot.weft", "--name", name, "--matte",
                            "masks/####.png", "--texture", "sample.png"}));
    expect_failure(run({"render", "shot.weft", "--export-plane", "plane.png"}), 2,
                   {"2 regions", "--enabled"});
    EXPECT_FALSE(fs::exists(in("plane.png")));
}

}  // namespace
}  // namespace weft::test
