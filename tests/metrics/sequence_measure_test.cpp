#include "engine/metrics/sequence_measure.h"

#include <gtest/gtest.h>

#include <functional>

#include "engine/core/parallel.h"
#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

constexpr Size kClipSize{160, 120};
constexpr float kStepX = 1.75f;
constexpr float kStepY = -0.5f;

// A square that moves by (kStepX, kStepY) a frame over a black plate; the plate's own surface is a
// second texture that moves along.
struct Clip {
    ImageU8x3 plane = synthetic::blobs(96, 21);
    IdealTexture surface{synthetic::blobs(96, 4)};
    FlowField motion = synthetic::constant_motion(kClipSize, kStepX, kStepY);

    static Matte matte(int t) {
        const int x = 20 + static_cast<int>(kStepX * static_cast<float>(t));
        const int y = 30 + static_cast<int>(kStepY * static_cast<float>(t));
        return synthetic::rectangle(kClipSize, {x, y, x + 80, y + 70});
    }
    static FlowField ref_from_cur(int t) {
        return synthetic::constant_motion(kClipSize, -kStepX * static_cast<float>(t),
                                          -kStepY * static_cast<float>(t));
    }
    [[nodiscard]] ImageF3 source(int t) const {
        return cut(surface.render(ref_from_cur(t), {}), t);
    }
    static ImageF3 cut(ImageF3 picture, int t) {
        const Matte m = matte(t);
        for (int y = 0; y < kClipSize.height; ++y) {
            for (int x = 0; x < kClipSize.width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    if (m.at(x, y) == 0) picture.at(x, y, c) = 0;
                }
            }
        }
        return picture;
    }
};

SequenceMeasures measure(const std::function<ImageF3(const Clip&, int)>& result, int frames = 4,
                         bool true_motion = true) {
    const Clip clip;
    MeasureOptions options;
    options.ideal.emplace();
    options.ideal->plane = clip.plane;
    options.quantise_ideal = false;
    SequenceMeasure m(options);
    for (int t = 0; t < frames; ++t) {
        const ImageF3 r = Clip::cut(result(clip, t), t);
        const ImageF3 s = clip.source(t);
        const Matte matte = Clip::matte(t);
        MeasureFrame f;
        f.frame = 100 + t;
        f.result = r;
        f.source = s;
        f.matte = matte;
        if (true_motion) f.motion = &clip.motion;
        const auto one = m.add(f);
        EXPECT_TRUE(one.has_value());
        EXPECT_EQ(one->frame, 100 + t);
        EXPECT_EQ(one->region_pixels, 80 * 70);
        EXPECT_EQ(one->tde.has_value(), t > 0);
    }
    return m.summary();
}

ImageF3 locked(const Clip& c, int t) {
    return IdealTexture(c.plane).render(Clip::ref_from_cur(t), {});
}

TEST(SequenceMeasure, AnIdealResultIsAtTheFloor) {
    const SequenceMeasures m = measure(locked);
    EXPECT_EQ(m.frames, 4);
    EXPECT_EQ(m.motion, "given (forward)");
    EXPECT_EQ(m.tde.frames, 3);
    EXPECT_GT(m.tde_floor.mean, 0.05);
    EXPECT_LT(m.tde_floor.mean, 5);
    EXPECT_NEAR(*m.tde_over_floor, 1.0, 0.02);
    EXPECT_NEAR(m.sharpness_kept.least, 1.0, 0.005);
    EXPECT_NEAR(m.sharpness_kept.largest, 1.0, 0.005);
    ASSERT_TRUE(m.drift.has_value());
    EXPECT_LT(m.drift->mean_px, 0.05);
    EXPECT_EQ(m.outside_max, 0);
    EXPECT_EQ(m.outside_differing, 0);
    EXPECT_LT(m.source_tde.mean, 5);
}

// The second of two measures of one clip takes motion and ideal from the first: its figures are
// those that it would have found by itself.
TEST(SequenceMeasure, ATwinGivesTheSameFigures) {
    const Clip clip;
    MeasureOptions options;
    options.ideal.emplace();
    options.ideal->plane = clip.plane;
    SequenceMeasure first(options), alone(options);
    options.ideal->plane = ImageU8x3(1, 1);
    SequenceMeasure second(options);
    for (int t = 0; t < 3; ++t) {
        const ImageF3 good = Clip::cut(locked(clip, t), t);
        const ImageF3 still =
            Clip::cut(IdealTexture(clip.plane).render(FlowField(kClipSize), {}), t);
        const ImageF3 source = clip.source(t);
        const Matte matte = Clip::matte(t);
        MeasureFrame f{t, good, source, matte};
        ASSERT_TRUE(first.add(f));
        f.result = still;
        const auto by_itself = alone.add(f);
        f.twin = &first;
        const auto beside = second.add(f);
        ASSERT_TRUE(by_itself && beside);
        EXPECT_EQ(beside->tde, by_itself->tde);
        EXPECT_EQ(beside->tde_floor, by_itself->tde_floor);
        EXPECT_EQ(beside->tde_at_floor, by_itself->tde_at_floor);
        EXPECT_EQ(beside->sharpness_kept, by_itself->sharpness_kept);
    }
    EXPECT_EQ(second.summary().motion, "deepflow");
    EXPECT_GT(second.summary().tde.mean, 2 * first.summary().tde.mean);
}

TEST(SequenceMeasure, EachFaultShowsInItsOwnFigure) {
    const SequenceMeasures ideal = measure(locked);
    const SequenceMeasures still = measure(
        [](const Clip& c, int) { return IdealTexture(c.plane).render(FlowField(kClipSize), {}); });
    EXPECT_GT(*still.tde_over_floor, 6);
    EXPECT_NEAR(still.sharpness_kept.mean, 1.0, 0.2);
    const SequenceMeasures fresh = measure([](const Clip& c, int t) {
        Mat3 place(1);
        place[2][0] = static_cast<float>(31 * t * t % 96);
        place[2][1] = static_cast<float>(17 * t * t * t % 96);
        return IdealTexture(c.plane).render(Clip::ref_from_cur(t), TextureMapping(place));
    });
    EXPECT_GT(fresh.tde.mean, still.tde.mean);
    const SequenceMeasures soft = measure([](const Clip& c, int t) {
        return IdealTexture(c.plane, {Kernel::kBilinear, 8, false})
            .render(Clip::ref_from_cur(t), {});
    });
    EXPECT_LT(soft.sharpness_kept.largest, 0.95);
    const SequenceMeasures slides = measure([](const Clip& c, int t) {
        Mat3 place(1);
        place[2][0] = -0.5f * static_cast<float>(t);  // 1.5 px by the last frame.
        return IdealTexture(c.plane).render(Clip::ref_from_cur(t), TextureMapping(place));
    });
    EXPECT_NEAR(slides.drift->mean_px, 1.5, 0.05);
    EXPECT_NEAR(slides.drift->mean_x_px, 1.5, 0.05);
    const SequenceMeasures flickers = measure([](const Clip& c, int t) {
        ImageF3 p = locked(c, t);
        for (int y = 0; y < kClipSize.height; ++y) {
            for (int i = 0; i < 3 * kClipSize.width; ++i)
                p.row(y)[i] *= t % 2 == 0 ? 1.0f : 0.8f;
        }
        return p;
    });
    EXPECT_GT(flickers.tiv, ideal.tiv + 100);
    EXPECT_NEAR(flickers.tiv_relative, 0.1 * 0.1 / (0.9 * 0.9), 0.002);
    EXPECT_GT(flickers.tde.mean, ideal.tde.mean + 10);
}

TEST(SequenceMeasure, EstimatesMotionAndSaysSoWhenNoneIsGiven) {
    const SequenceMeasures m = measure(locked, 3, false);
    EXPECT_EQ(m.motion, "deepflow");
    EXPECT_LT(m.tde.mean, 6);
    EXPECT_LT(m.source_tde.mean, 6);
}

TEST(SequenceMeasure, BackwardMotionAgreesWithForward) {
    const Clip clip;
    const FlowField back = synthetic::constant_motion(kClipSize, -kStepX, -kStepY);
    MeasureOptions options;
    options.ideal.emplace();
    options.ideal->plane = clip.plane;
    SequenceMeasure m(options);
    for (int t = 0; t < 4; ++t) {
        const ImageF3 r = Clip::cut(locked(clip, t), t);
        const Matte matte = Clip::matte(t);
        MeasureFrame f{t, r, r, matte, &back, MotionDirection::kBackward, nullptr};
        ASSERT_TRUE(m.add(f).has_value());
    }
    const SequenceMeasures s = m.summary();
    EXPECT_EQ(s.motion, "given (backward)");
    EXPECT_LT(s.tde.mean, 5);
    EXPECT_NEAR(s.sharpness_kept.least, 1.0, 0.01);
    EXPECT_LT(s.drift->mean_px, 0.05);
}

TEST(SequenceMeasure, FindsAChangeOutsideTheMatte) {
    const Clip clip;
    SequenceMeasure m({});
    const ImageF3 source = clip.source(0);
    ImageF3 result = source;
    result.at(2, 2, 1) += 4.0f / 255.0f;
    const Matte matte = Clip::matte(0);
    MeasureFrame f;
    f.result = result;
    f.source = source;
    f.matte = matte;
    const FrameMeasures one = *m.add(f);
    EXPECT_EQ(one.outside_differing, 1);
    EXPECT_NEAR(one.outside_max, 4, 1e-3);
    EXPECT_NEAR(one.outside_mean, 4.0 / 3 / (160 * 120 - 80 * 70), 1e-6);
}

TEST(SequenceMeasure, RefusesAMatteOfAnotherSize) {
    SequenceMeasure m({});
    const ImageF3 p(kClipSize);
    const Matte small(20, 20, 255);
    MeasureFrame f;
    f.frame = 7;
    f.result = p;
    f.source = p;
    f.matte = small;
    const auto r = m.add(f);
    ASSERT_FALSE(r.has_value());
    EXPECT_EQ(r.error().code, ErrorCode::kUnreadable);
    EXPECT_NE(r.error().sentence().find("matte of frame 7 is 20x20"), std::string::npos);
}

TEST(SequenceMeasure, SameNumbersForAnyNumberOfThreads) {
    set_thread_count(1);
    const SequenceMeasures a = measure(locked, 3, false);
    set_thread_count(3);
    const SequenceMeasures b = measure(locked, 3, false);
    set_thread_count(0);
    EXPECT_EQ(a.tde.mean, b.tde.mean);
    EXPECT_EQ(a.tde_floor.mean, b.tde_floor.mean);
    EXPECT_EQ(a.sharpness_kept.mean, b.sharpness_kept.mean);
    EXPECT_EQ(a.rms_contrast_kept.mean, b.rms_contrast_kept.mean);
    EXPECT_EQ(a.drift->mean_px, b.drift->mean_px);
    EXPECT_EQ(a.tiv, b.tiv);
}

}  // namespace
}  // namespace weft
