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
    void add(std::size_t node, int neighbour, double w, double gx, double gy) {
        Block& b = blocks_[node * 5 + static_cast<std::size_t>(neighbour)];
        b.xx += w * gx * gx;
        b.xy += w * gx * gy;
        b.yy += w * gy * gy;
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
    const int w = nodes_.width, h = nodes_.height;
    const auto at = [w](int i, int j) {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(w) +
               static_cast<std::size_t>(i);
    };
    const auto bend = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec2 d = stiffness * (x[a] - 2.0 * x[b] + x[c]);
        y[a] += d;
        y[b] -= 2.0 * d;
        y[c] += d;
    };
    for (int j = 0; j < h; ++j) {
        for (int i = 0; i < w; ++i) {
            if (i > 0 && i + 1 < w) bend(at(i - 1, j), at(i, j), at(i + 1, j));
            if (j > 0 && j + 1 < h) bend(at(i, j - 1), at(i, j), at(i, j + 1));
            if (i + 1 < w && j + 1 < h) {
                // The mixed second difference counts twice, as in the thin plate's energy.
                const glm::dvec2 d =
                    2.0 * stiffness *
                    (x[at(i, j)] - x[at(i + 1, j)] - x[at(i, j + 1)] + x[at(i + 1, j + 1)]);
                y[at(i, j)] += d;
                y[at(i + 1, j)] -= d;
                y[at(i, j + 1)] -= d;
                y[at(i + 1, j + 1)] += d;
            }
            y[at(i, j)] += 1e-3 * stiffness * x[at(i, j)];
        }
    }
}

const std::vector<glm::dvec2>& System::solve(const std::vector<glm::dvec2>& before,
                                             double stiffness, int iterations) {
    std::vector<glm::dvec2> r(count()), q(count());
    add_bending(before, -stiffness, r);
    for (std::size_t n = 0; n < count(); ++n)
        r[n] += rhs_[n];
    std::vector<glm::dvec2> p = r;
    const auto product = [](const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            sum += a[k].x * b[k].x + a[k].y * b[k].y;
        return sum;
    };
    double rr = product(r, r);
    const double enough = 1e-8 * rr;
    for (int k = 0; k < iterations && rr > enough; ++k) {
        multiply(p, stiffness, q);
        const double step = rr / product(p, q);
        for (std::size_t n = 0; n < count(); ++n) {
            x_[n] += step * p[n];
            r[n] -= step * q[n];
        }
        const double next = product(r, r);
        for (std::size_t n = 0; n < count(); ++n)
            p[n] = r[n] + (next / rr) * p[n];
        rr = next;
    }
    return x_;
}

struct Term {
    Vec2 p;
    float r;
    Vec2 g;
};

// Adds the residuals to the system of a lattice.
void fill(System& system, const LatticeField& lattice, const std::vector<Term>& terms,
          double scale) {
    const int width = lattice.nodes().width();
    for (const Term& t : terms) {
        const float gx = t.p.x / static_cast<float>(lattice.spacing()) + LatticeField::kMargin;
        const float gy = t.p.y / static_cast<float>(lattice.spacing()) + LatticeField::kMargin;
        const int i = static_cast<int>(gx), j = static_cast<int>(gy);
        const double fx = gx - static_cast<float>(i), fy = gy - static_cast<float>(j);
        const std::array<double, 4> b{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
        const auto node = static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(i);
        const std::array<std::size_t, 4> n{node, node + 1, node + static_cast<std::size_t>(width),
                                           node + static_cast<std::size_t>(width) + 1};
        const double w = cauchy(t.r / scale) / (scale * scale), x = t.g.x, y = t.g.y;
        for (std::size_t k = 0; k < 4; ++k) {
            system.add(n[k], 0, w * b[k] * b[k], x, y);
            system.add_rhs(n[k], -w * b[k] * t.r * x, -w * b[k] * t.r * y);
        }
        system.add(n[0], 1, w * b[0] * b[1], x, y);
        system.add(n[0], 3, w * b[0] * b[2], x, y);
        system.add(n[0], 4, w * b[0] * b[3], x, y);
        system.add(n[1], 2, w * b[1] * b[2], x, y);
        system.add(n[1], 3, w * b[1] * b[3], x, y);
        system.add(n[2], 1, w * b[2] * b[3], x, y);
    }
}

}  // namespace

LatticeField register_lattice(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                              const LatticeField& initial, const RegistrationOptions& options) {
    LatticeField field = initial;
    const auto samples = registration_samples(cur, options.samples);
    if (samples.size() < 100) return field;
    // Neighbouring residuals are correlated, two or three at a time.
    constexpr double kIndependent = 0.4;
    const double stiffness =
        1.0 / (static_cast<double>(options.stiffness_px) * options.stiffness_px);
    std::vector<glm::dvec2> corrected;
    for (int k = 0; k < options.iterations; ++k) {
        std::vector<Term> terms;
        std::vector<float> sizes;
        terms.reserve(samples.size());
        sizes.reserve(samples.size());
        for (const RegistrationSample& s : samples) {
            const auto seen = look_up(anchor, s.p + field.at(s.p));
            if (!seen) continue;
            terms.push_back({s.p, seen->value - s.value, seen->gradient});
            sizes.push_back(std::abs(terms.back().r));
        }
        if (terms.size() < 100) return initial;
        LatticeField correction(initial.full_size(), options.lattice_px);
        System system(correction.nodes().size());
        fill(system, correction, terms, robust_spread(sizes) / std::sqrt(kIndependent));
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
