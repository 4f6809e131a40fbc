#include "engine/synthesis/texture_plane.h"

#include <algorithm>
#include <new>

#include "engine/core/stopwatch.h"
#include "engine/core/text.h"
#include "engine/synthesis/amend_canvas.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/feather.h"
#include "engine/synthesis/grow_canvas.h"
#include "engine/synthesis/plane_energy.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/sample_cover.h"
#include "engine/synthesis/sweep_axis.h"

namespace weft {
namespace {

constexpr std::size_t kMostSamples = 64;
constexpr float kLargestGuideWeight = 1000.0f;

Status check(const std::vector<ViewU8x3>& samples, const PlaneOptions& o) {
    if (samples.empty() || samples.size() > kMostSamples) {
        return fail(ErrorCode::kUsage, "A texture plane needs 1 to 64 samples, not " +
                                           std::to_string(samples.size()) + ".");
    }
    for (const ViewU8x3& sample : samples)
        WEFT_CHECK_OK(check_sample(sample.size(), o.overlap_px));
    if (o.size.width < 1 || o.size.height < 1 || o.size.width > kLargestPlaneSide ||
        o.size.height > kLargestPlaneSide) {
        return fail(ErrorCode::kUsage, "The texture plane's size is " + size_text(o.size) + ".",
                    "Use 1 to 16384 px on each side.");
    }
    if (o.guide && (o.guide->target.size() != o.size || o.guide->known.size() != o.size)) {
        return fail(ErrorCode::kUsage,
                    "The guide picture is " + size_text(o.guide->target.size()) +
                        " px and the texture plane " + size_text(o.size) + " px.",
                    "They must have the same size.");
    }
    if (o.guide && !(o.guide->weight >= 0 && o.guide->weight <= kLargestGuideWeight)) {
        return fail(ErrorCode::kUsage, "The guide's weight must lie between 0 and 1000.");
    }
    return {};
}

// From positions in the atlas to the samples as they were given.
void name_sources(const SampleAtlas& atlas, TexturePlane& plane) {
    if (atlas.pages().size() == 1) return;
    plane.origin = Image<std::uint8_t, 2>(plane.source.size());
    for (int y = 0; y < plane.source.height(); ++y) {
        for (int x = 0; x < plane.source.width(); ++x) {
            std::int32_t* s = plane.source.pixel(x, y);
            const SampleAtlas::Place place = atlas.place_of({s[0], s[1]});
            s[0] = place.at.x, s[1] = place.at.y;
            plane.origin.pixel(x, y)[0] = static_cast<std::uint8_t>(place.sample);
            plane.origin.pixel(x, y)[1] = static_cast<std::uint8_t>(place.orientation);
        }
    }
}

// Above it a patch would drift by more than a pixel from its middle to its border.
constexpr double kLargestStrain = 0.02;

// What the sample's repetition asks of the plane, whose size may grow by it.
PlaneStructure structure_of(const SampleAtlas& atlas, PlaneOptions& options) {
    PlaneStructure structure;
    if (!options.align || atlas.pages().size() > 1) return structure;
    const SelfMismatch self = self_mismatch(atlas.pixels());
    structure.period = find_period(self);
    if (options.mode != PlaneMode::kAuto || options.guide) return structure;
    const SampleLattice lattice = find_lattice(atlas.pixels(), self);
    if (lattice.count == 0) return structure;
    const bool torus = options.tileable;
    const Size size =
        torus && options.whole_periods ? whole_periods(lattice, options.size) : options.size;
    const PlaneLattice on_plane(lattice, torus ? std::optional<Size>(size) : std::nullopt);
    // Checked before the size grows for it.
    if (on_plane.strain() > kLargestStrain ||
        !make_lattice_axes(on_plane, atlas.pixels().size(), size, torus, options.overlap_px)) {
        return structure;
    }
    structure.lattice = on_plane;
    options.size = size;
    return structure;
}

Expected<TexturePlane> grow(const std::vector<ViewU8x3>& samples, PlaneOptions options,
                            const CancelToken& cancel, const ProgressFn& progress) {
    TexturePlane plane;
    PlaneStats& stats = plane.stats;
    {
        const ScopeTimer total(stats.total_s);
        const SampleAtlas atlas(samples, options.orientations);
        const PlaneStructure structure = structure_of(atlas, options);
        Canvas canvas(options.size, options.tileable);
        if (!grow_canvas(atlas, options, structure, canvas, stats, cancel, progress) ||
            !amend_canvas(atlas, options, structure, canvas, stats, cancel))
            return growth_stopped(cancel);
        const PlaneEnergy energy = recount_energy(atlas, canvas.source(), options.tileable);
        stats.seam_energy = energy.energy;
        stats.seam_length_px = energy.length_px;
        stats.seam_energy_per_area = energy.energy / static_cast<double>(options.size.width) /
                                     static_cast<double>(options.size.height);
        plane.pixels = options.feather_px > 0 ? feather_seams(atlas, canvas.source(),
                                                              options.feather_px, options.tileable)
                                              : std::move(canvas.pixels());
        plane.source = std::move(canvas.source());
        name_sources(atlas, plane);
    }
    stats.other_s = stats.total_s - stats.search_s - stats.seam_s - stats.refine_s;
    return plane;
}

}  // namespace

Image<std::int32_t, 2> atlas_positions(const SampleAtlas& atlas, const TexturePlane& plane) {
    Image<std::int32_t, 2> out = plane.source;
    if (plane.origin.empty()) return out;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            std::int32_t* s = out.pixel(x, y);
            const std::uint8_t* origin = plane.origin.pixel(x, y);
            const Vec2i at = atlas.position_of({origin[0], origin[1], {s[0], s[1]}});
            s[0] = at.x, s[1] = at.y;
        }
    }
    return out;
}

Status check_sample(Size sample, int overlap_px) {
    if (sample.width < 2 * kLeastOverlap || sample.height < 2 * kLeastOverlap) {
        return fail(ErrorCode::kUsage,
                    "The texture sample is " + size_text(sample) + " px, too small for synthesis.",
                    "Use one of at least 24x24 px.");
    }
    if (overlap_px < kLeastOverlap) {
        return fail(ErrorCode::kUsage, "The overlap is " + std::to_string(overlap_px) + " px.",
                    "Use at least 12 px.");
    }
    if (std::min(sample.width, sample.height) < overlap_px) {
        return fail(ErrorCode::kUsage,
                    "The texture sample is " + size_text(sample) +
                        " px, smaller than the overlap of " + std::to_string(overlap_px) + " px.",
                    "Use a larger sample, or an overlap of at most " +
                        std::to_string(std::min(sample.width, sample.height) / 2) + " px.");
    }
    return {};
}

Expected<TexturePlane> grow_plane(const std::vector<ViewU8x3>& samples, const PlaneOptions& options,
                                  const CancelToken& cancel, const ProgressFn& progress) {
    WEFT_CHECK_OK(check(samples, options));
    try {
        if (shows_sample(options.mode)) return lay_sample(samples.front(), options);
        return grow(samples, options, cancel, progress);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace,
                    "Not enough memory for a texture plane of " + size_text(options.size) + " px.",
                    "Use a smaller size.");
    }
}

Expected<TexturePlane> grow_plane(ViewU8x3 sample, const PlaneOptions& options,
                                  const CancelToken& cancel, const ProgressFn& progress) {
    return grow_plane(std::vector<ViewU8x3>{sample}, options, cancel, progress);
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
