// weft synth and bench.

#include "app/cli/region_flags.h"

namespace weft {
namespace {

void add_isa(CLI::App& command, std::string& isa) {
    command
        .add_option("--isa", isa,
                    "Instruction set: scalar, avx2 or avx512, with one result [the best there is]")
        ->check(CLI::IsMember({"scalar", "avx2", "avx512"}))
        ->type_name("");
}

// A GPU takes longer to start than a plane of ordinary size to grow, so it has to be asked for.
void add_backend(CLI::App& command, std::string& backend) {
    command
        .add_option("--backend", backend,
                    "What searches for placements: cpu, cuda or auto, with one result [cpu]")
        ->type_name("");
}

void add_synth(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("synth", "Grow a texture plane from a sample");
    const auto options = std::make_shared<SynthOptions>();
    const auto size = std::make_shared<std::string>("512x512");
    const auto at = std::make_shared<std::string>("0,0");
    command
        ->add_option("sample", options->samples,
                     "Picture of the texture; several of one material are used together")
        ->required()
        ->type_name("PATH");
    command->add_option("-o,--output", options->output, "File to write")
        ->required()
        ->type_name("PATH");
    command->add_option("--size", *size, "Width x height in texels [512x512]")->type_name("WxH");
    const std::map<std::string, SeamMethod> seams{{"graphcut", SeamMethod::kGraphCut},
                                                  {"dp", SeamMethod::kDynamicProgramming},
                                                  {"none", SeamMethod::kNone}};
    command->add_option("--seam", options->plane.seam, "graphcut, dp or none [graphcut]")
        ->transform(CLI::CheckedTransformer(seams))
        ->type_name("");
    const std::map<std::string, SeamCost> costs{{"gradient", SeamCost::kGradient},
                                                {"paper", SeamCost::kPaper}};
    command
        ->add_option("--seam-cost", options->plane.seam_cost,
                     "gradient: mismatch over gradient; paper: its eq. 2 and 3 [gradient]")
        ->transform(CLI::CheckedTransformer(costs))
        ->type_name("");
    command
        ->add_option("--overlap", options->plane.overlap_px, "Largest overlap of pieces, px [36]")
        ->type_name("px");
    command->add_option("--feather", options->plane.feather_px, "Blend across the seams, px [0]")
        ->check(CLI::Range(0, 256))
        ->type_name("px");
    command
        ->add_option("--refine", options->plane.refine_passes,
                     "Rounds of refinement: cuts anew, then new pieces over the worst seams [2]")
        ->check(CLI::Range(0, 100))
        ->type_name("");
    command->add_flag("--rotations", options->plane.orientations.rotations,
                      "Use the sample turned by quarters, too");
    command->add_flag("--mirror", options->plane.orientations.mirror,
                      "Use the sample mirrored, too");
    command->add_flag("!--no-align", options->plane.align,
                      "Do not keep bricks, tiles and weaves in step");
    command
        ->add_option("--light", options->light,
                     "Picture of a wanted illumination that placements and seams follow")
        ->type_name("PATH");
    command->add_option("--light-weight", options->light_weight, "How much it counts [0.1]")
        ->check(CLI::Range(0.0, 1000.0))
        ->type_name("");
    command->add_flag("--endless", options->endless,
                      "A part of a plane without end, which is the same however it is read");
    command->add_option("--at", *at, "Of that plane, the upper left texel [0,0]")->type_name("X,Y");
    command->add_flag("--tileable", options->plane.tileable, "Opposite borders join");
    command->add_option("--seed", options->plane.seed, "Seed of all random choices [1]")
        ->type_name("");
    command
        ->add_option("--source-map", options->source_map,
                     "EXR of the sample's x, y that each texel shows")
        ->type_name("PATH");
    command->add_option("--texture-space", options->texture_space, "Colour space of the sample")
        ->type_name("");
    command->add_option("--threads", options->threads, "Threads to use; 0 is one a processor")
        ->check(CLI::Range(0, 1024));
    add_isa(*command, options->isa);
    add_backend(*command, options->backend);
    command->add_flag("--overwrite", options->overwrite, "Replace files that exist");
    command->add_flag("--json", options->json, "One JSON object on stdout");
    command->footer(
        "Examples:\n"
        "  weft synth wool.jpg -o plane.png --size 1024x1024\n"
        "  weft synth moss1.jpg moss2.jpg -o plane.png --rotations --mirror\n"
        "  weft synth brick.jpg -o plane.png --size 2048x2048 --tileable --source-map map.exr "
        "--json");
    command->callback([=, &exit] {
        int width = 0, height = 0;
        char after = 0;
        if (std::sscanf(size->c_str(), "%dx%d%c", &width, &height, &after) != 2 || width < 1 ||
            height < 1) {
            exit = report_error({ErrorCode::kUsage,
                                 "Cannot read the size '" + *size + "'. Write it like 512x512.",
                                 {}});
            return;
        }
        options->plane.size = {width, height};
        if (std::sscanf(at->c_str(), "%d,%d%c", &options->at.x, &options->at.y, &after) != 2) {
            exit = report_error(
                {ErrorCode::kUsage, "Cannot read the place '" + *at + "'. Write it like 0,0.", {}});
            return;
        }
        exit = synth_command(*options);
    });
}

void add_bench(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("bench", "Time the growing of texture planes");
    const auto options = std::make_shared<BenchOptions>();
    options->sizes = {512, 768, 1024, 1280};
    command
        ->add_option("sample", options->sample, "Picture of the texture; its middle 96x96 px count")
        ->required()
        ->type_name("PATH");
    command->add_option("--sizes", options->sizes, "Sides of the planes [512 768 1024 1280]")
        ->check(CLI::Range(64, 16384))
        ->type_name("PX");
    command->add_option("--runs", options->runs, "Runs of each [10]")
        ->check(CLI::Range(1, 1000))
        ->type_name("");
    command->add_option("--threads", options->threads, "Threads to use; 0 is one a processor [1]")
        ->check(CLI::Range(0, 1024));
    command->add_flag("--lighting", options->lighting,
                      "Only what light costs, beside the paper's own synthesis of the same size");
    command->add_option("--seams", options->seams, "Folder for pictures of the seams")
        ->type_name("PATH");
    command
        ->add_option("--repetition-of", options->repetition_of,
                     "Measure only how much these planes of the sample repeat")
        ->type_name("PATH");
    add_isa(*command, options->isa);
    add_backend(*command, options->backend);
    command->add_flag("--json", options->json, "One JSON object on stdout");
    command->footer(
        "Measures search, seams and total for each size, overlaps from 12 to 60, and the graph "
        "cut\n"
        "against dynamic programming and direct stitching.\n"
        "Examples:\n"
        "  weft bench gravel.jpg\n"
        "  weft bench gravel.jpg --sizes 512 --runs 3 --seams seams --json");
    command->callback([=, &exit] { exit = bench_command(*options); });
}

}  // namespace

void add_synth_commands(CLI::App& app, int& exit) {
    add_synth(app, exit);
    add_bench(app, exit);
}

}  // namespace weft
