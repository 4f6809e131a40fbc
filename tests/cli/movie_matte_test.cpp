// Mattes and holdouts that are movies.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/media/image_files.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class MovieMatte : public CliTest {
  protected:
    void SetUp() override {
        WEFT_NEEDS_MOVIES();
        CliTest::SetUp();
    }
    void put_movie(const std::string& name, const std::vector<ImageF3>& frames) const {
        auto movie = open_movie(in(name), frames.front().size(), 24, 1, WriteRule::own());
        ASSERT_TRUE(movie) << movie.error().text();
        for (const ImageF3& frame : frames)
            ASSERT_TRUE((*movie)->add(frame));
        ASSERT_TRUE((*movie)->close());
    }
    /// The mattes of the shot's first frames, as a lossless movie.
    void put_mattes(const std::string& name, int frames) const {
        std::vector<ImageF3> all;
        all.reserve(static_cast<std::size_t>(frames));
        for (int step = 0; step < frames; ++step)
            all.push_back(grey(card_matte(step)));
        put_movie(name, all);
    }
    [[nodiscard]] static ImageF3 grey(const Matte& matte) {
        ImageF3 out(matte.size());
        for (int y = 0; y < matte.height(); ++y)
            for (int x = 0; x < matte.width(); ++x)
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = static_cast<float>(matte.at(x, y)) / 255.0f;
        return out;
    }
    [[nodiscard]] Words with_matte(const std::string& matte, const Words& more = {}) const {
        Words words = replace(more);
        *std::next(std::find(words.begin(), words.end(), "--matte")) = matte;
        return words;
    }
    void expect_same_pictures(const std::string& one, const std::string& other, int frames) const {
        ASSERT_EQ(names(one).size(), static_cast<std::size_t>(frames));
        for (const std::string& name : names(one)) {
            std::string path(one), expected(other);
            path += "/" + name;
            expected += "/" + name;
            EXPECT_EQ(picture(path).rgb, picture(expected).rgb) << name;
        }
    }
};

TEST_F(MovieMatte, GivesThePicturesOfItsFrames) {
    make_shot(5, 11);
    put_mattes("m.mkv", 5);
    expect_success(run_replace());
    const Outcome movie = run(with_matte("m.mkv", {"-o", "movie/####.png"}));
    expect_success(movie);
    EXPECT_THAT(movie.err, Not(HasSubstr("warning")));
    expect_same_pictures("out", "movie", 5);
}

TEST_F(MovieMatte, BelongsToThePlatesFirstFrameIfThatIsAMovieToo) {
    make_shot(4);
    put_mattes("m.mkv", 4);
    std::vector<ImageF3> plates;
    plates.reserve(4);
    for (int step = 0; step < 4; ++step)
        plates.push_back(card_plate(step));
    put_movie("p.mkv", plates);
    expect_success(run_replace());
    expect_success(run(
        with_matte("m.mkv", {"--plate", "p.mkv", "--movie-start", "1", "-o", "movie/####.png"})));
    expect_same_pictures("out", "movie", 4);
}

TEST_F(MovieMatte, HoldsOutAndIsAZone) {
    make_shot(3);
    Matte front(Card::kPlate);
    for (int y = 40; y < 60; ++y)
        std::fill_n(front.row(y) + 60, 20, std::uint8_t{255});
    fs::create_directory(folder_ / "front");
    for (const char* name : {"front/0001.png", "front/0002.png", "front/0003.png"})
        put_matte(name, front);
    put_movie("front.mkv", std::vector<ImageF3>(3, grey(front)));
    expect_success(
        run_replace({"--holdout", "front/####.png", "--zone", "light=0@front/####.png"}));
    expect_success(run_replace(
        {"--holdout", "front.mkv", "--zone", "light=0@front.mkv", "-o", "movie/####.png"}));
    expect_same_pictures("out", "movie", 3);
}

TEST_F(MovieMatte, IsWrittenAsPicturesByMatteAndReadByValidate) {
    make_shot(3);
    put_mattes("m.mkv", 3);
    expect_success(run({"matte", "--plate", "frames/####.png", "--matte", "m.mkv", "-o",
                        "mattes/####.png", "--progress", "none"}));
    for (int step = 0; step < 3; ++step) {
        const std::string name = "mattes/000" + std::to_string(step + 1) + ".png";
        EXPECT_EQ(read_matte(in(name), {}, {}).value(), card_matte(step)) << name;
    }
    expect_success(run({"new", "p.weft", "--plate", "frames/####.png", "-o", "out/####.png"}));
    expect_success(run(
        {"region", "add", "p.weft", "--name", "card", "--matte", "m.mkv", "--plane", "tile.png"}));
    expect_success(run({"validate", "p.weft"}));
    expect_success(run({"render", "p.weft", "--quality", "draft", "--backend", "cpu"}));
    expect_success(run({"info", "p.weft"}));
    EXPECT_EQ(names("out").size(), 3u);
}

TEST_F(MovieMatte, OfAnotherLengthOrSizeIsNamed) {
    make_shot(4);
    put_mattes("long.mkv", 6);
    const Outcome longer = run(with_matte("long.mkv"));
    expect_success(longer);
    EXPECT_THAT(longer.err, HasSubstr("long.mkv has 6 frames, but the plate has 4"));
    put_mattes("short.mkv", 3);
    expect_failure(run(with_matte("short.mkv")), 4,
                   {"short.mkv has no picture for frame 4", "--frames"});
    const Outcome part = run(with_matte("short.mkv", {"--frames", "1-3", "--overwrite"}));
    expect_success(part);
    EXPECT_THAT(part.err, HasSubstr("short.mkv has 3 frames, but the plate has 4"));
    put_movie("small.mkv", std::vector<ImageF3>(4, ImageF3(Size{32, 24}, 1.0f)));
    expect_failure(run(with_matte("small.mkv", {"--overwrite"})), 3,
                   {"small.mkv", "32x24", "160x120"});
    expect_failure(run(with_matte("long.mkv", {"--matte-value", "3"})), 2,
                   {"long.mkv is a movie", "--matte-value"});
}

TEST_F(MovieMatte, ResumeNoticesAnotherMovieAndAnotherFirstFrame) {
    make_shot(3);
    put_mattes("m.mkv", 4);
    expect_success(run(with_matte("m.mkv")));
    const auto skipped = [&] {
        const Outcome again = run(with_matte("m.mkv", {"--resume", "--frames", "2-3", "--json"}));
        expect_success(again);
        const Json report = Json::parse(again.out);
        return std::count_if(report["frames"].begin(), report["frames"].end(),
                             [](const Json& frame) { return frame.value("skipped", false); });
    };
    EXPECT_EQ(skipped(), 2);
    fs::copy_file(folder_ / "frames/0001.png", folder_ / "frames/0000.png");
    EXPECT_EQ(skipped(), 0) << "the movie begins a frame earlier";
    fs::remove(folder_ / "frames/0000.png");
    EXPECT_EQ(skipped(), 0);
    EXPECT_EQ(skipped(), 2);
    fs::remove(folder_ / "m.mkv");
    put_mattes("m.mkv", 5);
    EXPECT_EQ(skipped(), 0) << "another movie";
}

}  // namespace
}  // namespace weft::test
