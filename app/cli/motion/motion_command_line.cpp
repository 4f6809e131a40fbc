#include <algorithm>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/motion/motion_command.h"
#include "app/cli/option_values.h"
#include "app/motion_export/motion_paths.h"
#include "app/project/codec/project_file.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

struct MotionFlags {
    MotionJobSpec spec;
    RunOptions run;
    std::string project;
    std::vector<std::string> what, vectors;
    bool overwrite = false, resume = false;
};

// Repeatable, or with commas between the words.
CLI::Option* add_words(CLI::App& command, const char* name, std::vector<std::string>& words,
                       const std::vector<std::string>& known, const std::string& help) {
    return command.add_option(name, words, help)
        ->delimiter(',')
        ->check(one_of(known))
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("NAMES");
}

MotionConvention convention_named(const std::string& name) {
    for (const MotionConvention known : {MotionConvention::kBlender, MotionConvention::kMoonray,
                                         MotionConvention::kFlame, MotionConvention::kArnold})
        if (name == name_of(known)) return known;
    return MotionConvention::kNuke;
}

void add_choices(CLI::App& command, MotionFlags& flags) {
    command.add_option("--region", flags.spec.regions, "Name or id of a region; repeatable [all]")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("NAME");
    command
        .add_option("--reference", flags.spec.reference,
                    "Frame that ST-maps, pins, shapes and meshes start from [each region's own]")
        ->transform(whole_number(-kMaxFrameNumber, kMaxFrameNumber))
        ->type_name("N");
    command.add_option("--frames", flags.spec.frames, "Frames to write [all of the project]");
    add_words(command, "--export", flags.what, {"st", "vectors", "corners", "roto", "mesh"},
              "What to write: st, vectors, corners, roto, mesh [st,vectors,corners]");
    command
        .add_option("--st-convention", flags.spec.st,
                    "Files of the ST-maps: nuke, fusion or blender [nuke]")
        ->transform(choice<StConvention>({{"nuke", StConvention::kNuke},
                                          {"fusion", StConvention::kFusion},
                                          {"blender", StConvention::kBlender}}))
        ->type_name("NAME");
    add_words(command, "--vector-convention", flags.vectors,
              {"nuke", "blender", "moonray", "flame", "arnold"},
              "Files of the vectors: nuke, blender, moonray, flame, arnold [nuke]");
}

CommandResult run_motion(MotionFlags& flags) {
    if (flags.overwrite && flags.resume)
        return fail(ErrorCode::kUsage, "--overwrite and --resume contradict each other.",
                    "Leave one out.");
    MotionJobSpec& spec = flags.spec;
    const auto wants = [&](const char* name) {
        return std::find(flags.what.begin(), flags.what.end(), name) != flags.what.end();
    };
    if (!flags.what.empty())
        spec.what = {wants("st"), wants("vectors"), wants("corners"), wants("roto"), wants("mesh")};
    if (!flags.vectors.empty()) spec.vectors.clear();
    for (const std::string& name : flags.vectors) {
        const MotionConvention convention = convention_named(name);
        if (std::find(spec.vectors.begin(), spec.vectors.end(), convention) == spec.vectors.end())
            spec.vectors.push_back(convention);
    }
    spec.existing = flags.overwrite ? ExistingFrames::kOverwrite
                    : flags.resume  ? ExistingFrames::kResume
                                    : ExistingFrames::kRefuse;
    spec.cache = flags.run.cache;
    spec.threads = flags.run.threads;
    spec.limits = {flags.run.output_root, {flags.project}};
    WEFT_TRY(written, load_project(flags.project));
    spec.project = resolve_paths(written, project_dir(flags.project));
    return motion_command(spec, flags.run.progress);
}

}  // namespace

void add_motion_command(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("motion",
                                           "Write a project's motion for other programs: ST-maps, "
                                           "vectors, corner pins, roto shapes, meshes");
    const auto flags = std::make_shared<MotionFlags>();
    add_project_path(*command, flags->project);
    command->add_option("-o,--output", flags->spec.folder, "Folder to write")
        ->required()
        ->type_name("FOLDER");
    add_choices(*command, *flags);
    add_analysis_flags(*command, flags->run);
    command->add_flag("--overwrite", flags->overwrite, "Replace existing output files");
    command->add_flag("--resume", flags->resume,
                      "Keep existing frames of the same motion and settings");
    add_output_root_flag(*command, flags->run.output_root);
    add_progress_flag(*command, flags->run);
    command->footer(
        "Nothing is rendered; what was analysed for a render is used again, and the other way "
        "round.\n"
        "Examples:\n"
        "  weft motion shot.weft -o motion\n"
        "  weft motion shot.weft -o motion --region wall --reference 1040 --export st,corners\n"
        "  weft motion shot.weft -o motion --export roto,mesh\n"
        "  weft motion shot.weft -o motion --vector-convention nuke,blender --resume --json");
    on_run(*command, result, [=] { return run_motion(*flags); });
}

}  // namespace weft
