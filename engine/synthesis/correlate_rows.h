#pragma once
// The inner loop of the direct search: exact correlations of bytes, for each instruction set.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/isa.h"
#include "engine/seam/aligned.h"
#include "engine/synthesis/scratch.h"

namespace weft {

/// Number of elements that are read at a time.
inline constexpr int kCorrelationChunk = 64;

/// The start of one row of a correlation on either side, in elements, and its length.
struct CorrelationRow {
    std::size_t a, b;
    int chunks;
};

/// The signed side, in the layout of an instruction set. Values lie in [−128, 127].
class SignedPlane {
  public:
    /// All 0. `stride` and the starts of rows must be multiples of kCorrelationChunk.
    SignedPlane(Isa isa, std::size_t stride, std::size_t rows);

    [[nodiscard]] std::size_t stride() const { return stride_; }
    void set(std::size_t index, int value) {
        if (isa_ == Isa::kAvx512) {
            (*bytes_)[index] = static_cast<std::int8_t>(value);
        } else {
            (*words_)[index] = static_cast<std::int16_t>(value);
        }
    }
    /// out[k] = Σ over the rows and their elements i of a[row.a + k·stride + i] · b[row.b + i], for
    /// k ∈ [0, count), 1 ≤ count ≤ kCorrelationGroup. Exact while a sum stays below 2^62.
    /// Thread-safe.
    void correlate(const std::vector<CorrelationRow>& rows, const std::uint8_t* b, int count,
                   std::int64_t* out) const;

  private:
    Isa isa_;
    std::size_t stride_;
    Scratch<std::vector<std::int8_t, AlignedAllocator<std::int8_t>>> bytes_;
    Scratch<std::vector<std::int16_t, AlignedAllocator<std::int16_t>>> words_;
};

inline constexpr int kCorrelationGroup = 13;

}  // namespace weft
