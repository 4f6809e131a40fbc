#pragma once
// Small systems of linear equations, such as the normal equations of a fit.

#include <array>
#include <cstddef>

namespace weft {

/// N equations in N unknowns; the last column is the right side.
template <std::size_t N>
using LinearSystem = std::array<std::array<double, N + 1>, N>;

/// Gaussian elimination without a choice of pivots, for symmetric positive definite matrices (a
/// ridge makes one of normal equations). The order of operations is fixed, so that the bits are the
/// same everywhere.
template <std::size_t N>
[[nodiscard]] std::array<double, N> solve(LinearSystem<N> m) {
    for (std::size_t k = 0; k < N; ++k) {
        for (std::size_t i = k + 1; i < N; ++i) {
            const double f = m[i][k] / m[k][k];
            for (std::size_t j = k; j <= N; ++j)
                m[i][j] -= f * m[k][j];
        }
    }
    std::array<double, N> x{};
    for (std::size_t k = N; k-- > 0;) {
        double rest = m[k][N];
        for (std::size_t j = k + 1; j < N; ++j)
            rest -= m[k][j] * x[j];
        x[k] = rest / m[k][k];
    }
    return x;
}

}  // namespace weft
