// Every instruction set gives the same integers, and so the same planes.

#include <gtest/gtest.h>

#include <vector>

#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/synthesis/direct_search.h"
#include "engine/synthesis/overlap_cost.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

std::vector<Isa> instruction_sets() {
    std::vector<Isa> out;
    for (const Isa isa : {Isa::kScalar, Isa::kAvx2, Isa::kAvx512}) {
        if (isa_available(isa)) out.push_back(isa);
    }
    return out;
}

class InstructionSets : public testing::Test {
  protected:
    void TearDown() override {
        force_isa(std::nullopt);
        set_thread_count(0);
    }
};

TEST_F(InstructionSets, AreNamedAndForced) {
    for (const Isa isa : instruction_sets()) {
        force_isa(isa);
        EXPECT_EQ(current_isa(), isa);
        EXPECT_EQ(parse_isa(isa_name(isa)), isa);
    }
    EXPECT_FALSE(parse_isa("mmx"));
}

// The costs of all translations against those by OverlapScorer, for samples larger and smaller than
// the block, odd widths, several filled parts, and the largest differences that there are.
TEST_F(InstructionSets, CostsAreTheDefinition) {
    Rng rng(1);
    for (int i = 0; i < 24; ++i) {
        const Size sample_px{20 + static_cast<int>(rng.below(60)),
                             20 + static_cast<int>(rng.below(60))};
        const Size block{17 + static_cast<int>(rng.below(50)), 9 + static_cast<int>(rng.below(50))};
        const int freedom = static_cast<int>(rng.below(12));
        const Vec2i lo{std::min(0, block.width - sample_px.width) - freedom,
                       std::min(0, block.height - sample_px.height) - freedom};
        const Vec2i hi{freedom, freedom + 3};
        ImageU8x3 sample(sample_px), pixels(block), guide(block);
        const bool extreme = i % 4 == 0;
        for (ImageU8x3* picture : {&sample, &pixels, &guide}) {
            for (std::size_t k = 0; k < picture->size_bytes(); ++k) {
                picture->data()[k] = static_cast<std::uint8_t>(
                    extreme ? (picture == &sample ? 255 : 0) : rng.below(256));
            }
        }
        Image<std::uint8_t, 1> filled(block, 0), known(block, 0);
        for (int y = 0; y < block.height; ++y) {
            for (int x = 0; x < block.width; ++x) {
                filled.at(x, y) = y < block.height / 3 || x > block.width - 4 || (x + y) % 7 == 0;
                known.at(x, y) = (x * y) % 5 == 0;
            }
        }
        MatchTarget target{pixels, filled, {}, {}, 1, 0};
        if (i % 2) target = {pixels, filled, guide, known, 256, 77};
        const OverlapScorer scorer(target, sample);
        // All, single ones, and what a period leaves: some neighbours here and there.
        std::vector<std::uint8_t> allowed(
            static_cast<std::size_t>((hi.x - lo.x + 1) * (hi.y - lo.y + 1)), 1);
        for (std::size_t k = 0; i % 3 && k < allowed.size(); ++k)
            allowed[k] = i % 3 == 1 ? rng.below(40) == 0 : k / 5 % 7 == 0;
        for (const Isa isa : instruction_sets()) {
            force_isa(isa);
            const DirectSearch search(sample, block, lo, hi);
            const std::vector<OverlapCost> costs = search.costs(target, allowed);
            std::size_t k = 0;
            for (int ty = lo.y; ty <= hi.y; ++ty) {
                for (int tx = lo.x; tx <= hi.x; ++tx, ++k) {
                    const OverlapCost truth = allowed[k] ? scorer.cost({tx, ty}) : OverlapCost{};
                    ASSERT_EQ(costs[k].ssd, truth.ssd)
                        << isa_name(isa) << " " << i << ": " << tx << "," << ty;
                    ASSERT_EQ(costs[k].weight, truth.weight);
                }
            }
        }
    }
}

// A sum that passes 32 bits many times over.
TEST_F(InstructionSets, LargeSumsAreExact) {
    const Size size{1024, 700};
    const ImageU8x3 white(size, 255), black(size, 0);
    const Image<std::uint8_t, 1> filled(size, 1);
    for (const Isa isa : instruction_sets()) {
        force_isa(isa);
        const DirectSearch search(white, size, {0, 0}, {1, 1});
        const auto costs = search.costs({black, filled, {}, {}, 1, 0}, {1, 1, 1, 1});
        EXPECT_EQ(costs[0].ssd, 3ull * 255 * 255 * 1024 * 700) << isa_name(isa);
        EXPECT_EQ(costs[3].ssd, 3ull * 255 * 255 * 1023 * 699) << isa_name(isa);
    }
}

TEST_F(InstructionSets, GiveOnePlaneInAnyNumberOfThreads) {
    const ImageU8x3 sample = blob_sample(96, 96, 4);
    for (const bool rotations : {false, true}) {
        PlaneOptions o;
        o.size = {330, 420};
        o.refine_passes = 3;
        o.orientations = {rotations, rotations};
        force_isa(std::nullopt);
        set_thread_count(1);
        const auto truth = grow_plane(sample, o);
        ASSERT_TRUE(truth);
        for (const Isa isa : instruction_sets()) {
            for (const int threads : {1, 2, 5}) {
                force_isa(isa);
                set_thread_count(threads);
                const auto plane = grow_plane(sample, o);
                ASSERT_TRUE(plane);
                EXPECT_EQ(plane->pixels, truth->pixels) << isa_name(isa) << " " << threads;
                EXPECT_EQ(plane->source, truth->source);
                EXPECT_EQ(plane->origin, truth->origin);
            }
        }
    }
}

}  // namespace
}  // namespace weft::test
