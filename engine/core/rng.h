#pragma once
// Counter-based random numbers: a value depends only on its key, never on how many were drawn
// before or by which thread.

#include <cstdint>

namespace weft {

/// A bijective mix of 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// Random numbers for one (seed, region, frame, patch). Copying copies the position.
class Rng {
  public:
    constexpr explicit Rng(std::uint64_t seed, std::uint64_t region = 0, std::uint64_t frame = 0,
                           std::uint64_t patch = 0)
        : key_(mix64(mix64(mix64(mix64(seed) ^ region) ^ frame) ^ patch)) {}

    /// Uniform over all 64-bit values.
    constexpr std::uint64_t next() { return mix64(key_ ^ mix64(counter_++)); }
    /// Uniform in [0, n); n ≥ 1. The bias is below n / 2^64.
    constexpr std::uint64_t below(std::uint64_t n) {
        return static_cast<std::uint64_t>((static_cast<unsigned __int128>(next()) * n) >> 64);
    }
    /// Uniform in [0, 1), a multiple of 2^-53.
    constexpr double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  private:
    std::uint64_t key_;
    std::uint64_t counter_ = 0;
};

}  // namespace weft
