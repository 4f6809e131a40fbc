#include "engine/synthesis/placement_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/synthesis/contact.h"
#include "engine/synthesis/fft_correlation.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

struct Scene {
    ImageU8x3 sample, pixels, guide;
    Image<std::uint8_t, 1> filled, known;
    Vec2i lo{0, 0}, hi{0, 0};
    MatchTarget target;
};

// A block with a ragged L of filled pixels; the sample may lie on it with `freedom` px to each
// side.
Scene make_scene(int sample_w, int sample_h, int block_w, int block_h, int freedom, bool guided,
                 std::uint64_t seed) {
    Scene s;
    Rng rng(seed);
    s.sample = blob_sample(sample_w, sample_h, seed);
    s.pixels = blob_sample(block_w, block_h, seed + 1);
    s.guide = blob_sample(block_w, block_h, seed + 2);
    s.filled = s.known = Image<std::uint8_t, 1>(block_w, block_h, 0);
    for (int x = 0; x < block_w; ++x) {
        const auto top = block_h / 4 + static_cast<int>(rng.below(4));
        for (int y = 0; y < block_h; ++y) {
            s.filled.at(x, y) = y < top || x < block_w / 4;
            s.known.at(x, y) = (x + y) % 3 != 0;
        }
    }
    s.lo = {std::min(0, block_w - sample_w) - freedom, std::min(0, block_h - sample_h) - freedom};
    s.hi = {freedom, freedom};
    s.target = {s.pixels, s.filled, {}, {}, 1, 0};
    if (guided) s.target = {s.pixels, s.filled, s.guide, s.known, 256, 100};
    return s;
}

OverlapCost cost_by_definition(const Scene& s, Vec2i t) {
    OverlapCost cost;
    for (int y = 0; y < s.filled.height(); ++y) {
        for (int x = 0; x < s.filled.width(); ++x) {
            const int sx = x - t.x, sy = y - t.y;
            if (sx < 0 || sy < 0 || sx >= s.sample.width() || sy >= s.sample.height()) continue;
            const auto add = [&](const std::uint8_t* p, std::uint32_t weight) {
                for (int c = 0; c < 3; ++c) {
                    const int d = p[c] - s.sample.at(sx, sy, c);
                    cost.ssd += static_cast<std::uint64_t>(d * d) * weight;
                }
                cost.weight += weight;
            };
            if (s.filled.at(x, y)) add(s.pixels.pixel(x, y), s.target.fill_weight);
            if (!s.target.guide.empty() && s.known.at(x, y)) {
                add(s.guide.pixel(x, y), s.target.guide_weight);
            }
        }
    }
    return cost;
}

TEST(OverlapCost, IsTheDefinition) {
    for (const bool guided : {false, true}) {
        const Scene s = make_scene(40, 31, 52, 44, 9, guided, 5);
        const OverlapScorer scorer(s.target, s.sample);
        for (int ty = s.lo.y; ty <= s.hi.y; ++ty) {
            for (int tx = s.lo.x; tx <= s.hi.x; ++tx) {
                const OverlapCost a = scorer.cost({tx, ty}), b = cost_by_definition(s, {tx, ty});
                ASSERT_EQ(a.ssd, b.ssd);
                ASSERT_EQ(a.weight, b.weight);
            }
        }
    }
}

TEST(OverlapCost, LargestSumIsExact) {
    const ImageU8x3 black(512, 512, 0), white(512, 512, 255);
    const Image<std::uint8_t, 1> all(512, 512, 1);
    const OverlapScorer scorer({black, all, {}, {}, 1, 0}, white);
    EXPECT_EQ(scorer.cost({0, 0}).ssd, 512ull * 512 * 3 * 255 * 255);
}

TEST(OverlapCost, ComparesFractionsExactly) {
    const std::uint64_t big = std::uint64_t{1} << 60;
    EXPECT_TRUE(at_most({big, 3}, {big + 1, 3}));
    EXPECT_FALSE(at_most({big + 1, 3}, {big, 3}));
    EXPECT_TRUE(at_most({2, 4}, {1, 2}));
    EXPECT_FALSE(at_most({11, 10}, {1, 1}));
    EXPECT_TRUE(at_most({11, 10}, {1, 1}, 110, 100));
    EXPECT_TRUE(at_most({0, 0}, {0, 5}));
}

// The estimates of every `step`th translation against the exact costs; gives the largest share of
// the bound that is used.
double share_of_bound(const Scene& s, std::size_t step) {
    const FftCorrelation fft(s.sample, s.filled.size(), s.lo, s.hi);
    const auto estimate = fft.estimate(s.target);
    const OverlapScorer scorer(s.target, s.sample);
    double worst = 0;
    for (std::size_t i = 0; i < estimate.ssd.size(); i += step) {
        const OverlapCost exact = scorer.cost(translation_at(s.lo, s.hi, i));
        EXPECT_EQ(estimate.weight[i], exact.weight);
        worst = std::max(worst, std::abs(estimate.ssd[i] - static_cast<double>(exact.ssd)));
    }
    // Useful, too: a thousandth of a typical cost.
    EXPECT_LT(estimate.error, 3e-3 * static_cast<double>(scorer.cost(s.hi).ssd));
    return worst / estimate.error;
}

TEST(FftCorrelation, EstimateStaysWithinItsErrorBound) {
    for (const bool guided : {false, true}) {
        const double share = share_of_bound(make_scene(96, 96, 120, 120, 12, guided, 7), 1);
        EXPECT_LE(share, 1);
        EXPECT_GT(share, 1e-4);
    }
}

TEST(FftCorrelation, EstimateStaysWithinItsErrorBoundForLargeAndExtremeOnes) {
    EXPECT_LE(share_of_bound(make_scene(488, 470, 220, 200, 0, true, 8), 997), 1);
    EXPECT_LE(share_of_bound(make_scene(1280, 1000, 96, 120, 0, false, 9), 9973), 1);
    // Black and white only: the largest values that there are.
    Scene s = make_scene(200, 160, 210, 200, 20, true, 10);
    for (ImageU8x3* picture : {&s.sample, &s.pixels, &s.guide}) {
        for (std::size_t i = 0; i < picture->size_bytes(); ++i)
            picture->data()[i] = picture->data()[i] & 1 ? 255 : 0;
    }
    EXPECT_LE(share_of_bound(s, 31), 1);
}

void expect_same_lists(Scene& s, const std::vector<Vec2i>& forbidden) {
    PlacementSearch search(s.sample, s.filled.size(), s.lo, s.hi);
    const Shortlist fft = search.find(s.target, forbidden, SearchMethod::kFft);
    const Shortlist direct = search.find(s.target, forbidden, SearchMethod::kDirect);
    EXPECT_EQ(fft.best, direct.best);
    EXPECT_EQ(fft.good, direct.good);
    EXPECT_EQ(fft.best_cost.ssd, direct.best_cost.ssd);
    // The best by the definition, of equal ones the first.
    OverlapCost best{};
    Vec2i where{0, 0};
    bool any = false;
    for (int ty = s.lo.y; ty <= s.hi.y; ++ty) {
        for (int tx = s.lo.x; tx <= s.hi.x; ++tx) {
            if (std::find(forbidden.begin(), forbidden.end(), Vec2i{tx, ty}) != forbidden.end()) {
                continue;
            }
            const OverlapCost cost = cost_by_definition(s, {tx, ty});
            if (any && at_most(best, cost)) continue;
            best = cost, where = {tx, ty}, any = true;
        }
    }
    EXPECT_EQ(fft.best, where);
}

TEST(PlacementSearch, FftAndDirectGiveTheSameList) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const bool guided = seed % 3 == 0;
        Scene small = make_scene(33, 40, 41, 46, 6, guided, seed);
        expect_same_lists(small, {});
        Scene window = make_scene(70, 64, 30, 34, 4, guided, seed);
        expect_same_lists(window, {});
    }
}

TEST(PlacementSearch, ExactCopiesAndTiesAreFoundExactly) {
    // The block shows the sample itself at one place: cost 0 there, which an estimate cannot tell
    // from a small one.
    Scene s = make_scene(48, 48, 60, 60, 12, false, 3);
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 60; ++x) {
            for (int c = 0; c < 3; ++c) {
                s.pixels.at(x, y, c) =
                    s.sample.at(std::clamp(x - 7, 0, 47), std::clamp(y - 5, 0, 47), c);
            }
        }
    }
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 60; ++x) {
            if (x < 7 || y < 5) s.filled.at(x, y) = 0;
        }
    }
    PlacementSearch search(s.sample, s.filled.size(), s.lo, s.hi);
    const Shortlist list = search.find(s.target, {}, SearchMethod::kFft);
    EXPECT_EQ(list.best, (Vec2i{7, 5}));
    EXPECT_EQ(list.good.size(), 1u);
    const Shortlist without = search.find(s.target, {{7, 5}}, SearchMethod::kFft);
    EXPECT_NE(without.best, (Vec2i{7, 5}));
    expect_same_lists(s, {{7, 5}});

    // Everything ties.
    std::fill_n(s.sample.data(), 48 * 48 * 3, std::uint8_t{90});
    std::fill_n(s.pixels.data(), 60 * 60 * 3, std::uint8_t{120});
    expect_same_lists(s, {});
    EXPECT_EQ(PlacementSearch(s.sample, s.filled.size(), s.lo, s.hi)
                  .find(s.target, {}, SearchMethod::kFft)
                  .good.size(),
              25u * 25u);
}

TEST(ThinContacts, AreCountedByTheDefinition) {
    Rng rng(9);
    for (const bool torus : {false, true}) {
        Canvas canvas({40, 40}, torus);
        const std::uint8_t grey[3] = {1, 1, 1};
        for (int n = 0; n < 12; ++n) {
            const int x0 = static_cast<int>(rng.below(34)), y0 = static_cast<int>(rng.below(34));
            for (int i = 0; i < 36; ++i)
                canvas.set({x0 + i % 6, y0 + i / 6}, grey, {0, 0});
        }
        const Block block = copy_block(canvas, {8, 9, 30, 29});
        const Vec2i lo{-3, -2}, hi{4, 6}, least{4, 5};
        const Size window{17, 15};
        const auto counts = thin_contacts(canvas, block, window, lo, hi, least);
        std::size_t i = 0;
        std::uint32_t largest = 0;
        for (int ty = lo.y; ty <= hi.y; ++ty) {
            for (int tx = lo.x; tx <= hi.x; ++tx, ++i) {
                const Recti r = block.rect.intersected(
                    {8 + tx, 9 + ty, 8 + tx + window.width, 9 + ty + window.height});
                std::uint32_t expected = 0;
                // From a pixel just outside inwards.
                const auto look = [&](Vec2i outside, Vec2i in, int enough) {
                    if (!canvas.filled(outside.x, outside.y)) return;
                    int depth = 0;
                    for (Vec2i p = outside + in; depth < enough && canvas.filled(p.x, p.y);
                         p += in) {
                        // What is filled beyond the block counts on.
                        ++depth;
                    }
                    expected += depth < enough;
                };
                for (int y = r.y0; y < r.y1; ++y) {
                    look({r.x0 - 1, y}, {1, 0}, least.x);
                    look({r.x1, y}, {-1, 0}, least.x);
                }
                for (int x = r.x0; x < r.x1; ++x) {
                    look({x, r.y0 - 1}, {0, 1}, least.y);
                    look({x, r.y1}, {0, -1}, least.y);
                }
                EXPECT_EQ(counts[i], expected) << torus << " " << tx << " " << ty;
                largest = std::max(largest, expected);
            }
        }
        EXPECT_GT(largest, 0u);
    }
}

TEST(PlacementSearch, WhenAllAreForbiddenAllTakePart) {
    Scene s = make_scene(30, 30, 32, 32, 0, false, 4);
    s.lo = {0, 0};
    s.hi = {1, 0};
    PlacementSearch search(s.sample, s.filled.size(), s.lo, s.hi);
    EXPECT_FALSE(search.find(s.target, {{0, 0}, {1, 0}}).good.empty());
}

}  // namespace
}  // namespace weft::test
