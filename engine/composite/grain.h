#pragma once
// The plate's grain: measured between neighbouring frames of the whole plate, and added anew in
// every frame (method: "Composite"). All values are display-encoded, where 1 is 255 levels; values
// above 1 are scene-linear highlights.

#include <array>
#include <cstddef>
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
    /// Per channel: turns white noise of deviation 1 into noise of deviation 1 with the grain's
    /// spectrum.
    std::array<std::array<float, kSide * kSide>, 3> kernel{};
    /// Lower triangle (Cholesky): the correlation of the channels' white noise.
    std::array<float, 6> mix{1, 0, 1, 0, 0, 1};
    [[nodiscard]] bool present() const;
};

/// Measures grain from pairs of frames. Grain comes from the camera, so it is measured on the whole
/// plate: as the difference of two frames in registered blocks (register_block()). Aliasing and
/// moving light also differ between frames, so the lowest differences at each luma count. Not
/// thread-safe.
class GrainMeter {
  public:
    /// `quantum`: the step of the plate's codes (1/255 for 8 bit, 0 for float), whose rounding is
    /// not grain.
    explicit GrainMeter(float quantum) : quantum_(quantum) {}

    /// All H×W. `visible` 255: the pixel counts. `prev_from_cur`: displacements (pixels) near which
    /// blocks are searched, in addition to 0.
    void add(ViewF3 current, ViewF3 previous, ViewU8x1 visible, ViewU8x1 previous_visible,
             ViewF2 prev_from_cur);
    /// The model; it is not present() if there is no grain or too little to be visible.
    [[nodiscard]] GrainModel model() const;

  private:
    static constexpr std::size_t kLags = GrainModel::kSide * GrainModel::kSide;
    using Lags = std::array<double, kLags>;
    // The pixels of a block that are of one luma.
    struct Cell {
        std::size_t block = 0;
        float luma = 0, count = 0;
        std::array<float, 3> variance{}, detail{};  // of the difference; of what both have
    };
    struct Block {
        std::array<Lags, 3> products{};              // of the difference, by lag
        std::array<std::array<float, 4>, 2> lookup;  // RegisteredBlock::lookup
        std::array<double, 3> together{};            // of the channels: GR, BR, BG
        double count = 0;
    };
    struct Sums;
    [[nodiscard]] Sums sums_of(const std::vector<float>& confidence) const;

    float quantum_;
    std::vector<Cell> cells_;
    std::vector<Block> blocks_;
};

/// Adds grain where the matte covers, different for every `key` (random numbers of the seed, region
/// and frame). `origin`: the picture's place on the plate. A pixel's grain does not depend on the
/// part that is rendered.
void add_grain(ImageView<float, 3> display, ViewU8x1 matte, Vec2i origin, const GrainModel& model,
               float strength, std::uint64_t key);

}  // namespace weft
