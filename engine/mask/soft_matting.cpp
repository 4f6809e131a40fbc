#include "engine/mask/soft_matting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/edge_alpha.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr int kSoftFrom = 26, kSoftTo = 229;  // a tenth and nine tenths of 255
constexpr int kCellPx = 8;

// Fills unknown (negative) pixels with the mean of known ones, recursively at half the size.
void fill_unknown(ImageF1& field) {
    const Size size = field.size();
    bool any = false, all = true;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            (field.at(x, y) >= 0 ? any : all) = field.at(x, y) >= 0;
    }
    if (all || !any) return;
    ImageF1 half(Size{(size.width + 1) / 2, (size.height + 1) / 2});
    for (int y = 0; y < half.height(); ++y) {
        for (int x = 0; x < half.width(); ++x) {
            float sum = 0, n = 0;
            for (int v = 2 * y; v < std::min(2 * y + 2, size.height); ++v) {
                for (int u = 2 * x; u < std::min(2 * x + 2, size.width); ++u) {
                    if (field.at(u, v) < 0) continue;
                    sum += field.at(u, v);
                    n += 1;
                }
            }
            half.at(x, y) = n > 0 ? sum / n : -1;
        }
    }
    fill_unknown(half);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (field.at(x, y) < 0) field.at(x, y) = half.at(x / 2, y / 2);
        }
    }
}

// The band's unknown pixels, numbered in scan order, and the linear system over them. Row n holds
// the weights of the 5×5 pixels around unknown n.
class MattingSystem {
  public:
    MattingSystem(ViewU8x3 frame, const Matte& known) : frame_(frame), known_(known) {
        number_ = Image<std::int32_t, 1>(known.size(), -1);
        for (int y = 0; y < known.height(); ++y) {
            for (int x = 0; x < known.width(); ++x) {
                if (known.at(x, y) != kUnknown) continue;
                number_.at(x, y) = static_cast<std::int32_t>(places_.size());
                places_.emplace_back(x, y);
            }
        }
        rows_.resize(places_.size());
        rhs_.resize(places_.size());
        for (int y = 1; y + 1 < known.height(); ++y) {
            for (int x = 1; x + 1 < known.width(); ++x)
                add_window(x, y);
        }
    }

    static constexpr std::uint8_t kUnknown = 128;

    [[nodiscard]] const std::vector<Vec2i>& places() const { return places_; }

    void add_prior(std::size_t n, float weight, float value) {
        rows_[n][kCentre] += weight;
        rhs_[n] += weight * value;
    }

    // Conjugate gradients with the diagonal as preconditioner, from `x`.
    void solve(std::vector<float>& x, int iterations) const {
        const std::size_t count = places_.size();
        std::vector<float> r(count), z(count), p(count), q(count);
        multiply(x, q);
        for (std::size_t n = 0; n < count; ++n) {
            r[n] = rhs_[n] - q[n];
            p[n] = z[n] = r[n] / diagonal(n);
        }
        double rz = product(r, z);
        const double enough = 1e-7 * static_cast<double>(count);
        for (int k = 0; k < iterations && rz > enough; ++k) {
            multiply(p, q);
            const double pq = product(p, q);
            if (!(pq > 0)) return;
            const auto step = static_cast<float>(rz / pq);
            for (std::size_t n = 0; n < count; ++n) {
                x[n] += step * p[n];
                r[n] -= step * q[n];
                z[n] = r[n] / diagonal(n);
            }
            const double next = product(r, z);
            const auto keep = static_cast<float>(next / rz);
            for (std::size_t n = 0; n < count; ++n)
                p[n] = z[n] + keep * p[n];
            rz = next;
        }
    }

  private:
    static constexpr std::size_t kCentre = 12;

    [[nodiscard]] float diagonal(std::size_t n) const { return std::max(rows_[n][kCentre], 1e-6f); }
    static double product(const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0;
        for (std::size_t n = 0; n < a.size(); ++n)
            sum += static_cast<double>(a[n]) * static_cast<double>(b[n]);
        return sum;
    }

    // Eq. 12: the window's contribution to the matting Laplacian.
    void add_window(int cx, int cy) {
        std::array<std::int32_t, 9> number{};
        bool any = false;
        for (int k = 0; k < 9; ++k) {
            number[static_cast<std::size_t>(k)] = number_.at(cx + k % 3 - 1, cy + k / 3 - 1);
            any |= number[static_cast<std::size_t>(k)] >= 0;
        }
        if (!any) return;
        std::array<Vec3, 9> colour;
        Vec3 mean(0);
        for (int k = 0; k < 9; ++k) {
            const std::uint8_t* c = frame_.pixel(cx + k % 3 - 1, cy + k / 3 - 1);
            colour[static_cast<std::size_t>(k)] = Vec3(c[0], c[1], c[2]) / 255.0f;
            mean += colour[static_cast<std::size_t>(k)] / 9.0f;
        }
        // Regularisation: grain and 8-bit rounding on a plain surface do not span a line of
        // colours.
        constexpr float kEpsilon = 2e-4f;
        glm::mat3 covariance(kEpsilon / 9.0f);
        for (Vec3& c : colour) {
            c -= mean;
            covariance += glm::outerProduct(c, c) / 9.0f;
        }
        const glm::mat3 inverse = glm::inverse(covariance);
        for (int i = 0; i < 9; ++i) {
            const std::int32_t n = number[static_cast<std::size_t>(i)];
            if (n < 0) continue;
            const Vec3 along = inverse * colour[static_cast<std::size_t>(i)];
            auto& row = rows_[static_cast<std::size_t>(n)];
            for (int j = 0; j < 9; ++j) {
                const float g = (i == j ? 1.0f : 0.0f) -
                                (1 + glm::dot(along, colour[static_cast<std::size_t>(j)])) / 9.0f;
                if (number[static_cast<std::size_t>(j)] < 0) {
                    if (known_.at(cx + j % 3 - 1, cy + j / 3 - 1) == 255)
                        rhs_[static_cast<std::size_t>(n)] -= g;
                    continue;
                }
                const int dx = j % 3 - i % 3, dy = j / 3 - i / 3;
                row[static_cast<std::size_t>((dy + 2) * 5 + dx + 2)] += g;
            }
        }
    }

    void multiply(const std::vector<float>& x, std::vector<float>& y) const {
        const int count = static_cast<int>(places_.size());
        parallel_rows(count, 4096, [&](int n0, int n1) {
            for (int n = n0; n < n1; ++n) {
                const Vec2i at = places_[static_cast<std::size_t>(n)];
                const auto& row = rows_[static_cast<std::size_t>(n)];
                float sum = 0;
                for (int k = 0; k < 25; ++k) {
                    const float w = row[static_cast<std::size_t>(k)];
                    if (w == 0) continue;
                    const std::int32_t m = number_.at(at.x + k % 5 - 2, at.y + k / 5 - 2);
                    sum += w * x[static_cast<std::size_t>(m)];
                }
                y[static_cast<std::size_t>(n)] = sum;
            }
        });
    }

    ViewU8x3 frame_;
    const Matte& known_;
    Image<std::int32_t, 1> number_;
    std::vector<Vec2i> places_;
    std::vector<std::array<float, 25>> rows_;
    std::vector<float> rhs_;
};

}  // namespace

ImageF1 shape_without_strands(ViewF1 phi, float limit_px) {
    constexpr double kSigmaPx = 3;
    cv::Mat inside(phi.height(), phi.width(), CV_32F);
    for (int y = 0; y < phi.height(); ++y)
        std::transform(phi.row(y), phi.row(y) + phi.width(), inside.ptr<float>(y),
                       [](float d) { return std::clamp(0.5f + d, 0.0f, 1.0f); });
    cv::GaussianBlur(inside, inside, {0, 0}, kSigmaPx, kSigmaPx, cv::BORDER_REPLICATE);
    Image<std::uint8_t, 1> mostly(phi.size());
    for (int y = 0; y < phi.height(); ++y)
        std::transform(inside.ptr<float>(y), inside.ptr<float>(y) + phi.width(), mostly.row(y),
                       [](float v) { return static_cast<std::uint8_t>(v >= 0.5f ? 1 : 0); });
    return smooth_distance(signed_distance(mostly, limit_px), 1);
}

ImageF1 edge_softness(ViewU8x1 matte, ViewF1 shape, float limit_px) {
    constexpr float kAntialiased = 2;  // soft pixels a pixel of boundary
    struct Cell {
        float widest = 0, soft = 0, boundary = 0;
    };
    const Size cells{(matte.width() + kCellPx - 1) / kCellPx,
                     (matte.height() + kCellPx - 1) / kCellPx};
    std::vector<Cell> found(static_cast<std::size_t>(cells.width) *
                            static_cast<std::size_t>(cells.height));
    const auto cell = [&](int i, int j) -> Cell& {
        return found[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.width) +
                     static_cast<std::size_t>(i)];
    };
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const float d = std::abs(shape.row(y)[x]);
            const int m = matte.row(y)[x];
            Cell& here = cell(x / kCellPx, y / kCellPx);
            if (d < 0.5f) here.boundary += 1;
            if (d >= limit_px || m < kSoftFrom || m > kSoftTo) continue;
            here.soft += 1;
            here.widest = std::max(here.widest, d);
        }
    }
    // Over the neighbouring cells, because strands stand apart.
    ImageF1 around(cells, -1);
    for (int y = 0; y < cells.height; ++y) {
        for (int x = 0; x < cells.width; ++x) {
            Cell sum;
            for (int v = std::max(0, y - 1); v <= std::min(cells.height - 1, y + 1); ++v) {
                for (int u = std::max(0, x - 1); u <= std::min(cells.width - 1, x + 1); ++u) {
                    const Cell& c = cell(u, v);
                    sum.widest = std::max(sum.widest, c.widest);
                    sum.soft += c.soft;
                    sum.boundary += c.boundary;
                }
            }
            if (sum.boundary <= 0) continue;
            around.at(x, y) = sum.soft < kAntialiased * sum.boundary ? 0.0f : sum.widest;
        }
    }
    fill_unknown(around);
    ImageF1 out(matte.size());
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x)
            out.row(y)[x] = std::max(0.0f, around.at(x / kCellPx, y / kCellPx));
    }
    return out;
}

CoveragePrior colour_prior(ViewU8x3 frame, ViewF1 shape, ViewF1 half_width) {
    constexpr float kBeyondPx = 5;    // how far beyond the band sure colours are searched
    constexpr float kWeight = 0.02f;  // where the colours separate with certainty
    CoveragePrior out{ImageF1(frame.size()), ImageF1(frame.size())};
    parallel_rows(frame.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < frame.width(); ++x) {
                const float width = half_width.row(y)[x];
                if (std::abs(shape.row(y)[x]) >= width) continue;
                ColorSum in, outside;
                const int reach = static_cast<int>(std::lround(2 * width + kBeyondPx));
                const int stride = std::max(1, reach / 6);
                for (int v = y - reach; v <= y + reach; v += stride) {
                    for (int u = x - reach; u <= x + reach; u += stride) {
                        if (u < 0 || v < 0 || u >= frame.width() || v >= frame.height()) continue;
                        const float d = shape.row(v)[u];
                        if (std::abs(d) < width || std::abs(d) > width + kBeyondPx) continue;
                        const auto r2 = static_cast<float>((u - x) * (u - x) + (v - y) * (v - y));
                        (d > 0 ? in : outside).add(frame.pixel(u, v), 1 / (4 + r2));
                    }
                }
                if (in.n <= 0 || outside.n <= 0) continue;
                const std::uint8_t* c = frame.pixel(x, y);
                const MixEstimate mix =
                    estimate_mix(Vec3(c[0], c[1], c[2]), in.mean(), in.variance(), outside.mean(),
                                 outside.variance());
                out.value.at(x, y) = mix.coverage;
                out.weight.at(x, y) = kWeight * mix.reliability;
            }
        }
    });
    return out;
}

Matte soft_alpha(ViewU8x3 frame, ViewU8x1 crisp, ViewF1 shape, ViewF1 half_width,
                 const CoveragePrior& prior) {
    Matte known(frame.size());
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            const bool unknown = std::abs(shape.row(y)[x]) < half_width.row(y)[x];
            known.at(x, y) = unknown ? MattingSystem::kUnknown : (crisp.row(y)[x] >= 128 ? 255 : 0);
        }
    }
    MattingSystem system(frame, known);
    std::vector<float> alpha(system.places().size());
    for (std::size_t n = 0; n < alpha.size(); ++n) {
        const Vec2i p = system.places()[n];
        const float width = std::max(half_width.row(p.y)[p.x], 0.5f);
        // Where nothing else is known, the shape decides, with a small weight.
        constexpr float kShapeWeight = 1e-4f;
        const float ramp = std::clamp(0.5f + 0.5f * shape.row(p.y)[p.x] / width, 0.0f, 1.0f);
        alpha[n] = ramp;
        system.add_prior(n, kShapeWeight, ramp);
        if (prior.weight.empty() || prior.weight.at(p.x, p.y) <= 0) continue;
        alpha[n] = prior.value.at(p.x, p.y);
        system.add_prior(n, prior.weight.at(p.x, p.y), alpha[n]);
    }
    constexpr int kIterations = 80;
    system.solve(alpha, kIterations);
    for (std::size_t n = 0; n < alpha.size(); ++n) {
        const Vec2i p = system.places()[n];
        known.at(p.x, p.y) =
            static_cast<std::uint8_t>(std::clamp(alpha[n], 0.0f, 1.0f) * 255 + 0.5f);
    }
    return known;
}

Matte with_soft_edges(ViewU8x3 frame, ViewF1 phi, ViewF1 softness, Matte crisp, ViewU8x1 expected,
                      float steadiness) {
    constexpr float kMarginPx = 1.5f;   // uncertainty of the boundary's position
    constexpr float kExpected = 0.04f;  // weight of the coverage in the frame before
    constexpr float kLimitPx = 40;
    bool any = false;
    for (int y = 0; y < crisp.height() && !any; ++y)
        any = std::any_of(softness.row(y), softness.row(y) + crisp.width(),
                          [](float soft) { return soft > 0; });
    if (!any) return crisp;
    const ImageF1 shape = shape_without_strands(phi, kLimitPx);
    ImageF1 half_width(crisp.size());
    any = false;
    for (int y = 0; y < crisp.height(); ++y) {
        for (int x = 0; x < crisp.width(); ++x) {
            const float soft = softness.row(y)[x];
            if (soft <= 0) continue;
            half_width.at(x, y) = soft + kMarginPx;
            any |= std::abs(shape.row(y)[x]) < half_width.at(x, y);
        }
    }
    if (!any) return crisp;
    CoveragePrior prior = colour_prior(frame, shape, half_width);
    for (int y = 0; y < crisp.height() && !expected.empty(); ++y) {
        for (int x = 0; x < crisp.width(); ++x) {
            if (std::abs(shape.row(y)[x]) >= half_width.at(x, y)) continue;
            const float before = static_cast<float>(expected.row(y)[x]) / 255.0f;
            const float w = prior.weight.at(x, y), more = kExpected * steadiness;
            if (w + more <= 0) continue;
            prior.value.at(x, y) = (w * prior.value.at(x, y) + more * before) / (w + more);
            prior.weight.at(x, y) = w + more;
        }
    }
    const Matte soft = soft_alpha(frame, crisp, shape, half_width, prior);
    for (int y = 0; y < crisp.height(); ++y) {
        for (int x = 0; x < crisp.width(); ++x) {
            if (std::abs(shape.row(y)[x]) < half_width.at(x, y)) crisp.at(x, y) = soft.at(x, y);
        }
    }
    return crisp;
}

float clearance_of(const ImageF1& phi, const ImageF1& softness) {
    double sum = 0, n = 0;
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x) {
            if (std::abs(phi.at(x, y)) >= 1) continue;
            sum += static_cast<double>(softness.at(x, y));
            n += 1;
        }
    }
    constexpr float kLeastPx = 1.5f, kMostPx = 6;
    const float usual = n > 0 ? static_cast<float>(sum / n) : 0.0f;
    return std::clamp(0.7f * usual, kLeastPx, kMostPx);
}

}  // namespace weft
