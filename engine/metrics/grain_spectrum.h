#pragma once
// The grain of a result compared with the plate's: the differences from frame to frame along the
// surface's motion, as a spectrum.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Standard deviations of the grain, 8-bit levels per channel.
struct GrainSpectrum {
    static constexpr int kBands = 4;  ///< Of spatial frequency, from 0 to 0.5 cycles per pixel.
    std::int64_t blocks = 0;
    std::array<double, 3> deviation{};                 ///< All bands together.
    std::array<std::array<double, kBands>, 3> band{};  ///< By channel and band.
    /// Correlation of one difference with the next along the motion: −0.5 if grain is independent
    /// in every frame, towards 1 if it changes slowly.
    std::optional<double> correlation;
};

/// Gathers one sequence's differences. Grain is measured in blocks of 16 px where the picture is
/// flattest, so that motion errors have little effect; the rest of them is part of the figure, for
/// the plate as for the result. Not thread-safe.
class GrainSpectrumMeter {
  public:
    /// Display-encoded frames, H×W×3. The motion lies on `from`'s pixels and points into `to`;
    /// `visible` (255 or 0, on `from`'s pixels) marks where both show the surface. `forward`:
    /// `from` is the `to` of the call before; else the other way round.
    void add(ViewF3 from, ViewF3 to, const FlowField& to_from_from, ViewU8x1 visible, bool forward);
    [[nodiscard]] GrainSpectrum spectrum() const;

  private:
    static constexpr int kSide = 16;
    struct Block {
        double flatness = 0;  // mean squared gradient
        std::array<std::array<double, GrainSpectrum::kBands>, 3> power{};
    };
    std::vector<Block> blocks_;
    ImageF3 last_;  // the difference before this one
    Matte last_known_;
    FlowField last_motion_;
    bool has_last_ = false;
    double cross_ = 0, energy_a_ = 0, energy_b_ = 0;
};

}  // namespace weft
