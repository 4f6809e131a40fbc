// Propagation on filmed clips whose true masks are known (DAVIS 2016, Perazzi et al.). The bounds
// lie a few hundredths below what was measured.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>
#include <vector>

#include "engine/mask/matte_propagation.h"
#include "tests/mask/moving_disc.h"
#include "tests/support/places.h"

namespace weft {
namespace {

class Clip {
  public:
    explicit Clip(const std::string& name)
        : root_(std::filesystem::path(test::shared_data_folder()) / "sequences" / name) {}

    [[nodiscard]] bool present() const { return std::filesystem::exists(root_ / "masks"); }
    [[nodiscard]] ImageU8x3 frame(int t) const {
        const cv::Mat bgr = cv::imread(path("frames", t, "jpg"), cv::IMREAD_COLOR);
        ImageU8x3 image(bgr.cols, bgr.rows);
        for (int y = 0; y < bgr.rows; ++y) {
            std::copy(bgr.ptr(y), bgr.ptr(y) + 3 * bgr.cols, image.row(y));
        }
        return image;
    }
    [[nodiscard]] Matte mask(int t) const {
        const cv::Mat m = cv::imread(path("masks", t, "png"), cv::IMREAD_GRAYSCALE);
        Matte matte(m.cols, m.rows);
        for (int y = 0; y < m.rows; ++y)
            std::copy(m.ptr(y), m.ptr(y) + m.cols, matte.row(y));
        return matte;
    }
    [[nodiscard]] FlowField motion(int source, int target) const {
        const cv::Mat a = luma(source), b = luma(target);
        cv::Mat there, back;
        const auto dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_FAST);
        dis->calc(a, b, there);
        dis->calc(b, a, back);
        FlowField f(Size{a.cols, a.rows});
        for (int y = 0; y < a.rows; ++y) {
            for (int x = 0; x < a.cols; ++x) {
                const auto d = there.at<cv::Vec2f>(y, x);
                f.d.at(x, y, 0) = d[0];
                f.d.at(x, y, 1) = d[1];
                const int u = static_cast<int>(std::lround(static_cast<float>(x) + d[0]));
                const int v = static_cast<int>(std::lround(static_cast<float>(y) + d[1]));
                const bool lands = u >= 0 && v >= 0 && u < a.cols && v < a.rows;
                const bool returns =
                    lands && cv::norm(d + back.at<cv::Vec2f>(v, u)) <= 0.7 + 0.05 * cv::norm(d);
                f.valid.at(x, y) = returns ? 255 : 0;
            }
        }
        return f;
    }

  private:
    [[nodiscard]] std::string path(const char* folder, int t, const char* extension) const {
        char name[32];
        std::snprintf(name, sizeof name, "%05d.%s", t, extension);
        return (root_ / folder / name).string();
    }
    [[nodiscard]] cv::Mat luma(int t) const {
        return cv::imread(path("frames", t, "jpg"), cv::IMREAD_GRAYSCALE);
    }
    std::filesystem::path root_;
};

std::vector<MatteEstimate> walk_clip(const Clip& clip, int from, int to) {
    std::vector<MatteEstimate> result;
    const int step = from < to ? 1 : -1;
    MatteWalker walker(clip.frame(from), clip.mask(from));
    for (int t = from + step; t != to + step; t += step) {
        result.push_back(walker.advance(clip.frame(t), clip.motion(t, t - step)));
    }
    return result;
}

TEST(PropagationOnClips, BlackswanFromOneKeyframe) {
    const Clip clip("davis_blackswan");
    if (!clip.present()) GTEST_SKIP() << "The evaluation clips are not here";
    const auto mattes = walk_clip(clip, 0, 12);
    EXPECT_GT(test::overlap(mattes.back().matte, clip.mask(12)), 0.93);
    EXPECT_GT(mattes.back().confidence, 0.7f);
}

TEST(PropagationOnClips, DancerFromOneKeyframeAndFromTwo) {
    const Clip clip("davis_dance-twirl");
    if (!clip.present()) GTEST_SKIP() << "The evaluation clips are not here";
    const auto before = walk_clip(clip, 0, 8), after = walk_clip(clip, 10, 2);
    double one = 0, two = 0;
    for (int t = 2; t <= 8; ++t) {
        const auto& a = before[static_cast<std::size_t>(t - 1)];
        const auto& b = after[static_cast<std::size_t>(9 - t)];
        const auto merged = merge_estimates(a, b, {t, 0, 10}, clip.frame(t));
        one += test::overlap(a.matte, clip.mask(t)) / 7;
        two += test::overlap(merged.matte, clip.mask(t)) / 7;
    }
    RecordProperty("one_keyframe", std::to_string(one));
    RecordProperty("two_keyframes", std::to_string(two));
    EXPECT_GT(one, 0.78);
    EXPECT_GT(two, 0.83);
    EXPECT_GT(two, one);
}

}  // namespace
}  // namespace weft
