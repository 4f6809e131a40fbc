#include <gtest/gtest.h>

#include <limits>

#include "engine/metrics/sequence_diff.h"

namespace weft {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Diff, EqualFramesWithNanAndInfinity) {
    ImageF3 a(9, 7, 0.25f);
    a.at(3, 3, 1) = kNan;
    a.at(4, 3, 1) = std::numeric_limits<float>::infinity();
    ImageF3 b = a;
    b.at(3, 3, 1) = -kNan;
    const FrameDiff d = *diff_frames(a, b);
    EXPECT_TRUE(d.equal);
    EXPECT_EQ(d.max_abs[1], 0);
    EXPECT_FALSE(d.psnr_db.has_value());
    EXPECT_FALSE(d.first.has_value());
}

TEST(Diff, SaysWhereAndHowMuch) {
    ImageF3 a(10, 8, 0.5f);
    ImageF3 b = a;
    b.at(6, 2, 0) = 0.75f;
    b.at(3, 5, 0) = 0.25f;
    b.at(3, 5, 2) = 1.0f;
    const FrameDiff d = *diff_frames(a, b);
    EXPECT_FALSE(d.equal);
    EXPECT_EQ(d.differing, 2);
    EXPECT_EQ(d.pixels, 80);
    EXPECT_EQ(d.max_abs[0], 0.25);
    EXPECT_EQ(d.max_abs[1], 0);
    EXPECT_EQ(d.max_abs[2], 0.5);
    EXPECT_NEAR(d.mean_abs[0], 0.5 / 80, 1e-12);
    EXPECT_EQ(d.box, (Recti{3, 2, 7, 6}));
    EXPECT_EQ(*d.first, Vec2i(6, 2));
    EXPECT_NEAR(*d.psnr_db, -10 * std::log10((0.0625 + 0.0625 + 0.25) / 240), 1e-9);
}

TEST(Diff, ANanBesideANumberIsAnInfiniteDifference) {
    ImageF3 a(4, 4, 0.5f);
    ImageF3 b = a;
    b.at(1, 1, 2) = kNan;
    const FrameDiff d = *diff_frames(a, b);
    EXPECT_EQ(d.differing, 1);
    EXPECT_TRUE(std::isinf(d.max_abs[2]));
}

TEST(Diff, OutsideAMatteLooksOnlyWhereItIsZero) {
    ImageF3 a(6, 6, 0.5f);
    ImageF3 b = a;
    b.at(2, 2, 0) = 0.6f;
    Matte m(6, 6);
    m.at(2, 2) = 1;
    EXPECT_TRUE(diff_outside(a, b, m)->equal);
    EXPECT_EQ(diff_outside(a, b, m)->pixels, 35);
    m.at(2, 2) = 0;
    EXPECT_FALSE(diff_outside(a, b, m)->equal);
}

TEST(Diff, SizesThatDifferAreAnErrorThatNamesBoth) {
    const auto d = diff_frames(ImageF3(4, 4), ImageF3(5, 4));
    ASSERT_FALSE(d.has_value());
    EXPECT_EQ(d.error().code, ErrorCode::kDiffers);
    EXPECT_NE(d.error().sentence().find("4x4 and 5x4"), std::string::npos);
}

TEST(Diff, SequenceKeepsTheWorst) {
    ImageF3 a(4, 4, 0.5f);
    ImageF3 b = a;
    SequenceDiff s;
    s.add(1, *diff_frames(a, b));
    EXPECT_TRUE(s.equal());
    b.at(0, 0, 1) = 0.75f;
    s.add(2, *diff_frames(a, b));
    b.at(0, 0, 1) = 0.625f;
    s.add(3, *diff_frames(a, b));
    EXPECT_FALSE(s.equal());
    EXPECT_EQ(s.frames, 3);
    EXPECT_EQ(s.differing_frames, 2);
    EXPECT_EQ(*s.first_differing_frame, 2);
    EXPECT_EQ(s.max_abs, 0.25);
    EXPECT_NEAR(*s.least_psnr_db, -10 * std::log10(0.0625 / 48), 1e-9);
}

}  // namespace
}  // namespace weft
