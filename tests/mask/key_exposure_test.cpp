#include "engine/mask/key_exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/mask/matte_propagation.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

ImageU8x3 brightened(ImageU8x3 frame, const Recti& where, Vec3 gain) {
    for (int y = where.y0; y < where.y1; ++y) {
        for (int x = where.x0; x < where.x1; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float code = gain[c] * frame.at(x, y, c);
                frame.at(x, y, c) = static_cast<std::uint8_t>(std::min(code + 0.5f, 255.0f));
            }
        }
    }
    return frame;
}

float mean_difference(const ImageU8x3& a, const ImageU8x3& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size_bytes(); ++i)
        sum += std::abs(a.data()[i] - b.data()[i]);
    return static_cast<float>(sum / static_cast<double>(a.size_bytes()));
}

bool same(const ImageU8x3& a, const ImageU8x3& b) {
    return std::equal(a.data(), a.data() + a.size_bytes(), b.data());
}

// The exposure of a disc's frames 1 to `frames`, which grow brighter by `gain` each.
float difference_after(int frames, Vec3 gain, const Recti& where) {
    const test::DiscScene scene;
    KeyExposure exposure;
    ImageU8x3 before = scene.frame(0);
    Vec3 total(1);
    for (int t = 1; t <= frames; ++t) {
        total *= gain;
        before = exposure.evened(brightened(scene.frame(t), where, total), before,
                                 scene.prev_from_cur(t));
    }
    return mean_difference(before, scene.frame(frames));
}

constexpr Recti kAll{0, 0, 160, 120};

TEST(KeyExposure, UndoesWhatACameraDoesByItself) {
    // Brighter by a half, and darker by a third, a step at a time: as it comes these differ by
    // fifty and thirty levels.
    EXPECT_LT(difference_after(10, Vec3(1.04f), kAll), 12);
    EXPECT_LT(difference_after(10, Vec3(0.96f), kAll), 12);
    EXPECT_LT(difference_after(1, Vec3(1.3f), kAll), 12);
    EXPECT_LT(difference_after(8, Vec3(1.04f, 1, 0.97f), kAll), 8);
}

TEST(KeyExposure, LeavesAShotThatKeepsItsExposure) {
    const test::DiscScene scene;
    KeyExposure exposure;
    ImageU8x3 before = scene.frame(0);
    for (int t = 1; t < 20; ++t) {
        const ImageU8x3 shown = scene.frame(t, 11);
        before = exposure.evened(shown, before, scene.prev_from_cur(t));
        EXPECT_TRUE(same(before, shown)) << t;
    }
}

TEST(KeyExposure, TakesNoShadeForOne) {
    const test::DiscScene scene;
    KeyExposure exposure;
    const ImageU8x3 shown = brightened(scene.frame(1), {0, 0, 100, 120}, Vec3(0.6f));
    EXPECT_TRUE(same(exposure.evened(shown, scene.frame(0), scene.prev_from_cur(1)), shown));
}

// A plain road that a white car leaves, after which the camera opens up.
struct Road {
    static constexpr Size kFrame{160, 120};
    static bool on_car(int x, int y, int t) {
        return x >= 50 && x < 100 && y >= 30 - 12 * t && y < 100 - 12 * t;
    }
    static ImageU8x3 frame(int t) {
        ImageU8x3 out(kFrame);
        Rng rng(5, static_cast<std::uint64_t>(t));
        const double gain = std::pow(1.05, std::max(0, t - 3));
        for (int y = 0; y < kFrame.height; ++y) {
            for (int x = 0; x < kFrame.width; ++x) {
                const double grain = rng.uniform() * 4 - 2, level = on_car(x, y, t) ? 200 : 52;
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) =
                        static_cast<std::uint8_t>(std::min(255.0, gain * level + grain + 0.5));
            }
        }
        return out;
    }
    static Matte matte(int t) {
        Matte out(kFrame);
        for (int y = 0; y < kFrame.height; ++y)
            for (int x = 0; x < kFrame.width; ++x)
                out.at(x, y) = on_car(x, y, t) ? 0 : 255;
        return out;
    }
    // What is plain is hardly found again by its motion.
    static FlowField prev_from_cur(int t) {
        FlowField out(kFrame);
        Rng rng(6, static_cast<std::uint64_t>(t));
        for (int y = 0; y < kFrame.height; ++y) {
            for (int x = 0; x < kFrame.width; ++x) {
                out.d.at(x, y, 1) = on_car(x, y, t) ? 12 : 0;
                const bool uncovered = !on_car(x, y, t) && on_car(x, y, t - 1);
                if (uncovered || rng.uniform() < 0.4) out.valid.at(x, y) = 0;
            }
        }
        return out;
    }
};

TEST(Propagation, APlainSurfaceStaysWhileTheExposureChanges) {
    MatteWalker walker(Road::frame(0), Road::matte(0));
    MatteEstimate last;
    for (int t = 1; t <= 24; ++t)
        last = walker.advance(Road::frame(t), Road::prev_from_cur(t));
    EXPECT_GT(test::overlap(last.matte, Road::matte(24)), 0.97f);
}

}  // namespace
}  // namespace weft
