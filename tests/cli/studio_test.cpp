// Studio features: layers, versions, gaps, burn-in, cuts.
#include <nlohmann/json.hpp>

#include <cmath>

#include "engine/media/exr_frame.h"
#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Studio : public CliTest {
  protected:
    // A layer's three channels.
    ImageF3 layer(const std::string& name, const std::string& layer_name) {
        auto read = read_image(in(name), layer_name);
        EXPECT_TRUE(read) << layer_name;
        return read ? std::move(read->rgb) : ImageF3();
    }
    ImageF1 alpha(const std::string& name, const std::string& layer_name) {
        auto read = read_image(in(name), layer_name);
        EXPECT_TRUE(read) << layer_name;
        return read ? std::move(read->alpha) : ImageF1();
    }
};

TEST_F(Studio, LayersReproduceTheOutput) {
    make_shot(3, 1, ".exr", PixelDepth::kHalf);
    // A soft matte, so that there are edges to correct.
    for (int step = 0; step < 3; ++step) {
        Matte soft = card_matte(step);
        const Matte hard = soft;
        for (int y = 2; y < soft.height() - 2; ++y)
            for (int x = 2; x < soft.width() - 2; ++x)
                soft.at(x, y) = static_cast<std::uint8_t>((hard.at(x - 2, y) + hard.at(x + 2, y) +
                                                           hard.at(x, y - 2) + hard.at(x, y + 2)) /
                                                          4);
        put_matte("masks/000" + std::to_string(step + 1) + ".png", soft);
    }
    expect_success(
        run_replace({"--plate", "frames/####.exr", "-o", "out/####.exr", "--layers", "all"}));
    const ImageF3 plate = layer("frames/0002.exr", ""), out = layer("out/0002.exr", "");
    const ImageF3 patch = layer("out/0002.exr", "patch"), edge = layer("out/0002.exr", "edge");
    const ImageF1 a = alpha("out/0002.exr", "patch");
    double worst = 0;
    int soft = 0;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float share = a.at(x, y);
            soft += share > 0 && share < 1;
            for (int c = 0; c < 3; ++c) {
                const float again =
                    plate.at(x, y, c) * (1 - share) + patch.at(x, y, c) + edge.at(x, y, c);
                // Four halves are added: each is within 2^-11 of itself.
                const double unit = (std::abs(plate.at(x, y, c)) + std::abs(patch.at(x, y, c)) +
                                     std::abs(edge.at(x, y, c)) + std::abs(out.at(x, y, c))) /
                                        2048.0 +
                                    1e-6;
                worst = std::max(worst, std::abs(again - out.at(x, y, c)) / unit);
            }
        }
    }
    EXPECT_GT(soft, 100);
    EXPECT_LE(worst, 1.0);
    // The place in the plane moves with the card, and 0–1 is the whole plane.
    const ImageF3 st = layer("out/0002.exr", "id");
    EXPECT_EQ(st.at(80, 60, 0), 1.0f);
    EXPECT_EQ(st.at(2, 2, 0), 0.0f);
}

TEST_F(Studio, LayersNeedAnExr) {
    make_shot(2);
    expect_failure(run_replace({"--layers", "patch"}), 2, {"--layers-output"});
    expect_failure(run_replace({"--layers", "beauty", "-o", "o/####.exr"}), 2, {"beauty", "patch"});
    expect_success(run_replace({"--layers", "patch,matte", "--layers-output", "layers/####.exr"}));
    EXPECT_EQ(names("layers").size(), 2u);
    EXPECT_FALSE(alpha("layers/0001.exr", "patch").empty());
}

TEST_F(Studio, LayersOfPlacesAreKeptFromLossyCompression) {
    make_shot(2);
    const Words lossy{"--exr-compression", "dwaa", "-o", "out/####.exr"};
    const auto with_layers = [&](const std::string& layers) {
        Words arguments = lossy;
        arguments.insert(arguments.end(), {"--layers", layers});
        return run_replace(arguments);
    };
    expect_failure(with_layers("patch,st"), 2, {"'st'", "--exr-compression", "zip"});
    expect_failure(with_layers("id"), 2, {"'id'"});
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    expect_success(with_layers("patch"));
}

TEST_F(Studio, VersionUpTakesTheNextFreeOne) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    const std::string pattern = "v002/shot_v002.####.png";
    expect_success(run_replace({"-o", pattern, "--version-up"}));
    EXPECT_EQ(names("v002").size(), 2u);
    expect_success(run_replace({"-o", pattern, "--version-up", "--movie", "shot_v002.mkv"}));
    EXPECT_EQ(names("v003"), (Words{"shot_v003.0001.png", "shot_v003.0002.png"}));
    EXPECT_TRUE(fs::exists(folder_ / "shot_v003.mkv"));
    fs::create_directories(folder_ / "v007");
    put("v007/shot_v007.0001.png", "x");
    expect_success(run_replace({"-o", pattern, "--version-up"}));
    EXPECT_EQ(names("v008").size(), 2u);
    expect_failure(run_replace({"-o", "out/####.png", "--version-up"}), 2, {"_v001"});
}

TEST_F(Studio, MissingFramesAreHeldBlackOrSkipped) {
    make_shot(5);
    fs::remove(folder_ / "frames/0003.png");
    fs::remove(folder_ / "masks/0003.png");
    EXPECT_EQ(run_replace({"--frames", "1-5"}).exit, 4);
    EXPECT_EQ(run_replace({}).exit, 4);
    expect_success(run_replace({"--missing", "hold", "-o", "hold/####.png"}));
    EXPECT_EQ(names("hold").size(), 5u);
    EXPECT_EQ(picture("hold/0003.png").rgb, picture("hold/0002.png").rgb);
    expect_success(run_replace({"--missing", "black", "-o", "black/####.png"}));
    EXPECT_EQ(picture("black/0003.png").rgb, ImageF3(Card::kPlate));
    expect_success(run_replace({"--missing", "skip", "-o", "skip/####.png"}));
    EXPECT_EQ(names("skip"), (Words{"0001.png", "0002.png", "0004.png", "0005.png"}));
    EXPECT_EQ(bytes("skip/0005.png").size(), bytes("hold/0005.png").size());
    EXPECT_EQ(picture("skip/0005.png").rgb, picture("hold/0005.png").rgb);
    expect_success(run_replace({"--missing", "hold", "--frames", "4-7", "-o", "late/####.png"}));
    EXPECT_EQ(picture("late/0007.png").rgb, picture("late/0005.png").rgb);
}

TEST_F(Studio, ACutGivesAWarning) {
    make_shot(8, 1, ".png", PixelDepth::kU8, [](int frame, ImageF3& plate) {
        if (frame < 5) return;
        for (int y = 0; y < plate.height(); ++y)
            for (int x = 0; x < plate.width(); ++x)
                for (int c = 0; c < 3; ++c)
                    plate.at(x, y, c) = x < 80 ? 0.05f : 0.95f;
    });
    EXPECT_THAT(run_replace().err, HasSubstr("new scene seems to begin at frame 5"));
    fs::remove_all(folder_ / "frames");
    fs::remove_all(folder_ / "out");
    make_shot(8);
    EXPECT_THAT(run_replace().err, Not(HasSubstr("new scene")));
}

TEST_F(Studio, BurnInAffectsTheMovieOnly) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    expect_success(run_replace({"-o", "a_v012.####.png", "--movie", "plain.mkv"}));
    expect_success(run_replace({"-o", "b_v012.####.png", "--movie", "burnt.mkv", "--burn-in"}));
    EXPECT_EQ(bytes("a_v012.0001.png"), bytes("b_v012.0001.png"));
    EXPECT_EQ(run({"diff", "plain.mkv", "burnt.mkv"}).exit, 8);
    const auto burnt = open_plate(in("burnt.mkv"), {}).value()->read(1001).value();
    int white = 0;
    for (int y = 108; y < 120; ++y)
        for (int x = 0; x < 80; ++x)
            white += burnt.rgb.at(x, y, 0) > 0.9f && burnt.rgb.at(x, y, 2) > 0.9f;
    EXPECT_GT(white, 20);
}

TEST_F(Studio, APlatesPixelAspectIsKept) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    for (int frame = 1; frame <= 2; ++frame) {
        WriteOptions options;
        options.depth = PixelDepth::kHalf;
        options.pixel_aspect = 2;
        const std::string name = "wide.000" + std::to_string(frame) + ".exr";
        ASSERT_TRUE(write_image(in(name), card_plate(frame - 1), {}, options));
    }
    for (const char* extension : {".exr", ".tif", ".png", ".dpx", ".jpg"}) {
        const std::string pattern = std::string("out/####") + extension;
        expect_success(run_replace({"--plate", "wide.####.exr", "-o", pattern, "--movie",
                                    std::string("m") + extension + ".mkv"}));
        EXPECT_NEAR(open_plate(in("out/0001") + extension, {}).value()->pixel_aspect(), 2.0, 0.01)
            << extension;
    }
    EXPECT_NEAR(open_plate(in("m.exr.mkv"), {}).value()->pixel_aspect(), 2.0, 0.01);
}

}  // namespace
}  // namespace weft::test
