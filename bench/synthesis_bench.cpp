// Benchmarks of the inner loops of synthesis: the placement search by each method and instruction
// set, the minimum cut by each solver, and whole planes.

#include <benchmark/benchmark.h>

#include <cstdint>

#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/placement_search.h"
#include "engine/synthesis/sweep_axis.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {
namespace {

// Value noise of several octaves: as rough as gravel, without a period.
ImageU8x3 noise(int w, int h, std::uint64_t seed) {
    ImageU8x3 out(w, h);
    const auto lattice = [&](int x, int y, std::uint64_t octave) {
        return static_cast<double>(
            Rng(seed, octave, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y))
                .below(256));
    };
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            double sum = 0;
            std::uint64_t octave = 0;
            for (const int cell : {2, 5, 11, 23}) {
                const int cx = x / cell, cy = y / cell;
                const double fx = x % cell / static_cast<double>(cell);
                const double fy = y % cell / static_cast<double>(cell);
                const double top =
                    lattice(cx, cy, octave) * (1 - fx) + lattice(cx + 1, cy, octave) * fx;
                const double bottom =
                    lattice(cx, cy + 1, octave) * (1 - fx) + lattice(cx + 1, cy + 1, octave) * fx;
                sum += (top * (1 - fy) + bottom * fy) / 4;
                ++octave;
            }
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>(sum * (1.0 - 0.2 * c));
        }
    }
    return out;
}

// An L of 36 px over a block for a sample of `side` px, with all translations of the first sweep.
void search(benchmark::State& state, SearchMethod method, Isa isa) {
    if (!isa_available(isa)) {
        state.SkipWithError("this processor lacks the instruction set");
        return;
    }
    force_isa(isa);
    const int side = static_cast<int>(state.range(0));
    const SweepAxis axis = make_sweep_axis(side, 4096, false, 36);
    const ImageU8x3 sample = noise(axis.window, axis.window, 1);
    const ImageU8x3 block = noise(axis.block, axis.block, 2);
    Image<std::uint8_t, 1> filled(block.size(), 0);
    for (int y = 0; y < block.height(); ++y) {
        for (int x = 0; x < block.width(); ++x)
            filled.at(x, y) = x < axis.overlap || y < axis.overlap;
    }
    PlacementSearch placements(sample, block.size(), {axis.lo, axis.lo}, {axis.hi, axis.hi});
    for (auto _ : state) {
        benchmark::DoNotOptimize(placements.find({block, filled, {}, {}, 1, 0}, {}, method));
    }
    force_isa(std::nullopt);
}
BENCHMARK_CAPTURE(search, direct_avx512, SearchMethod::kDirect, Isa::kAvx512)->Arg(96)->Arg(200);
BENCHMARK_CAPTURE(search, direct_avx2, SearchMethod::kDirect, Isa::kAvx2)->Arg(96)->Arg(200);
BENCHMARK_CAPTURE(search, direct_scalar, SearchMethod::kDirect, Isa::kScalar)->Arg(96)->Arg(200);
BENCHMARK_CAPTURE(search, fft_avx512, SearchMethod::kFft, Isa::kAvx512)
    ->Arg(96)
    ->Arg(200)
    ->Arg(488);
BENCHMARK_CAPTURE(search, fft_avx2, SearchMethod::kFft, Isa::kAvx2)->Arg(96)->Arg(200)->Arg(488);
BENCHMARK_CAPTURE(search, fft_scalar, SearchMethod::kFft, Isa::kScalar)
    ->Arg(96)
    ->Arg(200)
    ->Arg(488);

// An interior patch whose whole border is old, with the costs of old seams: the cut of refinement.
SeamProblem interior_problem(int side) {
    const ImageU8x3 a = noise(side, side, 3), b = noise(side, side, 4), c = noise(side, side, 6);
    SeamProblem p;
    p.cells = Image<SeamCell, 1>(side, side, SeamCell::kFree);
    for (int i = 0; i < side; ++i) {
        p.cells.at(i, 0) = p.cells.at(i, side - 1) = SeamCell::kOld;
        p.cells.at(0, i) = p.cells.at(side - 1, i) = SeamCell::kOld;
    }
    fill_seam_costs(a, b, p);
    fill_data_costs(a, b, c, Matte(side, side, 255), 0.1f, p);
    return p;
}

SeamProblem strip_problem(int width, int height) {
    const ImageU8x3 a = noise(width, height, 3), b = noise(width, height, 4);
    SeamProblem p;
    p.cells = Image<SeamCell, 1>(width, height, SeamCell::kFree);
    for (int y = 0; y < height; ++y) {
        p.cells.at(0, y) = SeamCell::kOld;
        p.cells.at(width - 1, y) = SeamCell::kNew;
    }
    fill_seam_costs(a, b, p);
    return p;
}

void cut_planar(benchmark::State& state) {
    const SeamProblem p = strip_problem(36, static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(solve_planar_dual(p));
    state.counters["graph_bytes"] = static_cast<double>(solve_planar_dual(p)->graph_bytes);
}
BENCHMARK(cut_planar)->Arg(96)->Arg(200);

void cut_max_flow(benchmark::State& state) {
    const SeamProblem p = strip_problem(36, static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(solve_grid_maxflow(p));
    state.counters["graph_bytes"] = static_cast<double>(solve_grid_maxflow(p).graph_bytes);
}
BENCHMARK(cut_max_flow)->Arg(96)->Arg(200);

void cut_interior(benchmark::State& state) {
    const SeamProblem p = interior_problem(static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(solve_grid_maxflow(p));
    state.counters["graph_bytes"] = static_cast<double>(solve_grid_maxflow(p).graph_bytes);
}
BENCHMARK(cut_interior)->Arg(48)->Arg(96)->Arg(200);

void cut_dynamic_programming(benchmark::State& state) {
    const SeamProblem p = strip_problem(36, static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(solve_min_error_boundary(p));
}
BENCHMARK(cut_dynamic_programming)->Arg(96)->Arg(200);

void plane(benchmark::State& state) {
    set_thread_count(static_cast<int>(state.range(2)));
    const ImageU8x3 sample = noise(96, 96, 5);
    PlaneOptions options;
    options.size = {static_cast<int>(state.range(0)), static_cast<int>(state.range(0))};
    options.refine_passes = static_cast<int>(state.range(1));
    for (auto _ : state)
        benchmark::DoNotOptimize(grow_plane(sample, options));
}
BENCHMARK(plane)
    ->ArgNames({"side", "refine", "threads"})
    ->ArgsProduct({{512, 1280}, {0, kDefaultRefinePasses}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace weft

BENCHMARK_MAIN();
