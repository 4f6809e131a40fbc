// weft measure of plates and results with an alpha.
#include <nlohmann/json.hpp>

#include "engine/color/color_space.h"
#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

using MeasureAlpha = CliTest;

// An EXR holds colours multiplied by the alpha, a PNG holds them straight, a JPEG and a movie lie
// over black.
TEST_F(MeasureAlpha, PicturesAreComparedAlike) {
    make_shot(1);
    const ImageF3 codes = picture("frames/0001.png").rgb;
    ImageF1 half(codes.size(), 0.5f);
    WriteOptions options;
    options.rule = WriteRule::own();
    for (const char* folder : {"straight", "associated", "opaque"})
        fs::create_directory(in(folder));
    ASSERT_TRUE(write_image(in("straight/0001.png"), codes, half, options));
    ASSERT_TRUE(write_image(in("opaque/0001.jpg"), codes, half, options));
    options.depth = PixelDepth::kHalf;
    const auto to_linear = make_color_transform({"srgb"}, {"linear"});
    ImageF3 linear = codes;
    (*to_linear)->apply(linear);
    ASSERT_TRUE(write_image(in("associated/0001.exr"), linear, half, options));
    const auto measured = [&](const Words& result, const std::string& plate) {
        Words words{"measure",  "--plate", plate,    "--matte", "masks/####.png",
                    "--frames", "1",       "--json", "--result"};
        words.insert(words.end(), result.begin(), result.end());
        const Outcome outcome = run(words);
        expect_success(outcome);
        return Json::parse(outcome.out, nullptr, false)["per_frame"][0];
    };
    for (const auto& [result, plate] : {std::pair("straight/####.png", "associated/####.exr"),
                                        {"associated/####.exr", "straight/####.png"},
                                        {"opaque/####.jpg", "straight/####.png"}}) {
        const Json frame = measured({result}, plate);
        EXPECT_GT(frame["region_px"].get<int>(), 0) << result;
        EXPECT_NEAR(frame["mean_v"].get<double>(), frame["source_mean_v"].get<double>(), 1.0)
            << result;
    }
}

}  // namespace
}  // namespace weft::test
