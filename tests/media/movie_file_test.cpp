// What a written movie's file says and how it gets onto the disk.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "engine/core/parallel.h"
#include "engine/media/frame_reader.h"
#include "engine/media/frame_writer.h"
#include "tests/media/coded_movie.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MovieFile : public MediaTest {
  protected:
    void write(const std::string& name, Size size, int frames, double fps) {
        auto movie = open_movie(in(name), size, fps, 1, WriteRule::own());
        ASSERT_TRUE(movie) << movie.error().text();
        for (int f = 0; f < frames; ++f)
            ASSERT_TRUE((*movie)->add(picture(size, f)));
        const Status closed = (*movie)->close();
        ASSERT_TRUE(closed) << closed.error().text();
    }
};

TEST_F(MovieFile, CarriesColourTags) {
    write("a.mp4", {64, 48}, 3, 24);
    const MovieTags mp4 = tags_of(in("a.mp4"));
    EXPECT_TRUE(mp4.codec == "h264" || mp4.codec == "mpeg4") << mp4.codec;
    EXPECT_EQ(mp4.matrix, AVCOL_SPC_BT709);
    EXPECT_EQ(mp4.range, AVCOL_RANGE_MPEG);
    EXPECT_EQ(mp4.primaries, AVCOL_PRI_BT709);
    EXPECT_EQ(mp4.transfer, AVCOL_TRC_IEC61966_2_1);

    write("a.mkv", {64, 48}, 3, 24);
    const MovieTags mkv = tags_of(in("a.mkv"));
    EXPECT_EQ(mkv.codec, "ffv1");
    EXPECT_EQ(mkv.matrix, AVCOL_SPC_RGB);
    EXPECT_EQ(mkv.primaries, AVCOL_PRI_BT709);
    EXPECT_EQ(mkv.transfer, AVCOL_TRC_IEC61966_2_1);
}

struct Rate {
    double asked;
    AVRational stored;
};

TEST_F(MovieFile, FrameRateAndCount) {
    const Rate rates[] = {{24, {24, 1}},          {23.976, {24000, 1001}},
                          {23.98, {24000, 1001}}, {29.97, {30000, 1001}},
                          {59.94, {60000, 1001}}, {24000 / 1001.0, {24000, 1001}},
                          {12.5, {25, 2}},        {1, {1, 1}},
                          {120, {120, 1}}};
    for (const char* name : {"a.mp4", "a.mkv"}) {
        for (const Rate& rate : rates) {
            write(name, {64, 48}, 11, rate.asked);
            // Matroska counts nanoseconds a frame.
            EXPECT_NEAR(av_q2d(tags_of(in(name)).fps) / av_q2d(rate.stored), 1, 1e-7)
                << name << " " << rate.asked;
            const auto plate = open_plate(in(name), {}).value();
            EXPECT_DOUBLE_EQ(plate->fps(), av_q2d(rate.stored)) << name;
            EXPECT_EQ(plate->frames().size(), 11u) << name << " " << rate.asked;
            EXPECT_THAT(plate->warnings(), IsEmpty()) << name << " " << rate.asked;
        }
    }
}

TEST_F(MovieFile, OneFrameIsAMovie) {
    for (const char* name : {"a.mp4", "a.mkv"}) {
        write(name, {64, 48}, 1, 24);
        EXPECT_EQ(open_plate(in(name), {}).value()->frames().size(), 1u) << name;
    }
}

// FFmpeg would open the files that such a list names.
TEST_F(MovieFile, AListOfMoviesIsNone) {
    write("a.mkv", {64, 48}, 2, 24);
    const std::string list = "ffconcat version 1.0\nfile a.mkv\n";
    put_bytes(in("b.mkv"), {list.begin(), list.end()}, list.size());
    EXPECT_TRUE(open_plate(in("a.mkv"), {}));
    EXPECT_FALSE(open_plate(in("b.mkv"), {}));
}

TEST_F(MovieFile, SameFramesSameBytes) {
    for (const std::string kind : {".mp4", ".mkv"}) {
        set_thread_count(1);
        write("a" + kind, {322, 241}, 30, 23.976);
        set_thread_count(3);
        write("b" + kind, {322, 241}, 30, 23.976);
        set_thread_count(0);
        EXPECT_TRUE(bytes_of(in("a" + kind)) == bytes_of(in("b" + kind))) << kind;
    }
}

TEST_F(MovieFile, IndexStandsInFront) {
    write("a.mp4", {64, 48}, 5, 24);
    const auto bytes = bytes_of(in("a.mp4"));
    const std::string text(bytes.begin(), bytes.end());
    ASSERT_NE(text.find("mdat"), std::string::npos);
    EXPECT_LT(text.find("moov"), text.find("mdat"));
}

TEST_F(MovieFile, FullDiskIsNoticedWhileWriting) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    for (const char* name : {"a.mkv", "a.mp4"}) {
        put_bytes(in(name), {'o', 'l', 'd'}, 3);
        auto movie = open_movie(in(name), {256, 256}, 24, 1, WriteRule::own());
        ASSERT_TRUE(movie);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{400000, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        Status added;
        int frames = 0;
        for (; added && frames < 200; ++frames)
            added =
                (*movie)->add(random_codes({256, 256}, 255, static_cast<std::uint64_t>(frames)));
        const Status again = (*movie)->add(ImageF3(256, 256));
        const Status closed = (*movie)->close();
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
        movie->reset();
        ASSERT_FALSE(added) << name;
        EXPECT_EQ(added.error().code, ErrorCode::kNoSpace) << added.error().text();
        EXPECT_EQ(again.error().text(), added.error().text());
        EXPECT_EQ(closed.error().text(), added.error().text());
        EXPECT_EQ(bytes_of(in(name)).size(), 3u) << "the older file is untouched";
    }
    EXPECT_THAT(names(), ::testing::ElementsAre("a.mkv", "a.mp4"));
}

TEST_F(MovieFile, NamesAreFilesNotProtocols) {
    // FFmpeg would look for a protocol before the colon, or list files from what follows it.
    write("pipe:1.mp4", {64, 48}, 2, 24);
    write("with space%d.mkv", {64, 48}, 2, 24);
    EXPECT_EQ(open_plate(in("pipe:1.mp4"), {}).value()->frames().size(), 2u);
}

TEST_F(MovieFile, NothingIsSaidOnStderr) {
    testing::internal::CaptureStderr();
    write("a.mp4", {64, 48}, 3, 24);
    write("a.mkv", {64, 48}, 3, 24);
    EXPECT_FALSE(open_movie(in("b.mp4"), {40000, 2}, 24));
    put_bytes(in("c.mp4"), std::vector<char>(5000, 'x'), 5000);
    EXPECT_FALSE(open_plate(in("c.mp4"), {}));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(MovieFile, SoundWithoutPicturesIsSaid) {
    std::string wav(
        "RIFF\x24\x08\0\0WAVEfmt \x10\0\0\0\1\0\1\0\x40\x1f\0\0\x80\x3e\0\0\2\0\x10\0"
        "data\0\x08\0\0",
        44);
    wav += std::string(2048, '\0');
    std::ofstream(in("a.mov"), std::ios::binary) << wav;
    const auto plate = open_plate(in("a.mov"), {});
    ASSERT_FALSE(plate);
    EXPECT_EQ(plate.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(plate.error().sentence(), HasSubstr("sound but no pictures"));
}

}  // namespace
}  // namespace weft
