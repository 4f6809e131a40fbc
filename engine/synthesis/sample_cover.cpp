#include "engine/synthesis/sample_cover.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/core/wrap.h"
#include "engine/synthesis/plane_energy.h"

namespace weft {
namespace {

constexpr double kExact_px = 0.75;

// The longest side of whole periods, or all.
int whole_part(const SampleLattice& lattice, int axis, int side) {
    const LatticeWaves waves = waves_of(lattice);
    for (int length = side; 2 * length >= side; --length) {
        glm::dvec2 miss{0};
        for (int k = 0; k < lattice.count; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const double turns = waves[i][axis] * length;
            miss += (turns - std::round(turns)) * lattice.steps[i];
        }
        if (std::hypot(miss.x, miss.y) <= kExact_px) return length;
    }
    return side;
}

int mirrored(int i, int n) {
    const int k = wrapped(i, 2 * n);
    return k < n ? k : 2 * n - 1 - k;
}

// Bilinear, with pixel centres on pixel centres.
void stretch_row(ViewU8x3 sample, int y, ImageU8x3& out) {
    const auto place = [](int i, int n, int from) {
        return std::clamp(
            (static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(n) -
                0.5f,
            0.0f, static_cast<float>(from - 1));
    };
    const float v = place(y, out.height(), sample.height());
    const int y0 = static_cast<int>(v), y1 = std::min(y0 + 1, sample.height() - 1);
    for (int x = 0; x < out.width(); ++x) {
        const float u = place(x, out.width(), sample.width());
        const int x0 = static_cast<int>(u), x1 = std::min(x0 + 1, sample.width() - 1);
        const float fx = u - static_cast<float>(x0), fy = v - static_cast<float>(y0);
        for (int c = 0; c < 3; ++c) {
            const auto at = [&](int sx, int sy) {
                return static_cast<float>(sample.pixel(sx, sy)[c]);
            };
            const float above = at(x0, y0) + fx * (at(x1, y0) - at(x0, y0));
            const float below = at(x0, y1) + fx * (at(x1, y1) - at(x0, y1));
            out.pixel(x, y)[c] = static_cast<std::uint8_t>(above + fy * (below - above) + 0.5f);
        }
    }
}

}  // namespace

Recti tiling_part(ViewU8x3 sample) {
    const SampleLattice lattice = find_lattice(sample);
    if (lattice.count == 0) return rect_of(sample.size());
    return {0, 0, whole_part(lattice, 0, sample.width()), whole_part(lattice, 1, sample.height())};
}

TexturePlane lay_sample(ViewU8x3 sample, const PlaneOptions& options) {
    TexturePlane plane;
    PlaneStats& stats = plane.stats;
    {
        const ScopeTimer total(stats.total_s);
        const Recti part =
            options.mode == PlaneMode::kTile ? tiling_part(sample) : rect_of(sample.size());
        const Size size = options.size;
        plane.pixels = ImageU8x3(size);
        plane.source = Image<std::int32_t, 2>(size);
        const auto from = [&](int i, int n, int length) {
            switch (options.mode) {
                case PlaneMode::kMirror:
                    return mirrored(i, length);
                case PlaneMode::kStretch:
                    return static_cast<int>(std::int64_t{i} * length / n);
                default:
                    return wrapped(i, length);
            }
        };
        parallel_rows(size.height, 32, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                const int sy = from(y, size.height, part.height());
                for (int x = 0; x < size.width; ++x) {
                    const int sx = from(x, size.width, part.width());
                    std::copy_n(sample.pixel(sx, sy), 3, plane.pixels.pixel(x, y));
                    plane.source.pixel(x, y)[0] = sx, plane.source.pixel(x, y)[1] = sy;
                }
                if (options.mode == PlaneMode::kStretch) stretch_row(sample, y, plane.pixels);
            }
        });
        if (options.mode == PlaneMode::kTile) {
            const PlaneEnergy energy =
                recount_energy(SampleAtlas(sample), plane.source, options.tileable);
            stats.seam_energy = energy.energy;
            stats.seam_length_px = energy.length_px;
            stats.seam_energy_per_area =
                energy.energy / static_cast<double>(size.width) / static_cast<double>(size.height);
        }
    }
    stats.other_s = stats.total_s;
    return plane;
}

}  // namespace weft
