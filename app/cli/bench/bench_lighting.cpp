#include "app/cli/bench/bench_lighting.h"

#include <time.h>

#include <nlohmann/json.hpp>

#include <optional>

#include "app/cli/console.h"
#include "engine/color/color_space.h"
#include "engine/core/isa.h"
#include "engine/lighting/clip_reflectance.h"
#include "engine/lighting/shading.h"
#include "engine/pipeline/surface_pass.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {
namespace {

constexpr int kFrames = 8;  // all are used as evidence and all are relit

// The plane in linear light under a soft shadow that moves from frame to frame.
ImageF3 plate_of(const ImageU8x3& plane, int frame) {
    ImageF3 out(plane.size());
    const float edge =
        static_cast<float>(plane.width()) * (0.2f + 0.08f * static_cast<float>(frame));
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float light = static_cast<float>(x) < edge ? 0.4f : 1.0f;
            for (int c = 0; c < 3; ++c) {
                const float code = static_cast<float>(plane.pixel(x, y)[c]) / 255.0f;
                out.pixel(x, y)[c] = light * srgb_to_linear(code);
            }
        }
    }
    return out;
}

double light_frames(const std::vector<ImageF3>& plates, FlowQuality quality, ImageF3& texture) {
    const Size size = texture.size();
    const Matte matte(size, 255);
    ShotPlan plan;
    plan.quality = quality;
    ShadingOptions options = shading_options(plan, size);
    options.daylight = find_daylight(plates.front());  // once for a shot
    const double start = cpu_s();
    std::vector<SurfaceSample> samples;
    ReflectanceGatherer gatherer(options);
    std::optional<ImageF2> still;
    if (quality == FlowQuality::kFinal) {
        for (const ImageF3& plate : plates) {
            samples.push_back(light_sample(plate, matte, options));
            if (!still) still.emplace(samples.back().box.size());
            gatherer.add(samples.back(), *still);
        }
    }
    const ClipReflectance reflectance = gatherer.finish();
    for (std::size_t k = 0; k < plates.size(); ++k) {
        const Shading shading = quality == FlowQuality::kFinal
                                    ? shading_with(samples[k], reflectance, *still, options)
                                    : estimate_shading(plates[k], matte, options);
        apply_light(texture, {0, 0}, matte, shading, 0.2f, {});
    }
    return (cpu_s() - start) / static_cast<double>(plates.size());
}

}  // namespace

double cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Expected<std::vector<LightingCost>> bench_lighting(const ImageU8x3& sample,
                                                   const std::vector<int>& sides, int runs) {
    std::vector<LightingCost> out;
    const Isa best = current_isa();
    for (const int side : sides) {
        LightingCost cost{side, 0, 0, 0};
        PlaneOptions paper;
        paper.size = {side, side};
        paper.seam_cost = SeamCost::kPaper;
        paper.refine_passes = 0;
        paper.plain_solvers = true;
        for (int run = 0; run < runs; ++run) {
            force_isa(Isa::kScalar);
            const double start = cpu_s();
            WEFT_TRY(plane, grow_plane(sample, paper));
            cost.synthesis_s += (cpu_s() - start) / runs;
            force_isa(best);
            std::vector<ImageF3> plates;
            for (int frame = 0; frame < kFrames; ++frame)
                plates.push_back(plate_of(plane.pixels, frame));
            ImageF3 texture = plates.front();
            cost.final_s += light_frames(plates, FlowQuality::kFinal, texture) / runs;
            cost.draft_s += light_frames(plates, FlowQuality::kDraft, texture) / runs;
        }
        out.push_back(cost);
    }
    return out;
}

std::string lighting_line(const LightingCost& c) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "light %4dx%-4d  final %6.1f ms (%.1f %%), draft %6.1f ms (%.1f %%) of the paper's "
        "synthesis, %.1f ms\n",
        c.side, c.side, 1e3 * c.final_s, 100 * c.final_s / c.synthesis_s, 1e3 * c.draft_s,
        100 * c.draft_s / c.synthesis_s, 1e3 * c.synthesis_s);
    return text;
}

nlohmann::ordered_json lighting_json(const std::vector<LightingCost>& costs) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const LightingCost& c : costs) {
        all.push_back({{"side", c.side},
                       {"synthesis_s", c.synthesis_s},
                       {"final_s", c.final_s},
                       {"draft_s", c.draft_s}});
    }
    return all;
}

}  // namespace weft
