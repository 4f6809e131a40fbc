// What is said of a movie whose frames are irregular, and of one that was written and is not whole.
#include <gmock/gmock.h>

#include "engine/media/frame_reader.h"
#include "engine/media/read_back.h"
#include "tests/media/coded_movie.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using MoviePacing = MediaTest;

TEST_F(MoviePacing, AVariableRateIsSaid) {
    CodedMovie movie;
    movie.stamps = {0, 1, 2, 4, 5, 8};
    write_bars(in("a.mkv"), movie, {{128, 128, 128, 0}});
    const auto plate = open_plate(in("a.mkv"), {}).value();
    ASSERT_EQ(plate->warnings().size(), 1u);
    EXPECT_THAT(plate->warnings()[0],
                AllOf(HasSubstr("variable frame rate"), HasSubstr("by number"),
                      HasSubstr("constant"), HasSubstr("fps"), HasSubstr("125.0 ms")));
    EXPECT_EQ(plate->frames().size(), 6u);

    movie.stamps = {0, 1, 2, 3, 4, 5};
    write_bars(in("b.mkv"), movie, {{128, 128, 128, 0}});  // Matroska rounds to milliseconds
    EXPECT_THAT(open_plate(in("b.mkv"), {}).value()->warnings(), IsEmpty());
}

class MovieReadBack : public ReadBackTest {};

TEST_F(MovieReadBack, AMovieHasItsFrames) {
    for (const char* name : {"a.mp4", "a.mkv"}) {
        auto movie = open_movie(in(name), kSize, 24);
        ASSERT_TRUE(movie) << movie.error().text();
        for (int k = 0; k < 30; ++k)
            ASSERT_TRUE((*movie)->add(picture(kSize, k)));
        ASSERT_TRUE((*movie)->close());
        EXPECT_TRUE(check_written_movie(in(name), "shown.mp4", kSize, 30)) << name;
        EXPECT_TRUE(is_review_movie(in(name), kSize)) << name;
        EXPECT_FALSE(is_review_movie(in(name), {80, 60})) << name;
        expect_refused(check_written_movie(in(name), "shown.mp4", kSize, 31), "30 frames");
        expect_refused(check_written_movie(in(name), "shown.mp4", {42, 30}, 30), "42x30");
        cut(name, 0);
        expect_refused(check_written_movie(in(name), "shown.mp4", kSize, 30), "cannot be opened");
        EXPECT_FALSE(is_review_movie(in(name), kSize)) << name;
    }
}

}  // namespace
}  // namespace weft
