#include "engine/synthesis/texture_plane.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "engine/core/parallel.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

using testing::HasSubstr;

struct Shape {
    int sample_w, sample_h, plane_w, plane_h, overlap;
    bool tileable;
};

class EveryShape : public testing::TestWithParam<Shape> {};

TEST_P(EveryShape, IsFilledAndRecounts) {
    const Shape s = GetParam();
    const ImageU8x3 sample = blob_sample(s.sample_w, s.sample_h, 1);
    PlaneOptions o = sized(s.plane_w, s.plane_h);
    o.overlap_px = s.overlap;
    o.tileable = s.tileable;
    for (const SeamMethod method :
         {SeamMethod::kGraphCut, SeamMethod::kDynamicProgramming, SeamMethod::kNone}) {
        o.seam = method;
        expect_sound(sample, grow(sample, o), o);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, EveryShape,
    testing::Values(Shape{96, 96, 200, 150, 36, false}, Shape{96, 96, 200, 150, 36, true},
                    Shape{24, 24, 70, 60, 12, false}, Shape{24, 24, 70, 60, 12, true},
                    Shape{120, 40, 130, 170, 20, false}, Shape{40, 120, 130, 170, 20, true},
                    Shape{300, 260, 320, 300, 36, false}, Shape{300, 260, 320, 300, 36, true},
                    Shape{150, 150, 97, 61, 60, true}, Shape{96, 96, 1, 1, 36, false},
                    Shape{96, 96, 1, 1, 36, true}, Shape{96, 96, 5, 200, 36, true},
                    Shape{96, 96, 3, 2, 36, true}, Shape{96, 96, 96, 96, 36, true},
                    Shape{48, 50, 99, 33, 48, true}, Shape{40, 40, 90, 90, 36, false}));

TEST(TexturePlane, SameBytesForAnyThreadCountAndAgain) {
    const ImageU8x3 sample = blob_sample(96, 96, 2);
    for (const bool tileable : {false, true}) {
        PlaneOptions o = sized(180, 180);
        o.tileable = tileable;
        o.feather_px = 2;
        o.refine_passes = 1;
        set_thread_count(1);
        const TexturePlane one = grow(sample, o);
        set_thread_count(2);
        const TexturePlane two = grow(sample, o);
        set_thread_count(0);
        EXPECT_EQ(one.pixels, two.pixels);
        EXPECT_EQ(one.source, two.source);
        EXPECT_EQ(one.stats.seam_energy, two.stats.seam_energy);
    }
}

TEST(TexturePlane, EachKeyOfTheRandomNumbersGivesAnotherPlane) {
    const ImageU8x3 sample = blob_sample(96, 96, 3);
    PlaneOptions o = sized(180, 120);
    const ImageU8x3 first = grow(sample, o).pixels;
    PlaneOptions seed = o, region = o, frame = o;
    seed.seed = 2;
    region.region = 1;
    frame.frame = 1;
    for (const PlaneOptions& other : {seed, region, frame}) {
        EXPECT_NE(grow(sample, other).pixels, first);
    }
}

TEST(TexturePlane, GraphCutHasTheLeastSeamEnergy) {
    const ImageU8x3 sample = blob_sample(96, 96, 4);
    std::map<SeamMethod, double> energy;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const SeamMethod method :
             {SeamMethod::kGraphCut, SeamMethod::kDynamicProgramming, SeamMethod::kNone}) {
            PlaneOptions o = sized(256, 256);
            o.seam = method;
            o.seed = seed;
            energy[method] += grow(sample, o).stats.seam_energy_per_area;
        }
    }
    EXPECT_LT(energy[SeamMethod::kGraphCut], energy[SeamMethod::kDynamicProgramming]);
    EXPECT_LT(energy[SeamMethod::kDynamicProgramming], energy[SeamMethod::kNone]);
    EXPECT_LT(energy[SeamMethod::kGraphCut], 0.85 * energy[SeamMethod::kNone]);
}

TEST(TexturePlane, RegularPatternsStayAligned) {
    const ImageU8x3 bricks = brick_sample(96, 96, 24, 12);
    PlaneOptions o = sized(300, 300);
    EXPECT_EQ(grow(bricks, o).stats.seam_energy, 0.0);
    // A torus whose sides are whole numbers of bricks closes without a fault.
    o.size = {24 * 10, 24 * 9};
    o.tileable = true;
    EXPECT_EQ(grow(bricks, o).stats.seam_energy, 0.0);
}

// The share of texels that show the same source pixel as the texel one step away, over the worst
// step: near 1 for a sample that is simply repeated.
double worst_repeat(const Image<std::int32_t, 2>& source) {
    double worst = 0;
    for (int dy = 0; dy <= 120; ++dy) {
        for (int dx = -120; dx <= 120; ++dx) {
            if (dy == 0 && dx <= 0) continue;
            int same = 0, all = 0;
            for (int y = 0; y + dy < source.height(); y += 3) {
                for (int x = std::max(0, -dx); x + std::max(dx, 0) < source.width(); x += 3) {
                    const auto *a = source.pixel(x, y), *b = source.pixel(x + dx, y + dy);
                    same += a[0] == b[0] && a[1] == b[1];
                    ++all;
                }
            }
            worst = std::max(worst, static_cast<double>(same) / all);
        }
    }
    return worst;
}

TEST(TexturePlane, DoesNotRepeatInAGrid) {
    EXPECT_LT(worst_repeat(grow(blob_sample(96, 96, 5), sized(400, 400)).source), 0.25);
    EXPECT_LT(worst_repeat(grow(blob_sample(300, 300, 5), sized(400, 400)).source), 0.25);
}

TEST(TexturePlane, ATorusIsAsGoodAcrossItsBordersAsInside) {
    const ImageU8x3 sample = blob_sample(96, 96, 6);
    PlaneOptions o = sized(240, 240);
    o.tileable = true;
    const TexturePlane plane = grow(sample, o);
    // Mean step between texels two columns apart, across the border and elsewhere.
    const auto step_at = [&](int x) {
        double sum = 0;
        for (int y = 0; y < 240; ++y) {
            for (int c = 0; c < 3; ++c) {
                sum += std::abs(plane.pixels.at(x, y, c) - plane.pixels.at((x + 1) % 240, y, c));
            }
        }
        return sum / (240 * 3);
    };
    double inside = 0;
    for (int x = 0; x < 239; ++x)
        inside += step_at(x) / 239;
    EXPECT_LT(step_at(239), 1.25 * inside);
    o.tileable = false;
    const ImageU8x3 open = grow(sample, o).pixels;
    double across = 0;
    for (int y = 0; y < 240; ++y) {
        for (int c = 0; c < 3; ++c)
            across += std::abs(open.at(239, y, c) - open.at(0, y, c));
    }
    EXPECT_GT(across / (240 * 3), 1.5 * inside);
}

TEST(TexturePlane, AFlatSampleGivesAFlatPlaneAndAWarning) {
    const ImageU8x3 flat(50, 60, 77);
    PlaneOptions o = sized(130, 90);
    o.overlap_px = 24;
    for (const bool tileable : {false, true}) {
        o.tileable = tileable;
        const TexturePlane plane = grow(flat, o);
        EXPECT_EQ(plane.pixels, ImageU8x3(130, 90, 77));
        EXPECT_EQ(plane.stats.seam_energy, 0.0);
    }
    ASSERT_TRUE(sample_warning(flat));
    EXPECT_THAT(*sample_warning(flat), HasSubstr("one flat colour"));
    EXPECT_FALSE(sample_warning(blob_sample(50, 60, 1)));
}

TEST(TexturePlane, BadRequestsSayWhatToDo) {
    const auto message = [](ViewU8x3 sample, const PlaneOptions& o) {
        const auto plane = grow_plane(sample, o);
        if (plane) return std::string("no error");
        EXPECT_EQ(plane.error().code, ErrorCode::kUsage);
        return plane.error().text();
    };
    PlaneOptions o = sized(100, 100);
    EXPECT_THAT(message(blob_sample(30, 90, 1), o),
                HasSubstr("30x90 px, smaller than the overlap of 36 px"));
    EXPECT_THAT(message(blob_sample(23, 90, 1), o), HasSubstr("at least 24x24"));
    EXPECT_THAT(message(ImageU8x3{}, o), HasSubstr("at least 24x24"));
    o.overlap_px = 11;
    EXPECT_THAT(message(blob_sample(90, 90, 1), o), HasSubstr("at least 12 px"));
    o = sized(0, 100);
    EXPECT_THAT(message(blob_sample(90, 90, 1), o), HasSubstr("1 to 16384"));
    o = sized(100, 16385);
    EXPECT_THAT(message(blob_sample(90, 90, 1), o), HasSubstr("1 to 16384"));
}

TEST(TexturePlane, StopsWhenCancelledAndReportsProgress) {
    const ImageU8x3 sample = blob_sample(96, 96, 7);
    CancelToken cancel;
    std::int64_t last = 0;
    int events = 0;
    const auto plane = grow_plane(sample, sized(300, 300), cancel, [&](const ProgressEvent& e) {
        EXPECT_GE(e.done, last);
        EXPECT_LE(e.done, e.total);
        EXPECT_EQ(e.total, 300 * 300);
        last = e.done;
        if (++events == 4) cancel.cancel(130);
    });
    ASSERT_FALSE(plane);
    EXPECT_EQ(plane.error().code, ErrorCode::kInterrupted);
    EXPECT_EQ(events, 4);
}

TEST(TexturePlane, StatisticsAreHonest) {
    PlaneOptions o = sized(256, 256);
    o.refine_passes = 1;
    const auto begin = std::chrono::steady_clock::now();
    const TexturePlane plane = grow(blob_sample(96, 96, 8), o);
    const double measured_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const PlaneStats& s = plane.stats;
    EXPECT_GT(s.search_s, 0);
    EXPECT_GT(s.seam_s, 0);
    EXPECT_GT(s.refine_s, 0);
    // The total is that of the whole call, and no part of it is counted twice: what remains is not
    // negative.
    EXPECT_LE(s.total_s, measured_s);
    EXPECT_GT(s.total_s, 0.5 * measured_s);
    EXPECT_GE(s.other_s, 0);
    EXPECT_LT(s.other_s, s.total_s - s.search_s - s.refine_s);
    EXPECT_GE(s.placements, 9);
    // The graph is confined to one patch's overlap.
    EXPECT_GT(s.peak_graph_bytes, 10'000u);
    EXPECT_LT(s.peak_graph_bytes, 96u * 96u * 60u);
}

}  // namespace
}  // namespace weft::test
