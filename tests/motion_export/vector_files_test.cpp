// Vectors in each convention, out and in again.
#include "app/motion_export/vector_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace weft {
namespace {

constexpr Size kPicture{48, 32};

class VectorFiles : public ::testing::TestWithParam<MotionConvention> {
  protected:
    void SetUp() override {
        std::string name =
            (std::filesystem::temp_directory_path() / "weft_vectors_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] FlowField through_file(const FrameVectors& vectors, MotionDirection way) const {
        const std::string path = folder_ + "/v.exr";
        WriteOptions write;
        write.rule = WriteRule::own();
        const Status status = write_vectors(path, vectors, GetParam(), write);
        EXPECT_TRUE(status) << status.error().text();
        const auto back = read_motion(path, {GetParam(), way, {}}, kPicture);
        EXPECT_TRUE(back) << (back ? "" : back.error().text());
        return back ? *back : FlowField();
    }
    // A convention with one vector takes the motion to be the same before and after the frame.
    [[nodiscard]] static bool has_both() {
        return GetParam() == MotionConvention::kNuke || GetParam() == MotionConvention::kBlender;
    }

    std::string folder_;
};

// A surface on the right two thirds that turns and grows.
FrameVectors turning() {
    FrameVectors out;
    out.forward = out.backward = ImageF2(kPicture);
    out.visible = ImageF1(kPicture);
    out.has_forward = out.has_backward = true;
    out.confidence = 0.75f;
    for (int y = 0; y < kPicture.height; ++y) {
        for (int x = kPicture.width / 3; x < kPicture.width; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            out.visible.at(x, y) = x == kPicture.width / 3 ? 0.5f : 1.0f;
            out.forward.at(x, y, 0) = 0.11f * fx - 0.3f * fy + 2;
            out.forward.at(x, y, 1) = 0.2f * fx + 0.07f * fy - 5;
            out.backward.at(x, y, 0) = -0.09f * fx - 1;
            out.backward.at(x, y, 1) = 0.01f * fx * fy - 3;
        }
    }
    return out;
}

// The largest distance where the surface shows.
float worst_vector(const ImageF2& a, const ImageF2& b, float sign) {
    float worst = 0;
    for (int y = 0; y < kPicture.height; ++y)
        for (int x = kPicture.width / 3; x < kPicture.width; ++x)
            worst = std::max(worst, std::hypot(a.at(x, y, 0) - sign * b.at(x, y, 0),
                                               a.at(x, y, 1) - sign * b.at(x, y, 1)));
    return worst;
}

TEST_P(VectorFiles, ComeBackBothWays) {
    const FrameVectors vectors = turning();
    const FlowField forward = through_file(vectors, MotionDirection::kForward),
                    backward = through_file(vectors, MotionDirection::kBackward);
    EXPECT_LT(worst_vector(forward.d, vectors.forward, 1), 1e-3f);
    if (has_both())
        EXPECT_LT(worst_vector(backward.d, vectors.backward, 1), 1e-3f);
    else
        EXPECT_LT(worst_vector(backward.d, vectors.forward, -1), 1e-3f);
    EXPECT_EQ(forward.valid.at(kPicture.width - 1, 3), 255);
}

TEST_P(VectorFiles, TheLastFrameHasTheMotionToTheOneBefore) {
    FrameVectors last = turning();
    last.has_forward = false;
    last.forward = ImageF2(kPicture);
    const FlowField backward = through_file(last, MotionDirection::kBackward);
    EXPECT_LT(worst_vector(backward.d, last.backward, 1), 1e-3f);
}

TEST_P(VectorFiles, BlueIsTheVisibilityAndAlphaTheConfidence) {
    static_cast<void>(through_file(turning(), MotionDirection::kForward));
    const auto picture = read_image(folder_ + "/v.exr");
    ASSERT_TRUE(picture) << picture.error().text();
    EXPECT_EQ(picture->rgb.at(1, 1, 2), 0);
    EXPECT_EQ(picture->rgb.at(kPicture.width / 3, 1, 2), 0.5f);
    EXPECT_EQ(picture->rgb.at(kPicture.width - 1, 1, 2), 1);
    EXPECT_EQ(picture->alpha.at(kPicture.width - 1, 1), 0.75f);
    EXPECT_EQ(picture->alpha.at(1, 1), 0);
}

INSTANTIATE_TEST_SUITE_P(Conventions, VectorFiles,
                         ::testing::Values(MotionConvention::kNuke, MotionConvention::kBlender,
                                           MotionConvention::kMoonray, MotionConvention::kFlame,
                                           MotionConvention::kArnold));

}  // namespace
}  // namespace weft
