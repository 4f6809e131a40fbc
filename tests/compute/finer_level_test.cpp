#include "engine/compute/finer_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/compute/plane_pyramid.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

using Plane = Image<float, 4>;

Plane grains(Size size) {
    Rng rng(21);
    Plane out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<float>(rng.uniform());
        }
    }
    return out;
}

// Bright lines of `width` texels on a darker ground, 24 texels apart, at an angle: the exact mean
// over each texel of a plane magnified `zoom` times.
Plane lines(double width, double degrees, int side, int zoom) {
    const double angle = degrees * M_PI / 180, nx = std::cos(angle), ny = std::sin(angle);
    constexpr int kCells = 16;
    Plane out(side * zoom, side * zoom);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            int lit = 0;
            for (int k = 0; k < kCells * kCells; ++k) {
                const int column = k % kCells, row = k / kCells;
                const double d = nx * ((x + (column + 0.5) / kCells) / zoom - side / 2.0) +
                                 ny * ((y + (row + 0.5) / kCells) / zoom - side / 2.0);
                lit += std::abs(d - 24 * std::round(d / 24)) < width / 2;
            }
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = 0.1f + 0.5f * static_cast<float>(lit) / (kCells * kCells);
        }
    }
    return out;
}

// Catmull–Rom at a position in texels: what the sampler does.
double cubic_at(const Plane& plane, double u, double v) {
    const auto weight = [](double t) {
        t = std::abs(t);
        if (t < 1) return 1.5 * t * t * t - 2.5 * t * t + 1;
        return t < 2 ? -0.5 * t * t * t + 2.5 * t * t - 4 * t + 2 : 0.0;
    };
    const int x0 = static_cast<int>(std::floor(u - 0.5)),
              y0 = static_cast<int>(std::floor(v - 0.5));
    double sum = 0;
    for (int y = y0 - 1; y <= y0 + 2; ++y) {
        for (int x = x0 - 1; x <= x0 + 2; ++x) {
            sum += weight(u - 0.5 - x) * weight(v - 0.5 - y) *
                   plane.at(std::clamp(x, 0, plane.width() - 1),
                            std::clamp(y, 0, plane.height() - 1), 0);
        }
    }
    return sum;
}

// Deviation of the tone along the middle of a line, over the contrast.
double beads(const Plane& plane, double degrees, int side) {
    const double angle = degrees * M_PI / 180, zoom = static_cast<double>(plane.width()) / side;
    constexpr double kStep = 0.13;
    const int n = static_cast<int>(std::ceil(0.6 * side / kStep));
    double sum = 0, squares = 0;
    for (int k = 0; k < n; ++k) {
        const double along = -0.3 * side + k * kStep;
        const double v = cubic_at(plane, (side / 2.0 - std::sin(angle) * along) * zoom,
                                  (side / 2.0 + std::cos(angle) * along) * zoom);
        sum += v, squares += v * v;
    }
    return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n)) / 0.5;
}

// Of the gradients of two planes of one size, in dB of a range of 1.
double gradient_psnr(const Plane& truth, const Plane& is) {
    double sum = 0;
    for (int y = 8; y < truth.height() - 8; ++y) {
        for (int x = 8; x < truth.width() - 8; ++x) {
            const auto change = [&](int dx, int dy) {
                return (truth.at(x + dx, y + dy, 0) - truth.at(x, y, 0)) -
                       (is.at(x + dx, y + dy, 0) - is.at(x, y, 0));
            };
            sum += std::pow(change(1, 0), 2) + std::pow(change(0, 1), 2);
        }
    }
    return -10 * std::log10(sum / 2 / (truth.width() - 16) / (truth.height() - 16));
}

Plane by_cubic(const Plane& plane, int zoom) {
    Plane out(plane.width() * zoom, plane.height() * zoom);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y, 0) =
                static_cast<float>(cubic_at(plane, (x + 0.5) / zoom, (y + 0.5) / zoom));
    }
    return out;
}

Plane twice_finer(const Plane& plane) {
    return finer_level(finer_level(plane, WrapMode::kClamp), WrapMode::kClamp);
}

TEST(FinerLevel, ALineHasNoBeads) {
    for (const double degrees : {3.0, 7.0, 15.0, 30.0, 45.0}) {
        const Plane plane = lines(2, degrees, 96, 1);
        const double naive = beads(plane, degrees, 96);
        EXPECT_GT(naive, 0.01) << degrees;
        EXPECT_LT(beads(twice_finer(plane), degrees, 96), naive / 5) << degrees;
    }
}

TEST(FinerLevel, ALineIsNearerToTheTruthThanByACubic) {
    for (const double width : {1.0, 2.0}) {
        for (const double degrees : {7.0, 15.0, 30.0}) {
            const Plane plane = lines(width, degrees, 64, 1), truth = lines(width, degrees, 64, 4);
            EXPECT_GT(gradient_psnr(truth, twice_finer(plane)),
                      gradient_psnr(truth, by_cubic(plane, 4)) + 0.6)
                << width << " texels at " << degrees;
        }
    }
}

TEST(FinerLevel, NoTexelLeavesTheRangeAroundIt) {
    const Plane plane = grains({61, 47});
    const Plane fine = finer_level(plane, WrapMode::kRepeat);
    ASSERT_EQ(fine.size(), (Size{122, 94}));
    for (int y = 0; y < fine.height(); ++y) {
        for (int x = 0; x < fine.width(); ++x) {
            float least = 1, most = 0;
            for (int k = 0; k < 9; ++k) {
                const float v =
                    plane.at(wrapped_index(x / 2 + k % 3 - 1, 61, WrapMode::kRepeat),
                             wrapped_index(y / 2 + k / 3 - 1, 47, WrapMode::kRepeat), 1);
                least = std::min(least, v), most = std::max(most, v);
            }
            ASSERT_GE(fine.at(x, y, 1), least);
            ASSERT_LE(fine.at(x, y, 1), most);
        }
    }
}

// The light of an area does not change: half as fine again, it is the plane.
TEST(FinerLevel, KeepsTheLightOfEveryTexel) {
    const Plane plane = lines(3, 20, 64, 1), fine = finer_level(plane, WrapMode::kClamp);
    double off = 0, naive = 0;
    const Plane cubic = by_cubic(plane, 2);
    for (int y = 4; y < 60; ++y) {
        for (int x = 4; x < 60; ++x) {
            const auto mean = [&](const Plane& p) {
                return 0.25f * (p.at(2 * x, 2 * y, 0) + p.at(2 * x + 1, 2 * y, 0) +
                                p.at(2 * x, 2 * y + 1, 0) + p.at(2 * x + 1, 2 * y + 1, 0));
            };
            off += std::abs(mean(fine) - plane.at(x, y, 0));
            naive += std::abs(mean(cubic) - plane.at(x, y, 0));
        }
    }
    EXPECT_LT(off, naive / 2);
}

TEST(FinerLevel, JoinsAsThePlaneDoesAndTilesDoNotShow) {
    // Moved by half its own size, and so cut into other tiles, a repeating plane is the same.
    const Plane plane = grains({250, 130});
    Plane moved(plane.size());
    for (int y = 0; y < 130; ++y) {
        for (int x = 0; x < 250; ++x)
            std::copy_n(plane.pixel((x + 125) % 250, (y + 65) % 130), 4, moved.pixel(x, y));
    }
    const Plane a = finer_level(plane, WrapMode::kRepeat),
                b = finer_level(moved, WrapMode::kRepeat);
    for (int y = 0; y < 260; ++y) {
        for (int x = 0; x < 500; ++x)
            ASSERT_EQ(b.at(x, y, 2), a.at((x + 250) % 500, (y + 130) % 260, 2)) << x << " " << y;
    }
}

TEST(FinerLevel, DependsNotOnThreadsAndTakesTheSmallestPlanes) {
    const Plane plane = grains({230, 119});
    set_thread_count(1);
    const Plane one = finer_level(plane, WrapMode::kMirror);
    for (const int threads : {2, 3}) {
        set_thread_count(threads);
        EXPECT_EQ(finer_level(plane, WrapMode::kMirror), one);
    }
    set_thread_count(0);
    const Plane dot(1, 1, 0.25f);
    for (const WrapMode wrap : {WrapMode::kRepeat, WrapMode::kMirror, WrapMode::kClamp})
        EXPECT_EQ(finer_level(dot, wrap), Plane(2, 2, 0.25f));
}

}  // namespace
}  // namespace weft
