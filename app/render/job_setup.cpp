#include "app/render/job_setup.h"

#include <algorithm>

#include "app/render/existing_frames.h"
#include "app/render/input_hashes.h"
#include "app/render/job_frames.h"
#include "app/render/memory_plan.h"
#include "app/render/plane_file.h"
#include "app/render/recipe.h"
#include "app/render/st_map_files.h"
#include "app/shot/frame_plan.h"
#include "app/shot/motion_check.h"
#include "engine/core/setting.h"
#include "engine/media/movies.h"
#include "engine/pipeline/form_drawn.h"

namespace weft {
namespace {

Status choose_job_backend(const JobSpec& spec, JobSetup& setup) {
    WEFT_TRY(choice, choose_backend(spec.backend));
    setup.backend = choice.backend;
    setup.result.backend = choice.backend->name();
    setup.result.backend_description = choice.backend->description();
    setup.result.passed_over = choice.passed_over;
    return {};
}

Status parse_output(const JobSpec& spec, JobSetup& setup) {
    const std::string& path = spec.project.output.path;
    if (path.empty()) {
        return fail(ErrorCode::kUsage, "No output is set.",
                    "Give a pattern with -o, such as 'out/####.png'.");
    }
    WEFT_TRY(pattern, SequencePattern::parse(path));
    setup.pattern = std::move(pattern);
    return {};
}

Expected<std::shared_ptr<const Shot>> open_job_shot(const JobSpec& spec,
                                                    const std::vector<int>& leave_out) {
    OpenShotOptions open;
    open.texture_library = spec.texture_library;
    open.watch_inputs = true;
    open.leave_out = leave_out;
    open.files = open_fingerprints(spec.cache);
    if (spec.memory_bytes > 0) {
        open.cache_bytes =
            std::min(open.cache_bytes, static_cast<std::size_t>(spec.memory_bytes) / kCacheShare);
    }
    WEFT_TRY(shot, open_shot(with_composite_layers(spec.project, spec.composites), open));
    WEFT_CHECK_OK(check_texture_licences(*shot));
    return shot;
}

Status take_shot(const JobSpec& spec, const std::vector<int>& leave_out, JobSetup& setup) {
    const Shot& shot = *setup.shot;
    WEFT_TRY(at_once, frames_at_once(shot.plate->size(), spec.memory_bytes, shot.plan.layers));
    setup.frames_at_once = at_once;
    setup.plan = shot.plan;
    JobResult& result = setup.result;
    result.shot = setup.shot;
    result.warnings = shot.warnings;
    if (!leave_out.empty()) {
        std::string which = frames_text(leave_out);
        which[0] = 'F';
        result.warnings.push_back(which +
                                  " cannot be read; light, grain and motion blur are measured "
                                  "without. Render again when the files are complete.");
    }
    result.spaces = shot.spaces;
    result.textures = shot.textures;
    result.size = shot.plate->size();
    return {};
}

Status check_settings(const JobSpec& spec, const JobSetup& setup) {
    if (setup.plan.regions.empty()) {
        return fail(ErrorCode::kUsage, "The project has no region.",
                    "Add one with a matte and a texture.");
    }
    if (setup.pattern.is_single() && setup.plan.frames.size() > 1) {
        return fail(ErrorCode::kUsage,
                    "The output " + setup.pattern.text() + " has no frame number for " +
                        std::to_string(setup.plan.frames.size()) + " frames.",
                    "Write it like 'out/####.png'.");
    }
    if (spec.settings.empty() || spec.settings == settings_hash(*setup.shot)) return {};
    return fail(ErrorCode::kUnreadable,
                "A texture, a colour space or a reference frame is not what it was when the job "
                "was submitted: frames of one job would differ.",
                "Submit again.");
}

// What the frames are made from, and whether that is what the job was submitted with.
Status know_inputs(const JobSpec& spec, const std::vector<int>& leave_out, JobSetup& setup) {
    std::vector<int> frames = setup.plan.frames;
    frames.insert(frames.end(), spec.inputs_of.begin(), spec.inputs_of.end());
    const InputHashes inputs(setup.shot, frames);
    for (const int frame : setup.plan.frames)
        setup.inputs[frame] = inputs.text(frame);
    // What is left out on a second attempt was compared on the first.
    if (spec.inputs.empty() || !leave_out.empty()) return {};
    const std::string now = inputs.text(spec.inputs_of);
    if (now == spec.inputs) return {};
    std::string changed;
    for (const std::string& what : changed_inputs(spec.inputs, now))
        changed += (changed.empty() ? "" : ", ") + what;
    return fail(ErrorCode::kUnreadable,
                "An input changed since the job was submitted (" + changed +
                    "): frames of one job would differ.",
                "Submit again.");
}

// DWA changes channels called R, G, B and Y as an eye would not see it, also those of layers:
// places move, and regions get other numbers.
Status check_layer_compression(const Output& output) {
    if (!output.exr_compression.starts_with("dwa")) return {};
    for (const LayerKind kind : {LayerKind::kSt, LayerKind::kId}) {
        if (std::ranges::find(output.layers, kind) == output.layers.end()) continue;
        return fail(ErrorCode::kUsage,
                    "The EXR compression " + output.exr_compression + " would change the layer '" +
                        std::string(info_of(kind).name) + "', which has to be exact.",
                    "Use zip, zips or piz" + by({{setting::kExrCompression}}) +
                        ", or leave the layer out.");
    }
    return {};
}

// Layers go into the output if it is EXR, otherwise into separate files.
Status choose_layer_files(JobSetup& setup) {
    const Output& output = setup.shot->project.output;
    if (output.layers.empty()) return {};
    WEFT_CHECK_OK(check_layer_compression(output));
    if (output.layers_path.empty()) {
        if (is_exr(output.path)) return {};
        return fail(ErrorCode::kUsage, "Layers need an EXR.",
                    "Write the output as .exr, or the layers to separate files" +
                        by({{setting::kLayersOutput, "layers/####.exr"}}) + ".");
    }
    WEFT_TRY(pattern, SequencePattern::parse(output.layers_path));
    WEFT_CHECK_OK(check_format(output.layers_path, {.depth = PixelDepth::kHalf}));
    const int first = setup.plan.frames.front();
    // Same names as the frames: one file holds both.
    if (real_path(pattern.path_for(first)) == real_path(setup.pattern.path_for(first)) &&
        pattern.is_single() == setup.pattern.is_single())
        return {};
    setup.layer_pattern = std::move(pattern);
    return {};
}

// The texture plane, the node trees and the ST-maps.
Status choose_exports(const JobSpec& spec, JobSetup& setup) {
    const CompositeSources sources{*setup.shot, setup.plan, setup.plan.frames,
                                   setup.layer_pattern.value_or(setup.pattern),
                                   setup.layer_pattern.has_value()};
    WEFT_CHECK_OK(check_composites(spec.composites, sources));
    if (!spec.plane.empty()) WEFT_CHECK_OK(check_plane_file(spec.plane, setup.plan));
    if (spec.st_maps.empty()) return {};
    WEFT_CHECK_OK(check_st_maps(spec.st_maps, setup.plan));
    WEFT_TRY(pattern, SequencePattern::parse(spec.st_maps));
    if (pattern.is_single() && setup.plan.frames.size() > 1) {
        return fail(ErrorCode::kUsage,
                    "The ST-maps " + pattern.text() + " have no frame number for " +
                        std::to_string(setup.plan.frames.size()) + " frames.",
                    "Write it like 'st/####.exr'.");
    }
    setup.st_map_pattern = std::move(pattern);
    return {};
}

Status choose_format(const JobSpec& spec, JobSetup& setup) {
    const Shot& shot = *setup.shot;
    const Output& output = shot.project.output;
    WriteOptions& write = setup.write;
    write.depth = output_depth(output, shot.plate->depth());
    write.jpeg_quality = output.jpeg_quality;
    write.dpx_log = shot.spaces.out.name == "cineon";
    write.exr_compression = output.exr_compression;
    write.metadata = recipe_metadata(shot, setup.result.backend);
    write.pixel_aspect = shot.plate->pixel_aspect();
    WEFT_TRY(fence, make_fence(shot.project, spec.limits));
    write.rule.fence = fence;
    write.rule.existing = existing_by(spec.existing != ExistingFrames::kRefuse);
    WEFT_CHECK_OK(choose_layer_files(setup));
    WEFT_CHECK_OK(choose_exports(spec, setup));
    return check_format(output.path, write);
}

// How existing frames are treated.
ExistingFrames existing_frames(const JobSpec& spec) {
    if (spec.stage == JobStage::kAll || spec.stage == JobStage::kFrames) return spec.existing;
    if (spec.stage != JobStage::kEncode) return ExistingFrames::kOverwrite;
    // The movie is encoded from existing frames.
    return spec.existing == ExistingFrames::kSkip ? ExistingFrames::kSkip : ExistingFrames::kResume;
}

// Creates the folders and decides about existing files.
Status check_existing(const JobSpec& spec, JobSetup& setup, OutputFolders folders) {
    const Size size = setup.shot->plate->size();
    OutputPlan outputs{setup.pattern, {}, setup.plan.frames, size, {}, {}, {}};
    outputs.st_maps = setup.st_map_pattern;
    outputs.plane = spec.plane;
    outputs.composites = composite_outputs(spec.composites, setup.plan);
    if (spec.stage == JobStage::kAll || spec.stage == JobStage::kFrames)
        outputs.layers = setup.layer_pattern;
    outputs.report = spec.report;
    outputs.recipe = spec.recipe;
    if (spec.stage != JobStage::kFrames) outputs.movie = setup.shot->project.output.movie;
    if (!outputs.movie.empty()) {
        WEFT_CHECK_OK(require_movies(outputs.movie));
        WEFT_CHECK_OK(check_movie(outputs.movie, movie_fps(*setup.shot)));
    }
    WEFT_TRY(rules, check_outputs(outputs, spec.existing, setup.write.rule, folders));
    setup.result.report_rule = rules.report;
    setup.result.recipe_rule = rules.recipe;
    setup.movie_rule = rules.movie;
    setup.plane_rule = rules.plane;
    setup.composite_rules = rules.composites;
    WEFT_TRY(kept, frames_to_keep(setup.pattern, setup.plan.frames, size, existing_frames(spec),
                                  {setup.write.metadata, setup.inputs}));
    // The encoder renders nothing: it refuses what does not fit.
    if (spec.stage != JobStage::kEncode)
        setup.result.warnings.insert(setup.result.warnings.end(), kept.notes.begin(),
                                     kept.notes.end());
    std::vector<int> to_render;
    for (const int frame : setup.plan.frames) {
        const bool skip = std::binary_search(kept.frames.begin(), kept.frames.end(), frame);
        setup.result.frames.push_back({frame, setup.pattern.path_for(frame), 0, skip, 0, 0});
        if (!skip) to_render.push_back(frame);
    }
    // Analyse only frames that are still to be rendered.
    setup.plan.frames = std::move(to_render);
    setup.plan.spare_memory = spec.memory_bytes > 0;
    return {};
}

}  // namespace

CompositeSources JobSetup::composite_sources() const {
    std::vector<int> frames;
    for (const FrameResult& frame : result.frames)
        frames.push_back(frame.frame);
    return {*shot, plan, std::move(frames), layer_pattern.value_or(pattern),
            layer_pattern.has_value()};
}

WriteOptions JobSetup::write_of(int frame) const {
    WriteOptions out = write;
    if (const auto of_frame = inputs.find(frame); of_frame != inputs.end())
        out.metadata.emplace_back("weft:inputs", of_frame->second);
    return out;
}

Expected<JobSetup> set_up_job(const JobSpec& spec, const std::vector<int>& leave_out,
                              std::shared_ptr<const Shot>& shot, OutputFolders folders) {
    use_threads(spec.threads);
    JobSetup setup;
    WEFT_CHECK_OK(choose_job_backend(spec, setup));
    WEFT_CHECK_OK(parse_output(spec, setup));
    WEFT_TRY(opened, open_job_shot(spec, leave_out));
    setup.shot = shot = std::move(opened);
    WEFT_CHECK_OK(take_shot(spec, leave_out, setup));
    WEFT_CHECK_OK(check_settings(spec, setup));
    WEFT_CHECK_OK(know_inputs(spec, leave_out, setup));
    WEFT_CHECK_OK(choose_format(spec, setup));
    if (spec.stage != JobStage::kEncode)
        WEFT_CHECK_OK(check_drawn_forms(*setup.shot->source, setup.plan));
    WEFT_CHECK_OK(check_existing(spec, setup, folders));
    if (spec.stage != JobStage::kEncode && !setup.plan.frames.empty()) {
        WEFT_TRY(warnings, check_motion(*setup.shot));
        setup.result.warnings.insert(setup.result.warnings.end(), warnings.begin(), warnings.end());
    }
    return setup;
}

}  // namespace weft
