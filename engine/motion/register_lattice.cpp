// The smooth correction of register_lattice(): photometric Gauss–Newton on a coarse lattice.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/motion/photometric_register.h"
#include "engine/motion/photometric_samples.h"

namespace weft {
namespace {

// Normal equations of a vector field on a lattice with bilinear data terms: per node a symmetric
// 2×2 block for itself and for the neighbours to the right and below (the others by symmetry), and
// the right-hand side.
struct Block {
    double xx = 0, xy = 0, yy = 0;
};

class System {
  public:
    explicit System(Size nodes) : nodes_(nodes), blocks_(count() * 5), rhs_(count()), x_(count()) {}

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(nodes_.width) * static_cast<std::size_t>(nodes_.height);
    }
    void add(std::size_t node, int neighbour, double share, const Block& own) {
        Block& b = blocks_[node * 5 + static_cast<std::size_t>(neighbour)];
        b.xx += share * own.xx;
        b.xy += share * own.xy;
        b.yy += share * own.yy;
    }
    void add_rhs(std::size_t node, double x, double y) {
        rhs_[node].x += x;
        rhs_[node].y += y;
    }
    // The step x that minimises data + stiffness · |second differences of (before + x)|² + a small
    // multiple of |before + x|², where `before` is the correction so far; by conjugate gradients.
    const std::vector<glm::dvec2>& solve(const std::vector<glm::dvec2>& before, double stiffness,
                                         int iterations);

    // Neighbours in the order of `blocks_`: itself, right, below left, below, below right.
    static constexpr std::array<Vec2i, 5> kNeighbours{{{0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

  private:
    void multiply(const std::vector<glm::dvec2>& x, double stiffness,
                  std::vector<glm::dvec2>& y) const;
    void add_bending(const std::vector<glm::dvec2>& x, double stiffness,
                     std::vector<glm::dvec2>& y) const;
    [[nodiscard]] std::vector<Block> own_inverse(double stiffness) const;

    // Of the stiffness: what holds the correction near 0 where nothing else does.
    static constexpr double kPull = 1e-3;

    Size nodes_;
    std::vector<Block> blocks_;
    std::vector<glm::dvec2> rhs_, x_;
};

void System::multiply(const std::vector<glm::dvec2>& x, double stiffness,
                      std::vector<glm::dvec2>& y) const {
    const int w = nodes_.width, h = nodes_.height;
    const auto at = [w](int i, int j) {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(w) +
               static_cast<std::size_t>(i);
    };
    std::fill(y.begin(), y.end(), glm::dvec2(0));
    for (int j = 0; j < h; ++j) {
        for (int i = 0; i < w; ++i) {
            const std::size_t n = at(i, j);
            for (std::size_t k = 0; k < 5; ++k) {
                const Block& b = blocks_[n * 5 + k];
                if (b.xx == 0 && b.yy == 0) continue;
                const std::size_t m = at(i + kNeighbours[k].x, j + kNeighbours[k].y);
                y[n] += glm::dvec2(b.xx * x[m].x + b.xy * x[m].y, b.xy * x[m].x + b.yy * x[m].y);
                if (k > 0)
                    y[m] +=
                        glm::dvec2(b.xx * x[n].x + b.xy * x[n].y, b.xy * x[n].x + b.yy * x[n].y);
            }
        }
    }
    add_bending(x, stiffness, y);
}

void System::add_bending(const std::vector<glm::dvec2>& x, double stiffness,
                         std::vector<glm::dvec2>& y) const {
    const auto w = static_cast<std::size_t>(nodes_.width);
    const auto h = static_cast<std::size_t>(nodes_.height);
    const auto bend = [&](std::size_t middle, std::size_t step) {
        const glm::dvec2 d = stiffness * (x[middle - step] - 2.0 * x[middle] + x[middle + step]);
        y[middle - step] += d;
        y[middle] -= 2.0 * d;
        y[middle + step] += d;
    };
    for (std::size_t j = 0; j < h; ++j) {
        const std::size_t row = j * w;
        for (std::size_t n = row + 1; n + 1 < row + w; ++n)
            bend(n, 1);
        if (j > 0 && j + 1 < h) {
            for (std::size_t n = row; n < row + w; ++n)
                bend(n, w);
        }
        for (std::size_t n = row; j + 1 < h && n + 1 < row + w; ++n) {
            // The mixed second difference counts twice, as in the thin plate's energy.
            const glm::dvec2 d = 2.0 * stiffness * (x[n] - x[n + 1] - x[n + w] + x[n + w + 1]);
            y[n] += d;
            y[n + 1] -= d;
            y[n + w] -= d;
            y[n + w + 1] += d;
        }
        for (std::size_t n = row; n < row + w; ++n)
            y[n] += kPull * stiffness * x[n];
    }
}

// The inverse of each node's own 2×2 block, by which conjugate gradients are preconditioned
// (block Jacobi): nodes differ much in what the picture says about them.
std::vector<Block> System::own_inverse(double stiffness) const {
    const int w = nodes_.width, h = nodes_.height;
    // How often a node is the end and the middle of a second difference along a line of `count`.
    const auto along = [](int k, int count) {
        const int ends = (k >= 2 ? 1 : 0) + (k + 2 < count ? 1 : 0);
        return ends + (k >= 1 && k + 1 < count ? 4 : 0);
    };
    std::vector<Block> out(count());
    for (int j = 0; j < h; ++j) {
        for (int i = 0; i < w; ++i) {
            const std::size_t n = static_cast<std::size_t>(j) * static_cast<std::size_t>(w) +
                                  static_cast<std::size_t>(i);
            const int squares =
                (i > 0 ? 1 : 0) * (j > 0 ? 1 : 0) + (i + 1 < w ? 1 : 0) * (j > 0 ? 1 : 0) +
                (i > 0 ? 1 : 0) * (j + 1 < h ? 1 : 0) + (i + 1 < w ? 1 : 0) * (j + 1 < h ? 1 : 0);
            const double own = stiffness * (along(i, w) + along(j, h) + 2 * squares + kPull);
            const Block& b = blocks_[n * 5];
            const double xx = b.xx + own, yy = b.yy + own;
            const double one_over = 1 / (xx * yy - b.xy * b.xy);
            out[n] = {yy * one_over, -b.xy * one_over, xx * one_over};
        }
    }
    return out;
}

const std::vector<glm::dvec2>& System::solve(const std::vector<glm::dvec2>& before,
                                             double stiffness, int iterations) {
    std::vector<glm::dvec2> r(count()), q(count()), z(count());
    add_bending(before, -stiffness, r);
    for (std::size_t n = 0; n < count(); ++n)
        r[n] += rhs_[n];
    const std::vector<Block> inverse = own_inverse(stiffness);
    const auto condition = [&] {
        for (std::size_t n = 0; n < count(); ++n) {
            const Block& b = inverse[n];
            z[n] = {b.xx * r[n].x + b.xy * r[n].y, b.xy * r[n].x + b.yy * r[n].y};
        }
    };
    const auto product = [](const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            sum += a[k].x * b[k].x + a[k].y * b[k].y;
        return sum;
    };
    condition();
    std::vector<glm::dvec2> p = z;
    double rz = product(r, z);
    const double enough = 1e-8 * rz;
    for (int k = 0; k < iterations && rz > enough; ++k) {
        multiply(p, stiffness, q);
        const double step = rz / product(p, q);
        for (std::size_t n = 0; n < count(); ++n) {
            x_[n] += step * p[n];
            r[n] -= step * q[n];
        }
        condition();
        const double next = product(r, z);
        for (std::size_t n = 0; n < count(); ++n)
            p[n] = z[n] + (next / rz) * p[n];
        rz = next;
    }
    return x_;
}

// Adds the residuals to the system of a lattice.
void fill(System& system, const LatticeField& lattice,
          const std::vector<RegistrationResidual>& residuals, double scale) {
    const int width = lattice.nodes().width();
    for (const RegistrationResidual& t : residuals) {
        const float gx = t.p.x / static_cast<float>(lattice.spacing()) + LatticeField::kMargin;
        const float gy = t.p.y / static_cast<float>(lattice.spacing()) + LatticeField::kMargin;
        const int i = static_cast<int>(gx), j = static_cast<int>(gy);
        const double fx = gx - static_cast<float>(i), fy = gy - static_cast<float>(j);
        const std::array<double, 4> b{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
        const auto node = static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(i);
        const std::array<std::size_t, 4> n{node, node + 1, node + static_cast<std::size_t>(width),
                                           node + static_cast<std::size_t>(width) + 1};
        const double w = cauchy(t.r / scale) / (scale * scale);
        const double x = t.gradient.x, y = t.gradient.y;
        const Block own{w * x * x, w * x * y, w * y * y};
        for (std::size_t k = 0; k < 4; ++k) {
            system.add(n[k], 0, b[k] * b[k], own);
            system.add_rhs(n[k], -w * b[k] * t.r * x, -w * b[k] * t.r * y);
        }
        system.add(n[0], 1, b[0] * b[1], own);
        system.add(n[0], 3, b[0] * b[2], own);
        system.add(n[0], 4, b[0] * b[3], own);
        system.add(n[1], 2, b[1] * b[2], own);
        system.add(n[1], 3, b[1] * b[3], own);
        system.add(n[2], 1, b[2] * b[3], own);
    }
}

}  // namespace

LatticeField register_lattice(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                              const LatticeField& initial, const RegistrationOptions& options) {
    LatticeField field = initial;
    const RegistrationSamples samples = registration_samples(cur, options.samples);
    if (samples.size() < 100) return field;
    // Neighbouring residuals are correlated, two or three at a time.
    constexpr double kIndependent = 0.4;
    const double stiffness =
        1.0 / (static_cast<double>(options.stiffness_px) * options.stiffness_px);
    std::vector<glm::dvec2> corrected;
    for (int k = 0; k < options.iterations; ++k) {
        const auto residuals = residuals_at(anchor, samples, places_under(field, samples));
        if (residuals.size() < 100) return initial;
        LatticeField correction(initial.full_size(), options.lattice_px);
        System system(correction.nodes().size());
        fill(system, correction, residuals, robust_spread(residuals) / std::sqrt(kIndependent));
        corrected.resize(system.count());
        const auto& x = system.solve(corrected, stiffness, 60);
        float most = 0;
        for (int j = 0; j < correction.nodes().height(); ++j) {
            for (int i = 0; i < correction.nodes().width(); ++i) {
                const std::size_t n = static_cast<std::size_t>(j) *
                                          static_cast<std::size_t>(correction.nodes().width()) +
                                      static_cast<std::size_t>(i);
                const glm::dvec2 d = x[n];
                const Vec2 step(static_cast<float>(std::clamp(d.x, -2.0, 2.0)),
                                static_cast<float>(std::clamp(d.y, -2.0, 2.0)));
                correction.set_node(i, j, step);
                corrected[n] += glm::dvec2(step);
                most = std::max({most, std::abs(step.x), std::abs(step.y)});
            }
        }
        const LatticeField fine = correction.resampled(field.spacing());
        for (int j = 0; j < field.nodes().height(); ++j) {
            for (int i = 0; i < field.nodes().width(); ++i)
                field.set_node(i, j, field.node(i, j) + fine.node(i, j));
        }
        if (most < 0.01f) break;
    }
    return field;
}

}  // namespace weft
