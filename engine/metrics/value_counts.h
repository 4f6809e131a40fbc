#pragma once
// Quantiles of more values than memory holds.

#include <cstdint>
#include <vector>

namespace weft {

/// Counts values in bins of 1/8192 from −40 to 40; what lies beyond is in the last bin. Meant for
/// natural logarithms: a bin is 0.012 %. The order of adding does not matter. Not thread-safe.
class ValueCounts {
  public:
    ValueCounts();

    void add(double value);
    [[nodiscard]] std::int64_t count() const { return count_; }
    /// The value below which a share (0 to 1) of all lies; linear inside a bin. count() > 0.
    [[nodiscard]] double quantile(double share) const;
    /// The distance from `middle` below which a share of all lies.
    [[nodiscard]] double distance_quantile(double middle, double share) const;

  private:
    std::vector<std::int64_t> bins_;
    std::int64_t count_ = 0;
};

}  // namespace weft
