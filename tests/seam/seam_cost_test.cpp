#include "engine/seam/seam_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/seam/random_problems.h"

namespace weft::test {
namespace {

ImageU8x3 noise(int w, int h, Rng& rng) {
    ImageU8x3 image(w, h);
    for (int i = 0; i < w * h * 3; ++i)
        image.data()[i] = static_cast<std::uint8_t>(rng.below(256));
    return image;
}

double norm(const std::uint8_t* a, const std::uint8_t* b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(SeamCost, IsKwatrasFormula) {
    Rng rng(21);
    const ImageU8x3 a = noise(9, 7, rng), b = noise(9, 7, rng);
    SeamProblem p = strip(9, 7, rng, Costs::kZeros);
    fill_seam_costs(a, b, p);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 9; ++x) {
            const auto expected = [&](int qx, int qy) {
                const double mismatch =
                    norm(a.pixel(x, y), b.pixel(x, y)) + norm(a.pixel(qx, qy), b.pixel(qx, qy));
                const double gradient =
                    norm(a.pixel(x, y), a.pixel(qx, qy)) + norm(b.pixel(x, y), b.pixel(qx, qy));
                return mismatch / (gradient + kGradientFloor) * kSeamCostScale;
            };
            if (x + 1 < 9) {
                EXPECT_NEAR(p.right.at(x, y), expected(x + 1, y), 2.0);
            }
            if (y + 1 < 7) {
                EXPECT_NEAR(p.down.at(x, y), expected(x, y + 1), 2.0);
            }
        }
    }
}

TEST(SeamCost, EqualPicturesCostNothingAndEdgesAreCheap) {
    Rng rng(22);
    const ImageU8x3 a = noise(6, 6, rng);
    SeamProblem p = strip(6, 6, rng, Costs::kDistinct);
    fill_seam_costs(a, a, p);
    EXPECT_EQ(solve_seam(p).energy, 0);

    // The same mismatch costs less where both pictures have an edge.
    ImageU8x3 flat_a(2, 1, 100), flat_b(2, 1, 120), edge_a(2, 1, 100), edge_b(2, 1, 120);
    for (int c = 0; c < 3; ++c)
        edge_a.at(1, 0, c) = 180, edge_b.at(1, 0, c) = 200;
    SeamProblem flat = strip(2, 1, rng, Costs::kDistinct), edge = flat;
    fill_seam_costs(flat_a, flat_b, flat);
    fill_seam_costs(edge_a, edge_b, edge);
    EXPECT_LT(edge.right.at(0, 0) * 5, flat.right.at(0, 0));
}

TEST(SeamCost, LargestCostFitsInThirtyTwoBits) {
    Rng rng(23);
    SeamProblem p = strip(2, 1, rng, Costs::kDistinct);
    fill_seam_costs(ImageU8x3(2, 1, 0), ImageU8x3(2, 1, 255), p);
    EXPECT_NEAR(p.right.at(0, 0), 2 * 255 * std::sqrt(3.0) / kGradientFloor * kSeamCostScale, 4.0);
}

TEST(SeamCost, ThePapersVariantIsItsFormula) {
    Rng rng(9);
    ImageU8x3 a(7, 5), b(7, 5), target(7, 5);
    Matte known(7, 5, 0);
    for (ImageU8x3* picture : {&a, &b, &target}) {
        for (int y = 0; y < 5; ++y) {
            for (int i = 0; i < 21; ++i)
                picture->row(y)[i] = static_cast<std::uint8_t>(rng.below(256));
        }
    }
    for (int x = 0; x < 4; ++x)
        known.at(x, 2) = 255;
    SeamProblem p;
    p.cells = Image<SeamCell, 1>(7, 5, SeamCell::kFree);
    fill_paper_costs(a, b, target, known, p);
    const auto wanted = [&](int x, int y, int c) {
        return known.at(x, y) ? static_cast<double>(target.at(x, y, c))
                              : (a.at(x, y, c) + b.at(x, y, c)) / 2.0;
    };
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x) {
            for (const Vec2i d : {Vec2i{1, 0}, Vec2i{0, 1}}) {
                if (x + d.x >= 7 || y + d.y >= 5) continue;
                double sum = 0;
                for (int c = 0; c < 3; ++c)
                    sum += std::pow(wanted(x, y, c) - wanted(x + d.x, y + d.y, c), 2);
                EXPECT_NEAR((d.x ? p.right : p.down).at(x, y), sum / (255 * 255) * kSeamCostScale,
                            0.51);
            }
        }
    }
}

TEST(SeamCost, DataTermsPullTowardsTheTarget) {
    Rng rng(24);
    const ImageU8x3 a(8, 8, 60), b(8, 8, 70), target(8, 8, 69);
    SeamProblem p = strip(8, 8, rng, Costs::kZeros);
    fill_seam_costs(a, b, p);
    fill_data_costs(a, b, target, Matte(8, 8, 255), 1000.0f, p);
    EXPECT_GT(p.old_cost.at(3, 3), p.new_cost.at(3, 3));
    EXPECT_EQ(solve_seam(p).labels.at(1, 4), 1);
    fill_data_costs(a, b, target, Matte(8, 8, 0), 1000.0f, p);
    EXPECT_EQ(p.old_cost.at(3, 3), 0);
}

}  // namespace
}  // namespace weft::test
