#include "engine/motion/bending_system.h"

#include <algorithm>

namespace weft {

void BendingSystem::measure(Vec2 p, const Block& own, const glm::dvec2& rhs) {
    const float gx = p.x / static_cast<float>(spacing_) + LatticeField::kMargin;
    const float gy = p.y / static_cast<float>(spacing_) + LatticeField::kMargin;
    const int i = static_cast<int>(gx), j = static_cast<int>(gy);
    const double fx = gx - static_cast<float>(i), fy = gy - static_cast<float>(j);
    const std::array<double, 4> b{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
    const auto width = static_cast<std::size_t>(nodes_.width);
    const std::size_t node = static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i);
    const std::array<std::size_t, 4> n{node, node + 1, node + width, node + width + 1};
    for (std::size_t k = 0; k < 4; ++k) {
        add(n[k], 0, b[k] * b[k], own);
        rhs_[n[k]] += b[k] * rhs;
    }
    add(n[0], 1, b[0] * b[1], own);
    add(n[0], 3, b[0] * b[2], own);
    add(n[0], 4, b[0] * b[3], own);
    add(n[1], 2, b[1] * b[2], own);
    add(n[1], 3, b[1] * b[3], own);
    add(n[2], 1, b[2] * b[3], own);
}

void BendingSystem::multiply(const std::vector<glm::dvec2>& x, double stiffness,
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

void BendingSystem::add_bending(const std::vector<glm::dvec2>& x, double stiffness,
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
std::vector<Block> BendingSystem::own_inverse(double stiffness) const {
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

const std::vector<glm::dvec2>& BendingSystem::solve(const std::vector<glm::dvec2>& before,
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

}  // namespace weft
