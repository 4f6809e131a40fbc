#include <gmock/gmock.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <thread>

#include "engine/media/frame_reader.h"
#include "engine/media/frame_writer.h"
#include "tests/media/coded_movie.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Movie : public MediaTest {
  protected:
    void write(const std::string& name, Size size, int frames, double fps = 24) {
        auto movie = open_movie(in(name), size, fps, 1, WriteRule::own());
        ASSERT_TRUE(movie) << movie.error().text();
        for (int f = 0; f < frames; ++f)
            ASSERT_TRUE((*movie)->add(picture(size, f)));
        const Status closed = (*movie)->close();
        ASSERT_TRUE(closed) << closed.error().text();
    }
};

double mean_difference(const ImageF3& a, const ImageF3& b, Size size) {
    double sum = 0;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c)
                sum += std::abs(a.at(x, y, c) - b.at(x, y, c));
        }
    }
    return sum / (3.0 * size.width * size.height);
}

// Bars that move by `step` px from half frame to half frame, upper lines first.
ImageF3 moving_bars(Size size, int upper, int lower, int step) {
    ImageF3 out(size);
    for (int y = 0; y < size.height; ++y) {
        const int at = step * (y % 2 == 0 ? upper : lower);
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = (x - at + 1000) / 8 % 2 == 0 ? 0.25f : 0.75f;
        }
    }
    return out;
}

TEST_F(Movie, InterlacedIsRefusedAndSaysWhatToDo) {
    const Size size{96, 64};
    for (const bool interlaced : {false, true}) {
        auto movie = open_movie(in("a.mkv"), size, 25, 1, {.existing = Existing::kReplace});
        ASSERT_TRUE(movie);
        for (int k = 0; k < 6; ++k)
            ASSERT_TRUE((*movie)->add(moving_bars(size, 2 * k, 2 * k + interlaced, 2)));
        ASSERT_TRUE((*movie)->close());
        const auto plate = open_plate(in("a.mkv"), {});
        ASSERT_EQ(plate.has_value(), !interlaced);
        if (plate) continue;
        EXPECT_EQ(plate.error().code, ErrorCode::kUnreadable);
        EXPECT_THAT(plate.error().sentence(), HasSubstr("a.mkv"));
        EXPECT_THAT(plate.error().sentence(), HasSubstr("not flagged"));
        EXPECT_THAT(plate.error().sentence(), HasSubstr("Deinterlace it first"));
    }
}

TEST_F(Movie, ProgressivePicturesThatAreFlaggedInterlacedAreUsed) {
    CodedMovie movie;
    movie.interlaced = true;
    movie.stamps = {0, 1, 2};
    write_bars(in("psf.mkv"), movie, {{50, 128, 128, 0}, {200, 128, 128, 0}});
    const auto plate = open_plate(in("psf.mkv"), {});
    ASSERT_TRUE(plate) << plate.error().text();
    EXPECT_EQ((*plate)->frames().size(), 3u);
    EXPECT_THAT((*plate)->warnings(), ElementsAre(HasSubstr("its pictures are progressive")));
}

TEST_F(Movie, LosslessComesBackBitForBit) {
    const Size size{96, 64};
    write("a.mkv", size, 9);
    const auto plate = open_plate(in("a.mkv"), {}).value();
    EXPECT_EQ(plate->size(), size);
    EXPECT_EQ(plate->fps(), 24);
    EXPECT_THAT(plate->warnings(), IsEmpty());
    ASSERT_EQ(plate->frames().size(), 9u);
    EXPECT_EQ(plate->frames().front(), 1001);
    for (int f = 0; f < 9; ++f) {
        EXPECT_TRUE(plate->read(1001 + f).value().rgb == picture(size, f)) << f;
    }
}

TEST_F(Movie, LosslessKeepsEverySize) {
    for (const Size size : {Size{97, 63}, Size{3, 3}, Size{4, 5}, Size{855, 481}}) {
        const std::string name = std::to_string(size.width) + ".mkv";
        auto movie = open_movie(in(name), size, 24);
        ASSERT_TRUE(movie) << movie.error().text();
        const ImageF3 codes[] = {random_codes(size, 255, 1), random_codes(size, 255, 2)};
        for (const ImageF3& frame : codes)
            ASSERT_TRUE((*movie)->add(frame));
        const Status closed = (*movie)->close();
        ASSERT_TRUE(closed) << name << closed.error().text();
        const auto plate = open_plate(in(name), {}).value();
        EXPECT_EQ(plate->size(), size);
        EXPECT_EQ(plate->depth(), PixelDepth::kU8);
        for (int f = 0; f < 2; ++f)
            EXPECT_TRUE(plate->read(1001 + f).value().rgb == codes[f]) << name << " frame " << f;
    }
}

TEST_F(Movie, FramesInAnyOrder) {
    write("a.mkv", {96, 64}, 30);
    ReadOptions options;
    options.movie_start = -3;
    options.counted = std::make_shared<std::atomic<int>>(0);
    const auto plate = open_plate(in("a.mkv"), options).value();
    EXPECT_EQ(*options.counted, 30);
    for (const int f : {29, 28, 27, 0, 14, 13, 15, 29, 1, 1}) {
        EXPECT_TRUE(plate->read(f - 3).value().rgb == picture({96, 64}, f)) << f;
    }
    EXPECT_EQ(plate->read(-4).error().code, ErrorCode::kMissingFrames);
    EXPECT_EQ(plate->read(27).error().code, ErrorCode::kMissingFrames);
    EXPECT_EQ(plate->stamp(27).error().code, ErrorCode::kMissingFrames);
    EXPECT_NE(plate->stamp(1).value(), plate->stamp(2).value());
}

TEST_F(Movie, ThreadsShareOneMovie) {
    write("a.mkv", {96, 64}, 12);
    const auto plate = open_plate(in("a.mkv"), {}).value();
    std::vector<int> wrong(3, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 12; ++i) {
                const int f = (i * 5 + static_cast<int>(t) * 4) % 12;
                wrong[t] += !(plate->read(1001 + f).value().rgb == picture({96, 64}, f));
            }
        });
    }
    for (auto& thread : threads)
        thread.join();
    EXPECT_THAT(wrong, ElementsAre(0, 0, 0));
}

TEST_F(Movie, Mp4KeepsEveryFrameAndPadsOddSizes) {
    // Flat frames, each 0.04 brighter: a lost, doubled or shifted frame is off by more than the
    // codec and its conversion from RGB.
    const Size size{97, 63};
    auto movie = open_movie(in("a.mp4"), size, 25);
    ASSERT_TRUE(movie) << movie.error().text();
    const auto level = [](int f) { return 0.1f + 0.04f * static_cast<float>(f); };
    for (int f = 0; f < 20; ++f)
        ASSERT_TRUE((*movie)->add(ImageF3(size, level(f))));
    ASSERT_TRUE((*movie)->close());
    const auto plate = open_plate(in("a.mp4"), {}).value();
    EXPECT_EQ(plate->frames().size(), 20u);
    EXPECT_EQ(plate->fps(), 25);
    EXPECT_EQ(plate->size(), (Size{98, 64}));
    for (const int f : {0, 1, 10, 18, 19}) {
        const PlateFrame frame = plate->read(1001 + f).value();
        EXPECT_LT(mean_difference(frame.rgb, ImageF3({98, 64}, level(f)), {98, 64}), 1.01 / 255)
            << f;
    }
}

TEST_F(Movie, TruncatedMovieHasTheFramesThatDecode) {
    write("whole.mkv", {96, 64}, 30);
    const auto bytes = bytes_of(in("whole.mkv"));
    put_bytes(in("a.mkv"), bytes, bytes.size() * 6 / 10);
    testing::internal::CaptureStderr();
    const auto plate = open_plate(in("a.mkv"), {});
    ASSERT_TRUE(plate) << plate.error().text();
    const auto& frames = (*plate)->frames();
    EXPECT_GT(frames.size(), 5u);
    EXPECT_LT(frames.size(), 30u);
    // All but the last, which may be cut inside, are whole; the last can be asked for without harm.
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        ASSERT_TRUE((*plate)->read(frames[i]).value().rgb ==
                    picture({96, 64}, static_cast<int>(i)));
    }
    EXPECT_TRUE((*plate)->read(frames.back()));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_EQ((*plate)->warnings().size(), 1u);
    EXPECT_THAT((*plate)->warnings()[0], HasSubstr("30 frames"));

    write("whole.mp4", {96, 64}, 30);
    const auto mp4 = bytes_of(in("whole.mp4"));
    put_bytes(in("a.mp4"), mp4, mp4.size() / 2);
    const auto half = open_plate(in("a.mp4"), {});
    ASSERT_TRUE(half) << half.error().text();
    EXPECT_GT((*half)->frames().size(), 5u);
    EXPECT_LT((*half)->frames().size(), 30u);
    ASSERT_FALSE((*half)->warnings().empty());
    EXPECT_THAT((*half)->warnings()[0], HasSubstr("30 frames"));
    put_bytes(in("a.mp4"), mp4, 300);  // cut inside its index, which stands in front
    EXPECT_EQ(open_plate(in("a.mp4"), {}).error().code, ErrorCode::kUnreadable);
}

TEST_F(Movie, AppearsOnlyWhenClosed) {
    {
        auto movie = open_movie(in("a.mp4"), {64, 48}, 24);
        ASSERT_TRUE(movie);
        for (int f = 0; f < 5; ++f)
            ASSERT_TRUE((*movie)->add(picture({64, 48}, f)));
        EXPECT_FALSE(std::filesystem::exists(in("a.mp4")));
    }
    EXPECT_THAT(names(), IsEmpty());
    {
        auto movie = open_movie(in("a.mp4"), {64, 48}, 24);
        EXPECT_EQ((*movie)->close().error().code, ErrorCode::kRenderFailed);  // no frames
    }
    EXPECT_THAT(names(), IsEmpty());
    write("a.mp4", {64, 48}, 5);
    EXPECT_THAT(names(), ElementsAre("a.mp4"));
}

TEST_F(Movie, FullDiskIsNoticedAtTheEnd) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    for (const char* name : {"a.mkv", "a.mp4"}) {
        auto movie = open_movie(in(name), {256, 256}, 24, 1, WriteRule::own());
        ASSERT_TRUE(movie);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{20000, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        for (int f = 0; f < 10; ++f) {
            if (!(*movie)->add(random_codes({256, 256}, 255, static_cast<std::uint64_t>(f)))) break;
        }
        const Status closed = (*movie)->close();
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
        movie->reset();
        ASSERT_FALSE(closed) << name;
        EXPECT_EQ(closed.error().code, ErrorCode::kNoSpace) << closed.error().text();
        EXPECT_THAT(names(), IsEmpty()) << name;
    }
}

TEST_F(Movie, BadRequests) {
    EXPECT_EQ(open_movie(in("a.gif"), {64, 48}, 24).error().code, ErrorCode::kUsage);
    EXPECT_EQ(open_movie(in("a.mp4"), {0, 48}, 24).error().code, ErrorCode::kUsage);
    EXPECT_EQ(open_movie(in("a.mp4"), {64, 48}, 0).error().code, ErrorCode::kUsage);
    EXPECT_EQ(open_movie(in("a.mp4"), {64, 48}, 2000).error().code, ErrorCode::kUsage);
    // FFV1 does not keep the colours of so few rows.
    EXPECT_EQ(open_movie(in("a.mkv"), {64, 2}, 24).error().code, ErrorCode::kUnreadable);
    EXPECT_EQ(open_movie(in("none/a.mp4"), {64, 48}, 24).error().code, ErrorCode::kUnreadable);
    auto movie = open_movie(in("a.mp4"), {64, 48}, 24);
    EXPECT_EQ((*movie)->add(picture({65, 48}, 0)).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace weft
