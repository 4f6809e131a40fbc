// What a GPU takes: the whole placement search of a first sweep, for each strategy, and a frame.
// Prints tables in Markdown. tests/gpu/run builds and starts it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "engine/composite/composite.h"
#include "engine/compute/backend_registry.h"
#include "engine/compute/plane_sampler.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/lighting/shading.h"
#include "gpu/cuda_backend.h"
#include "gpu/cuda_device.h"
#include "tests/gpu/search_cases.h"

namespace weft::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRuns = 10;
constexpr int kSample_px = 96, kOverlap_px = 36, kLeastOverlap_px = 12;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string mean_and_deviation(const std::vector<double>& values) {
    double mean = 0, square = 0;
    for (const double v : values)
        mean += v / static_cast<double>(values.size());
    for (const double v : values)
        square += (v - mean) * (v - mean) / static_cast<double>(values.size());
    char text[64];
    std::snprintf(text, sizeof text, "%.2f ± %.2f", mean, std::sqrt(square));
    return text;
}

// Noise that neighbouring pixels share, so that costs differ as they do in a photograph.
ImageU8x3 soft_noise(Size size) {
    Rng rng(4);
    ImageU8x3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const int left = x > 0 ? out.at(x - 1, y, c) : 128;
                const int above = y > 0 ? out.at(x, y - 1, c) : 128;
                const int fresh = static_cast<int>(rng.below(256));
                out.at(x, y, c) = static_cast<std::uint8_t>((2 * left + 2 * above + fresh) / 5);
            }
        }
    }
    return out;
}

struct Sweep {
    std::vector<std::size_t> winners;
    double device_ms = 0, search_ms = 0;
};

// The placements of a first sweep as grow_plane() makes them, without cuts: what is unfilled gets
// the sample's pixels.
Sweep sweep(PlaneSearch& search, ViewU8x3 sample, int side, bool timed) {
    constexpr int kSlack = kOverlap_px - kLeastOverlap_px, kBlock = kSample_px + kSlack;
    Sweep result;
    ImageU8x3 pixels(side, side);
    Image<std::uint8_t, 1> filled(side, side, 0);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            if (filled.at(x, y)) continue;
            PlaneSearchRequest r;
            const int x0 = x - (x == 0 ? kSlack : kOverlap_px);
            const int y0 = y - (y == 0 ? kSlack : kOverlap_px);
            r.block = {x0, y0, x0 + kBlock, y0 + kBlock};
            r.window = rect_of(sample.size());
            r.hi = {kSlack, kSlack};
            r.want_time = timed;
            const auto start = Clock::now();
            const auto found = search.find(r);
            result.search_ms += ms_since(start);
            if (!found) return result;
            result.device_ms += found->device_ms;
            result.winners.push_back(found->best);
            const int px = x0 + static_cast<int>(found->best) % (kSlack + 1);
            const int py = y0 + static_cast<int>(found->best) / (kSlack + 1);
            const Recti patch =
                Recti{px, py, px + kSample_px, py + kSample_px}.intersected(rect_of(pixels.size()));
            for (int cy = patch.y0; cy < patch.y1; ++cy) {
                for (int cx = patch.x0; cx < patch.x1; ++cx) {
                    if (filled.at(cx, cy)) continue;
                    std::copy_n(sample.pixel(cx - px, cy - py), 3, pixels.pixel(cx, cy));
                    filled.at(cx, cy) = 1;
                }
            }
            const auto update_start = Clock::now();
            if (!search.update(patch, pixels.view().crop(patch), filled.view().crop(patch)))
                return result;
            result.search_ms += ms_since(update_start);
        }
    }
    return result;
}

std::shared_ptr<const Backend> backend(const std::string& name) {
    BackendRegistry registry;
    register_cuda(registry);
    const auto choice = registry.choose(name);
    return choice ? choice->backend : nullptr;
}

bool measure_search() {
    std::printf("\n## Placement search, one sweep, sample %d px, overlap %d px, ms, %d runs\n\n",
                kSample_px, kOverlap_px, kRuns);
    std::printf("| plane | strategy | placements | device events | end to end | same winners |\n");
    std::printf("|---|---|---:|---:|---:|---|\n");
    bool all_same = true;
    const ImageU8x3 sample = soft_noise({kSample_px, kSample_px});
    for (const int side : {512, 768, 1024, 1280}) {
        PlaneSearchSetup setup;
        setup.canvas = {side, side};
        setup.samples = {sample};
        const auto scalar = make_synthesis_search(setup, SynthesisMethod::kDirect);
        const Sweep should = sweep(*scalar, sample, side, false);
        for (const char* name : {"cuda", "cuda-candidate", "cuda-pixel"}) {
            const auto made = backend(name);
            if (!made) return false;
            std::vector<double> device_ms, wall_ms;
            bool same = true;
            // The first run warms the device up and is not counted. Timers are off for the wall
            // clock, because they cost a little themselves.
            for (int run = 0; run <= kRuns; ++run) {
                const auto timed_search = made->open_plane_search(setup);
                const auto search = made->open_plane_search(setup);
                if (!timed_search || !search) return false;
                const Sweep timed = sweep(*timed_search, sample, side, true);
                const Sweep plain = sweep(*search, sample, side, false);
                same = same && timed.winners == should.winners && plain.winners == should.winners;
                if (run == 0) continue;
                device_ms.push_back(timed.device_ms);
                wall_ms.push_back(plain.search_ms);
            }
            all_same = all_same && same;
            std::printf("| %d² | %s | %zu | %s | %s | %s |\n", side, name, should.winners.size(),
                        mean_and_deviation(device_ms).c_str(), mean_and_deviation(wall_ms).c_str(),
                        same ? "yes" : "NO");
            std::fflush(stdout);
        }
    }
    return all_same;
}

struct FrameScene {
    Size size{1920, 1080};
    ImageF3 plate, surface;
    PlanePyramid plane;
    ImageF2 coords;
    Matte matte;
    Shading shading;
};

FrameScene make_frame() {
    FrameScene s;
    Rng rng(6);
    const auto noise = [&](Size size) {
        ImageF3 out(size);
        for (int k = 0; k < 3 * size.width * size.height; ++k)
            out.data()[k] = static_cast<float>(rng.uniform());
        return out;
    };
    s.plate = noise(s.size);
    s.surface = s.plate;
    s.plane = PlanePyramid(noise({2048, 2048}), WrapMode::kRepeat);
    s.coords = ImageF2(s.size);
    s.matte = Matte(s.size, 255);
    for (int y = 0; y < s.size.height; ++y) {
        for (int x = 0; x < s.size.width; ++x) {
            s.coords.pixel(x, y)[0] = 1.1f * static_cast<float>(x) + 0.2f * static_cast<float>(y);
            s.coords.pixel(x, y)[1] = 1.2f * static_cast<float>(y) - 0.1f * static_cast<float>(x);
            if (x < 8) s.matte.at(x, y) = static_cast<std::uint8_t>(30 * x + 1);
        }
    }
    s.shading.value = ImageF1({960, 540}, 0.6f);
    s.shading.full = s.size;
    return s;
}

void composite_on_cpu(const FrameScene& s, ImageF3& out) {
    ImageF3 texture(s.size);
    sample_plane_cpu({&s.plane, s.coords, s.matte, SampleQuality::kFinal}, texture);
    apply_light(texture, {0, 0}, s.matte, s.shading, 0.5f, {});
    composite_over(out, s.plate, s.surface, s.matte, texture);
    (void)roll_off(out, s.matte);
}

bool composite_on_gpu(const Backend& gpu, const FrameScene& s, ImageF3& out) {
    LayerRequest layer;
    layer.texture = {&s.plane, s.coords, s.matte, SampleQuality::kFinal};
    layer.old_surface = s.surface;
    layer.gain = GainRequest{s.shading.value, s.shading.downscale, 0.5f, 1.0f};
    const auto canvas = gpu.open_frame(s.plate);
    return canvas && canvas->add(layer) && canvas->finish(0.9f, out);
}

bool measure_frame() {
    const FrameScene s = make_frame();
    const auto gpu = backend("cuda");
    if (!gpu) return false;
    ImageF3 on_cpu = s.plate, on_gpu = s.plate;
    std::vector<double> cpu_ms, gpu_ms;
    for (int run = 0; run <= kRuns; ++run) {
        auto start = Clock::now();
        composite_on_cpu(s, on_cpu);
        if (run > 0) cpu_ms.push_back(ms_since(start));
        start = Clock::now();
        if (!composite_on_gpu(*gpu, s, on_gpu)) return false;
        if (run > 0) gpu_ms.push_back(ms_since(start));
    }
    float worst = 0;
    for (int k = 0; k < 3 * s.size.width * s.size.height; ++k)
        worst = std::max(worst, std::abs(on_cpu.data()[k] - on_gpu.data()[k]));
    std::printf(
        "\n## A frame of 1920×1080, all of it replaced: texture, light, composite, "
        "roll-off, ms end to end, %d runs\n\n",
        kRuns);
    std::printf("| | ms |\n|---|---:|\n");
    std::printf("| CPU, %d threads | %s |\n", thread_count(), mean_and_deviation(cpu_ms).c_str());
    std::printf("| GPU, bus included | %s |\n\n", mean_and_deviation(gpu_ms).c_str());
    std::printf("Largest difference: %.3g (allowed: %.3g)\n", static_cast<double>(worst),
                1.0 / 255.0);
    return worst <= 1.0f / 255.0f;
}

int run() {
    const auto device = open_cuda_device();
    if (!device) {
        std::printf("There is no GPU to measure. %s\n", device.error().text().c_str());
        return 2;
    }
    std::printf("GPU: %s\n", (*device)->description().c_str());
    const bool search = measure_search(), frame = measure_frame();
    if (!search || !frame) std::printf("\nFAILED: the GPU's results are not the CPU's.\n");
    return search && frame ? 0 : 1;
}

}  // namespace
}  // namespace weft::test

int main() {
    return weft::test::run();
}
