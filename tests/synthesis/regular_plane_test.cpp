// Periodic samples: their lattice, planes on it, and the kinds of samples.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/synthesis/plane_phase.h"
#include "engine/synthesis/sample_cover.h"
#include "engine/synthesis/sample_kind.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

// A print whose repeat has the two steps, with a little noise. Each cell holds a disc and a bar.
ImageU8x3 print_sample(int side, glm::dvec2 a, glm::dvec2 b, std::uint64_t seed = 3) {
    SampleLattice lattice;
    lattice.count = 2;
    lattice.steps = {a, b};
    const LatticeWaves waves = waves_of(lattice);
    ImageU8x3 out(side, side);
    Rng rng(seed);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::dvec2 p{x, y};
            double u = glm::dot(waves[0], p), v = glm::dot(waves[1], p);
            u -= std::floor(u), v -= std::floor(v);
            const double r = std::hypot(u - 0.4, v - 0.5);
            const double disc = std::clamp((0.3 - r) * 12, 0.0, 1.0);
            const double bar = std::clamp((0.12 - std::abs(v - 0.05)) * 25, 0.0, 1.0);
            const double noise = static_cast<double>(rng.below(13));
            out.at(x, y, 0) = static_cast<std::uint8_t>(60 + 150 * disc + noise);
            out.at(x, y, 1) = static_cast<std::uint8_t>(90 + 60 * bar + noise);
            out.at(x, y, 2) = static_cast<std::uint8_t>(120 - 80 * disc + 50 * bar + noise);
        }
    }
    return out;
}

// Rows of one height, otherwise without order.
ImageU8x3 planks_sample(int side, double height) {
    ImageU8x3 out = blob_sample(side, side, 5);
    for (int y = 0; y < side; ++y) {
        const double turns = y / height;
        const double dark = std::clamp((turns - std::floor(turns)) * 1.4, 0.15, 1.0);
        for (int x = 0; x < side; ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>(
                    dark * (100 + 0.4 * static_cast<double>(out.at(x, y, c))));
        }
    }
    return out;
}

// Where in its brick, which is `side` high and twice as long, a place of a bond lies: along and
// across it from 0 to 1, and which brick it is.
struct InBrick {
    double along, across;
    int brick;
};

InBrick horizontal(double u, double v, int column, int row) {
    return {u, v, 71 * column + 37 * row};
}
InBrick upright(double u, double v, int column, int row) {
    return {v, u, 71 * column + 37 * row + 11};
}

int cell(double v) {
    return static_cast<int>(std::floor(v));
}

// Pairs of bricks, lying and upright in turn.
InBrick in_basket(glm::dvec2 p) {
    const int i = cell(p.x / 2), j = cell(p.y / 2);
    const double u = p.x / 2 - i, v = p.y / 2 - j;
    if ((i + j) % 2 == 0) return horizontal(u, 2 * v - cell(2 * v), i, 2 * j + cell(2 * v));
    return upright(2 * u - cell(2 * u), v, 2 * i + cell(2 * u), j);
}

InBrick in_herringbone(glm::dvec2 p) {
    const int i = cell(p.x), j = cell(p.y), turn = ((i - j) % 4 + 4) % 4;
    const double u = p.x - i, v = p.y - j;
    if (turn < 2) return horizontal((u + turn) / 2, v, i - turn, j);
    return upright(u, (v + (turn == 2 ? 1 : 0)) / 2, i, turn == 2 ? j - 1 : j);
}

// Bricks between joints, each of a tone of its own.
ImageU8x3 bond_sample(int size, double side, InBrick (*in_brick)(glm::dvec2)) {
    ImageU8x3 out(size, size);
    Rng noise(5);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const InBrick at = in_brick(glm::dvec2(x + 0.5, y + 0.5) / side);
            const bool joint = std::min(at.along, 1 - at.along) < 0.06 ||
                               std::min(at.across, 1 - at.across) < 0.12;
            Rng own(7, static_cast<std::uint64_t>(at.brick + 4096));
            const double tone = joint ? 150 : 70 + 40 * own.uniform();
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) =
                    static_cast<std::uint8_t>(tone + static_cast<double>(noise.below(9)));
        }
    }
    return out;
}

bool same_lattice(const SampleLattice& found, glm::dvec2 a, glm::dvec2 b, double most_px) {
    SampleLattice truth;
    truth.count = 2;
    truth.steps = reduced({a, b});
    if (found.count != 2) return false;
    const PlaneLattice in_found(found), in_truth(truth);
    return glm::length(in_found.miss(a)) < most_px && glm::length(in_found.miss(b)) < most_px &&
           glm::length(in_truth.miss(found.steps[0])) < most_px &&
           glm::length(in_truth.miss(found.steps[1])) < most_px;
}

// Every step is a whole combination of a and b, and a cell at most three of theirs: where chance
// makes some units more alike than others, the lattice may be of two or three together.
bool of_whole_units(const SampleLattice& found, glm::dvec2 a, glm::dvec2 b, double most_px) {
    SampleLattice truth;
    truth.count = 2;
    truth.steps = reduced({a, b});
    if (found.count != 2) return false;
    const auto area = [](glm::dvec2 s, glm::dvec2 t) { return std::abs(s.x * t.y - s.y * t.x); };
    const PlaneLattice in_truth(truth);
    return glm::length(in_truth.miss(found.steps[0])) < most_px &&
           glm::length(in_truth.miss(found.steps[1])) < most_px &&
           area(found.steps[0], found.steps[1]) < 3.1 * area(a, b);
}

PlaneOptions automatic(Size size, bool tileable) {
    PlaneOptions o;
    o.size = size;
    o.tileable = tileable;
    o.mode = PlaneMode::kAuto;
    o.whole_periods = true;
    return o;
}

TEST(SampleLattice, IsFoundToAFractionOfAPixel) {
    struct Case {
        glm::dvec2 a, b;
    };
    for (const Case& k : {Case{{23.37, 0}, {0, 17.81}}, Case{{30.2, 0.6}, {-0.5, 22.4}},
                          Case{{28.6, 0}, {14.3, 15.7}}, Case{{16.4, 11.2}, {-13.1, 18.3}}}) {
        const SampleLattice found = find_lattice(print_sample(96, k.a, k.b));
        EXPECT_TRUE(same_lattice(found, k.a, k.b, 0.25))
            << k.a.x << ": " << found.count << " (" << found.steps[0].x << ", " << found.steps[0].y
            << ") (" << found.steps[1].x << ", " << found.steps[1].y << ")";
        EXPECT_GT(found.confidence, 0.3);
    }
    // A longer sample says it more exactly.
    const SampleLattice found = find_lattice(print_sample(256, {23.37, 0.21}, {-0.3, 17.81}));
    EXPECT_TRUE(same_lattice(found, {23.37, 0.21}, {-0.3, 17.81}, 0.06));
}

TEST(SampleLattice, OfCoursesThatAreShifted) {
    EXPECT_TRUE(same_lattice(find_lattice(brick_sample(96, 96, 32, 14)), {32, 0}, {16, 14}, 0.3));
}

// Half a brick on, such bonds are like themselves as well, but less.
TEST(SampleLattice, OfBondsIsNotHalfABrick) {
    for (const double side : {9.7, 11.3}) {
        const glm::dvec2 whole{2 * side, 2 * side}, other{-2 * side, 2 * side};
        EXPECT_TRUE(
            of_whole_units(find_lattice(bond_sample(96, side, in_basket)), whole, other, 0.6))
            << side;
        EXPECT_TRUE(of_whole_units(find_lattice(bond_sample(96, side, in_herringbone)), whole / 2.0,
                                   other, 0.6))
            << side;
    }
}

// Courses are stripes to the eye that averages along them; their joints say where a brick begins.
TEST(SampleLattice, OfCoursesWithFaintJointsIsNotOfStripes) {
    const ImageU8x3 strong = brick_sample(96, 96, 32, 14);
    ImageU8x3 faint = strong;
    // Uneven tones of the courses drown most of what the joints say.
    Rng rng(5);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const double tone = 28.0 * std::cos(2 * std::numbers::pi * y / 14.0) + rng.below(40);
            for (int c = 0; c < 3; ++c) {
                faint.at(x, y, c) = static_cast<std::uint8_t>(
                    std::clamp(0.35 * strong.at(x, y, c) + tone + 60.0, 0.0, 255.0));
            }
        }
    }
    const SampleLattice found = find_lattice(faint);
    EXPECT_NE(found.count, 1) << "slivers: moves along the courses would be free";
    if (found.count == 2) {
        EXPECT_TRUE(of_whole_units(found, {32, 0}, {16, 14}, 1.2));
    }
}

TEST(SampleLattice, HasOneStepAcrossPlanks) {
    const SampleLattice found = find_lattice(planks_sample(96, 17.3));
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.steps[0].x, 0, 0.3);
    EXPECT_NEAR(found.steps[0].y, 17.3, 0.15);
}

TEST(SampleLattice, IsNotSeenInNoise) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6})
        EXPECT_EQ(find_lattice(blob_sample(96, 96, seed)).count, 0) << seed;
    EXPECT_EQ(find_lattice(ImageU8x3(96, 96)).count, 0);
    EXPECT_EQ(find_lattice(ImageU8x3(24, 300)).count, 0);
}

TEST(PlaneLattice, CoversHoldAPointWhereverTheyLie) {
    for (const auto& steps :
         {std::array<glm::dvec2, 2>{glm::dvec2{23.4, 0.3}, glm::dvec2{-0.2, 17.9}},
          std::array<glm::dvec2, 2>{glm::dvec2{40, 0}, glm::dvec2{20, 20}},
          std::array<glm::dvec2, 2>{glm::dvec2{16.4, 11.2}, glm::dvec2{-13.1, 18.3}}}) {
        SampleLattice sample;
        sample.count = 2;
        sample.steps = reduced(steps);
        const PlaneLattice lattice(sample);
        ASSERT_FALSE(lattice.covers().empty());
        Rng rng(11);
        for (const Size size : lattice.covers()) {
            for (int k = 0; k < 60; ++k) {
                const Vec2i first{static_cast<int>(rng.below(4000)) - 2000,
                                  static_cast<int>(rng.below(4000)) - 2000};
                const auto held = lattice.held(first, {size.width + 1, size.height + 1});
                EXPECT_NE(std::count(held.data(), held.data() + held.size_bytes(), 1), 0)
                    << size.width << "x" << size.height;
            }
        }
    }
}

TEST(PlaneLattice, IsStrainedToWholePeriodsOnATorus) {
    SampleLattice sample;
    sample.count = 2;
    sample.steps = {glm::dvec2{23.37, 0.4}, glm::dvec2{-0.3, 17.81}};
    const Size size = whole_periods(sample, {512, 512});
    EXPECT_GE(size.width, 512);
    EXPECT_LE(size.width, 576);
    const PlaneLattice lattice(sample, size);
    EXPECT_LT(lattice.strain(), 0.02);
    EXPECT_NEAR(glm::length(lattice.miss({size.width, 0})), 0, 1e-6);
    EXPECT_NEAR(glm::length(lattice.miss({0, size.height})), 0, 1e-6);
    EXPECT_EQ(whole_periods({}, {512, 300}), (Size{512, 300}));
}

TEST(RegularPlane, StaysOnOneLattice) {
    const glm::dvec2 a{23.37, 0}, b{0, 17.81};
    const ImageU8x3 sample = print_sample(96, a, b);
    const SampleLattice found = find_lattice(sample);
    for (const bool torus : {false, true}) {
        const auto plane = grow_plane(sample, automatic({640, 512}, torus));
        ASSERT_TRUE(plane);
        ASSERT_FALSE(plane->stats.lattice.empty());
        const PlanePhase phase = source_phase(plane->source, found, plane->stats.lattice);
        EXPECT_LT(phase.median_px, 0.6);
        EXPECT_LT(phase.worst_px, 1.6);
        const PlanePhase seen = seen_phase(plane->pixels, plane->stats.lattice);
        EXPECT_LT(seen.p95_px, 2.0);
        EXPECT_GT(seen.share, 0.9);
    }
    // Before, an error of each patch added up, and a torus kept no period.
    PlaneOptions before = automatic({640, 512}, true);
    before.mode = PlaneMode::kSynthesize;
    const auto plane = grow_plane(sample, before);
    ASSERT_TRUE(plane);
    EXPECT_TRUE(plane->stats.lattice.empty());
    EXPECT_EQ(plane->pixels.size(), before.size);
}

TEST(RegularPlane, OfPlanksKeepsTheirRows) {
    const ImageU8x3 sample = planks_sample(96, 17.3);
    const auto plane = grow_plane(sample, automatic({512, 512}, true));
    ASSERT_TRUE(plane);
    ASSERT_EQ(plane->stats.lattice.count(), 1);
    const PlanePhase phase =
        source_phase(plane->source, find_lattice(sample), plane->stats.lattice);
    EXPECT_LT(phase.worst_px, 1.3);
}

TEST(RegularPlane, IsTheSameByAnyNumberOfThreads) {
    const ImageU8x3 sample = print_sample(96, {28.6, 0}, {14.3, 15.7});
    for (const bool torus : {false, true}) {
        set_thread_count(1);
        const auto one = grow_plane(sample, automatic({400, 400}, torus));
        set_thread_count(3);
        const auto three = grow_plane(sample, automatic({400, 400}, torus));
        set_thread_count(0);
        ASSERT_TRUE(one && three);
        EXPECT_FALSE(one->stats.lattice.empty());
        EXPECT_EQ(one->source, three->source);
        EXPECT_EQ(one->pixels, three->pixels);
    }
}

TEST(RegularPlane, OfASampleWithoutAPeriodIsWhatItWas) {
    const ImageU8x3 sample = blob_sample(96, 96, 2);
    for (const bool torus : {false, true}) {
        PlaneOptions now = automatic({300, 260}, torus), before = now;
        before.mode = PlaneMode::kSynthesize;
        before.whole_periods = false;
        const auto a = grow_plane(sample, now), b = grow_plane(sample, before);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->pixels, b->pixels);
        EXPECT_EQ(a->source, b->source);
    }
}

// The size that was found, asked for again without room to grow, gives the same plane.
TEST(RegularPlane, OfItsOwnSizeIsTheSame) {
    const ImageU8x3 sample = print_sample(96, {23.37, 0.3}, {-0.2, 17.81});
    const auto first = grow_plane(sample, automatic({512, 512}, true));
    ASSERT_TRUE(first);
    PlaneOptions exact = automatic(first->pixels.size(), true);
    exact.whole_periods = false;
    const auto again = grow_plane(sample, exact);
    ASSERT_TRUE(again);
    EXPECT_EQ(first->pixels, again->pixels);
}

TEST(SampleCover, TilesWholePeriods) {
    const ImageU8x3 sample = brick_sample(100, 95, 32, 14);
    EXPECT_EQ(tiling_part(sample), (Recti{0, 0, 96, 84}));
    const ImageU8x3 noise = blob_sample(80, 60, 1);
    EXPECT_EQ(tiling_part(noise), (Recti{0, 0, 80, 60}));
    PlaneOptions o;
    o.size = {250, 200};
    o.mode = PlaneMode::kTile;
    const auto plane = grow_plane(sample, o);
    ASSERT_TRUE(plane);
    for (const Vec2i p : {Vec2i{0, 0}, Vec2i{97, 3}, Vec2i{249, 199}}) {
        EXPECT_EQ(plane->source.pixel(p.x, p.y)[0], p.x % 96);
        EXPECT_EQ(plane->source.pixel(p.x, p.y)[1], p.y % 84);
        EXPECT_EQ(plane->pixels.at(p.x, p.y, 1), sample.at(p.x % 96, p.y % 84, 1));
    }
}

TEST(SampleCover, MirrorsAndStretches) {
    const ImageU8x3 sample = blob_sample(40, 40, 1);
    PlaneOptions o;
    o.size = {120, 120};
    o.mode = PlaneMode::kMirror;
    const auto mirrored = grow_plane(sample, o);
    ASSERT_TRUE(mirrored);
    EXPECT_EQ(mirrored->source.pixel(40, 0)[0], 39);
    EXPECT_EQ(mirrored->source.pixel(79, 0)[0], 0);
    EXPECT_EQ(mirrored->source.pixel(80, 40)[0], 0);
    EXPECT_EQ(mirrored->source.pixel(80, 40)[1], 39);
    o.mode = PlaneMode::kStretch;
    const auto stretched = grow_plane(sample, o);
    ASSERT_TRUE(stretched);
    EXPECT_EQ(stretched->pixels.at(0, 0, 0), sample.at(0, 0, 0));
    EXPECT_EQ(stretched->pixels.at(61, 61, 2), sample.at(20, 20, 2));
    EXPECT_EQ(stretched->pixels.at(119, 119, 1), sample.at(39, 39, 1));
}

TEST(SampleKind, IsSaidWithItsReason) {
    const SampleDescription noise = describe_sample(blob_sample(96, 96, 1));
    EXPECT_EQ(noise.kind, SampleKind::kStochastic);
    const SampleDescription bricks = describe_sample(brick_sample(96, 96, 32, 14));
    EXPECT_EQ(bricks.kind, SampleKind::kPeriodic);
    EXPECT_NE(reason_of(bricks).find("21.3 px at"), std::string::npos);
    EXPECT_STREQ(kind_name(bricks.kind), "periodic");

    ImageU8x3 disc = blob_sample(96, 96, 1), vignette = disc, halves = disc;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const double r = std::hypot(x - 47.5, y - 47.5) / 47.5;
            for (int c = 0; c < 3; ++c) {
                if (r > 0.6) disc.at(x, y, c) = 200;
                vignette.at(x, y, c) = static_cast<std::uint8_t>(
                    static_cast<double>(vignette.at(x, y, c)) * std::max(0.1, 1 - 0.4 * r * r));
                if (x > 48) halves.at(x, y, c) = static_cast<std::uint8_t>(halves.at(x, y, c) / 4);
            }
        }
    }
    for (const ImageU8x3* picture : {&disc, &vignette, &halves}) {
        const SampleDescription d = describe_sample(*picture);
        EXPECT_EQ(d.kind, SampleKind::kPicture) << d.border << " " << d.radial << " " << d.uneven;
        EXPECT_FALSE(reason_of(d).empty());
    }
}

}  // namespace
}  // namespace weft::test
