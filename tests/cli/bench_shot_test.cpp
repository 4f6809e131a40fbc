// weft bench --shot: figures of whole renders, beside another program's.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

using BenchShot = CliTest;

TEST_F(BenchShot, PrintsEachCaseTheFloorAndTheOtherProgramsRatios) {
    make_shot(3, 1, ".png", PixelDepth::kU8);
    const auto said =
        run({"bench", "sample.png", "--shot", "frames/####.png", "--matte", "masks/####.png",
             "--runs", "1", "--against", "/proc/self/exe", "--json"});
    expect_success(said);
    const auto shot = nlohmann::json::parse(said.out).at("shot");
    for (const char* name :
         {"draft", "draft, analysis cached", "final", "final, analysis cached"}) {
        const auto& figures = shot.at(name);
        EXPECT_GT(figures.at("wall_s").get<double>(), 0) << name;
        EXPECT_GT(figures.at("cpu_s").get<double>(), 0) << name;
        EXPECT_NEAR(figures.at("frames_per_s").get<double>() * figures.at("wall_s").get<double>(),
                    3, 1e-6);
        EXPECT_GT(figures.at("stages_s").at("render").get<double>(), 0) << name;
        EXPECT_GT(figures.at("faster").at("wall").get<double>(), 0) << name;
    }
    EXPECT_GT(shot.at("dis chain").at("frames_per_s").get<double>(), 0);
}

TEST_F(BenchShot, NeedsAMatteAndSaysWhatARunSaid) {
    make_shot(2, 1, ".png", PixelDepth::kU8);
    expect_failure(run({"bench", "sample.png", "--shot", "frames/####.png"}), 2, {"--matte"});
    const auto missing = run({"bench", "sample.png", "--shot", "nowhere/####.png", "--matte",
                              "masks/####.png", "--runs", "1"});
    EXPECT_NE(missing.exit, 0);
    EXPECT_NE(missing.err.find("nowhere"), std::string::npos) << missing.err;
}

}  // namespace
}  // namespace weft::test
