#include "engine/composite/moving_light.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBlock = 32, kCell = 8;  // pixels
constexpr int kFewestInCell = 16, kFewestCells = 3;
// Share of the variance that the cells' means may hold. White noise leaves 1/64 in them, grain of a
// correlation of 1.2 px a fifth; a shadow that moves leaves most.
constexpr double kMostWide = 0.3;

struct Sums {
    double n = 0;
    std::array<double, 3> v{}, squares{};

    void add(const Sums& o) {
        n += o.n;
        for (std::size_t c = 0; c < 3; ++c)
            v[c] += o.v[c], squares[c] += o.squares[c];
    }
    [[nodiscard]] double square_of_mean() const {
        return n > 0 ? (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / n : 0.0;
    }
    [[nodiscard]] double all_squares() const { return squares[0] + squares[1] + squares[2]; }
    [[nodiscard]] float largest_variance() const {
        double largest = 0;
        for (std::size_t c = 0; c < 3; ++c)
            largest = std::max(largest, (squares[c] - v[c] * v[c] / n) / n);
        return static_cast<float>(largest);
    }
};

Sums sums_of(const ImageF3& difference, const Matte& known, const Recti& cell) {
    Sums s;
    for (int y = cell.y0; y < cell.y1; ++y) {
        for (int x = cell.x0; x < cell.x1; ++x) {
            if (!known.row(y)[x]) continue;
            const float* d = difference.pixel(x, y);
            s.n += 1;
            for (std::size_t c = 0; c < 3; ++c) {
                s.v[c] += d[c];
                s.squares[c] += static_cast<double>(d[c]) * d[c];
            }
        }
    }
    return s;
}

// The block's variance, if it stays.
std::optional<float> judge(ImageF3& difference, Matte& known, const Recti& block) {
    Sums all;
    double wide = 0;
    int cells = 0;
    for (int y = block.y0; y < block.y1; y += kCell) {
        for (int x = block.x0; x < block.x1; x += kCell) {
            const Sums cell =
                sums_of(difference, known, Recti{x, y, x + kCell, y + kCell}.intersected(block));
            if (cell.n < kFewestInCell) continue;
            ++cells;
            all.add(cell);
            wide += cell.square_of_mean();
        }
    }
    const double mean = all.square_of_mean();
    const bool fine =
        cells >= kFewestCells && wide - mean <= kMostWide * (all.all_squares() - mean);
    for (int y = block.y0; y < block.y1; ++y) {
        for (int x = block.x0; x < block.x1; ++x) {
            if (!fine) known.row(y)[x] = 0;
            for (std::size_t c = 0; fine && c < 3; ++c)
                difference.pixel(x, y)[c] -= static_cast<float>(all.v[c] / all.n);
        }
    }
    if (!fine) return std::nullopt;
    return all.largest_variance();
}

}  // namespace

std::vector<float> leave_out_moving_light(ImageF3& difference, Matte& known) {
    const Recti frame{0, 0, known.width(), known.height()};
    std::vector<std::vector<float>> rows(
        static_cast<std::size_t>((frame.y1 + kBlock - 1) / kBlock));
    parallel_rows(static_cast<int>(rows.size()), 1, [&](int r0, int r1) {
        for (int r = r0; r < r1; ++r) {
            for (int x = 0; x < frame.x1; x += kBlock) {
                const int y = r * kBlock;
                const auto variance = judge(difference, known,
                                            Recti{x, y, x + kBlock, y + kBlock}.intersected(frame));
                if (variance) rows[static_cast<std::size_t>(r)].push_back(*variance);
            }
        }
    });
    std::vector<float> all;
    for (const auto& row : rows)
        all.insert(all.end(), row.begin(), row.end());
    return all;
}

}  // namespace weft
