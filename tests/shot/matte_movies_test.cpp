// Movies as mattes of a shot.
#include "app/shot/matte_movies.h"

#include "app/shot/shot.h"
#include "engine/media/frame_writer.h"
#include "engine/media/movies.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MatteMovies : public ShotTest {
  protected:
    void SetUp() override {
        if (movie_library().empty()) GTEST_SKIP() << "this build has no movies";
        ShotTest::SetUp();
    }
    /// The shot with the mattes of its first frames as a movie.
    [[nodiscard]] Project project(int frames) const {
        auto movie = open_movie(in("m.mkv"), Card::kPlate, 24, 1, WriteRule::own());
        EXPECT_TRUE(movie);
        for (int step = 0; step < frames; ++step) {
            const Matte matte = card_matte(step);
            ImageF3 grey(matte.size());
            for (std::size_t i = 0; i < matte.size_bytes(); ++i)
                std::fill_n(grey.data() + 3 * i, 3, static_cast<float>(matte.data()[i]) / 255.0f);
            EXPECT_TRUE((*movie)->add(grey));
        }
        EXPECT_TRUE((*movie)->close());
        Project out = spec("out").project;
        out.regions[0] = out.regions[0].with([&](Region& region) {
            MatteSource matte;
            matte.files = in("m.mkv");
            region.matte = matte;
        });
        return out;
    }
};

TEST_F(MatteMovies, TheirFramesAreThoseOfThePlate) {
    const auto shot = open_shot(project(kFrames));
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_THAT((*shot)->warnings, IsEmpty());
    for (int step = 0; step < kFrames; ++step)
        EXPECT_EQ((*shot)->source->matte(0, step + 1).value(), card_matte(step)) << step;
}

TEST_F(MatteMovies, OneThatIsTooShortIsAnErrorWhereItIsNeeded) {
    Project some = project(4);
    const auto all = open_shot(some);
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().code, ErrorCode::kMissingFrames);
    EXPECT_THAT(all.error().text(), HasSubstr("m.mkv has no picture for frames 5-6"));
    some.settings.frames = "2-4";
    const auto part = open_shot(some);
    ASSERT_TRUE(part) << part.error().text();
    EXPECT_THAT((*part)->warnings, ElementsAre(HasSubstr("has 4 frames, but the plate has 6")));
}

// Where the plate repeats its first frame before it begins, the movie begins with the plate.
TEST_F(MatteMovies, RepeatedFramesHaveTheMatteOfTheFrameTheyRepeat) {
    Project held = project(kFrames);
    held.plate.missing = MissingFrames::kHold;
    held.settings.frames = "-1-8";
    const auto shot = open_shot(held);
    ASSERT_TRUE(shot) << shot.error().text();
    EXPECT_THAT((*shot)->warnings, IsEmpty());
    const ShotSource& source = *(*shot)->source;
    EXPECT_EQ(source.matte(0, -1).value(), card_matte(0));
    EXPECT_EQ(source.matte(0, 2).value(), card_matte(1));
    EXPECT_EQ(source.matte(0, 8).value(), card_matte(5));
}

}  // namespace
}  // namespace weft::test
