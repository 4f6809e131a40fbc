#include "engine/synthesis/texture_plane.h"

#include <algorithm>
#include <new>

#include "engine/synthesis/canvas.h"
#include "engine/synthesis/feather.h"
#include "engine/synthesis/plane_energy.h"
#include "engine/synthesis/refine.h"
#include "engine/synthesis/sweep.h"

namespace weft {
namespace {

constexpr int kLeastOverlap = 12;
constexpr int kLargestSide = 16384;
constexpr float kLargestGuideWeight = 1000.0f;

std::string text_of(Size s) {
    return std::to_string(s.width) + "x" + std::to_string(s.height);
}

Status check(ViewU8x3 sample, const PlaneOptions& o) {
    WEFT_CHECK_OK(check_sample(sample.size(), o.overlap_px));
    if (o.size.width < 1 || o.size.height < 1 || o.size.width > kLargestSide ||
        o.size.height > kLargestSide) {
        return fail(ErrorCode::kUsage, "The texture plane's size is " + text_of(o.size) +
                                           ". Use 1 to 16384 px on each side.");
    }
    if (o.guide && (o.guide->target.size() != o.size || o.guide->known.size() != o.size)) {
        return fail(ErrorCode::kUsage, "The guide picture is " + text_of(o.guide->target.size()) +
                                           " px and the texture plane " + text_of(o.size) +
                                           " px. They must have the same size.");
    }
    if (o.guide && !(o.guide->weight >= 0 && o.guide->weight <= kLargestGuideWeight)) {
        return fail(ErrorCode::kUsage, "The guide's weight must lie between 0 and 1000.");
    }
    return {};
}

tl::unexpected<Error> stopped(const CancelToken& cancel) {
    return fail(static_cast<ErrorCode>(cancel.reason()), "Growing the texture plane was stopped.");
}

Expected<TexturePlane> grow(ViewU8x3 sample, const PlaneOptions& options, const CancelToken& cancel,
                            const ProgressFn& progress) {
    TexturePlane plane;
    PlaneStats& stats = plane.stats;
    {
        const StageTimer total(stats.total_s);
        Canvas canvas(options.size, options.tileable);
        Sweep sweep(sample, options, canvas, stats);
        const auto area = static_cast<std::int64_t>(options.size.width) * options.size.height;
        while (sweep.step()) {
            if (cancel.cancelled()) return stopped(cancel);
            if (progress) progress({"synthesise", canvas.filled_count(), area, 0, 0});
        }
        Refiner refiner(sample, options, canvas, stats);
        for (int pass = 0; pass < options.refine_passes; ++pass) {
            if (cancel.cancelled()) return stopped(cancel);
            if (refiner.pass(pass) <= 0) break;
        }
        const PlaneEnergy energy = recount_energy(sample, canvas.source(), options.tileable);
        stats.seam_energy = energy.energy;
        stats.seam_length_px = energy.length_px;
        stats.seam_energy_per_area = energy.energy / static_cast<double>(area);
        plane.pixels = options.feather_px > 0 ? feather_seams(sample, canvas.source(),
                                                              options.feather_px, options.tileable)
                                              : std::move(canvas.pixels());
        plane.source = std::move(canvas.source());
    }
    stats.other_s = stats.total_s - stats.search_s - stats.seam_s;
    return plane;
}

}  // namespace

Status check_sample(Size sample, int overlap_px) {
    if (sample.width < 2 * kLeastOverlap || sample.height < 2 * kLeastOverlap) {
        return fail(ErrorCode::kUsage, "The texture sample is " + text_of(sample) +
                                           " px, too small to grow. Use one of at least 24x24 px.");
    }
    if (overlap_px < kLeastOverlap) {
        return fail(ErrorCode::kUsage,
                    "The overlap is " + std::to_string(overlap_px) + " px. Use at least 12 px.");
    }
    if (std::min(sample.width, sample.height) < overlap_px) {
        return fail(ErrorCode::kUsage,
                    "The texture sample is " + text_of(sample) +
                        " px, smaller than the overlap of " + std::to_string(overlap_px) +
                        " px. Use a larger sample, or an overlap of at most " +
                        std::to_string(std::min(sample.width, sample.height) / 2) + " px.");
    }
    return {};
}

Expected<TexturePlane> grow_plane(ViewU8x3 sample, const PlaneOptions& options,
                                  const CancelToken& cancel, const ProgressFn& progress) {
    WEFT_CHECK_OK(check(sample, options));
    try {
        return grow(sample, options, cancel, progress);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, "There is not enough memory for a texture plane of " +
                                             text_of(options.size) + " px. Use a smaller size.");
    }
}

std::optional<std::string> sample_warning(ViewU8x3 sample) {
    if (sample.empty()) return std::nullopt;
    const std::uint8_t* first = sample.pixel(0, 0);
    for (int y = 0; y < sample.height(); ++y) {
        for (int x = 0; x < sample.width(); ++x) {
            const std::uint8_t* p = sample.pixel(x, y);
            if (!std::equal(p, p + 3, first)) return std::nullopt;
        }
    }
    return "The texture sample is one flat colour, so the result shows no texture. Use a "
           "photograph "
           "of the material.";
}

}  // namespace weft
