#pragma once
// The plate's grain: measured between neighbouring frames of the whole plate, put back fresh in
// every frame (method: "Composite"). Everything on display-encoded values, where 1 is 255 levels;
// values above 1 are scene-linear highlights.

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
    /// Per channel: white noise of deviation 1 under it has deviation 1 and the grain's spectrum.
    std::array<std::array<float, kSide * kSide>, 3> kernel{};
    /// Lower triangle (Cholesky): how the channels' white noise under the kernels hangs together.
    std::array<float, 6> mix{1, 0, 1, 0, 0, 1};
    [[nodiscard]] bool present() const;
};

/// Measures grain from pairs of frames. It is the camera's, so it is looked for on the whole plate:
/// what differs between two frames in blocks that are laid on top of each other (register_block).
/// What differs so at one luma is grain and what else is fresh there (aliasing, light that moves),
/// so the least of it counts. Not thread-safe.
class GrainMeter {
  public:
    /// `quantum`: the step of the plate's codes (1/255 for 8 bit, 0 for float), whose rounding is
    /// no grain.
    explicit GrainMeter(float quantum) : quantum_(quantum) {}

    /// All of one size; `visible` 255: counts. `prev_from_cur`: displacements, in pixels, near
    /// which blocks are looked for (and near 0).
    void add(ViewF3 current, ViewF3 previous, ViewU8x1 visible, ViewU8x1 previous_visible,
             ViewF2 prev_from_cur);
    /// A model that is not present() where there is no grain, or too little to be seen.
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
    [[nodiscard]] Sums sums_of(const std::vector<float>& trust) const;

    float quantum_;
    std::vector<Cell> cells_;
    std::vector<Block> blocks_;
};

/// Adds grain, fresh for every `key` (random numbers of the seed, region and frame), to what the
/// matte covers. `origin`: the picture's place on the plate; a pixel's grain does not depend on the
/// part that is rendered.
void add_grain(ImageView<float, 3> display, ViewU8x1 matte, Vec2i origin, const GrainModel& model,
               float strength, std::uint64_t key);

}  // namespace weft
