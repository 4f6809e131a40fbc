#include "app/render/render_estimate.h"

#include <algorithm>
#include <cmath>

#include "app/render/memory_plan.h"
#include "app/shot/frame_plan.h"

namespace weft {
namespace {

// Microseconds per pixel of whole frames on two cores, measured on five shots of film at both
// qualities (docs/BENCHMARKS.md, "Painted on one frame", and davis_blackswan). A draft follows
// surfaces by the final's motion and mattes, so it saves only where it renders.
struct Costs {
    double motion, matte, region, render;
};
constexpr Costs kDraft{0.36, 0.33, 0.18, 0.22}, kFinal{0.40, 0.34, 0.23, 0.28};
constexpr double kStart_s = 1.5;
// Memory of a region's planes and their synthesis; final quality needs larger motion pyramids.
constexpr std::int64_t kRegionBytes = 90ll << 20, kFinalBytes = 130ll << 20;
// Painted mattes are propagated beside the surfaces that follow them.
constexpr std::int64_t kPaintedBytes = 60ll << 20, kPaintedBytesPerPixel = 60;
// Speed-up is less than proportional to cores, because tracks are computed in order.
constexpr double kScaling = 0.75, kMeasuredOn = 2;

// Disk space of all layers.
constexpr double kWrittenLayersBytesPerPixel = 8;

std::int64_t painted_bytes(Size size) {
    return kPaintedBytes + kPaintedBytesPerPixel * size.width * size.height;
}

double bytes_per_pixel(std::string_view extension) {
    if (extension == "exr") return 7.5;
    if (extension == "tif" || extension == "tiff") return 3.2;
    if (extension == "jpg" || extension == "jpeg") return 0.6;
    if (extension == "dpx") return 4;
    return 2.2;
}

}  // namespace

std::size_t analysed_frames(const Project& project, int first, int last, FrameRange all) {
    const int rendered = first;
    const auto reach = [&](int frame) {
        first = std::min(first, frame);
        last = std::max(last, frame);
    };
    for (const Leaf<Region>& region : project.regions) {
        if (!region->enabled) continue;
        for (const int frame : region->reference_frames)
            reach(frame);
        for (const auto& [frame, pins] : region->corrections)
            reach(frame);
        for (const auto& [frame, painted] : region->matte->keyframes)
            reach(frame);
        const auto& keys = region->matte->keyframes;
        const int reference = !region->reference_frames.empty() ? region->reference_frames.front()
                              : !keys.empty()                   ? keys.begin()->first
                                                                : rendered;
        reach(std::max(all.begin, reference - kEvidenceReach));
        reach(std::min(all.end - 1, reference + kEvidenceReach));
    }
    return static_cast<std::size_t>(last - first + 1);
}

void count_regions(const Project& project, EstimateInputs& in) {
    in.regions = 0;
    in.motion_given = true;
    in.mattes_painted = false;
    for (const Leaf<Region>& region : project.regions) {
        if (!region->enabled) continue;
        ++in.regions;
        in.mattes_painted = in.mattes_painted || !region->matte->keyframes.empty();
        in.motion_given = in.motion_given && !region->motion.files.empty();
    }
}

RenderEstimate estimate_render(const EstimateInputs& in) {
    const double pixels = static_cast<double>(in.size.width) * in.size.height;
    const Costs& cost = in.quality == Quality::kDraft ? kDraft : kFinal;
    const double analysis = (in.motion_given ? 0 : cost.motion) +
                            (in.mattes_painted ? cost.matte : 0) +
                            cost.region * static_cast<double>(in.regions);
    const double cores = std::pow(std::max(1u, in.threads) / kMeasuredOn, kScaling);
    const auto taking_s = [&](double cost_us, std::size_t frames) {
        return 1e-6 * pixels * cost_us * static_cast<double>(frames) / cores /
               std::max(in.speed, 1e-3);
    };
    const double measured_s = in.analysed > 0 ? in.analysis_s : 0;
    RenderEstimate out;
    out.seconds = kStart_s / std::max(in.speed, 1e-3) + taking_s(cost.render, in.frames) +
                  std::max(taking_s(analysis, in.analysed), measured_s);
    out.memory_bytes =
        render_memory_bytes(in.size, std::min<std::size_t>(in.threads, in.frames), in.layers) +
        kRegionBytes * static_cast<std::int64_t>(in.regions) +
        (in.quality == Quality::kFinal ? kFinalBytes : 0) +
        (in.mattes_painted ? painted_bytes(in.size) : 0);
    out.disk_bytes = static_cast<std::int64_t>(
        static_cast<double>(in.frames) * pixels *
        (bytes_per_pixel(in.extension) + (in.layers ? kWrittenLayersBytesPerPixel : 0)));
    return out;
}

}  // namespace weft
