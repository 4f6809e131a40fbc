#pragma once
// Small systems of linear equations, such as the normal equations of a fit.

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// N equations in N unknowns; the last column is the right side.
template <std::size_t N>
using LinearSystem = std::array<std::array<double, N + 1>, N>;

/// Gaussian elimination without a choice of pivots, for symmetric positive definite matrices (a
/// ridge makes one of normal equations). `m(i, j)` is the coefficient of unknown j in equation i,
/// `m(i, n)` its right side, and is changed; `x` is where the n unknowns go. The order of
/// operations is fixed, so that the bits are the same everywhere.
template <class Matrix>
void eliminate(Matrix&& m, std::size_t n, double* x) {
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = k + 1; i < n; ++i) {
            const double f = m(i, k) / m(k, k);
            for (std::size_t j = k; j <= n; ++j)
                m(i, j) -= f * m(k, j);
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        double rest = m(k, n);
        for (std::size_t j = k + 1; j < n; ++j)
            rest -= m(k, j) * x[j];
        x[k] = rest / m(k, k);
    }
}

template <std::size_t N>
[[nodiscard]] std::array<double, N> solve(LinearSystem<N> m) {
    std::array<double, N> x{};
    eliminate([&](std::size_t i, std::size_t j) -> double& { return m[i][j]; }, N, x.data());
    return x;
}
/// The same for a number of unknowns that is known only when it runs: n rows of n + 1 numbers.
[[nodiscard]] inline std::vector<double> solve(std::vector<double> m, std::size_t n) {
    std::vector<double> x(n, 0.0);
    eliminate([&](std::size_t i, std::size_t j) -> double& { return m[i * (n + 1) + j]; }, n,
              x.data());
    return x;
}

}  // namespace weft
