// weft synth and bench.

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"

namespace weft {
namespace {

void add_isa(CLI::App& command, std::string& isa) {
    command
        .add_option(
            "--isa", isa,
            "Instruction set: scalar, avx2 or avx512; the result is the same [best available]")
        ->check(one_of({"scalar", "avx2", "avx512"}))
        ->type_name("");
}

// CPU by default: starting a GPU takes longer than synthesizing a plane of ordinary size.
void add_backend(CLI::App& command, std::string& backend) {
    command
        .add_option(
            "--backend", backend,
            "Backend of the placement search: cpu, cuda or auto; the result is the same [cpu]")
        ->type_name("");
}

void add_mode(CLI::App& command, PlaneOptions& plane) {
    plane.mode = PlaneMode::kAuto;
    plane.whole_periods = true;
    command
        .add_option("--mode", plane.mode,
                    "How the sample covers the plane: auto, synthesize, tile, stretch or mirror; "
                    "auto lays a periodic sample on one lattice [auto]")
        ->transform(choice<PlaneMode>({{"auto", PlaneMode::kAuto},
                                       {"synthesize", PlaneMode::kSynthesize},
                                       {"tile", PlaneMode::kTile},
                                       {"stretch", PlaneMode::kStretch},
                                       {"mirror", PlaneMode::kMirror}}))
        ->type_name("");
}

void add_synth(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("synth", "Synthesize a texture plane from a sample");
    const auto options = std::make_shared<SynthOptions>();
    const auto size = std::make_shared<std::string>("512x512");
    const auto at = std::make_shared<std::string>("0,0");
    command
        ->add_option("sample", options->samples,
                     "Image of the texture; several of one material are used together")
        ->required()
        ->type_name("PATH");
    command->add_option("-o,--output", options->output, "File to write")
        ->required()
        ->type_name("PATH");
    command->add_option("--size", *size, "Width x height in texels [512x512]")->type_name("WxH");
    command->add_option("--seam", options->plane.seam, "graphcut, dp or none [graphcut]")
        ->transform(choice<SeamMethod>({{"graphcut", SeamMethod::kGraphCut},
                                        {"dp", SeamMethod::kDynamicProgramming},
                                        {"none", SeamMethod::kNone}}))
        ->type_name("");
    command
        ->add_option("--seam-cost", options->plane.seam_cost,
                     "gradient: mismatch over gradient; paper: its eq. 2 and 3 [gradient]")
        ->transform(
            choice<SeamCost>({{"gradient", SeamCost::kGradient}, {"paper", SeamCost::kPaper}}))
        ->type_name("");
    command
        ->add_option("--overlap", options->plane.overlap_px, "Largest overlap of patches, px [36]")
        ->transform(whole_number())
        ->type_name("px");
    command->add_option("--feather", options->plane.feather_px, "Blend across the seams, px [0]")
        ->transform(whole_number(0, 256))
        ->type_name("px");
    command
        ->add_option(
            "--refine", options->plane.refine_passes,
            "Rounds of refinement: cuts all seams again, then puts patches over the worst [2]")
        ->transform(whole_number(0, 100))
        ->type_name("");
    add_mode(*command, options->plane);
    command->add_flag("--rotations", options->plane.orientations.rotations,
                      "Also use the sample rotated by quarter turns");
    command->add_flag("--mirror", options->plane.orientations.mirror,
                      "Also use the sample mirrored");
    command->add_flag_callback(
        "--no-align", [=] { options->plane.align = false; },
        "Do not align rows of bricks, tiles and weaves");
    command
        ->add_option("--light", options->light,
                     "Image of the target illumination for placements and seams")
        ->type_name("PATH");
    command->add_option("--light-weight", options->light_weight, "Weight of the illumination [0.1]")
        ->check(number(0.0, 1000.0))
        ->type_name("");
    command->add_flag("--endless", options->endless,
                      "A part of an unbounded plane; parts fit together");
    command->add_option("--at", *at, "Upper left texel of the part [0,0]")->type_name("X,Y");
    command->add_flag("--tileable", options->plane.tileable, "Opposite borders match");
    command->add_option("--seed", options->plane.seed, "Seed of all random choices [1]")
        ->transform(whole_number(0, std::numeric_limits<std::int64_t>::max()))
        ->type_name("");
    command
        ->add_option("--source-map", options->source_map,
                     "EXR of the sample's x, y that each texel shows")
        ->type_name("PATH");
    command->add_option("--texture-space", options->texture_space, "Colour space of the sample")
        ->type_name("");
    add_threads_flag(*command, options->threads);
    add_isa(*command, options->isa);
    add_backend(*command, options->backend);
    add_write_flags(*command, options->write);
    command->footer(
        "Examples:\n"
        "  weft synth wool.jpg -o plane.png --size 1024x1024\n"
        "  weft synth moss1.jpg moss2.jpg -o plane.png --rotations --mirror\n"
        "  weft synth brick.jpg -o plane.png --size 2048x2048 --tileable --source-map map.exr "
        "--json");
    on_run(*command, result, [=]() -> CommandResult {
        int width = 0, height = 0;
        char after = 0;
        if (std::sscanf(size->c_str(), "%dx%d%c", &width, &height, &after) != 2 || width < 1 ||
            height < 1) {
            return fail(ErrorCode::kUsage,
                        "--size must be two whole numbers above 0, not '" + *size + "'.",
                        "Write it like 512x512.");
        }
        options->plane.size = {width, height};
        if (std::sscanf(at->c_str(), "%d,%d%c", &options->at.x, &options->at.y, &after) != 2) {
            return fail(ErrorCode::kUsage, "--at must be two whole numbers, not '" + *at + "'.",
                        "Write it like 0,0.");
        }
        return synth_command(*options);
    });
}

void add_shot(CLI::App& command, ShotBenchOptions& shot) {
    command
        .add_option(
            "--shot", shot.plate,
            "Time only replacing the texture of this sequence by the sample, draft and final")
        ->type_name("PATH");
    command.add_option("--matte", shot.matte, "Mattes of the shot's frames, a pattern")
        ->type_name("PATH");
    command.add_option("--matte-value", shot.matte_value, "Id mattes: the pixels with this value")
        ->transform(whole_number(0, 65535))
        ->type_name("N");
    command.add_option("--against", shot.against, "Another weft, timed in turns with this one")
        ->type_name("PATH");
}

void add_bench(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("bench", "Time texture synthesis");
    const auto options = std::make_shared<BenchOptions>();
    options->sizes = {512, 768, 1024, 1280};
    command
        ->add_option("sample", options->sample,
                     "Image of the texture; its middle 96x96 px are used")
        ->required()
        ->type_name("PATH");
    command->add_option("--sizes", options->sizes, "Sides of the planes [512 768 1024 1280]")
        ->transform(whole_number(64, 16384))
        ->type_name("PX");
    command->add_option("--runs", options->runs, "Runs per case [10]")
        ->transform(whole_number(1, 1000))
        ->type_name("");
    add_threads_flag(*command, options->threads);
    command->add_flag("--lighting", options->lighting,
                      "Time only the light, and the paper's synthesis of the same size");
    add_write_flags(*command, options->write);
    command->add_option("--seams", options->seams, "Folder for images of the seams")
        ->type_name("PATH");
    command
        ->add_option("--repetition-of", options->repetition_of,
                     "Measure only the repetition of these planes of the sample")
        ->type_name("PATH");
    add_shot(*command, options->shot);
    add_isa(*command, options->isa);
    add_backend(*command, options->backend);
    command->footer(
        "Measures search, seams and total for each size, overlaps from 12 to 60, and the graph "
        "cut\n"
        "against dynamic programming and direct stitching.\n"
        "Examples:\n"
        "  weft bench gravel.jpg\n"
        "  weft bench gravel.jpg --sizes 512 --runs 3 --seams seams --json\n"
        "  weft bench gravel.jpg --shot 'frames/####.png' --matte 'masks/####.png' --against "
        "/usr/bin/weft");
    on_run(*command, result, [=] {
        // A shot uses all processors, and a few runs suffice.
        if (command->count("--threads") > 0) options->shot.threads = options->threads;
        if (command->count("--runs") > 0) options->shot.runs = options->runs;
        return bench_command(*options);
    });
}

}  // namespace

void add_synth_commands(CLI::App& app, CommandResult& result) {
    add_synth(app, result);
    add_bench(app, result);
}

}  // namespace weft
