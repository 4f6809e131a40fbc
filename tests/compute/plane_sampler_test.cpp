#include "engine/compute/plane_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

using Map = std::function<Vec2(Vec2)>;  // plate pixel → texel

ImageF3 plane_noise(Size size) {
    Rng rng(9);
    ImageF3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int k = 0; k < 3 * size.width; ++k)
            out.row(y)[k] = static_cast<float>(rng.uniform());
    }
    return out;
}

// Noise without the finest detail, like a photograph: every pixel the mean of 3 × 3.
ImageF3 soft_noise(Size size) {
    const ImageF3 raw = plane_noise(size);
    ImageF3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                for (int k = 0; k < 9; ++k) {
                    const int sx = (x + k % 3 + size.width - 1) % size.width;
                    const int sy = (y + k / 3 + size.height - 1) % size.height;
                    out.at(x, y, c) += raw.at(sx, sy, c) / 9;
                }
            }
        }
    }
    return out;
}

ImageF2 coords_of(Size size, const Map& map) {
    ImageF2 uv(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const Vec2 u = map({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            uv.at(x, y, 0) = u.x;
            uv.at(x, y, 1) = u.y;
        }
    }
    return uv;
}

ImageF3 sampled(const PlanePyramid& plane, const ImageF2& uv,
                SampleQuality quality = SampleQuality::kFinal) {
    const Matte all(uv.size(), 255);
    ImageF3 out(uv.size());
    SampleRequest request;
    request.plane = &plane;
    request.coords = uv;
    request.matte = all;
    request.quality = quality;
    sample_plane_cpu(request, out);
    return out;
}

// Catmull–Rom interpolation of the plane at a texel position, as a reference.
float cubic(const ImageF3& plane, Vec2 u, int c, WrapMode wrap) {
    const auto weight = [](double t) {
        t = std::abs(t);
        if (t < 1) return 1.5 * t * t * t - 2.5 * t * t + 1;
        return t < 2 ? -0.5 * t * t * t + 2.5 * t * t - 4 * t + 2 : 0.0;
    };
    const double gx = u.x - 0.5, gy = u.y - 0.5;
    const int x0 = static_cast<int>(std::floor(gx)), y0 = static_cast<int>(std::floor(gy));
    double sum = 0;
    for (int j = -1; j <= 2; ++j) {
        for (int i = -1; i <= 2; ++i) {
            sum += weight(gx - (x0 + i)) * weight(gy - (y0 + j)) *
                   plane.at(wrapped_index(x0 + i, plane.width(), wrap),
                            wrapped_index(y0 + j, plane.height(), wrap), c);
        }
    }
    return static_cast<float>(sum);
}

// The pixel's integral by 8 × 8 cubic lookups.
ImageF3 integrated(const ImageF3& plane, Size size, const Map& map, WrapMode wrap) {
    constexpr int kCells = 8;
    ImageF3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int k = 0; k < kCells * kCells; ++k) {
                const Vec2 in((static_cast<float>(k % kCells) + 0.5f) / kCells,
                              (static_cast<float>(k / kCells) + 0.5f) / kCells);
                const Vec2 u = map(Vec2(x, y) + in);
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) += cubic(plane, u, c, wrap) / (kCells * kCells);
            }
        }
    }
    return out;
}

struct Difference {
    double mean = 0, worst = 0;
};

// Without the outermost pixels, whose Jacobian is one-sided.
Difference difference(const ImageF3& a, const ImageF3& b) {
    Difference out;
    int count = 0;
    for (int y = 1; y < a.height() - 1; ++y) {
        for (int x = 1; x < a.width() - 1; ++x) {
            for (int c = 0; c < 3; ++c, ++count) {
                const double d = std::abs(a.at(x, y, c) - b.at(x, y, c));
                out.mean += d;
                out.worst = std::max(out.worst, d);
            }
        }
    }
    out.mean /= count;
    return out;
}

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments(const ImageF3& image) {
    Moments out;
    const auto n = static_cast<double>(image.width()) * image.height();
    for (int k = 0; k < image.width() * image.height(); ++k)
        out.mean += image.data()[3 * k] / n;
    for (int k = 0; k < image.width() * image.height(); ++k) {
        out.variance += std::pow(image.data()[3 * k] - out.mean, 2) / n;
    }
    return out;
}

constexpr Size kOut{48, 40};
constexpr Size kPlane{64, 56};

TEST(PlaneSampler, AConstantPlaneStaysConstant) {
    const PlanePyramid plane(ImageF3(33, 17, 0.37f).view(), WrapMode::kRepeat);
    for (const float scale : {0.1f, 1.0f, 7.0f, 60.0f}) {
        const ImageF3 out = sampled(plane, coords_of(kOut, [&](Vec2 p) { return scale * p; }));
        EXPECT_LT(difference(out, ImageF3(kOut, 0.37f)).worst, 2e-5) << scale;
    }
}

TEST(PlaneSampler, IntegratesThePixelsSquare) {
    const ImageF3 picture = soft_noise(kPlane);
    const PlanePyramid plane(picture.view(), WrapMode::kRepeat);
    const std::vector<std::pair<const char*, Map>> maps{
        {"identity", [](Vec2 p) { return p; }},
        {"shifted", [](Vec2 p) { return p + Vec2(0.37f, 0.81f); }},
        {"turned",
         [](Vec2 p) { return Vec2(0.8f * p.x - 0.6f * p.y + 20, 0.6f * p.x + 0.8f * p.y); }},
        {"smaller", [](Vec2 p) { return 1.7f * p; }},
        {"larger", [](Vec2 p) { return 0.45f * p; }},
        {"sheared", [](Vec2 p) { return Vec2(1.2f * p.x + 0.5f * p.y, 0.7f * p.y); }},
    };
    for (const auto& [name, map] : maps) {
        const ImageF3 truth = integrated(picture, kOut, map, WrapMode::kRepeat);
        const Difference final_d = difference(sampled(plane, coords_of(kOut, map)), truth);
        // In units of the picture's range; its standard deviation is about 0.1.
        EXPECT_LT(final_d.mean, 0.004) << name;
        EXPECT_LT(final_d.worst, 0.025) << name;
        const Difference draft =
            difference(sampled(plane, coords_of(kOut, map), SampleQuality::kDraft), truth);
        EXPECT_LT(draft.mean, 0.012) << name;
    }
}

TEST(PlaneSampler, KeepsThePicturesSharpness) {
    // White noise at the identity: the contrast that the cubics in use integrate to, Catmull–Rom
    // (1) and OpenCV's (about 1.15), not that of a blur.
    const ImageF3 picture = plane_noise(kPlane);
    const PlanePyramid plane(picture.view(), WrapMode::kRepeat);
    const Map identity = [](Vec2 p) { return p; };
    const double right = moments(integrated(picture, kOut, identity, WrapMode::kRepeat)).variance;
    const double kept = moments(sampled(plane, coords_of(kOut, identity))).variance / right;
    EXPECT_GT(kept, 0.98);
    EXPECT_LT(kept, 1.15);
}

TEST(PlaneSampler, GoesOnBeyondThePlaneAsItsWrapModeSays) {
    const ImageF3 picture = soft_noise({24, 20});
    for (const WrapMode wrap : {WrapMode::kRepeat, WrapMode::kMirror, WrapMode::kClamp}) {
        const PlanePyramid plane(picture.view(), wrap);
        const Map around = [](Vec2 p) { return 1.3f * p - Vec2(20, 16); };
        const Difference d = difference(sampled(plane, coords_of(kOut, around)),
                                        integrated(picture, kOut, around, wrap));
        EXPECT_LT(d.mean, 0.004) << static_cast<int>(wrap);
        EXPECT_LT(d.worst, 0.03) << static_cast<int>(wrap);
    }
}

TEST(PlaneSampler, RepeatsWithThePlanesPeriodFarAway) {
    const PlanePyramid plane(soft_noise({32, 16}).view(), WrapMode::kRepeat);
    const ImageF3 here = sampled(plane, coords_of(kOut, [](Vec2 p) { return p; }));
    const ImageF3 there =
        sampled(plane, coords_of(kOut, [](Vec2 p) { return p + Vec2(-3200, 1600); }));
    EXPECT_LT(difference(here, there).worst, 1e-3);
}

TEST(PlaneSampler, MinifiesWithoutAlias) {
    // 8 : 1 of white noise: the mean of 64 independent texels.
    const PlanePyramid plane(plane_noise({512, 384}).view(), WrapMode::kRepeat);
    for (const SampleQuality quality : {SampleQuality::kDraft, SampleQuality::kFinal}) {
        const Moments out =
            moments(sampled(plane, coords_of({64, 48}, [](Vec2 p) { return 8.0f * p; }), quality));
        EXPECT_NEAR(out.mean, 0.5, 0.005);
        EXPECT_LT(out.variance, 2.0 / 12 / 64);
        EXPECT_GT(out.variance, 0.4 / 12 / 64);
    }
    // Stripes of one texel, which any point sampling turns into bands.
    ImageF3 stripes(256, 256);
    for (int y = 0; y < 256; ++y) {
        for (int k = 0; k < 3 * 256; ++k)
            stripes.row(y)[k] = k / 3 % 2 ? 1.0f : 0.0f;
    }
    const PlanePyramid striped(stripes.view(), WrapMode::kRepeat);
    for (const float scale : {4.1f, 7.9f, 15.7f, 40.3f}) {
        const ImageF3 out = sampled(striped, coords_of(kOut, [&](Vec2 p) { return scale * p; }));
        EXPECT_LT(difference(out, ImageF3(kOut, 0.5f)).worst, 0.06) << scale;
    }
}

TEST(PlaneSampler, MagnifiesSmoothly) {
    // Eight pixels a texel: no step between neighbours is larger than the cubic's steepest slope.
    ImageF3 edge(16, 16);
    for (int y = 0; y < 16; ++y)
        std::fill(edge.row(y) + 24, edge.row(y) + 48, 1.0f);
    const PlanePyramid plane(edge.view(), WrapMode::kClamp);
    const ImageF3 out = sampled(plane, coords_of({128, 16}, [](Vec2 p) { return 0.125f * p; }));
    float steepest = 0;
    for (int x = 1; x < 128; ++x)
        steepest = std::max(steepest, std::abs(out.at(x, 8) - out.at(x - 1, 8)));
    EXPECT_LT(steepest, 0.2f);
    EXPECT_NEAR(out.at(4, 8), 0, 1e-3f);
    EXPECT_NEAR(out.at(124, 8), 1, 1e-3f);
    EXPECT_NEAR(0.5f * (out.at(63, 8) + out.at(64, 8)), 0.5f, 0.01f);
}

TEST(PlaneSampler, FinerLevelsChangeNothingWhereThePlaneIsNotMagnified) {
    const ImageF3 picture = soft_noise(kPlane);
    const PlanePyramid plain(picture.view(), WrapMode::kRepeat),
        fine(picture.view(), WrapMode::kRepeat, 2);
    ASSERT_EQ(fine.plane_level(), 2);
    ASSERT_EQ(fine.size(), kPlane);
    for (const SampleQuality quality : {SampleQuality::kDraft, SampleQuality::kFinal}) {
        for (const Vec2 scale : {Vec2(1, 1), Vec2(1.3f, 4), Vec2(9, 0.2f), Vec2(40, 40)}) {
            const ImageF2 uv = coords_of(kOut, [&](Vec2 p) { return scale * p; });
            EXPECT_EQ(sampled(fine, uv, quality), sampled(plain, uv, quality)) << scale.x;
        }
    }
}

TEST(PlaneSampler, FinerLevelsComeInWithoutAStep) {
    // From two texels a pixel to an eighth of one: no neighbouring columns differ in how sharp they
    // are by more than the pattern does.
    const PlanePyramid fine(soft_noise(kPlane).view(), WrapMode::kRepeat, 2);
    const auto shown = [&](float texels) {
        return sampled(fine, coords_of(kOut, [&](Vec2 p) { return texels * p + Vec2(3, 5); }));
    };
    for (int k = 24; k > 3; --k) {
        const float texels = 0.05f * static_cast<float>(k), step = 1e-4f;
        EXPECT_LT(difference(shown(texels), shown(texels - step)).worst, 0.02) << texels;
    }
    // Well magnified it is the finest level that is seen.
    const ImageF2 uv = coords_of(kOut, [](Vec2 p) { return 0.2f * p; });
    const PlanePyramid plain(soft_noise(kPlane).view(), WrapMode::kRepeat);
    EXPECT_GT(difference(sampled(fine, uv), sampled(plain, uv)).mean, 0.005);
}

TEST(PlaneSampler, BlursOnlyAlongTheFootprint) {
    // Squeezed 6 : 1 along x only: stripes along x survive, stripes along y average out.
    ImageF3 rows(96, 96), columns(96, 96);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            for (int c = 0; c < 3; ++c) {
                rows.at(x, y, c) = y / 4 % 2 ? 1.0f : 0.0f;
                columns.at(x, y, c) = x % 2 ? 1.0f : 0.0f;
            }
        }
    }
    const ImageF2 uv = coords_of(kOut, [](Vec2 p) { return Vec2(6 * p.x, p.y); });
    EXPECT_GT(moments(sampled(PlanePyramid(rows.view(), WrapMode::kRepeat), uv)).variance, 0.2);
    EXPECT_LT(moments(sampled(PlanePyramid(columns.view(), WrapMode::kRepeat), uv)).variance, 1e-3);
}

TEST(PlaneSampler, LeavesPixelsOutsideTheMatte) {
    const PlanePyramid plane(ImageF3(8, 8, 0.5f).view(), WrapMode::kRepeat);
    Matte matte(6, 4);
    matte.at(2, 1) = 1;
    const ImageF2 uv = coords_of({6, 4}, [](Vec2 p) { return p; });
    ImageF3 out(6, 4, -7.0f);
    SampleRequest request;
    request.plane = &plane;
    request.coords = uv;
    request.matte = matte;
    sample_plane_cpu(request, out);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 6; ++x)
            EXPECT_NEAR(out.at(x, y, 2), matte.at(x, y) ? 0.5f : -7.0f, 1e-4f);
    }
}

TEST(PlaneSampler, CoordinatesThatAreNoNumberGiveBlack) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    for (const WrapMode wrap : {WrapMode::kRepeat, WrapMode::kMirror, WrapMode::kClamp}) {
        const PlanePyramid plane(soft_noise({20, 20}).view(), wrap);
        for (const float bad : {nan, inf, -inf, 1e30f}) {
            ImageF2 uv = coords_of({9, 9}, [](Vec2 p) { return p; });
            uv.at(4, 4, 0) = bad;
            const ImageF3 out = sampled(plane, uv);
            for (int y = 0; y < 9; ++y) {
                for (int k = 0; k < 27; ++k)
                    ASSERT_TRUE(std::isfinite(out.row(y)[k])) << bad;
            }
            EXPECT_EQ(out.at(4, 4), 0.0f) << bad;
            EXPECT_GT(out.at(7, 7), 0.0f);
        }
    }
}

TEST(PlaneSampler, TakesTheSmallestPlanesAndPictures) {
    const PlanePyramid dot(ImageF3(1, 1, 0.25f).view(), WrapMode::kRepeat);
    EXPECT_NEAR(sampled(dot, coords_of({1, 1}, [](Vec2 p) { return p; })).at(0, 0), 0.25f, 1e-4f);
    EXPECT_NEAR(sampled(dot, coords_of({5, 3}, [](Vec2 p) { return 9.0f * p; })).at(4, 2), 0.25f,
                1e-4f);
}

TEST(PlaneSampler, DependsNeitherOnThreadsNorOnTheBand) {
    const PlanePyramid plane(plane_noise(kPlane).view(), WrapMode::kRepeat);
    const ImageF2 uv =
        coords_of({70, 90}, [](Vec2 p) { return Vec2(1.1f * p.x + 0.3f * p.y, 0.9f * p.y); });
    set_thread_count(1);
    const ImageF3 one = sampled(plane, uv);
    set_thread_count(2);
    EXPECT_EQ(sampled(plane, uv), one);
    set_thread_count(0);

    // Rows 20–60 alone: but for the first and last row, whose Jacobian is one-sided, the same bits.
    const Matte all({70, 40}, 255);
    ImageF3 part(70, 40);
    SampleRequest request;
    request.plane = &plane;
    request.coords = uv.view().crop({0, 20, 70, 60});
    request.matte = all;
    sample_plane_cpu(request, part);
    for (int y = 1; y < 39; ++y) {
        for (int k = 0; k < 210; ++k)
            ASSERT_EQ(part.row(y)[k], one.row(20 + y)[k]) << y;
    }
}

}  // namespace
}  // namespace weft
