#pragma once
// The plate's grain: measured along the surface's motion, put back fresh in every frame (method:
// "Composite"). Everything on display-encoded values, where 1 is 255 levels; values above 1 are
// scene-linear highlights.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

struct GrainModel {
    static constexpr int kBins = 8;    ///< Of luma from 0 to 1; the last holds what is brighter.
    static constexpr int kRadius = 3;  ///< Of the kernels.
    static constexpr int kSide = 2 * kRadius + 1;
    /// Deviation by channel and luma; all 0: the plate has no grain.
    std::array<std::array<float, kBins>, 3> deviation{};
    /// Per channel: white noise of deviation 1 under it has deviation 1 and the grain's spectrum.
    std::array<std::array<float, kSide * kSide>, 3> kernel{};
    /// Lower triangle (Cholesky) by which the channels' grain hangs together.
    std::array<float, 6> mix{1, 0, 1, 0, 0, 1};
    [[nodiscard]] bool present() const;
};

/// Measures grain from pairs of frames. Grain is what differs along the motion where the picture is
/// flat; how errors of the motion grow with the picture's gradient is fitted and taken out. Not
/// thread-safe.
class GrainMeter {
  public:
    /// `quantum`: the step of the plate's codes (1/255 for 8 bit, 0 for float), whose rounding is
    /// no grain.
    explicit GrainMeter(float quantum) : quantum_(quantum) {}

    /// All of one size; `visible` 255: seen wholly. `prev_from_cur`: the surface's motion, pixels.
    void add(ViewF3 current, ViewF3 previous, ViewU8x1 visible, ViewU8x1 previous_visible,
             ViewF2 prev_from_cur);
    /// A model that is not present() where there is no grain, or too little to be seen.
    [[nodiscard]] GrainModel model() const;

  private:
    static constexpr int kLags = GrainModel::kSide;
    struct Pixel {
        std::array<float, 3> difference;
        float gradient2, luma, gain;  // gain: of white noise in the difference
    };
    float quantum_;
    std::vector<Pixel> pixels_;
    std::vector<float> block_variances_;  // of the difference
    std::array<std::array<double, kLags * kLags>, 3> lag_sums_{};
    std::array<double, kLags * kLags> lag_counts_{};
};

/// Adds grain, fresh for every `key` (random numbers of the seed, region and frame), to what the
/// matte covers. `origin`: the picture's place on the plate; a pixel's grain does not depend on the
/// part that is rendered.
void add_grain(ImageView<float, 3> display, ViewU8x1 matte, Vec2i origin, const GrainModel& model,
               float strength, std::uint64_t key);

}  // namespace weft
