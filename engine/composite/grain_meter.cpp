#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/composite/grain.h"
#include "engine/composite/grain_levels.h"
#include "engine/composite/grain_spectrum.h"
#include "engine/composite/registered_block.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBlockSide = RegisteredBlock::kSide;
// Pixels whose neighbours within the reach are in the block.
constexpr int kInner = kBlockSide - 2 * GrainModel::kRadius;
constexpr double kMostBlocks = 600;    // of a frame; more add nothing new
constexpr float kFewestInCell = 60;    // pixels
constexpr double kFewestPixels = 400;  // in all
// This many pixels of grain, whose neighbours are correlated, count as one independent pixel.
constexpr double kPixelsOfOne = 2.5;
constexpr double kLeastDeviation = 0.35 / 255;  // less is not visible
constexpr double kMostDeviation = 0.1;          // more is not grain
constexpr double kMostOfUsual = 2.5;            // deviation at one luma over that at all
// If the means of 10 px squares hold more than this share of a block's variance, light moves there.
// White noise gives 1 %, grain with a correlation of 1.2 px an eighth.
constexpr int kSquare = 10;
constexpr double kMostWide = 0.3;
// Smooth terms that registration removes: brightness, its two slopes, gain.
constexpr double kTaken = 4;
// Farther than two codes from black and white, nothing is clipped.
constexpr float kClippedCodes = 2;

double rounding_variance(float quantum) {
    return static_cast<double>(quantum) * quantum / 12;
}

bool moving_light(const RegisteredBlock& block) {
    double wide = 0, all = 0;
    for (int y = 0; y < kBlockSide; y += kSquare) {
        for (int x = 0; x < kBlockSide; x += kSquare) {
            std::array<double, 3> sum{};
            for (int v = y; v < y + kSquare; ++v) {
                for (int u = x; u < x + kSquare; ++u) {
                    const float* r = block.residual.pixel(u, v);
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] += r[c], all += static_cast<double>(r[c]) * r[c];
                }
            }
            for (const double s : sum)
                wide += s * s / (kSquare * kSquare);
        }
    }
    return wide > kMostWide * all;
}

// 5×5 mean, which holds hardly any grain.
float smooth_luma(const ImageF3& mean, int x, int y) {
    float sum = 0;
    for (int v = y - 2; v <= y + 2; ++v) {
        for (int u = x - 2; u <= x + 2; ++u)
            sum += luma_601(
                mean.pixel(std::clamp(u, 0, kBlockSide - 1), std::clamp(v, 0, kBlockSide - 1)));
    }
    return sum / 25.0f;
}

std::size_t bin_of(float luma) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(luma * GrainModel::kBins), 0, GrainModel::kBins - 1));
}

GrainLags lags_in_plane(const std::array<std::array<float, 4>, 2>& lookup) {
    GrainLags out{};
    for (int y = -GrainModel::kRadius; y <= GrainModel::kRadius; ++y) {
        for (int x = -GrainModel::kRadius; x <= GrainModel::kRadius; ++x) {
            out[static_cast<std::size_t>((y + GrainModel::kRadius) * GrainModel::kSide + x +
                                         GrainModel::kRadius)] =
                static_cast<double>(lookup[0][static_cast<std::size_t>(std::abs(x))]) *
                lookup[1][static_cast<std::size_t>(std::abs(y))];
        }
    }
    return out;
}

std::array<float, 6> cholesky(double gr, double br, double bg) {
    const double g1 = std::sqrt(1 - gr * gr);
    const double b1 = (bg - br * gr) / g1;
    const double b2 = std::sqrt(std::max(0.0, 1 - br * br - b1 * b1));
    return {1,
            static_cast<float>(gr),
            static_cast<float>(g1),
            static_cast<float>(br),
            static_cast<float>(b1),
            static_cast<float>(b2)};
}

}  // namespace

// Sums over all blocks, weighted by how far they show grain alone.
struct GrainMeter::Sums {
    std::array<Lags, 3> products{};
    std::array<double, 3> together{};
    Lags lookup{};
};

namespace {

// The lumas of a block, each with its differences.
template <class Cell>
std::vector<Cell> cells_of(const RegisteredBlock& block, float clipped) {
    std::array<Cell, GrainModel::kBins> cells{};
    for (int y = 0; y < kBlockSide; ++y) {
        for (int x = 0; x < kBlockSide; ++x) {
            const float luma = smooth_luma(block.mean, x, y);
            const float* m = block.mean.pixel(x, y);
            if (clipped > 0 && (std::min({m[0], m[1], m[2]}) < clipped ||
                                std::max({m[0], m[1], m[2]}) > 1 - clipped))
                continue;
            Cell& cell = cells[bin_of(luma)];
            cell.count += 1, cell.luma += luma;
            for (std::size_t c = 0; c < 3; ++c) {
                const float r = block.residual.pixel(x, y)[c];
                cell.variance[c] += r * r, cell.detail[c] += block.detail.pixel(x, y)[c];
            }
        }
    }
    std::vector<Cell> out;
    for (Cell& cell : cells) {
        if (cell.count < kFewestInCell) continue;
        cell.luma /= cell.count;
        for (std::size_t c = 0; c < 3; ++c) {
            cell.variance[c] /= cell.count, cell.detail[c] /= cell.count;
            // Less than three deviations of the chance deviation of grain is not detail.
            cell.detail[c] -= std::min(cell.detail[c], cell.variance[c] / std::sqrt(cell.count));
        }
        out.push_back(cell);
    }
    return out;
}

template <class Block>
Block products_of(const RegisteredBlock& block) {
    Block out{};
    out.lookup = block.lookup;
    out.count = kBlockSide * kBlockSide;
    for (int y = GrainModel::kRadius; y < kBlockSide - GrainModel::kRadius; ++y) {
        for (int x = GrainModel::kRadius; x < kBlockSide - GrainModel::kRadius; ++x) {
            const float* r = block.residual.pixel(x, y);
            out.together[0] += static_cast<double>(r[1]) * r[0];
            out.together[1] += static_cast<double>(r[2]) * r[0];
            out.together[2] += static_cast<double>(r[2]) * r[1];
            std::size_t k = 0;
            for (int v = -GrainModel::kRadius; v <= GrainModel::kRadius; ++v) {
                for (int u = -GrainModel::kRadius; u <= GrainModel::kRadius; ++u, ++k) {
                    const float* o = block.residual.pixel(x + u, y + v);
                    for (std::size_t c = 0; c < 3; ++c)
                        out.products[c][k] += static_cast<double>(r[c]) * o[c];
                }
            }
        }
    }
    return out;
}

}  // namespace

void GrainMeter::add(ViewF3 current, ViewF3 previous, ViewU8x1 visible, ViewU8x1 previous_visible,
                     ViewF2 prev_from_cur) {
    const Size size = current.size();
    if (size.width < 2 * kBlockSide || size.height < 2 * kBlockSide) return;
    const BlockPair pair(current, previous, visible, previous_visible);
    const double area = static_cast<double>(size.width) * size.height;
    const int step = std::max(kBlockSide, static_cast<int>(std::sqrt(area / kMostBlocks)));
    constexpr int kBorder = 2 * RegisteredBlock::kBorder;
    const int columns = (size.width - 2 * kBorder - kBlockSide) / step + 1;
    const int rows = (size.height - 2 * kBorder - kBlockSide) / step + 1;
    struct Found {
        Block block;
        std::vector<Cell> cells;
    };
    std::vector<std::optional<Found>> found(static_cast<std::size_t>(columns) *
                                            static_cast<std::size_t>(rows));
    parallel_rows(rows, 1, [&](int r0, int r1) {
        for (int r = r0; r < r1; ++r) {
            for (int k = 0; k < columns; ++k) {
                const Vec2i corner{kBorder + k * step, kBorder + r * step};
                const float* d =
                    prev_from_cur.pixel(corner.x + kBlockSide / 2, corner.y + kBlockSide / 2);
                const auto block = register_block(pair, corner, {d[0], d[1]});
                if (!block || moving_light(*block)) continue;
                Found f{products_of<Block>(*block),
                        cells_of<Cell>(*block, kClippedCodes * quantum_)};
                if (!f.cells.empty())
                    found[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                          static_cast<std::size_t>(k)] = std::move(f);
            }
        }
    });
    for (auto& f : found) {
        if (!f) continue;
        for (Cell& cell : f->cells) {
            cell.block = blocks_.size();
            cells_.push_back(cell);
        }
        blocks_.push_back(f->block);
    }
}

GrainMeter::Sums GrainMeter::sums_of(const std::vector<float>& confidence) const {
    std::vector<double> of_block(blocks_.size(), 0.0);
    for (std::size_t i = 0; i < cells_.size(); ++i)
        of_block[cells_[i].block] +=
            static_cast<double>(confidence[i]) * confidence[i] * cells_[i].count;
    Sums sums;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        // A block counts by its information about the spectrum, not by the strength of its grain.
        const double energy = block.products[0][kLags / 2] + block.products[1][kLags / 2] +
                              block.products[2][kLags / 2];
        if (!(energy > 0)) continue;
        const double share = of_block[b] / energy;
        const Lags lookup = lags_in_plane(block.lookup);
        const double rounding = 2 * rounding_variance(quantum_) * kInner * kInner;
        for (std::size_t c = 0; c < 3; ++c) {
            sums.together[c] += share * block.together[c];
            for (std::size_t k = 0; k < kLags; ++k)
                sums.products[c][k] += share * (block.products[c][k] - rounding * lookup[k]);
        }
        for (std::size_t k = 0; k < kLags; ++k)
            sums.lookup[k] += of_block[b] * lookup[k];
    }
    for (Lags& products : sums.products) {
        // Registration removes the widest part of the grain, equally at all lags.
        const double whole = std::accumulate(products.begin(), products.end(), 0.0);
        for (double& p : products)
            p += kTaken / (kBlockSide * kBlockSide) * whole;
    }
    return sums;
}

GrainModel GrainMeter::model() const {
    GrainModel model;
    double pixels = 0;
    for (const Cell& cell : cells_)
        pixels += cell.count;
    if (pixels < kFewestPixels) return model;

    // The first round assumes that the lookup removes no grain, to find the places that show grain
    // and its spectrum. The second allows for what the lookup removes of such grain.
    std::array<GrainSpectrum, 3> spectra;
    std::array<GrainLevels, 3> levels;
    for (int pass = 0; pass < 2; ++pass) {
        std::vector<float> confidence(cells_.size(), 1.0f);
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<GrainPlace> places;
            for (const Cell& cell : cells_) {
                double kept = 0;
                const Lags lookup = lags_in_plane(blocks_[cell.block].lookup);
                for (std::size_t k = 0; k < kLags; ++k)
                    kept += lookup[k] *
                            (pass == 0 ? (k == kLags / 2 ? 1.0 : 0.0) : spectra[c].correlation[k]);
                places.push_back(
                    {cell.luma, static_cast<float>(cell.variance[c] / (2 * std::max(0.1, kept))),
                     cell.detail[c], static_cast<float>(std::sqrt(2 * kPixelsOfOne / cell.count))});
            }
            levels[c] = grain_levels(places);
            for (std::size_t i = 0; i < confidence.size(); ++i)
                confidence[i] = std::min(confidence[i], levels[c].confidence[i]);
        }
        const Sums sums = sums_of(confidence);
        for (std::size_t c = 0; c < 3; ++c)
            spectra[c] = grain_spectrum(sums.products[c], sums.lookup);
        const auto correlation = [&](std::size_t k, std::size_t a, std::size_t b) {
            const double both = sums.products[a][kLags / 2] * sums.products[b][kLags / 2];
            // Different kernels lower the correlation of the noise that they filter.
            double alike = 0;
            for (std::size_t i = 0; i < kLags; ++i)
                alike += static_cast<double>(spectra[a].kernel[i]) * spectra[b].kernel[i];
            const double seen = sums.together[k] / std::sqrt(std::max(1e-30, both));
            return std::clamp(seen / std::max(0.1, alike), -0.99, 0.99);
        };
        model.mix = cholesky(correlation(0, 1, 0), correlation(1, 2, 0), correlation(2, 2, 1));
    }

    const double rounding = rounding_variance(quantum_);
    std::array<double, GrainModel::kBins> share{};
    for (const Cell& cell : cells_)
        share[bin_of(cell.luma)] += cell.count / pixels;
    std::array<double, 3> usual{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t b = 0; b < GrainModel::kBins; ++b)
            usual[c] += share[b] * std::max(0.0, levels[c].variance[b] - rounding);
    }
    const double most = std::max({usual[0], usual[1], usual[2]});
    if (!(most > kLeastDeviation * kLeastDeviation && most < kMostDeviation * kMostDeviation))
        return model;
    for (std::size_t c = 0; c < 3; ++c) {
        model.kernel[c] = spectra[c].kernel;
        for (std::size_t b = 0; b < GrainModel::kBins; ++b)
            model.deviation[c][b] = static_cast<float>(std::sqrt(std::clamp(
                levels[c].variance[b] - rounding, 0.0, kMostOfUsual * kMostOfUsual * usual[c])));
    }
    return model;
}

}  // namespace weft
