// weft motion: what it writes, read again, and what it refuses.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "engine/motion/corner_track.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class MotionCommand : public CliTest {
  protected:
    void make_project(int frames, const Words& more = {}) {
        make_shot(frames, 1001);
        expect_success(run({"new", "shot.weft", "--plate", "frames/####.png"}));
        Words add{"region",         "add",       "shot.weft", "--name", "card", "--matte",
                  "masks/####.png", "--texture", "sample.png"};
        add.insert(add.end(), more.begin(), more.end());
        expect_success(run(add));
    }
    Outcome motion(const Words& more = {}) const {
        return run(with_options({"motion", "shot.weft", "-o", "out"}, more));
    }
    // Steps of the analysis that a run took.
    static int analysed(const Outcome& outcome) {
        int count = 0;
        for (std::size_t at = 0; (at = outcome.out.find("analyse frame", at)) != std::string::npos;
             ++at)
            ++count;
        return count;
    }
    ImageF2 st(const std::string& name, const std::string& layer = {}) const {
        const auto found = read_uv(in(name), layer, Card::kPlate);
        EXPECT_TRUE(found) << (found ? "" : found.error().text());
        return found ? *found : ImageF2(Card::kPlate);
    }
    // Where the card's pixel x, y of `map` comes from, px.
    static Vec2 mapped(const ImageF2& map, int x, int y) {
        return {map.at(x, y, 0) * 160, (1 - map.at(x, y, 1)) * 120};
    }
};

// Pixels of the card on the frame 1001 + step, without its border.
template <class F>
void inside_card(int step, const F& visit) {
    const Vec2i c = Card::corner(step);
    for (int y = c.y + 8; y < c.y + Card::kHeight - 8; ++y)
        for (int x = c.x + 8; x < c.x + Card::kWidth - 8; ++x)
            visit(x, y);
}

TEST_F(MotionCommand, WritesMapsVectorsAndCornerPins) {
    make_project(4);
    const Outcome outcome = motion({"--json"});
    expect_success(outcome);
    EXPECT_EQ(names("out"), (Words{"card", "motion.json"}));
    EXPECT_EQ(names("out/card"),
              (Words{"corner_pin.nk", "corner_pin_after_effects.txt", "corner_pin_blender.py", "st",
                     "track.json", "vectors_nuke"}));
    EXPECT_EQ(names("out/card/st"), (Words{"1001.exr", "1002.exr", "1003.exr", "1004.exr"}));
    EXPECT_EQ(names("out/card/vectors_nuke").size(), 4u);
    const Json answer = Json::parse(outcome.out);
    EXPECT_EQ(answer["pictures_written"], 8);
    EXPECT_EQ(answer["complete"], true);
    const Json manifest = Json::parse(bytes("out/motion.json"));
    EXPECT_EQ(manifest["schema"], "weft.motion/1");
    EXPECT_EQ(manifest["complete"], true);
    EXPECT_EQ(manifest["frames"], "1001-1004");
    EXPECT_EQ(manifest["regions"][0]["corner_pin"]["nuke"], "card/corner_pin.nk");
    EXPECT_THAT(bytes("out/motion.json"), Not(HasSubstr(folder_.string())));
}

// The maps are those of a render, and nothing is followed twice.
TEST_F(MotionCommand, TheMapsAreThoseOfARender) {
    make_project(3);
    expect_success(motion());
    const Outcome render = run(
        {"render", "shot.weft", "-o", "frames_out/####.png", "--export-st-maps", "st/####.exr"});
    expect_success(render);
    for (const char* layer : {"", "stabilize"}) {
        const ImageF2 here = st("out/card/st/1003.exr", layer), there = st("st/1003.exr", layer);
        EXPECT_TRUE(std::equal(here.data(), here.data() + 2 * 160 * 120, there.data())) << layer;
    }
}

// Another reference frame: no analysis, and the maps are the difference of two frames' places.
TEST_F(MotionCommand, AnotherReferenceFrameIsComposed) {
    make_project(6);
    const Outcome first = motion();
    expect_success(first);
    EXPECT_GT(analysed(first), 0);
    const Outcome again = motion({"-o", "other", "--reference", "1004", "--export", "st,corners"});
    expect_success(again);
    EXPECT_EQ(analysed(again), 0);
    EXPECT_EQ(names("other/card/st").size(), 6u);
    int compared = 0;
    const ImageF2 warp = st("other/card/st/1006.exr"),
                  back = st("other/card/st/1006.exr", "stabilize");
    inside_card(5, [&](int x, int y) {
        const Vec2 here(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        EXPECT_LT(glm::length(mapped(warp, x, y) - (here - Vec2(4, 2))), 0.1f);
        EXPECT_LT(glm::length(mapped(back, x - 4, y - 2) - here), 0.1f);
        ++compared;
    });
    EXPECT_GT(compared, 2000);
    const ImageF2 still = st("other/card/st/1004.exr");
    inside_card(3, [&](int x, int y) {
        EXPECT_LT(glm::length(mapped(still, x, y) -
                              Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)),
                  1e-3f);
    });
}

TEST_F(MotionCommand, VectorsLeadToTheNeighbours) {
    make_project(3);
    expect_success(motion({"--vector-convention", "nuke,blender", "--export", "vectors"}));
    EXPECT_EQ(names("out/card"), (Words{"vectors_blender", "vectors_nuke"}));
    for (const auto& [folder, convention] :
         {std::pair("nuke", MotionConvention::kNuke), {"blender", MotionConvention::kBlender}}) {
        const std::string path = in(std::string("out/card/vectors_") + folder + "/1002.exr");
        for (const auto way : {MotionDirection::kForward, MotionDirection::kBackward}) {
            const auto flow = read_motion(path, {convention, way, {}}, Card::kPlate);
            ASSERT_TRUE(flow) << flow.error().text();
            const float sign = way == MotionDirection::kForward ? 1.0f : -1.0f;
            inside_card(1, [&](int x, int y) {
                EXPECT_NEAR(flow->d.at(x, y, 0), sign * 2, 0.1f);
                EXPECT_NEAR(flow->d.at(x, y, 1), sign * 1, 0.1f);
            });
        }
    }
}

// Weft reads its own corner pins: the surface lies where it was tracked.
TEST_F(MotionCommand, CornerPinsOutAndIn) {
    make_project(5);
    expect_success(motion({"--reference", "1003", "--export", "corners", "--json"}));
    const Json manifest = Json::parse(bytes("out/motion.json"));
    const Json& corners = manifest["regions"][0]["corner_pin"]["corners_px"];
    EXPECT_LT(manifest["regions"][0]["corner_pin"]["off_plane_px"]["p90"].get<double>(), 0.1);
    for (const char* file : {"corner_pin.nk", "corner_pin_after_effects.txt"}) {
        SCOPED_TRACE(file);
        const auto track =
            parse_corner_track(bytes(std::string("out/card/") + file), {Card::kPlate, 1001});
        ASSERT_TRUE(track) << track.error().text();
        EXPECT_EQ(track->size(), 5u);
        for (const auto& [frame, quad] : *track)
            for (std::size_t k = 0; k < 4; ++k) {
                const glm::dvec2 start(corners[2 * k].get<double>(),
                                       corners[2 * k + 1].get<double>());
                const double t = frame - 1003;
                EXPECT_LT(glm::length(quad[k] - start - glm::dvec2(2 * t, t)), 0.15)
                    << "frame " << frame << " corner " << k;
            }
    }
    // Followed by that track instead of the plate, the card lies at the same places.
    expect_success(motion({"--export", "st", "-o", "by_plate"}));
    expect_success(
        run({"region", "set", "shot.weft", "card", "--track", "out/card/corner_pin.nk"}));
    expect_success(motion({"--export", "st", "-o", "by_track"}));
    const ImageF2 plate = st("by_plate/card/st/1005.exr"), pin = st("by_track/card/st/1005.exr");
    float worst = 0;
    inside_card(4, [&](int x, int y) {
        worst = std::max(worst, glm::length(mapped(plate, x, y) - mapped(pin, x, y)));
    });
    EXPECT_LT(worst, 0.05f);
}

// The card's corners, on every frame.
TEST_F(MotionCommand, ShapesGoWithTheCard) {
    make_project(5);
    expect_success(motion({"--export", "roto", "--reference", "1003"}));
    EXPECT_EQ(names("out/card"), (Words{"roto_blender.py", "roto_mlt.json", "roto_nuke.py"}));
    const Json roto = Json::parse(bytes("out/motion.json"))["regions"][0]["roto"];
    ASSERT_EQ(roto["shapes"].size(), 1u);
    EXPECT_EQ(roto["shapes"][0]["name"], "outline_1");
    EXPECT_EQ(roto["shapes"][0]["first"], 1001);
    EXPECT_EQ(roto["shapes"][0]["last"], 1005);
    EXPECT_LT(roto["off_matte_px"]["worst_frame"].get<double>(), 0.5);
    const Json shapes = Json::parse(bytes("out/card/roto_mlt.json"));
    ASSERT_EQ(shapes.size(), 2u);
    const Json& spline = shapes[1]["spline"];
    ASSERT_EQ(spline.size(), 5u);
    for (int step = 0; step < 5; ++step) {
        const Json& points = spline[std::to_string(step)];
        ASSERT_EQ(points.size(), spline["2"].size());
        Vec2 low(1e6f), high(-1e6f);
        for (const Json& point : points) {
            const Vec2 at(160 * point[1][0].get<float>(), 120 * point[1][1].get<float>());
            low = glm::min(low, at), high = glm::max(high, at);
        }
        const Vec2i corner = Card::corner(step);
        EXPECT_LT(glm::length(low - Vec2(corner)), 1);
        EXPECT_LT(glm::length(high - Vec2(corner) - Vec2(Card::kWidth, Card::kHeight)), 1);
    }
}

TEST_F(MotionCommand, AMeshGoesWithTheCard) {
    make_project(5);
    expect_success(motion({"--export", "mesh", "--reference", "1003"}));
    EXPECT_EQ(names("out/card"), (Words{"mesh.obj", "mesh.pc2", "mesh.usda"}));
    const Json mesh = Json::parse(bytes("out/motion.json"))["regions"][0]["mesh"];
    EXPECT_EQ(mesh["pc2"], "card/mesh.pc2");
    const std::string cache = bytes("out/card/mesh.pc2");
    const auto points = mesh["corners"].get<std::size_t>();
    ASSERT_EQ(cache.size(), 32 + 5 * points * 12);
    const auto number = [&](std::size_t step, std::size_t k, std::size_t axis) {
        float out = 0;
        std::memcpy(&out, cache.data() + 32 + (step * points + k) * 12 + 4 * axis, sizeof out);
        return out;
    };
    for (std::size_t step = 0; step < 5; ++step)
        for (std::size_t k = 0; k < points; ++k) {
            const float t = static_cast<float>(step) - 2;
            EXPECT_NEAR(number(step, k, 0), number(2, k, 0) + 2 * t, 0.15f);
            EXPECT_NEAR(number(step, k, 1), number(2, k, 1) - t, 0.15f);
        }
}

// What bulges towards the camera lies nearer to it, on all frames about alike.
TEST_F(MotionCommand, AMeshHasTheFormsDepth) {
    make_project(3, {"--form", "inflate"});
    expect_success(motion({"--export", "mesh"}));
    const Json mesh = Json::parse(bytes("out/motion.json"))["regions"][0]["mesh"];
    EXPECT_EQ(mesh["depth"], true);
    const std::string cache = bytes("out/card/mesh.pc2");
    const auto points = mesh["corners"].get<std::size_t>();
    ASSERT_EQ(cache.size(), 32 + 3 * points * 12);
    std::vector<Vec3> corners(3 * points);
    std::memcpy(corners.data(), cache.data() + 32, 3 * points * 12);
    const Vec2 middle = Vec2(Card::corner(0)) + 0.5f * Vec2(Card::kWidth, Card::kHeight);
    float inside = -1e6f, rim = 1e6f, moved = 0;
    for (std::size_t k = 0; k < points; ++k) {
        const Vec2 off = Vec2(corners[k].x, 120 - corners[k].y) - middle;
        if (glm::length(off) < 8) inside = std::max(inside, corners[k].z);
        rim = std::min(rim, corners[k].z);
        moved = std::max(moved, std::abs(corners[2 * points + k].z - corners[k].z));
    }
    EXPECT_GT(inside, rim + 4);
    EXPECT_LT(moved, 5);  // measured: 3.1 px at most
}

TEST_F(MotionCommand, ARegionThatIsNotSeenHasNoShapes) {
    make_project(3);
    put_matte("masks/1002.png", Matte(Card::kPlate));
    const Outcome outcome = motion({"--export", "roto", "--frames", "1002"});
    expect_success(outcome);
    EXPECT_THAT(outcome.err, HasSubstr("'card' has no roto shapes"));
    EXPECT_EQ(names("out/card"), Words{});
}

TEST_F(MotionCommand, OtherProgramsGetAFileForEachWay) {
    make_project(2);
    for (const char* program : {"fusion", "blender"}) {
        const std::string folder = program;
        expect_success(motion({"--export", "st", "--st-convention", program, "-o", folder}));
        EXPECT_EQ(names(folder + "/card"), (Words{"st_match_move", "st_stabilize"}));
        const auto picture = read_image(in(folder + "/card/st_match_move/1002.exr"));
        ASSERT_TRUE(picture) << picture.error().text();
        inside_card(1, [&](int x, int y) {
            EXPECT_NEAR(picture->rgb.at(x, y, 0) * 160, static_cast<float>(x) + 0.5f - 2, 0.1f);
            EXPECT_EQ(picture->rgb.at(x, y, 2), 1);
        });
    }
}

TEST_F(MotionCommand, BytesDependOnNeitherThreadsNorFolder) {
    make_project(3);
    expect_success(motion({"--threads", "1"}));
    expect_success(motion({"--threads", "3", "-o", "again", "--no-cache"}));
    expect_success(motion({"--threads", "1", "--export", "roto", "-o", "roto"}));
    expect_success(motion({"--threads", "3", "--export", "roto", "-o", "roto_again"}));
    EXPECT_EQ(contents("roto/card"), contents("roto_again/card"));
    for (const char* part : {"", "/card", "/card/st", "/card/vectors_nuke"})
        EXPECT_EQ(contents(std::string("out") + part), contents(std::string("again") + part));
}

TEST_F(MotionCommand, ResumesWhatMatches) {
    make_project(4);
    expect_success(motion({"--export", "st", "--json"}));
    const auto whole = contents("out/card/st");
    fs::remove(in("out/card/st/1002.exr"));
    expect_failure(motion({"--export", "st"}), 2, {"exists already", "--resume, --overwrite"});
    const Outcome again = motion({"--export", "st", "--resume", "--json"});
    expect_success(again);
    EXPECT_EQ(Json::parse(again.out)["pictures_written"], 1);
    EXPECT_EQ(Json::parse(again.out)["pictures_kept"], 3);
    EXPECT_EQ(contents("out/card/st"), whole);
    const Outcome other = motion({"--export", "st", "--resume", "--reference", "1002", "--json"});
    expect_success(other);
    EXPECT_EQ(Json::parse(other.out)["pictures_written"], 4) << "they were made of another motion";
    const Outcome over = motion({"--export", "st", "--overwrite", "--json"});
    expect_success(over);
    EXPECT_EQ(Json::parse(over.out)["pictures_written"], 4);
    EXPECT_EQ(contents("out/card/st"), whole);
}

TEST_F(MotionCommand, ReplacesNothingThatIsNotItsOwn) {
    make_project(2);
    fs::create_directories(in("out/card/st"));
    put_picture("out/card/st/1001.exr", card_plate(0), PixelDepth::kHalf);
    expect_failure(motion({"--export", "st", "--resume"}), 2, {"1001.exr", "not rendered by Weft"});
    put("out/motion.json", "{}");
    expect_failure(motion({"--export", "corners", "--resume"}), 2,
                   {"motion.json", "not that of a motion export"});
    EXPECT_EQ(bytes("out/motion.json"), "{}");
    expect_failure(motion({"--export", "st", "-o", "frames", "--output-root", "out"}), 2,
                   {"frames"});
}

TEST_F(MotionCommand, ADiskThatIsFullLeavesAFolderThatIsNotComplete) {
    make_project(3);
    expect_success(motion({"-o", "first"}));
    options_.largest_file_bytes = 8192;
    expect_failure(motion({"--export", "st", "--progress", "none"}), 6,
                   {"Frame 100", "out/card/st/100"});
    // The reference frame's map of nothing but its own places is small.
    const auto whole = contents("first/card/st"), part = contents("out/card/st");
    EXPECT_LT(part.size(), whole.size());
    for (const auto& [name, hash] : part)
        EXPECT_EQ(hash, whole.at(name)) << name;
    EXPECT_EQ(Json::parse(bytes("out/motion.json"))["complete"], false);
    options_.largest_file_bytes = 0;
    expect_success(motion({"--export", "st", "--resume"}));
    EXPECT_EQ(Json::parse(bytes("out/motion.json"))["complete"], true);
    EXPECT_EQ(contents("out/card/st"), whole);
}

TEST_F(MotionCommand, SaysWhatIsWrong) {
    make_project(3);
    expect_failure(motion({"--region", "wall"}), 2, {"no enabled region 'wall'", "'card'"});
    expect_failure(motion({"--reference", "1009"}), 4, {"1009", "frames 1001-1003"});
    expect_failure(motion({"--frames", "1002-1005"}), 4, {"1004", "1005", "1001-1003"});
    expect_failure(motion({"--export", "model"}), 2,
                   {"--export", "st, vectors, corners, roto or mesh"});
    expect_failure(motion({"--overwrite", "--resume"}), 2, {"--overwrite", "--resume"});
    expect_failure(run({"motion", "gone.weft", "-o", "out"}), 3, {"gone.weft"});
    put_matte("masks/1002.png", Matte(Card::kPlate));
    expect_failure(motion({"--reference", "1002", "--progress", "none"}), 2,
                   {"1002 shows nothing of region 'card'", "frames 1001,1003"});
    EXPECT_FALSE(fs::exists(in("out")));
    expect_success(run({"region", "set", "shot.weft", "card", "--temporal", "none"}));
    expect_failure(motion(), 2, {"'card'", "--temporal locked"});
}

TEST_F(MotionCommand, RegionsHaveFoldersOfTheirOwn) {
    make_project(2);
    for (const char* name : {"a/b", "a?b", "\xc3\xa4rmel"})
        expect_success(run({"region", "add", "shot.weft", "--name", name, "--matte",
                            "masks/####.png", "--texture", "sample.png"}));
    expect_success(motion({"--export", "st"}));
    EXPECT_EQ(names("out"), (Words{"a_b", "a_b_2", "card", "motion.json", "\xc3\xa4rmel"}));
}

}  // namespace
}  // namespace weft::test
