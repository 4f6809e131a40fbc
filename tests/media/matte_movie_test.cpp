// A movie as a matte.
#include <gmock/gmock.h>

#include "engine/media/matte_files.h"
#include "engine/media/matte_movie.h"
#include "tests/media/coded_movie.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Size kMatteMovieSize{64, 48};

class MovieMatte : public MediaTest {
  protected:
    [[nodiscard]] std::string movie(const std::string& name, AVPixelFormat format,
                                    const std::vector<std::vector<Codes>>& frames) const {
        CodedMovie out;
        out.format = format;
        out.size = kMatteMovieSize;
        out.stamps.clear();
        for (int k = 0; k < static_cast<int>(frames.size()); ++k)
            out.stamps.push_back(k);
        write_frames(in(name), out, frames);
        return in(name);
    }
    [[nodiscard]] static MatteFiles files(const std::string& path, int first = 0) {
        return MatteFiles::parse(path, first).value();
    }
    static int left(const Expected<Matte>& matte) {
        EXPECT_TRUE(matte) << matte.error().text();
        return matte ? matte->at(0, 0) : -1;
    }
    static int right(const Expected<Matte>& matte) {
        EXPECT_TRUE(matte) << matte.error().text();
        return matte ? matte->at(kMatteMovieSize.width - 1, 0) : -1;
    }
};

TEST_F(MovieMatte, ItsFirstFrameIsThatOfThePlate) {
    const MatteFiles matte =
        files(movie("m.mkv", AV_PIX_FMT_GRAY8, {{{0}, {255}}, {{7}, {128}}, {{90}, {91}}}), 1001);
    EXPECT_TRUE(matte.is_movie());
    EXPECT_FALSE(matte.is_single());
    EXPECT_THAT(matte.list_frames().value(), ElementsAre(1001, 1002, 1003));
    EXPECT_EQ(left(matte.read(1003, {}, kMatteMovieSize)), 90);
    EXPECT_EQ(left(matte.read(1001, {}, kMatteMovieSize)), 0);
    EXPECT_EQ(right(matte.read(1001, {}, kMatteMovieSize)), 255);
    EXPECT_EQ(right(matte.read(1002, {}, kMatteMovieSize)), 128);
    for (const int beyond : {1000, 1004})
        EXPECT_EQ(matte.read(beyond, {}, kMatteMovieSize).error().code, ErrorCode::kMissingFrames);
}

TEST_F(MovieMatte, LimitedRangeIsStretched) {
    const MatteFiles matte =
        files(movie("m.mkv", AV_PIX_FMT_YUV420P, {{{16, 128, 128}, {235, 128, 128}}}));
    EXPECT_EQ(left(matte.read(0, {}, kMatteMovieSize)), 0);
    EXPECT_EQ(right(matte.read(0, {}, kMatteMovieSize)), 255);
}

// The element fills the first frame.
TEST_F(MovieMatte, AlphaCountsOnAllFramesIfItIsTransparentOnOne) {
    const std::vector<Codes> full{{50, 50, 50, 255}, {200, 200, 200, 255}};
    const std::vector<Codes> part{{50, 50, 50, 40}, {200, 200, 200, 255}};
    const MatteFiles some = files(movie("some.mkv", AV_PIX_FMT_BGRA, {full, part, full}));
    EXPECT_EQ(left(some.read(0, {}, kMatteMovieSize)), 255);
    EXPECT_EQ(left(some.read(1, {}, kMatteMovieSize)), 40);
    const MatteFiles opaque = files(movie("opaque.mkv", AV_PIX_FMT_BGRA, {full, full}));
    EXPECT_EQ(left(opaque.read(0, {}, kMatteMovieSize)), 50);
    EXPECT_EQ(right(opaque.read(1, {}, kMatteMovieSize)), 200);
}

TEST_F(MovieMatte, AChannelMayBeGivenAndTheMatteInverted) {
    const std::string path =
        movie("m.mkv", AV_PIX_FMT_BGRA, {{{10, 20, 30, 40}, {10, 20, 30, 255}}});
    const auto by = [&](const std::string& channel) {
        return files(path).read(0, {{}, channel, false}, kMatteMovieSize);
    };
    EXPECT_EQ(left(by("R")), 10);
    EXPECT_EQ(left(by("G")), 20);
    EXPECT_EQ(left(by("B")), 30);
    EXPECT_EQ(left(by("A")), 40);
    EXPECT_EQ(left(files(path).read(0, {{}, "A", true}, kMatteMovieSize)), 215);
    EXPECT_EQ(by("mask").error().code, ErrorCode::kUnreadable);
    const auto grey =
        files(movie("g.mkv", AV_PIX_FMT_GRAY8, {{{1}}})).read(0, {{}, "A"}, kMatteMovieSize);
    ASSERT_FALSE(grey);
    EXPECT_THAT(grey.error().sentence(), HasSubstr("no channel 'A'"));
}

TEST_F(MovieMatte, WhatItCannotBeIsSaid) {
    const MatteFiles matte = files(movie("m.mkv", AV_PIX_FMT_GRAY8, {{{0}, {255}}}));
    const auto size = matte.read(0, {}, {640, 360});
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(size.error().sentence(), HasSubstr("64x48"));
    MatteSelect objects;
    objects.crypto = "hero";
    EXPECT_EQ(matte.read(0, objects, kMatteMovieSize).error().code, ErrorCode::kUsage);
    EXPECT_EQ(matte.read(0, {1, {}, false}, kMatteMovieSize).error().code, ErrorCode::kUsage);
    EXPECT_EQ(files(in("none.mkv")).read(0, {}, kMatteMovieSize).error().code,
              ErrorCode::kMissingFrames);
    put_bytes(in("x.mp4"), {'x'}, 1);
    EXPECT_EQ(files(in("x.mp4")).read(0, {}, kMatteMovieSize).error().code, ErrorCode::kUnreadable);
}

TEST_F(MovieMatte, AnotherFileOfTheNameIsReadAnew) {
    const std::string path = movie("m.mkv", AV_PIX_FMT_GRAY8, {{{10}}});
    EXPECT_EQ(left(files(path).read(0, {}, kMatteMovieSize)), 10);
    const auto before = files(path).stamp(0).value();
    std::filesystem::remove(path);
    static_cast<void>(movie("m.mkv", AV_PIX_FMT_GRAY8, {{{10}}, {{99}}}));
    EXPECT_EQ(left(files(path).read(1, {}, kMatteMovieSize)), 99);
    EXPECT_NE(files(path).stamp(0).value(), before);
    EXPECT_NE(files(path).stamp(0).value(), files(path).stamp(1).value());
}

TEST_F(MovieMatte, PicturesAreReadAsBefore) {
    ASSERT_TRUE(write_matte(in("0002.png"), Matte(4, 1, 77), WriteRule::own()));
    const MatteFiles numbered = files(in("####.png"), 1001);
    EXPECT_FALSE(numbered.is_movie());
    EXPECT_THAT(numbered.list_frames().value(), ElementsAre(2));
    EXPECT_EQ(numbered.read(2, {}, {4, 1}).value(), Matte(4, 1, 77));
    const MatteFiles one = files(in("0002.png"));
    EXPECT_TRUE(one.is_single());
    EXPECT_THAT(one.list_frames().value(), IsEmpty());
    EXPECT_EQ(one.read(55, {}, {4, 1}).value(), Matte(4, 1, 77));
}

// FFmpeg's own decoders of VP8 and VP9 leave the alpha out.
TEST_F(MovieMatte, TheAlphaOfWebmIsRead) {
    if (!has_encoder("libvpx-vp9")) GTEST_SKIP() << "FFmpeg has no encoder for VP9 here";
    CodedMovie out;
    out.format = AV_PIX_FMT_YUVA420P;
    out.size = kMatteMovieSize;
    out.stamps = {0, 1};
    out.encoder = "libvpx-vp9";
    const std::vector<Codes> bars{{200, 90, 200, 0}, {60, 128, 128, 255}};
    write_frames(in("m.webm"), out, {bars, bars});
    const MatteFiles matte = files(in("m.webm"));
    EXPECT_LT(left(matte.read(0, {}, kMatteMovieSize)), 3);
    EXPECT_GT(right(matte.read(0, {}, kMatteMovieSize)), 252);
}

TEST_F(MovieMatte, ColoursAreNotCoverage) {
    const auto colours =
        MatteMovie::open(movie("c.mkv", AV_PIX_FMT_YUV444P, {{{81, 90, 240}, {145, 54, 34}}}));
    EXPECT_THAT(colours.value()->judge().error().sentence(), HasSubstr("has colours"));
    const auto grey = MatteMovie::open(movie("g.mkv", AV_PIX_FMT_GRAY8, {{{0}, {255}}}));
    EXPECT_EQ(grey.value()->judge().value(), "");
}

}  // namespace
}  // namespace weft
