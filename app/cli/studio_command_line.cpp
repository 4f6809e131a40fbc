// weft look, collect, submit, task and doctor.

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"
#include "app/exchange/schemas.h"

namespace weft {
namespace {

void add_look(CLI::App& app, CommandResult& result) {
    CLI::App* group = app.add_subcommand("look", "Save a look and apply it to other shots");
    group->require_subcommand(1);
    const auto project = std::make_shared<std::string>(), look = std::make_shared<std::string>(),
               region = std::make_shared<std::string>();
    CLI::App* save = group->add_subcommand("save", "Write the look of a project's regions");
    save->add_option("project", *project, "Project file (.weft)")->required()->type_name("PATH");
    save->add_option("look", *look, "Look file to write (.json)")->required()->type_name("PATH");
    save->add_option("--region", *region, "Only this region");
    const auto write = std::make_shared<WriteFlags>();
    add_write_flags(*save, *write);
    save->footer("Example:\n  weft look save sh010.weft brick.look.json --region wall");
    on_run(*save, result, [=] { return look_save_command(*project, *look, *region, *write); });
    CLI::App* apply = group->add_subcommand("apply", "Apply a look to a project's regions");
    apply->add_option("look", *look, "Look file")->required()->type_name("PATH");
    apply->add_option("project", *project, "Project file (.weft)")->required()->type_name("PATH");
    apply->add_option("--region", *region, "Region to apply a look of one region to");
    const auto library = add_library_flag(*apply);
    apply->footer(
        "Regions are found by their names. Mattes, motion and the shot's own passes stay.\n"
        "Example:\n  weft look apply brick.look.json sh020.weft");
    on_run(*apply, result, [=] { return look_apply_command(*look, *project, *region, *library); });
}

void add_collect(CLI::App& app, CommandResult& result) {
    CLI::App* command =
        app.add_subcommand("collect", "Copy all files of a project into one folder");
    const auto project = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
    const auto run = std::make_shared<RunOptions>();
    add_project_path(*command, *project);
    command->add_option("folder", *folder, "Folder to fill")->required()->type_name("PATH");
    const auto library = add_library_flag(*command);
    add_map_flag(*command, *run);
    add_output_root_flag(*command, run->output_root);
    command->footer("Example:\n  weft collect sh010.weft /archive/sh010");
    on_run(*command, result, [=] { return collect_command(*project, *folder, *library, *run); });
}

void add_submit(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("submit", "Write a job for a render farm");
    const auto options = std::make_shared<SubmitOptions>();
    add_project_path(*command, options->project);
    command->add_option("--to", options->engine, "openjd, slurm, deadline, opencue or flamenco")
        ->required()
        ->type_name("FARM");
    command->add_option("-o,--output", options->folder, "Folder for the job's files")
        ->required()
        ->type_name("PATH");
    command->add_option("--cache", options->cache, "Folder that all machines share [OUTPUT/cache]")
        ->type_name("PATH");
    command->add_option("--chunk", options->chunk, "Frames per task [10]")
        ->transform(whole_number(1, 100000));
    add_threads_flag(*command, options->threads);
    command->add_option("--map", options->maps, "FROM=TO for the machines' roots; repeatable")
        ->type_name("")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--db", options->library, "Library of the textures 'db:ID'")
        ->type_name("FILE");
    command->add_flag("--resume", options->resume,
                      "Keep existing frames of the same settings and inputs");
    command->add_flag("--skip-existing", options->skip_existing,
                      "Keep existing frames that are readable");
    add_write_flags(*command, options->write);
    add_trust_flag(*command, options->trust);
    command->add_flag("--run", options->run, "Also submit the job (Slurm)");
    command->footer(
        "The job has a snapshot of the project; submit again after changes. All machines must "
        "find its\nfiles under the same paths (--map).\n"
        "Example:\n  weft submit sh010.weft --to slurm -o /proj/farm/sh010 --run");
    on_run(*command, result, [=] { return submit_command(*options); });
}

void add_task(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("task", "Run one task of a farm job");
    const auto job = std::make_shared<std::string>(), stage = std::make_shared<std::string>();
    const auto index = std::make_shared<int>(0);
    const auto run = std::make_shared<RunOptions>();
    command->add_option("job", *job, "job.json of 'weft submit'")->required()->type_name("PATH");
    command->add_option("stage", *stage, "motion, analyse, planes, frames or encode")->required();
    command->add_option("index", *index, "Index of the task, from 0")
        ->required()
        ->transform(whole_number(0));
    add_progress_flag(*command, *run);
    add_output_root_flag(*command, run->output_root);
    command->footer("Example:\n  weft task /proj/farm/sh010/job.json frames 3 --progress openjd");
    on_run(*command, result, [=] { return task_command(*job, *stage, *index, *run); });
}

void add_doctor(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("doctor", "Check the installation");
    const auto assets = std::make_shared<std::string>(assets_folder());
    command->add_option("--assets", *assets, "Folder of the demo's assets")->type_name("PATH");
    command->footer("Example:\n  weft doctor");
    on_run(*command, result, [=] { return doctor_command(*assets); });
}

void add_schema(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand(
        "schema", "Print the JSON Schema of projects, actions, reports or errors");
    const auto name = std::make_shared<std::string>();
    command->add_option("name", *name, "project, actions, report, motion or error")->required();
    command->footer("Example:\n  weft schema project > project.schema.json");
    on_run(*command, result, [=]() -> CommandResult {
        WEFT_TRY(schema, json_schema(*name));
        return Answer{{{"name", *name}, {"json_schema", nlohmann::ordered_json::parse(schema)}},
                      schema};
    });
}

}  // namespace

void add_studio_commands(CLI::App& app, CommandResult& result) {
    add_look(app, result);
    add_collect(app, result);
    add_submit(app, result);
    add_task(app, result);
    add_doctor(app, result);
    add_schema(app, result);
}

}  // namespace weft
