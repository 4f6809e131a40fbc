#pragma once
// Fourier transforms of real planes in single precision. Sixteen rows or sixteen columns are
// transformed at a time, one in each lane, so that every instruction set does the same operations
// in the same order: the results are the same bits on all of them.

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

inline constexpr int kFftLanes = 16;

/// One complex number in each lane.
struct alignas(64) FftLanes {
    std::array<float, kFftLanes> re, im;
};

/// The smallest even size ≥ n without prime factors above 5, at least 4.
[[nodiscard]] int fast_fft_size(int n);

struct FftTables;

/// Thread-safe once made.
class PlaneFft {
  public:
    /// Both sides as fast_fft_size() gives them.
    explicit PlaneFft(Size size);
    ~PlaneFft();
    PlaneFft(const PlaneFft&) = delete;
    PlaneFft& operator=(const PlaneFft&) = delete;

    [[nodiscard]] Size size() const { return size_; }
    /// Elements of a spectrum, whole or of the rows alone: [kx / 16][y][kx % 16] for kx from 0 to
    /// width/2, each of the two counts rounded up to 16.
    [[nodiscard]] std::size_t spectrum_size() const;
    /// Floats from one row of an output plane to the next, and rows that it needs room for.
    [[nodiscard]] std::size_t row_stride() const;
    [[nodiscard]] int padded_height() const;

    /// Transforms along x: `plane` holds `filled` pixels row by row, without gaps, at the origin of
    /// a plane that is zero elsewhere. `out` holds spectrum_size() elements. Twice the usual
    /// values.
    void forward_rows(const float* plane, Size filled, FftLanes* out) const;
    /// Transforms what forward_rows() gave along y, in place.
    void forward_columns(FftLanes* spectrum) const;

    struct Product {
        const FftLanes* rows;      ///< From forward_rows().
        const FftLanes* spectrum;  ///< After forward_columns() as well.
        float weight;
    };
    /// Σ weight · F(rows) · conj(spectrum), transformed back along y: what backward_rows() wants.
    /// `out` may be the `rows` of a product.
    void correlate(std::span<const Product> products, FftLanes* out) const;
    /// Transforms back along x: the rows of [first, end), and up to 15 before and behind them, are
    /// written to their places in `out` (padded_height() rows). All in all a correlation comes out
    /// 4 · width · height times as large as it is.
    void backward_rows(const FftLanes* spectrum, int first, int end, float* out) const;

  private:
    Size size_;
    std::unique_ptr<const FftTables> tables_;
};

}  // namespace weft
