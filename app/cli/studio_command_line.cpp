// weft look, collect, submit, task and doctor.

#include "app/cli/region_flags.h"
#include "app/session/schemas.h"

namespace weft {
namespace {

void add_look(CLI::App& app, int& exit) {
    CLI::App* group = app.add_subcommand("look", "Carry a look from shot to shot");
    group->require_subcommand(1);
    const auto project = std::make_shared<std::string>(), look = std::make_shared<std::string>(),
               region = std::make_shared<std::string>();
    CLI::App* save = group->add_subcommand("save", "Write the look of a project's regions");
    save->add_option("project", *project, "Project file (.weft)")->required()->type_name("PATH");
    save->add_option("look", *look, "Look file to write (.json)")->required()->type_name("PATH");
    save->add_option("--region", *region, "Only this region");
    save->footer("Example:\n  weft look save sh010.weft brick.look.json --region wall");
    save->callback([=, &exit] { exit = look_save_command(*project, *look, *region); });
    CLI::App* apply = group->add_subcommand("apply", "Put a look on a project's regions");
    apply->add_option("look", *look, "Look file")->required()->type_name("PATH");
    apply->add_option("project", *project, "Project file (.weft)")->required()->type_name("PATH");
    apply->add_option("--region", *region, "The region to put a look of one region on");
    const auto library = add_library_flag(*apply);
    apply->footer(
        "Regions are found by their names. Mattes, motion and the shot's own passes stay.\n"
        "Example:\n  weft look apply brick.look.json sh020.weft");
    apply->callback([=, &exit] { exit = look_apply_command(*look, *project, *region, *library); });
}

void add_collect(CLI::App& app, int& exit) {
    CLI::App* command =
        app.add_subcommand("collect", "Gather all that a project needs in one folder");
    const auto project = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
    const auto run = std::make_shared<RunOptions>();
    command->add_option("project", *project, "Project file (.weft)")->required()->type_name("PATH");
    command->add_option("folder", *folder, "Folder to fill")->required()->type_name("PATH");
    const auto library = add_library_flag(*command);
    add_map_flag(*command, *run);
    command->add_flag("--json", run->json, "As JSON");
    command->footer("Example:\n  weft collect sh010.weft /archive/sh010");
    command->callback([=, &exit] { exit = collect_command(*project, *folder, *library, *run); });
}

void add_submit(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("submit", "Write a job for a render farm");
    const auto options = std::make_shared<SubmitOptions>();
    command->add_option("project", options->project, "Project file (.weft)")
        ->required()
        ->type_name("PATH");
    command->add_option("--to", options->engine, "openjd, slurm, deadline, opencue or flamenco")
        ->required();
    command->add_option("-o,--output", options->folder, "Folder for the job's files")
        ->required()
        ->type_name("PATH");
    command->add_option("--cache", options->cache, "Folder that all machines share [OUTPUT/cache]")
        ->type_name("PATH");
    command->add_option("--chunk", options->chunk, "Frames of a task [10]")
        ->check(CLI::Range(1, 100000));
    command->add_option("--threads", options->threads, "Threads of a task; 0 is one a processor")
        ->check(CLI::Range(0, 1024));
    command->add_option("--map", options->maps, "FROM=TO for the machines' roots; repeatable")
        ->type_name("")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--db", options->library, "Library of the textures 'db:ID'")
        ->type_name("FILE");
    command->add_flag("--run", options->run, "Submit it, too (Slurm)");
    command->add_flag("--json", options->json, "As JSON");
    command->footer(
        "The project's frames, outputs and paths must mean the same on all machines (--map).\n"
        "Example:\n  weft submit sh010.weft --to slurm -o /proj/farm/sh010 --run");
    command->callback([=, &exit] { exit = submit_command(*options); });
}

void add_task(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("task", "Do one task of a farm's job");
    const auto job = std::make_shared<std::string>(), stage = std::make_shared<std::string>();
    const auto index = std::make_shared<int>(0);
    const auto run = std::make_shared<RunOptions>();
    command->add_option("job", *job, "job.json of 'weft submit'")->required()->type_name("PATH");
    command->add_option("stage", *stage, "motion, analyse, planes, frames or encode")->required();
    command->add_option("index", *index, "Which task of it, from 0")->required();
    add_progress_flags(*command, *run);
    command->footer("Example:\n  weft task /proj/farm/sh010/job.json frames 3 --progress openjd");
    command->callback([=, &exit] { exit = task_command(*job, *stage, *index, run->progress); });
}

void add_doctor(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("doctor", "Say what is found, missing, and to be done");
    const auto assets = std::make_shared<std::string>(assets_folder());
    const auto json = std::make_shared<bool>(false);
    command->add_option("--assets", *assets, "Folder of the demo's assets")->type_name("PATH");
    command->add_flag("--json", *json, "As JSON");
    command->footer("Example:\n  weft doctor");
    command->callback([=, &exit] { exit = doctor_command(*assets, *json); });
}

void add_schema(CLI::App& app, int& exit) {
    CLI::App* command =
        app.add_subcommand("schema", "Print the JSON Schema of projects, actions or reports");
    const auto name = std::make_shared<std::string>();
    command->add_option("name", *name, "project, actions or report")->required();
    command->footer("Example:\n  weft schema project > project.schema.json");
    command->callback([=, &exit] {
        const auto schema = json_schema(*name);
        if (schema) print(stdout, *schema);
        exit = schema ? 0 : report_error(schema.error());
    });
}

}  // namespace

void add_studio_commands(CLI::App& app, int& exit) {
    add_look(app, exit);
    add_collect(app, exit);
    add_submit(app, exit);
    add_task(app, exit);
    add_doctor(app, exit);
    add_schema(app, exit);
}

}  // namespace weft
