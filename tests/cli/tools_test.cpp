// weft synth, measure, diff, matte, and movies.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Tools = CliTest;

TEST_F(Tools, ThePublishedSchemasAreThoseOfTheProgram) {
    for (const char* name : {"project", "actions", "report", "motion"}) {
        const Outcome outcome = run({"schema", name});
        expect_success(outcome);
        std::ifstream file((source_folder() + "/docs/schemas/") + name + ".schema.json");
        const std::string published{std::istreambuf_iterator<char>(file), {}};
        EXPECT_EQ(Json::parse(outcome.out, nullptr, false), Json::parse(published, nullptr, false))
            << name << ": weft schema " << name << " > docs/schemas/" << name << ".schema.json";
    }
}

TEST_F(Tools, PartsOfAnUnboundedPlaneFitTogether) {
    expect_success(run({"synth", "sample.png", "-o", "a.png", "--endless", "--size", "150x120",
                        "--at", "-70,100", "--refine", "0"}));
    expect_success(run({"synth", "sample.png", "-o", "b.png", "--endless", "--size", "130x90",
                        "--at", "-10,150", "--refine", "0"}));
    const ImageF3 a = picture("a.png").rgb, b = picture("b.png").rgb;
    int wrong = 0;
    for (int y = 0; y < 70; ++y) {
        for (int x = 0; x < 90; ++x)
            wrong += !std::equal(b.pixel(x, y), b.pixel(x, y) + 3, a.pixel(x + 60, y + 50));
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(run({"synth", "sample.png", "-o", "c.png", "--endless", "--tileable"}).exit, 2);
    EXPECT_EQ(run({"synth", "sample.png", "-o", "c.png", "--endless", "--at", "2000000000,0"}).exit,
              2);
}

TEST_F(Tools, SynthJsonHasEveryKeyOfTheContract) {
    const Outcome outcome = run({"synth", "sample.png", "-o", "plane.png", "--size", "200x150",
                                 "--source-map", "map.exr", "--seed", "7", "--json"});
    expect_success(outcome);
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["size"], (Json{200, 150}));
    EXPECT_EQ(json["seed"], 7);
    EXPECT_EQ(json["backend"], "cpu");
    for (const char* key :
         {"seam_energy", "seam_length_px", "seam_energy_per_area", "peak_graph_bytes", "threads"})
        EXPECT_TRUE(json[key].is_number()) << key;
    double parts = 0;
    for (const char* key : {"search", "seam", "other"})
        parts += json["seconds"][key].get<double>();
    EXPECT_GT(parts, 0);
    EXPECT_LE(parts, json["seconds"]["total"].get<double>() + 1e-3);

    // Each texel is the sample's pixel that the source map names.
    const ImageF3 sample = picture("sample.png").rgb, plane = picture("plane.png").rgb,
                  map = picture("map.exr").rgb;
    ASSERT_EQ(plane.size(), (Size{200, 150}));
    int wrong = 0;
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 200; ++x) {
            const int sx = static_cast<int>(map.at(x, y, 0)),
                      sy = static_cast<int>(map.at(x, y, 1));
            wrong += std::memcmp(plane.pixel(x, y), sample.pixel(sx, sy), 3 * sizeof(float)) != 0;
        }
    EXPECT_EQ(wrong, 0);

    expect_failure(run({"synth", "sample.png", "-o", "plane.png"}), 2,
                   {"plane.png", "--overwrite"});
    expect_failure(run({"synth", "sample.png", "-o", "other.png", "--size", "0x9"}), 2, {"0x9"});
}

TEST_F(Tools, SynthGivesTheSameBytesForTheSameSeed) {
    const auto grow = [&](const std::string& out, const std::string& seed, const char* threads) {
        expect_success(run({"synth", "sample.png", "-o", out, "--size", "160x160", "--seed", seed,
                            "--threads", threads}));
        return bytes(out);
    };
    const std::string first = grow("a.png", "1", "1");
    EXPECT_EQ(grow("b.png", "1", "2"), first);
    EXPECT_NE(grow("c.png", "2", "2"), first);
}

TEST_F(Tools, MeasureJsonHasItsKeys) {
    make_shot(3);
    fs::create_directory(folder_ / "flow");
    FlowField flow(Card::kPlate);
    for (int i = 0; i < Card::kPlate.width * Card::kPlate.height; ++i) {
        flow.d.data()[2 * i] = static_cast<float>(Card::kStepX);
        flow.d.data()[2 * i + 1] = static_cast<float>(Card::kStepY);
    }
    for (const char* name : {"flow/0001.png", "flow/0002.png", "flow/0003.png"})
        ASSERT_TRUE(write_flow_kitti(in(name), flow));
    expect_success(run_replace({"--light", "none", "--quality", "final"}));
    const Outcome outcome =
        run({"measure", "--result", "out/####.png", "--plate", "frames/####.png", "--matte",
             "masks/####.png", "--motion", "flow/####.png", "--plane", "tile.png", "--json"});
    expect_success(outcome);
    const Json json = Json::parse(outcome.out);
    for (const char* key : {"motion", "tde", "source_tde", "tde_floor", "sharpness_kept",
                            "matte_chatter_px", "drift_px", "tiv", "tiv_relative", "per_frame"})
        EXPECT_FALSE(json[key].is_null()) << key;
    EXPECT_EQ(json["frames"], 3);
    EXPECT_EQ(json["per_frame"].size(), 3u);
    EXPECT_EQ(json["outside_differing_px"], 0);
    // The card and its matte move by whole pixels, so the source has no flicker.
    EXPECT_LT(json["matte_chatter_px"]["mean"].get<double>(), 0.01);
    EXPECT_LT(json["source_tde"]["mean"].get<double>(), 0.5);

    const Outcome estimated = run({"measure", "--result", "out/####.png", "--plate",
                                   "frames/####.png", "--matte", "masks/####.png"});
    expect_success(estimated);
    EXPECT_THAT(estimated.out, HasSubstr("motion: "));
    expect_failure(run({"measure", "--result", "none/####.png", "--plate", "frames/####.png",
                        "--matte", "masks/####.png"}),
                   4, {"none/####.png"});
}

// A card whose paint is known, under light that falls off from left to right.
TEST_F(Tools, MeasureComparesLightWithAPassAndTheResultWithATruth) {
    const auto light = [](int x) { return 1.0f - 0.004f * static_cast<float>(x); };
    const auto lit = [&](int, ImageF3& plate) {
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                for (int c = 0; c < 3; ++c)
                    plate.at(x, y, c) *= light(x);
            }
        }
    };
    make_shot(3, 1, ".exr", PixelDepth::kHalf, lit);
    fs::create_directory(folder_ / "light");
    fs::create_directory(folder_ / "true");
    ImageF3 pass(Card::kPlate), grey(64, 64);
    for (int y = 0; y < pass.height(); ++y) {
        for (int x = 0; x < pass.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                pass.at(x, y, c) = light(x);
        }
    }
    std::fill_n(grey.data(), 64 * 64 * 3, 0.3f);
    put_picture("grey.exr", grey, PixelDepth::kFloat);
    for (int frame = 1; frame <= 3; ++frame) {
        const std::string name = "000" + std::to_string(frame) + ".exr";
        put_picture("light/" + name, pass, PixelDepth::kFloat);
        ImageF3 truth = picture("frames/" + name).rgb;
        for (int y = 0; y < truth.height(); ++y) {
            for (int x = 0; x < truth.width(); ++x) {
                if (!Card::covers(frame - 1, x, y)) continue;
                for (int c = 0; c < 3; ++c)
                    truth.at(x, y, c) = 0.3f * light(x);
            }
        }
        put_picture("true/" + name, truth, PixelDepth::kFloat);
    }
    expect_success(run_replace({"--plate", "frames/####.exr", "-o", "out/####.exr", "--plane",
                                "grey.exr", "--quality", "final", "--lighting", "light/####.exr"}));
    const Outcome outcome =
        run({"measure", "--result", "out/####.exr", "--plate", "frames/####.exr", "--matte",
             "masks/####.png", "--lighting", "light/####.exr", "--truth", "true/####.exr",
             "--light-pictures", "pictures", "--cache", "cache", "--json"});
    expect_success(outcome);
    const Json json = Json::parse(outcome.out);
    // Lit by the pass itself: nothing but rounding.
    EXPECT_LT(json["truth"]["inside"]["largest"].get<double>(), 1.0);
    EXPECT_LT(json["truth"]["brightness_error"].get<double>(), 0.01);
    // The estimate separates the pattern from the light, roughly.
    EXPECT_GT(json["light"]["correlation"]["least"].get<double>(), 0.8);
    EXPECT_EQ(json["light"]["per_frame"].size(), 3u);
    EXPECT_GT(json["light"]["true_deviation_levels"]["mean"].get<double>(), 5);
    for (const char* name :
         {"before", "before_shading", "before_reflectance", "after", "after_shading",
          "after_reflectance", "true_shading", "true_reflectance", "shading_difference", "sheet"})
        EXPECT_TRUE(fs::exists(folder_ / "pictures" / (std::string(name) + ".00002.png"))) << name;

    const Outcome missing =
        run({"measure", "--result", "out/####.exr", "--plate", "frames/####.exr", "--matte",
             "masks/####.png", "--truth", "none/####.exr"});
    EXPECT_EQ(missing.exit, 4);
}

class MeasureForm : public CliTest {
  protected:
    static constexpr double kTilt = 0.8;

    void SetUp() override {
        CliTest::SetUp();
        make_shot(3);
        fs::create_directory(folder_ / "p");
        for (const char* name : {"p/0001.exr", "p/0002.exr", "p/0003.exr"})
            put_places(name, Card::kPlate);
    }

    // A plane that turns away downwards, seen from far: flat coordinates are stretched by 1 / cos.
    void put_places(const std::string& name, Size size, float unknown = 0) const {
        ImageF3 places(size);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                places.at(x, y, 0) = 0.01f * static_cast<float>(x) + unknown;
                places.at(x, y, 1) = 0.01f * static_cast<float>(y);
                places.at(x, y, 2) = static_cast<float>(0.01 * y * std::tan(kTilt));
            }
        }
        put_picture(name, places, PixelDepth::kFloat);
    }
    void render() const {
        expect_success(run_replace({"--form", "flat", "--layers", "st", "--layers-output",
                                    "layers/####.exr", "--light", "none"}));
    }
    Outcome measure(const Words& more = {}) const {
        return run(
            with_options({"measure", "--result", "out/####.png", "--plate", "frames/####.png",
                          "--matte", "masks/####.png", "--st", "layers/####.exr", "--position-pass",
                          "p/####.exr", "--plane", "tile.png"},
                         more));
    }
};

TEST_F(MeasureForm, AFlatTextureOnATiltedPlaneIsStretchedByItsCosine) {
    render();
    const Outcome outcome = measure({"--json"});
    expect_success(outcome);
    const Json form = Json::parse(outcome.out)["form"];
    EXPECT_NEAR(form["stretch"]["median"].get<double>(), 1 / std::cos(kTilt), 0.02);
    EXPECT_NEAR(form["rim_stretch"]["median"].get<double>(), 1 / std::cos(kTilt), 0.02);
    EXPECT_LT(form["area_percent"]["median"].get<double>(), 3);
    EXPECT_EQ(form["flipped_share"], 0.0);
    EXPECT_EQ(form["torn_share"], 0.0);
    EXPECT_EQ(form["base_frame"], 1);
    EXPECT_EQ(form["pixels"], 3 * 72 * 52);
    ASSERT_EQ(form["per_frame"].size(), 3u);
    EXPECT_EQ(form["per_frame"][2]["frame"], 3);
    EXPECT_EQ(form["per_frame"][2]["pixels"], 72 * 52);
    EXPECT_THAT(measure().out, HasSubstr("stretch              median 1.4"));
    EXPECT_FALSE(Json::parse(measure({"--json", "--st", ""}).out).contains("form"));
}

TEST_F(MeasureForm, BadInputIsAnErrorThatSaysWhatToDo) {
    render();
    expect_failure(measure({"--position-pass", ""}), 2, {"--position-pass"});
    expect_failure(measure({"--plane", ""}), 2, {"--plane", "a render exports it"});
    expect_failure(measure({"--st", "p/####.exr"}), 3,
                   {"p/0001.exr", "no layer st", "--layers st", "R, G, B"});
    expect_failure(measure({"--st", "layers/none.####.exr"}), 4, {"none.####.exr"});
    expect_failure(measure({"--position-layer", "nowhere"}), 3,
                   {"p/0001.exr", "the channels of a position pass", "--position-layer"});
    put_places("small.exr", {80, 60});
    expect_failure(measure({"--position-pass", "small.exr"}), 3, {"small.exr", "80x60", "160x120"});
    put_places("unknown.exr", Card::kPlate, 1e12f);
    expect_failure(measure({"--position-pass", "unknown.exr"}), 3,
                   {"unknown.exr", "no places inside the matte"});
    fs::remove(folder_ / "layers/0002.exr");
    expect_failure(measure(), 4, {"The layer st", "layers/####.exr", "frame 2", "--frames"});
    expect_success(measure({"--frames", "1,3"}));
    fs::remove(folder_ / "p/0003.exr");
    expect_failure(measure({"--frames", "1,3"}), 4,
                   {"The position pass", "p/####.exr", "frame 3", "--position-pass"});
}

TEST_F(Tools, DiffReportsWhereSequencesDiffer) {
    make_shot(3);
    fs::copy(folder_ / "frames", folder_ / "copy");
    const Outcome same = run({"diff", "frames/####.png", "copy/####.png"});
    expect_success(same);
    ImageF3 touched = picture("copy/0002.png").rgb;
    touched.at(17, 23, 1) += 3.0f / 255;
    put_picture("copy/0002.png", touched);
    const Outcome differs = run({"diff", "frames/####.png", "copy/####.png", "--json"});
    EXPECT_EQ(differs.exit, 8);
    EXPECT_THAT(differs.err, IsEmpty());
    const Json json = Json::parse(differs.out);
    EXPECT_EQ(json["equal"], false);
    EXPECT_EQ(json["differences"][0]["frame"], 2);
    EXPECT_EQ(json["differences"][0]["box"], (Json{17, 23, 18, 24}));
    EXPECT_EQ(run({"diff", "frames/####.png", "copy/####.png", "--tolerance", "0.02"}).exit, 0);
    fs::remove(folder_ / "copy/0003.png");
    expect_failure(run({"diff", "frames/####.png", "copy/####.png"}), 8,
                   {"1-3", "1-2", "--frames"});
    expect_failure(run({"diff", "frames/####.png", "nothing.png"}), 4, {"nothing.png"});
}

TEST_F(Tools, AFrozenMatteIsKeptAndPropagatedFrom) {
    make_shot(4);
    const auto propagate = [&](std::vector<std::string> more, const std::string& out) {
        std::vector<std::string> words{"matte",   "--plate",          "frames/####.png",
                                       "--matte", "1=masks/0001.png", "-o",
                                       out,       "--progress",       "none"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    expect_success(propagate({}, "first/####.png"));
    // Frame 3 is frozen with the matte of frame 1, which propagation would never give.
    fs::create_directories(folder_ / "final");
    fs::copy_file(folder_ / "masks/0001.png", folder_ / "final/0003.png");
    expect_success(propagate({"--matte-frozen", "3", "--matte-frozen-files", "final/####.png"},
                             "second/####.png"));
    EXPECT_EQ(bytes("second/0003.png"), bytes("second/0001.png"));
    EXPECT_NE(bytes("first/0003.png"), bytes("second/0003.png"));
    EXPECT_NE(bytes("first/0004.png"), bytes("second/0004.png"));
    expect_failure(propagate({"--matte-frozen", "3"}, "third/####.png"), 2,
                   {"--matte-frozen-files"});
}

TEST_F(Tools, MattePrintsAConfidenceForEachFrame) {
    make_shot(4);
    const Outcome outcome =
        run({"matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o",
             "mattes/####.png", "--progress", "none"});
    expect_success(outcome);
    EXPECT_THAT(outcome.err, IsEmpty());
    EXPECT_THAT(outcome.out, HasSubstr("matte 1 confidence 1.00\n"));
    EXPECT_THAT(outcome.out, HasSubstr("\nmatte 4 confidence 0."));
    EXPECT_EQ(names("mattes").size(), 4u);
    const auto key = read_matte(in("mattes/0001.png"), {}, {});
    ASSERT_TRUE(key);
    const Matte painted = card_matte(0);
    EXPECT_EQ(std::memcmp(key->data(), painted.data(), painted.size_bytes()), 0);

    const Outcome json = run({"matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png",
                              "-o", "mattes/####.png", "--overwrite", "--json"});
    expect_success(json);
    EXPECT_EQ(Json::parse(json.out)["mattes"].size(), 4u);
    expect_failure(run({"matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o",
                        "mattes/####.png"}),
                   2, {"mattes/0001.png", "--overwrite"});
}

TEST_F(Tools, MattesAreWrittenWithTheirEdges) {
    make_shot(2);
    const auto area = [&](const std::vector<std::string>& edge) {
        std::vector<std::string> words{
            "matte", "--plate",         "frames/####.png", "--matte",    "masks/####.png",
            "-o",    "mattes/####.png", "--overwrite",     "--progress", "none"};
        words.insert(words.end(), edge.begin(), edge.end());
        expect_success(run(words));
        const auto matte = read_matte(in("mattes/0002.png"), {}, {});
        EXPECT_TRUE(matte);
        double sum = 0;
        for (std::size_t i = 0; matte && i < matte->size_bytes(); ++i)
            sum += matte->data()[i] / 255.0;
        return sum;
    };
    const double plain = area({}), grown = area({"--matte-choke", "2"});
    EXPECT_GT(grown, plain + 50);
    EXPECT_NEAR(area({"--matte-choke-keys", "1:0 3:4"}), grown, 1e-6) << "2 px on frame 2";
    EXPECT_LT(area({"--matte-choke=-1.5"}), plain - 40);
    expect_failure(run({"matte", "--plate", "frames/####.png", "--matte", "masks/####.png", "-o",
                        "mattes/####.png", "--overwrite", "--matte-choke", "900"}),
                   2, {"--matte-choke", "900", "200"});
}

TEST_F(Tools, MoviesAreWrittenAndRead) {
    WEFT_NEEDS_MOVIES();
    make_shot(3, 12);
    expect_success(run_replace({"--movie", "review.mkv"}));
    expect_success(run_replace({"-o", "again/####.png", "--movie", "review.mp4"}));
    EXPECT_GT(fs::file_size(folder_ / "review.mp4"), 1000u);
    // The lossless movie holds the frames; as a plate with an empty matte they come back out.
    fs::create_directory(folder_ / "none");
    for (const char* name : {"none/0012.png", "none/0013.png", "none/0014.png"})
        put_matte(name, Matte(Card::kPlate));
    Words words = replace({"--plate", "review.mkv", "--movie-start", "12", "-o", "back/####.png"});
    std::replace(words.begin(), words.end(), std::string("masks/####.png"),
                 std::string("none/####.png"));
    expect_success(run(words));
    EXPECT_EQ(run({"diff", "out/####.png", "back/####.png"}).out,
              "The same: 3 of 3 frames are equal.\n");
}

}  // namespace
}  // namespace weft::test
