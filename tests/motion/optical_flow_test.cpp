#include "engine/motion/optical_flow.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core/utility.hpp>

#include "engine/core/parallel.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kFlowFrame{200, 140};

Matte moved_texture(Size size, Vec2 by, std::uint64_t seed = 1) {
    const WaveTexture texture(seed);
    return draw(size, [&](Vec2 p) { return texture(p - by); });
}

double mean_error(const FlowField& flow, const Recti& area, Vec2 truth) {
    double sum = 0;
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x) {
            const float* d = flow.d.pixel(x, y);
            sum += distance({d[0], d[1]}, truth);
        }
    }
    return sum / (static_cast<double>(area.width()) * area.height());
}

double share_valid(const FlowField& flow, const Recti& area) {
    int valid = 0;
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x)
            valid += flow.valid.at(x, y) != 0;
    }
    return static_cast<double>(valid) / (area.width() * area.height());
}

TEST(OpticalFlow, FindsATranslation) {
    const Vec2 by(3.3f, -1.7f);
    const Matte source = moved_texture(kFlowFrame, {0, 0}), target = moved_texture(kFlowFrame, by);
    const Recti inner = rect_of(kFlowFrame).grown(-12);
    EXPECT_LT(mean_error(estimate_flow(source, target, FlowQuality::kFinal), inner, by), 0.08);
    EXPECT_LT(mean_error(estimate_flow(source, target, FlowQuality::kDraft), inner, by), 0.2);
    // The direction is target_from_source, not its inverse.
    EXPECT_LT(mean_error(estimate_flow(target, source, FlowQuality::kFinal), inner, -by), 0.08);
}

TEST(OpticalFlow, StartsWithEveryPixelValid) {
    const Matte picture = moved_texture({70, 70}, {0, 0});
    const FlowField flow = estimate_flow(picture, picture, FlowQuality::kDraft);
    EXPECT_EQ(flow.size(), picture.size());
    EXPECT_EQ(share_valid(flow, {0, 0, 70, 70}), 1.0);
}

TEST(OpticalFlow, CropsGiveWhatTheirCopiesGive) {
    const Matte source = moved_texture(kFlowFrame, {0, 0}),
                target = moved_texture(kFlowFrame, {2, 1});
    const Recti box{31, 17, 151, 111};
    const auto copied = [&](const Matte& m) {
        Matte out(box.size());
        for (int y = 0; y < box.height(); ++y) {
            std::copy_n(m.pixel(box.x0, box.y0 + y), box.width(), out.row(y));
        }
        return out;
    };
    const FlowField of_crops =
        estimate_flow(source.view().crop(box), target.view().crop(box), FlowQuality::kFinal);
    EXPECT_EQ(of_crops.d, estimate_flow(copied(source), copied(target), FlowQuality::kFinal).d);
    // A crop of one picture against a whole one.
    EXPECT_EQ(of_crops.d,
              estimate_flow(source.view().crop(box), copied(target), FlowQuality::kFinal).d);
}

TEST(OpticalFlow, TakesTheSmallestPictures) {
    for (const Size size :
         {Size{8, 8}, Size{1, 1}, Size{1, 90}, Size{90, 1}, Size{64, 9}, Size{20000, 4}}) {
        const Matte picture = moved_texture(size, {0, 0});
        for (const FlowQuality quality : {FlowQuality::kDraft, FlowQuality::kFinal}) {
            FlowField there = estimate_flow(picture, picture, quality);
            FlowField back = there;
            ASSERT_EQ(there.size(), size);
            EXPECT_LT(mean_error(there, rect_of(size), {0, 0}), 0.01);
            check_consistency(there, back);
            EXPECT_EQ(share_valid(there, rect_of(size)), 1.0) << size.width << "x" << size.height;
        }
    }
}

TEST(OpticalFlow, DoesNotDependOnThreads) {
    const Matte source = moved_texture(kFlowFrame, {0, 0}),
                target = moved_texture(kFlowFrame, {4, -3});
    const auto both = [&](int threads, FlowQuality quality) {
        cv::setNumThreads(threads);
        set_thread_count(threads);
        FlowField there = estimate_flow(source, target, quality);
        FlowField back = estimate_flow(target, source, quality);
        check_consistency(there, back);
        return there;
    };
    for (const FlowQuality quality : {FlowQuality::kDraft, FlowQuality::kFinal}) {
        const FlowField one = both(1, quality), two = both(2, quality);
        EXPECT_EQ(one.d, two.d);
        EXPECT_EQ(one.valid, two.valid);
    }
    cv::setNumThreads(-1);
    set_thread_count(0);
}

TEST(Consistency, MarksWhatWasUncovered) {
    const WaveTexture ground(1), square(2);
    constexpr Size kLarge{320, 200};
    constexpr int kStep = 8, kLeft = 80, kRight = 200, kTop = 40, kBottom = 160;
    const auto frame = [&](int moved) {
        return draw(kLarge, [&](Vec2 p) {
            const bool inside = Recti{kLeft + moved, kTop, kRight + moved, kBottom}.contains(
                static_cast<int>(p.x), static_cast<int>(p.y));
            return inside ? square(p - Vec2(moved, 0)) : ground(p);
        });
    };
    const Matte before = frame(0), now = frame(kStep);
    FlowField prev_from_cur = estimate_flow(now, before, FlowQuality::kFinal);
    FlowField cur_from_prev = estimate_flow(before, now, FlowQuality::kFinal);
    check_consistency(prev_from_cur, cur_from_prev);
    // Behind the square's trailing side lies ground that was hidden; the leading side hides some.
    EXPECT_LT(share_valid(prev_from_cur, {kLeft, kTop, kLeft + kStep, kBottom}), 0.3);
    EXPECT_LT(share_valid(cur_from_prev, {kRight, kTop, kRight + kStep, kBottom}), 0.3);
    EXPECT_GT(
        share_valid(prev_from_cur, Recti{kLeft + kStep, kTop, kRight + kStep, kBottom}.grown(-12)),
        0.95);
    EXPECT_GT(share_valid(prev_from_cur, {230, 8, 312, 192}), 0.98);
}

TEST(Consistency, MarksWhatLeavesTheFrame) {
    FlowField there(kFlowFrame), back(kFlowFrame);
    for (int y = 0; y < kFlowFrame.height; ++y) {
        for (int x = 0; x < kFlowFrame.width; ++x) {
            there.d.at(x, y, 0) = 20;
            back.d.at(x, y, 0) = -20;
        }
    }
    check_consistency(there, back);
    EXPECT_EQ(share_valid(there, {0, 0, kFlowFrame.width - 20, kFlowFrame.height}), 1.0);
    EXPECT_EQ(share_valid(there, {kFlowFrame.width - 20, 0, kFlowFrame.width, kFlowFrame.height}),
              0.0);
    EXPECT_EQ(share_valid(back, {0, 0, 20, kFlowFrame.height}), 0.0);
}

TEST(Consistency, MarksUnknownMotion) {
    FlowField there({16, 16}), back({16, 16});
    there.d.at(5, 6, 1) = std::numeric_limits<float>::quiet_NaN();
    check_consistency(there, back);
    EXPECT_EQ(there.valid.at(5, 6), 0);
    EXPECT_EQ(there.valid.at(6, 6), 255);
}

FlowField uniform_flow(Size size, Vec2 d) {
    FlowField flow(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            flow.d.at(x, y, 0) = d.x;
            flow.d.at(x, y, 1) = d.y;
        }
    }
    return flow;
}

TEST(InvertFlow, OfATranslationIsTheOpposite) {
    const Size size{40, 30};
    const FlowField whole = invert_flow(uniform_flow(size, {5, -2}));
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const bool reached = x >= 5 && y < size.height - 2;
            ASSERT_EQ(whole.valid.at(x, y), reached ? 255 : 0) << x << ", " << y;
            EXPECT_EQ(whole.d.at(x, y, 0), reached ? -5.0f : 0.0f);
            EXPECT_EQ(whole.d.at(x, y, 1), reached ? 2.0f : 0.0f);
        }
    }
    const FlowField part = invert_flow(uniform_flow(size, {-2.5f, 0.25f}));
    for (int y = 2; y < size.height - 2; ++y) {
        for (int x = 1; x < size.width - 4; ++x) {
            ASSERT_EQ(part.valid.at(x, y), 255);
            EXPECT_NEAR(part.d.at(x, y, 0), 2.5f, 1e-5f);
            EXPECT_NEAR(part.d.at(x, y, 1), -0.25f, 1e-5f);
        }
    }
}

TEST(InvertFlow, IsUnknownWhereSurfacesFoldOver) {
    const Size size{60, 20};
    FlowField flow(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            flow.d.at(x, y, 0) = x < 30 ? 8.0f : -8.0f;
    }
    const FlowField inverse = invert_flow(flow);
    EXPECT_EQ(share_valid(inverse, {22, 0, 38, size.height}), 0.0);  // both sides land here
    EXPECT_EQ(share_valid(inverse, {8, 0, 22, size.height}), 1.0);
    EXPECT_EQ(share_valid(inverse, {38, 0, 52, size.height}), 1.0);
    EXPECT_EQ(share_valid(inverse, {0, 0, 8, size.height}), 0.0);  // nothing lands here
    EXPECT_EQ(inverse.d.at(10, 3, 0), -8.0f);
    EXPECT_EQ(inverse.d.at(45, 3, 0), 8.0f);
}

TEST(InvertFlow, LeavesOutWhatIsInvalidOrNotANumber) {
    FlowField flow = uniform_flow({20, 20}, {3, 0});
    flow.valid.at(8, 8) = 0;
    flow.d.at(8, 12, 0) = std::numeric_limits<float>::quiet_NaN();
    flow.d.at(8, 14, 1) = std::numeric_limits<float>::infinity();
    const FlowField inverse = invert_flow(flow);
    EXPECT_EQ(inverse.valid.at(11, 8), 0);
    EXPECT_EQ(inverse.valid.at(11, 12), 0);
    EXPECT_EQ(inverse.valid.at(11, 14), 0);
    EXPECT_EQ(inverse.valid.at(11, 9), 255);
}

TEST(InvertFlow, SendsFarMotionNowhere) {
    const FlowField inverse = invert_flow(uniform_flow({20, 20}, {3e9f, -1e30f}));
    EXPECT_EQ(share_valid(inverse, {0, 0, 20, 20}), 0.0);
}

}  // namespace
}  // namespace weft
