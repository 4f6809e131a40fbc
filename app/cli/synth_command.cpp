#include <nlohmann/json.hpp>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/engine_choice.h"
#include "engine/color/color_space.h"
#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/media/atomic_file.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/plate_views.h"
#include "engine/synthesis/endless_plane.h"
#include "engine/synthesis/light_guide.h"
#include "engine/synthesis/plane_energy.h"
#include "engine/synthesis/plane_phase.h"
#include "engine/synthesis/repetition.h"
#include "engine/synthesis/sample_kind.h"

namespace weft {
namespace {

Status write_plane(const std::string& path, const TexturePlane& plane, const WriteRule& rule) {
    ImageF3 pixels(plane.pixels.size());
    std::transform(plane.pixels.data(), plane.pixels.data() + plane.pixels.size_bytes(),
                   pixels.data(), [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
    WriteOptions write;
    write.depth = default_depth(path, PixelDepth::kU8);
    write.rule = rule;
    if (write.depth == PixelDepth::kHalf || write.depth == PixelDepth::kFloat) {
        WEFT_TRY(to_linear, make_color_transform({"srgb"}, {"linear"}));
        to_linear->apply(pixels);
    }
    return write_image(path, pixels, {}, write);
}

// Writes the source map: R and G are the sample's x and y for each texel; B is the sample's index
// plus 256 times its orientation.
Status write_source_map(const std::string& path, const TexturePlane& plane, const WriteRule& rule) {
    ImageF3 map(plane.source.size());
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            for (int c = 0; c < 2; ++c)
                map.pixel(x, y)[c] = static_cast<float>(plane.source.pixel(x, y)[c]);
            if (plane.origin.empty()) continue;
            const std::uint8_t* origin = plane.origin.pixel(x, y);
            map.pixel(x, y)[2] = static_cast<float>(origin[0] + 256 * origin[1]);
        }
    }
    WriteOptions write;
    write.depth = PixelDepth::kFloat;
    write.rule = rule;
    WEFT_CHECK_OK(check_format(path, write));
    return write_image(path, map, {}, write);
}

Expected<ImageU8x3> read_sample(const std::string& path, const std::string& space_name) {
    WEFT_TRY(picture, read_image(path));
    WEFT_TRY(space, parse_color_space(space_name.empty() ? picture.color.space : space_name));
    WEFT_TRY(display_from_texture, make_color_transform(space, {"srgb"}));
    return make_views(picture.rgb, *display_from_texture).display;
}

// V of the image, stretched over the plane (nearest neighbour, since illumination is smooth).
Image<std::uint8_t, 1> illumination(const ImageU8x3& picture, Size plane) {
    Image<std::uint8_t, 1> out(plane);
    for (int y = 0; y < plane.height; ++y) {
        const int from_y = static_cast<int>(std::int64_t{y} * picture.height() / plane.height);
        for (int x = 0; x < plane.width; ++x) {
            const int from_x = static_cast<int>(std::int64_t{x} * picture.width() / plane.width);
            const std::uint8_t* p = picture.pixel(from_x, from_y);
            out.at(x, y) = std::max({p[0], p[1], p[2]});
        }
    }
    return out;
}

// Reads texels of an unbounded plane, starting at `at`.
Expected<TexturePlane> read_endless(const std::vector<ImageU8x3>& samples, const PlaneOptions& grow,
                                    Vec2i at) {
    if (samples.size() > 1 || grow.tileable || grow.guide || grow.orientations.rotations ||
        grow.orientations.mirror || shows_sample(grow.mode)) {
        return fail(ErrorCode::kUsage,
                    "An unbounded plane (--endless) needs one upright sample that is synthesized, "
                    "without --tileable and --light.");
    }
    constexpr int kFurthest = 1 << 30, kLargestSide = 16384;
    if (std::max(grow.size.width, grow.size.height) > kLargestSide || at.x < -kFurthest ||
        at.y < -kFurthest || at.x > kFurthest - grow.size.width ||
        at.y > kFurthest - grow.size.height) {
        return fail(ErrorCode::kUsage,
                    "Parts of an unbounded plane may have up to 16384 px per side, between "
                    "-2^30 and 2^30.");
    }
    const auto start = Clock::now();
    WEFT_TRY(endless, EndlessPlane::make(samples.front(), grow, cancel_on_signals()));
    WEFT_TRY(part, endless->read({at.x, at.y, at.x + grow.size.width, at.y + grow.size.height},
                                 cancel_on_signals()));
    TexturePlane plane;
    plane.pixels = std::move(part.pixels);
    plane.source = std::move(part.source);
    PlaneStats& stats = plane.stats;
    stats.total_s = stats.other_s = seconds_since(start);
    const PlaneEnergy energy =
        recount_energy(SampleAtlas(samples.front().view()), plane.source, false);
    stats.seam_energy = energy.energy;
    stats.seam_length_px = energy.length_px;
    stats.seam_energy_per_area = energy.energy / static_cast<double>(grow.size.width) /
                                 static_cast<double>(grow.size.height);
    return plane;
}

struct Synthesized {
    TexturePlane plane;
    SampleDescription sample;  ///< Of the first sample.
};

// What the mode does with the kind that the sample has.
std::string mode_remark(const SampleDescription& sample, const PlaneOptions& options,
                        const PlaneStats& stats) {
    std::string out = std::string(kind_name(sample.kind)) + ": " + reason_of(sample);
    if (options.mode != PlaneMode::kAuto) return out;
    if (sample.kind == SampleKind::kPicture) return out + "; consider --mode stretch or mirror";
    if (sample.kind == SampleKind::kPeriodic)
        return out + (stats.lattice.empty() ? "; not laid on one lattice" : "; on one lattice");
    return out;
}

Expected<Synthesized> run(const SynthOptions& options, const Backend& backend) {
    std::vector<std::string> reads = options.samples;
    if (!options.light.empty()) reads.push_back(options.light);
    WEFT_TRY(rule, write_rule(options.write, reads));
    std::vector<PlannedFile> files{{"The plane", options.output}};
    if (!options.source_map.empty()) files.push_back({"The source map", options.source_map});
    WEFT_CHECK_OK(check_apart(files));
    WriteOptions write;
    write.depth = default_depth(options.output, PixelDepth::kU8);
    WEFT_CHECK_OK(check_format(options.output, write));
    for (const PlannedFile& file : files)
        WEFT_CHECK_OK(check_output(file.path, rule));
    std::vector<ImageU8x3> samples;
    std::string names;
    for (const std::string& path : options.samples) {
        WEFT_TRY(sample, read_sample(path, options.texture_space));
        if (const auto warning = sample_warning(sample)) print_warning(path + ": " + *warning);
        samples.push_back(std::move(sample));
        names += (names.empty() ? "" : ", ") + path;
    }
    PlaneOptions grow = options.plane;
    grow.backend = &backend;
    ImageU8x3 guide;
    Image<std::uint8_t, 1> known;
    if (!options.light.empty()) {
        WEFT_TRY(picture, read_sample(options.light, {}));
        guide = light_guide(samples.front(), illumination(picture, grow.size));
        known = Image<std::uint8_t, 1>(grow.size, 255);
        grow.guide = PlaneGuide{guide, known, static_cast<float>(options.light_weight)};
    }
    auto plane = options.endless ? read_endless(samples, grow, options.at)
                                 : grow_plane(std::vector<ViewU8x3>(samples.begin(), samples.end()),
                                              grow, cancel_on_signals());
    if (!plane) return fail_in(std::move(plane).error(), names);
    for (const std::string& remark : backend.remarks())
        print_warning(remark);
    for (const PlannedFile& file : files)
        WEFT_CHECK_OK(make_folder_of(file.path, rule));
    WEFT_CHECK_OK(write_plane(options.output, *plane, rule));
    if (!options.source_map.empty())
        WEFT_CHECK_OK(write_source_map(options.source_map, *plane, rule));
    return Synthesized{*std::move(plane), describe_sample(samples.front())};
}

nlohmann::ordered_json json_of(const PlanePhase& phase) {
    return {{"median_px", phase.median_px},
            {"p95_px", phase.p95_px},
            {"worst_px", phase.worst_px},
            {"share", phase.share}};
}

nlohmann::ordered_json json_of(const SampleDescription& sample) {
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (int i = 0; i < sample.lattice.count; ++i) {
        const glm::dvec2 step = sample.lattice.steps[static_cast<std::size_t>(i)];
        steps.push_back({step.x, step.y});
    }
    return {{"kind", kind_name(sample.kind)},
            {"reason", reason_of(sample)},
            {"steps", steps},
            {"confidence", sample.lattice.confidence},
            {"residual_px", sample.lattice.residual_px},
            {"border", sample.border},
            {"radial", sample.radial},
            {"uneven", sample.uneven}};
}

// How far the plane strays from the lattice of its sample.
nlohmann::ordered_json phase_json(const TexturePlane& plane, const SampleLattice& sample,
                                  bool tileable) {
    if (sample.count == 0 || !plane.origin.empty()) return nullptr;
    const PlaneLattice lattice =
        tileable ? PlaneLattice(sample, plane.pixels.size()) : PlaneLattice(sample);
    return {{"source", json_of(source_phase(plane.source, sample, lattice))},
            {"seen", json_of(seen_phase(plane.pixels, lattice))},
            {"strain", lattice.strain()}};
}

nlohmann::ordered_json json_of(const Synthesized& made, const Repetition& repetition,
                               const Backend& backend, const SynthOptions& options) {
    const TexturePlane& plane = made.plane;
    const PlaneStats& s = plane.stats;
    nlohmann::ordered_json period = nlohmann::ordered_json::array();
    for (int i = 0; i < s.period.count; ++i) {
        const Vec2i step = s.period.steps[static_cast<std::size_t>(i)];
        period.push_back({step.x, step.y});
    }
    return {{"output", absolute_path(options.output)},
            {"size", {plane.pixels.width(), plane.pixels.height()}},
            {"seconds",
             {{"search", s.search_s},
              {"seam", s.seam_s},
              {"refine", s.refine_s},
              {"other", s.other_s},
              {"total", s.total_s}}},
            {"seam_energy", s.seam_energy},
            {"seam_length_px", s.seam_length_px},
            {"seam_energy_per_area", s.seam_energy_per_area},
            {"peak_graph_bytes", s.peak_graph_bytes},
            {"placements", s.placements},
            {"refinements", s.refinements},
            {"repetition", repetition.peak},
            {"repetition_at", {repetition.peak_at.x, repetition.peak_at.y}},
            {"verbatim", repetition.verbatim},
            {"verbatim_at", {repetition.verbatim_at.x, repetition.verbatim_at.y}},
            {"period", period},
            {"period_correlation", repetition.own_period},
            {"sample", json_of(made.sample)},
            {"on_lattice", !s.lattice.empty()},
            {"phase", phase_json(plane, made.sample.lattice, options.plane.tileable)},
            {"backend", backend.name()},
            {"isa", isa_name(current_isa())},
            {"threads", thread_count()},
            {"seed", options.plane.seed}};
}

}  // namespace

CommandResult synth_command(const SynthOptions& options) {
    WEFT_TRY(chosen, choose_engine(options.threads, options.isa, options.backend));
    const Backend& backend = *chosen.backend;
    WEFT_TRY(made, run(options, backend));
    const TexturePlane& plane = made.plane;
    Answer answer;
    // Only for JSON: measuring repetition takes longer than synthesizing a small plane.
    if (json_output()) answer.json = json_of(made, measure_repetition(plane), backend, options);
    const PlaneStats& s = plane.stats;
    char line[256];
    std::snprintf(line, sizeof line,
                  "%s %dx%d: %d placements, seam energy per area %.3f, %.3fs (search %.3f, seam "
                  "%.3f, refine %.3f, other %.3f)\n",
                  options.output.c_str(), plane.pixels.width(), plane.pixels.height(), s.placements,
                  s.seam_energy_per_area, s.total_s, s.search_s, s.seam_s, s.refine_s, s.other_s);
    answer.text = line + ("The sample is " + mode_remark(made.sample, options.plane, s)) + "\n";
    return answer;
}

}  // namespace weft
