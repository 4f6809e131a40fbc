// A rendered shot from the Cryptomatte pick to the exported EXR without painted mattes: with exact
// coordinates and light, the result equals a render with the new texture.
#include <cstdlib>

#include <cmath>

#include "engine/color/color_space.h"
#include "engine/media/cryptomatte.h"
#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Without detail finer than a renderer's pixel filter, which is wider than Weft's.
ImageF3 smooth_picture(std::uint64_t seed) {
    constexpr int kSide = 512, kScale = 8;
    const ImageF3 coarse = pattern_picture({kSide / kScale + 2, kSide / kScale + 2}, seed);
    ImageF3 out(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int u = x / kScale, v = y / kScale;
            const float fx = static_cast<float>(x % kScale) / kScale,
                        fy = static_cast<float>(y % kScale) / kScale;
            for (int c = 0; c < 3; ++c) {
                const float top = coarse.at(u, v, c) * (1 - fx) + coarse.at(u + 1, v, c) * fx,
                            bottom =
                                coarse.at(u, v + 1, c) * (1 - fx) + coarse.at(u + 1, v + 1, c) * fx;
                out.at(x, y, c) = top * (1 - fy) + bottom * fy;
            }
        }
    }
    return out;
}

class BlenderShot : public CliTest {
  protected:
    bool blender(const std::string& output, const std::string& picture) const {
        const std::string command = "blender -b --factory-startup -P " + source_folder() +
                                    "/tests/data/studio_shot.py -- '" + in(output) +
                                    "' 320 180 4 16 '" + in(picture) + "' > '" + in("blender.log") +
                                    "' 2>&1";
        return std::system(command.c_str()) == 0;
    }
};

TEST_F(BlenderShot, FromThePickToTheExportedFrames) {
    if (std::system("blender --version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "SKIPPED: there is no blender on this machine (apt install blender)";
    put_picture("old.png", pattern_picture({512, 512}, 31));
    put_picture("new.png", smooth_picture(77));
    fs::create_directories(folder_ / "cg");
    fs::create_directories(folder_ / "truth");
    ASSERT_TRUE(blender("cg/####.exr", "old.png")) << bytes("blender.log");
    ASSERT_TRUE(blender("truth/####.exr", "new.png")) << bytes("blender.log");

    const Outcome pick = run({"cryptomatte", "cg/0001.exr", "--at", "250,50"});
    expect_success(pick);
    EXPECT_THAT(pick.out, HasSubstr("/Wall"));
    const Outcome rendered = run({"replace",
                                  "--plate",
                                  "cg/####.exr",
                                  "--plate-layer",
                                  "shot.Combined",
                                  "--matte",
                                  "crypto:Wall",
                                  "--motion",
                                  "cg/####.exr",
                                  "--motion-convention",
                                  "blender",
                                  "--motion-direction",
                                  "backward",
                                  "--uv",
                                  "cg/####.exr",
                                  "--plane",
                                  "new.png",
                                  "--albedo",
                                  "cg/####.exr",
                                  "--light-exact",
                                  "--grain",
                                  "0",
                                  "--defocus",
                                  "0",
                                  "--shutter",
                                  "0",
                                  "-o",
                                  "out/####.exr",
                                  "--layers",
                                  "all",
                                  "--backend",
                                  "cpu"});
    expect_success(rendered);

    const auto display = make_color_transform({"linear"}, {"srgb"}).value();
    for (int frame = 1; frame <= 4; ++frame) {
        const std::string name = "/000" + std::to_string(frame) + ".exr";
        ImageF3 ours = read_image(in("out" + name), "shot.Combined").value().rgb;
        ImageF3 truth = read_image(in("truth" + name), "shot.Combined").value().rgb;
        ImageF3 plate = read_image(in("cg" + name), "shot.Combined").value().rgb;
        const Matte wall = read_cryptomatte(in("cg" + name), "Wall", {}).value();
        const ImageF3 source = plate;
        for (ImageF3* image : {&ours, &truth, &plate})
            display->apply(*image);
        double off = 0, moved = 0, count = 0;
        for (int y = 0; y < wall.height(); ++y) {
            for (int x = 0; x < wall.width(); ++x) {
                if (wall.at(x, y) == 0) continue;
                for (int c = 0; c < 3; ++c) {
                    const auto level = [&](const ImageF3& image) {
                        return 255.0 * std::fmin(1.0, std::fmax(0.0, image.at(x, y, c)));
                    };
                    off += std::abs(level(ours) - level(truth));
                    moved += std::abs(level(plate) - level(truth));
                    count += 1;
                }
            }
        }
        std::printf("frame %d: %.2f levels off, %.2f before\n", frame, off / count, moved / count);
        EXPECT_LE(off / count, 2.0) << frame;
        EXPECT_GT(moved / count, 10.0) << frame;
        // The other passes are unchanged.
        EXPECT_EQ(read_image(in("out" + name), "shot.DiffCol").value().rgb,
                  read_image(in("cg" + name), "shot.DiffCol").value().rgb);
        EXPECT_FALSE(list_cryptomatte(in("out" + name)).value().empty());
    }
}

}  // namespace
}  // namespace weft::test
