// User errors, one test each: one clear line (what, where, what to do), the exit code, and no
// partial files.
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using BadInput = CliTest;

TEST_F(BadInput, MissingFrameInTheMiddle) {
    make_shot(5);
    fs::remove(folder_ / "frames/0003.png");
    expect_failure(run_replace(), 4, {"frame 3", "--frames"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, FramesMissingInThePlate) {
    make_shot(3);
    expect_failure(run_replace({"--frames", "2-9"}), 4, {"frames/####.png", "4-9", "1-3"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, NoFrameAtAll) {
    fs::create_directory(folder_ / "frames");
    expect_failure(run_replace(), 4, {"frames/####.png"});
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(BadInput, NoSuchFolder) {
    expect_failure(run_replace(), 4, {"frames/####.png"});
}

TEST_F(BadInput, TruncatedFrameIsNamed) {
    make_shot(4);
    const std::string whole = bytes("frames/0003.png");
    put("frames/0003.png", whole.substr(0, whole.size() / 2));
    expect_failure(run_replace(), 3, {"frames/0003.png"});
    EXPECT_THAT(names("out"), IsEmpty());
    EXPECT_THAT(names("tmp"), IsEmpty());
}

TEST_F(BadInput, EmptyFileInsteadOfAFrame) {
    make_shot(3);
    put("frames/0001.png", "");
    expect_failure(run_replace(), 3, {"frames/0001.png"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, FrameOfAnotherSize) {
    make_shot(3);
    put_picture("frames/0002.png", pattern_picture({150, 120}, 3));
    expect_failure(run_replace(), 3, {"frames/0002.png", "150", "160"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, MatteOfAnotherSize) {
    make_shot(3);
    put_matte("masks/0002.png", Matte(Size{80, 60}, 255));
    expect_failure(run_replace(), 3, {"masks/0002.png", "80", "160"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, MatteMissingForAFrame) {
    make_shot(3);
    fs::remove(folder_ / "masks/0003.png");
    expect_failure(run_replace(), 4, {"matte", "frame 3", "--frames"});
    EXPECT_THAT(names("out"), IsEmpty());
}

// Excluding the frame does not help if the surface must be tracked through it.
TEST_F(BadInput, MatteGapBetweenTheReferenceAndTheFrames) {
    make_shot(6);
    fs::remove(folder_ / "masks/0003.png");
    expect_failure(run_replace({"--frames", "4-6", "--reference-frame", "1"}), 4,
                   {"matte", "frame 3", "reference frame 1", "--reference-frame 4"});
    expect_failure(run_replace({"--frames", "1-2", "--reference-frame", "5"}), 4,
                   {"matte", "frame 3", "reference frame 5", "--reference-frame 1"});
    expect_success(run_replace({"--frames", "4-6", "--reference-frame", "4"}));
}

TEST_F(BadInput, MatteForNoFrameOfThePlate) {
    make_shot(3);
    expect_failure(run_replace({"--matte", "elsewhere/####.png"}), 2, {"second matte"});
    fs::remove_all(folder_ / "masks");
    fs::create_directory(folder_ / "masks");
    put_matte("masks/0077.png", card_matte(0));
    expect_failure(run_replace(), 4, {"masks/####.png", "1-3"});
}

TEST_F(BadInput, MatteKeyframeOnAFrameThatDoesNotExist) {
    make_shot(3);
    Words words = replace();
    words.erase(words.begin() + 3, words.begin() + 5);
    words.insert(words.end(), {"--matte", "12=masks/0001.png"});
    expect_failure(run(words), 4, {"12"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, MatteKeyframeWhoseFileIsMissing) {
    make_shot(3);
    Words words = replace();
    words.erase(words.begin() + 3, words.begin() + 5);
    words.insert(words.end(), {"--matte", "2=nothing.png"});
    expect_failure(run(words), 4, {"nothing.png"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, MatteEmptyOnEveryFrameLeavesThePlate) {
    make_shot(3);
    for (const char* name : {"masks/0001.png", "masks/0002.png", "masks/0003.png"})
        put_matte(name, Matte(Card::kPlate));
    const Outcome outcome = run_replace();
    expect_success(outcome);
    expect_one_line(outcome.err, {"warning", "matte", "empty"});
    expect_success(run({"diff", "frames/####.png", "out/####.png"}));
}

TEST_F(BadInput, MatteEmptyOnTheFirstFramesMovesTheReference) {
    make_shot(4);
    for (const char* name : {"masks/0001.png", "masks/0002.png"})
        put_matte(name, Matte(Card::kPlate));
    const Outcome outcome = run_replace({"--report", "report.json"});
    expect_success(outcome);
    EXPECT_THAT(outcome.err, HasSubstr("the reference frame is 3"));
    EXPECT_THAT(outcome.err, HasSubstr("empty on frames 1-2:"));
    EXPECT_THAT(bytes("report.json"), HasSubstr("\"frame\": 3,\n      \"chosen\": true"));
    const auto by_default = contents("out");
    expect_success(run_replace({"--reference-frame", "3", "-o", "given/####.png"}));
    EXPECT_EQ(contents("given"), by_default);
    // A part of the shot uses the same reference.
    expect_success(run_replace({"--frames", "4", "-o", "part/####.png"}));
    EXPECT_EQ(contents("part").at("0004.png"), by_default.at("0004.png"));
}

TEST_F(BadInput, MatteEmptyOnTheGivenReferenceFrameNamesABetterOne) {
    make_shot(4);
    put_matte("masks/0001.png", Matte(Card::kPlate));
    const Words words = replace({"--reference-frame", "1"});
    for (const bool dry : {true, false}) {
        Words all = words;
        if (dry) all.push_back("--dry-run");
        const Outcome outcome = run(all);
        expect_success(outcome);
        EXPECT_THAT(outcome.err, HasSubstr("empty on the reference frame 1."));
        EXPECT_THAT(outcome.err, HasSubstr("(--reference-frame 2)."));
    }
    EXPECT_EQ(run({"diff", "frames/####.png", "out/####.png", "--frames", "1"}).exit, 0);
}

TEST_F(BadInput, ReferenceFrameMissingInThePlate) {
    make_shot(4, 1001);
    expect_failure(run_replace({"--reference-frame", "99"}), 4,
                   {"reference frame 99 is not in the plate (1001-1004)", "--reference-frame"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, AGapInTheMatteNamesTheSideToRender) {
    make_shot(6);
    fs::remove(folder_ / "masks/0003.png");
    fs::remove(folder_ / "masks/0004.png");
    expect_failure(
        run_replace(), 4,
        {"no file for frames 3-4", "reference frame 1", "render only frames 1-2", "--frames"});
    expect_failure(run_replace({"--frames", "5-6"}), 4,
                   {"no file for frames 3-4", "--reference-frame 5"});
    expect_success(run_replace({"--frames", "5-6", "--reference-frame", "5"}));
    EXPECT_EQ(names("out"), (Words{"0005.png", "0006.png"}));
}

TEST_F(BadInput, AGapInThePlateNamesTheSideToRender) {
    make_shot(6);
    fs::remove(folder_ / "frames/0003.png");
    expect_failure(run_replace({"--frames", "4-6"}), 4,
                   {"no frame 3", "reference frame 1", "--reference-frame 4"});
    expect_failure(run_replace(), 4, {"no frame 3", "render only frames 1-2"});
}

// Frame numbers at the limits of int, far apart, and negative: time and memory must not depend on
// them.
TEST_F(BadInput, FrameNumbersBeyondTheRange) {
    make_shot(2);
    for (const char* number : {"2147483647", "-2147483648", "100000001", "99999999999999999999"}) {
        const std::string file = "frames/" + std::string(number) + ".png";
        fs::copy_file(folder_ / "frames/0001.png", folder_ / file);
        expect_failure(run_replace(), 3, {file, "frame number beyond 100000000"});
        fs::remove(folder_ / file);
        if (std::string(number).size() > 11) continue;
        const std::string list = number;
        expect_failure(run_replace({"--frames", "1," + list}), 2, {list, "100000000"});
        expect_failure(run_replace({"--reference-frame=" + list}), 2, {"100000000"});
        expect_failure(run_replace({"--movie-start=" + list}), 2, {"100000000"});
    }
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, FrameNumbersFarApart) {
    make_shot(2, 99999999);  // up to the largest number
    expect_success(run_replace());
    EXPECT_EQ(names("out"), (Words{"100000000.png", "99999999.png"}));
    for (const char* folder : {"frames/0001.png", "masks/0001.png"})
        fs::copy_file((folder_ / folder).parent_path() / "99999999.png", folder_ / folder);
    for (const char* missing : {"error", "hold", "skip"}) {
        expect_failure(run_replace({"--missing", missing, "-o", "far/####.png"}), 4,
                       {"no frames 2-99999998", "--frames"});
    }
    make_shot(3, -100000000);
    expect_success(run_replace({"--frames", "-100000000--99999998", "--reference-frame",
                                "-100000000", "-o", "low/####.png"}));
    EXPECT_EQ(names("low").size(), 3u);
}

TEST_F(BadInput, SampleSmallerThanTheOverlap) {
    make_shot(1);
    put_picture("small.png", pattern_picture({30, 30}, 3));
    const Words parts{"small.png", "30x30", "overlap of 36 px", "15 px"};
    expect_failure(run({"synth", "small.png", "-o", "plane.png"}), 2, parts);
    expect_failure(run_replace({"--plane", "", "--texture", "small.png"}), 2, parts);
    EXPECT_FALSE(fs::exists(folder_ / "plane.png"));
    EXPECT_THAT(names("out"), IsEmpty());
    expect_success(run({"synth", "small.png", "-o", "plane.png", "--overlap", "15"}));
    put_picture("tiny.png", pattern_picture({20, 20}, 3));
    expect_failure(run({"synth", "tiny.png", "-o", "other.png"}), 2,
                   {"tiny.png", "20x20", "24x24"});
}

TEST_F(BadInput, ConstantColourSampleWarnsAndWorks) {
    ImageF3 flat(Size{64, 64});
    std::fill_n(flat.data(), flat.size_bytes() / sizeof(float), 0.4f);
    put_picture("flat.png", flat);
    const Outcome outcome = run({"synth", "flat.png", "-o", "plane.png", "--size", "128x96"});
    expect_success(outcome);
    expect_one_line(outcome.err, {"warning"});
    const PlateFrame plane = picture("plane.png");
    EXPECT_EQ(plane.rgb.size(), (Size{128, 96}));
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 3 * 128; ++x)
            ASSERT_FLOAT_EQ(plane.rgb.row(y)[x], 102.0f / 255.0f);
}

TEST_F(BadInput, SampleThatIsNotAnImage) {
    make_shot(2);
    put("words.png", "these are words");
    expect_failure(run_replace({"--plane", "words.png"}), 3, {"words.png"});
    expect_failure(run_replace({"--plane", "nothing.png"}), 3, {"nothing.png"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadInput, MovieWithoutFrames) {
    WEFT_NEEDS_MOVIES();
    make_shot(1);
    put("empty.mp4", "");
    put("noise.mp4", std::string(4000, 'x'));
    expect_failure(run_replace({"--plate", "empty.mp4"}), 3, {"empty.mp4"});
    expect_failure(run_replace({"--plate", "noise.mp4"}), 3, {"noise.mp4"});
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(BadInput, ProjectFromANewerVersion) {
    put("shot.weft", R"({"schema": "weft.project/99", "regions": []})");
    for (const char* command : {"render", "info", "validate"})
        expect_failure(run({command, "shot.weft"}), 3, {"shot.weft", "version 99", "update Weft"});
}

TEST_F(BadInput, HostileProjects) {
    const std::map<std::string, std::string> hostile{
        {"empty", ""},
        {"words", "not a project"},
        {"half", R"({"schema": "weft.project/1", "plate": {"pa)"},
        {"list", "[1, 2, 3]"},
        {"deep", std::string(200000, '[')},
        {"wrong type", R"({"schema": "weft.project/1", "regions": 7})"},
        {"zeros", std::string(5000, '\0')},
    };
    for (const auto& [what, text] : hostile) {
        SCOPED_TRACE(what);
        put("shot.weft", text);
        expect_failure(run({"render", "shot.weft"}), 3, {"shot.weft"});
    }
    expect_failure(run({"render", "missing.weft"}), 3, {"missing.weft"});
    expect_failure(run({"render", "."}), 3, {});
}

TEST_F(BadInput, ContradictoryOptions) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    const std::vector<std::pair<Words, Words>> cases{
        {{"--overwrite", "--skip-existing"}, {"--overwrite", "--skip-existing"}},
        {{"--texture", "sample.png"}, {"--texture", "--plane"}},
        {{"--matte", "1=masks/0001.png"}, {"matte"}},
        {{"--corners", "0,0", "10,0", "0,10", "10,10"}, {"corners"}},
        {{"--out-space", "no such space"}, {"no such space"}},
        {{"--plate-space", "no such space"}, {"no such space"}},
        {{"--frames", "9-3"}, {"9-3"}},
        {{"--frames", "a"}, {"a"}},
        {{"-o", "out/frame.png"}, {"out/frame.png", "####"}},
        {{"-o", "out/####.xyz"}, {"xyz"}},
        {{"-o", "out/####.png", "--depth", "half"}, {"png"}},
        {{"-o", "frames/####.png", "--overwrite"}, {"overwrite", "frames/"}},
        {{"--seam", "sometimes"}, {"--seam", "graphcut"}},
        {{"--scale", "0"}, {"--scale"}},
        {{"--scale", "nan"}, {"--scale"}},
        {{"--light-strength", "2.5"}, {"--light-strength"}},
        {{"--layer-blend", "sideways"}, {"--layer-blend", "soft-light"}},
        {{"--multiply", "1,2"}, {"--multiply"}},
        {{"--threads", "-1"}, {"--threads"}},
        {{"--backend", "abacus"}, {"abacus", "cpu"}},
        {{"--no-such-option"}, {"--no-such-option", "--help"}},
        {{"--movie", "review.gif"}, {"review.gif"}},
    };
    for (const auto& [words, parts] : cases) {
        SCOPED_TRACE(::testing::PrintToString(words));
        expect_failure(run_replace(words), 2, parts);
        EXPECT_THAT(names("out"), IsEmpty());
        EXPECT_EQ(names("frames"), (Words{"0001.png", "0002.png"}));
    }
}

TEST_F(BadInput, MissingRequiredParts) {
    make_shot(1);
    expect_failure(run({"replace", "--matte", "m.png", "--plane", "tile.png", "-o", "o.png"}), 2,
                   {"--plate"});
    expect_failure(
        run({"replace", "--plate", "frames/####.png", "--plane", "tile.png", "-o", "out/####.png"}),
        2, {"No matte"});
    expect_failure(run({"replace", "--plate", "frames/####.png", "--matte", "masks/####.png", "-o",
                        "out/####.png"}),
                   2, {"--texture"});
    expect_failure(run({"replace", "--plate", "frames/####.png", "--matte", "masks/####.png",
                        "--plane", "tile.png"}),
                   2, {"-o"});
    expect_failure(run({}), 2, {"--help"});
    expect_failure(run({"no-such-command"}), 2, {"--help"});
}

}  // namespace
}  // namespace weft::test
