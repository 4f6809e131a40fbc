#include "engine/form/reciprocal_depth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

constexpr std::array kGrids{2, 4, 8, 16};  // cells along each side of the picture
constexpr int kCellPlaces = 12;            // along each side of a cell
// Root mean square of what a plane leaves, relative to the mean: a half holds 1.4e-4.
constexpr double kBent = 1.5e-3;
constexpr double kStraight = 0.15;   // times what the other reading leaves
constexpr double kLeastArea = 0.05;  // of the picture, that tells
constexpr double kMajority = 4;      // times the area that says the opposite

// A linear function over a cell's grid of places, fitted by least squares. The places are
// symmetric, so the slopes are told apart by sums of their own.
class LinearFit {
  public:
    void add(double u, double v, double value) {
        sum_ += value, squares_ += value * value;
        along_u_ += u * value, along_v_ += v * value;
        uu_ += u * u, vv_ += v * v, ++count_;
    }
    // Relative to the mean.
    [[nodiscard]] double left() const {
        const double mean = sum_ / count_;
        const double rest =
            squares_ - count_ * mean * mean - along_u_ * along_u_ / uu_ - along_v_ * along_v_ / vv_;
        return std::sqrt(std::max(0.0, rest) / count_) / mean;
    }

  private:
    double sum_ = 0, squares_ = 0, along_u_ = 0, along_v_ = 0, uu_ = 0, vv_ = 0;
    int count_ = 0;
};

enum class DepthReading { kNothing, kDistance, kReciprocal };

DepthReading reading_of(ViewF1 depth, const Recti& cell) {
    LinearFit as_it_is, inverted;
    for (int j = 0; j < kCellPlaces; ++j) {
        for (int i = 0; i < kCellPlaces; ++i) {
            // Whole pixels of equal distance, symmetric about the middle one.
            const int step_x = (cell.width() - 1) / (kCellPlaces - 1);
            const int step_y = (cell.height() - 1) / (kCellPlaces - 1);
            const double value = depth.row(cell.y0 + j * step_y)[cell.x0 + i * step_x];
            if (!(value > 0) || !std::isfinite(value)) return DepthReading::kNothing;
            const double u = i - 0.5 * (kCellPlaces - 1), v = j - 0.5 * (kCellPlaces - 1);
            as_it_is.add(u, v, value);
            inverted.add(u, v, 1 / value);
        }
    }
    const double own = as_it_is.left(), other = inverted.left();
    if (own > kBent && other < kStraight * own) return DepthReading::kDistance;
    if (other > kBent && own < kStraight * other) return DepthReading::kReciprocal;
    return DepthReading::kNothing;
}

}  // namespace

bool looks_reciprocal(ViewF1 depth) {
    double distance = 0, reciprocal = 0;  // shares of the picture, over all grids
    for (const int grid : kGrids) {
        const int width = depth.width() / grid, height = depth.height() / grid;
        if (width < kCellPlaces || height < kCellPlaces) break;
        for (int j = 0; j < grid; ++j) {
            for (int i = 0; i < grid; ++i) {
                const DepthReading found =
                    reading_of(depth, {i * width, j * height, (i + 1) * width, (j + 1) * height});
                const double area = 1.0 / (grid * grid);
                distance += found == DepthReading::kDistance ? area : 0;
                reciprocal += found == DepthReading::kReciprocal ? area : 0;
            }
        }
    }
    return reciprocal > kLeastArea && reciprocal > kMajority * distance;
}

}  // namespace weft
