#include "engine/metrics/measuring_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "engine/core/parallel.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::kSlidSize;
using synthetic::slid_texture;

class MeasuringMotion : public testing::TestWithParam<MeasuringEstimator> {
  protected:
    void TearDown() override {
        set_thread_count(0);
        cv::setNumThreads(-1);
    }
};

TEST_P(MeasuringMotion, FindsAKnownMotionInsideTheMatte) {
    const Matte matte = synthetic::rectangle(kSlidSize, {40, 30, 150, 120});
    const FlowField f = measuring_motion(slid_texture(0, 0, 11), slid_texture(2.25f, -1.5f, 11),
                                         matte, matte, GetParam());
    double miss = 0;
    int valid = 0;
    for (int y = 0; y < kSlidSize.height; ++y) {
        for (int x = 0; x < kSlidSize.width; ++x) {
            if (f.valid.at(x, y) == 0) continue;
            EXPECT_NE(matte.at(x, y), 0);
            miss += std::hypot(static_cast<double>(f.d.at(x, y, 0)) - 2.25,
                               static_cast<double>(f.d.at(x, y, 1)) + 1.5);
            ++valid;
        }
    }
    EXPECT_GT(valid, 110 * 90 * 9 / 10);
    EXPECT_LT(miss / valid, 0.1);
}

TEST_P(MeasuringMotion, IsTheSameForAnyNumberOfThreads) {
    const Matte matte(kSlidSize, 255);
    set_thread_count(1);
    cv::setNumThreads(1);
    const FlowField one =
        measuring_motion(slid_texture(0, 0, 11), slid_texture(3, 1, 11), matte, matte, GetParam());
    set_thread_count(4);
    cv::setNumThreads(4);
    const FlowField four =
        measuring_motion(slid_texture(0, 0, 11), slid_texture(3, 1, 11), matte, matte, GetParam());
    EXPECT_EQ(one.d, four.d);
    EXPECT_EQ(one.valid, four.valid);
}

TEST_P(MeasuringMotion, GivesUpWhatIsHidden) {
    // A block of another texture goes right by 5 px over a plate that stands still.
    ImageF1 earlier = slid_texture(0, 0, 11);
    ImageF1 later = earlier;
    const ImageF1 block = slid_texture(40, 50, 11);
    for (int y = 60; y < 100; ++y) {
        for (int x = 60; x < 110; ++x) {
            earlier.at(x, y) = block.at(x, y);
            later.at(x + 5, y) = block.at(x, y);
        }
    }
    const Matte all(kSlidSize, 255);
    const FlowField f = measuring_motion(earlier, later, all, all, GetParam());
    int hidden = 0;
    int open = 0;
    for (int y = 62; y < 98; ++y) {
        for (int x = 110; x < 115; ++x) {
            hidden += f.valid.at(x, y) == 0;
            open += f.valid.at(x + 40, y) != 0;
        }
    }
    EXPECT_GT(hidden, 36 * 5 / 2);
    EXPECT_GT(open, 36 * 5 * 9 / 10);
    EXPECT_EQ(measuring_motion(earlier, later, Matte(kSlidSize, 0), all, GetParam()).valid.at(9, 9),
              0);
}

INSTANTIATE_TEST_SUITE_P(Estimators, MeasuringMotion,
                         testing::Values(MeasuringEstimator::kDeepFlow,
                                         MeasuringEstimator::kFarneback),
                         [](const auto& p) { return std::string(name_of(p.param)); });

}  // namespace
}  // namespace weft
