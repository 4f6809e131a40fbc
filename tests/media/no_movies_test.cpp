// In a build without movies: they are refused in words, and nothing is written.
#include <gmock/gmock.h>

#include "engine/media/frame_reader.h"
#include "engine/media/movies.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class NoMovies : public MediaTest {};

TEST_F(NoMovies, ReadingIsRefused) {
    std::ofstream(in("plate.mp4")) << "anything";
    const auto plate = open_plate(in("plate.mp4"), {});
    ASSERT_FALSE(plate);
    EXPECT_EQ(plate.error().code, ErrorCode::kNoBackend);
    EXPECT_THAT(plate.error().sentence(), HasSubstr("plate.mp4: this build has no movies"));
    EXPECT_THAT(plate.error().sentence(), HasSubstr("numbered frames"));
    EXPECT_THAT(movie_library(), IsEmpty());
}

TEST_F(NoMovies, MissingOnesAreMissing) {
    EXPECT_EQ(open_plate(in("none.mkv"), {}).error().code, ErrorCode::kMissingFrames);
}

TEST_F(NoMovies, WritingIsRefusedAndLeavesNothing) {
    const auto movie = open_movie(in("review.mp4"), {64, 48}, 24);
    ASSERT_FALSE(movie);
    EXPECT_EQ(movie.error().code, ErrorCode::kNoBackend);
    EXPECT_THAT(movie.error().sentence(), HasSubstr("this build has no movies"));
    EXPECT_THAT(names(), IsEmpty());
}

}  // namespace
}  // namespace weft
