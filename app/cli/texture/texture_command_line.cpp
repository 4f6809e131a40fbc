// Arguments of weft texture.

#include <memory>

#include "app/cli/command_line.h"
#include "app/cli/option_values.h"
#include "app/cli/texture/texture_commands.h"
#include "app/cli/texture/texture_console.h"

namespace weft {

CLI::App* add_texture_subcommand(CLI::App& group, const std::string& name, const std::string& help,
                                 const std::shared_ptr<TextureCommandOptions>& common) {
    CLI::App* command = group.add_subcommand(name, help);
    command->add_option("--db", common->db, "Library file; default: the user's own")
        ->type_name("FILE");
    add_threads_flag(*command, common->threads);
    return command;
}

namespace {

void add_build(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto options = std::make_shared<BuildOptions>();
    const auto estimate = std::make_shared<bool>(false), no_starter = std::make_shared<bool>(false);
    CLI::App* command = add_texture_subcommand(
        group, "build", "Build the full library from Debian packages", common);
    command
        ->add_option("--packages", options->packages,
                     "Packages to take images from; 'none' for the starter textures only")
        ->delimiter(',');
    command->add_option("--work", options->work_folder, "Folder for downloads")->type_name("PATH");
    command
        ->add_option("--per-picture", options->most_per_picture,
                     "Maximum number of samples per image [30]")
        ->transform(whole_number(1, 1000));
    command->add_flag("--no-starter", *no_starter, "Leave out the procedural starter textures");
    command->add_flag("--keep-downloads", options->keep_downloads,
                      "Keep the packages for another build");
    command->add_flag("--estimate", *estimate, "Only estimate download, disk and time");
    command->footer(
        "An interrupted build continues when it is run again. Nothing is installed.\n"
        "Examples:\n  weft texture build --estimate\n  weft texture build --packages "
        "ufoai-textures,openarena-081-textures");
    on_run(*command, result, [=] {
        options->starter = !*no_starter;
        std::erase(options->packages, "none");
        return texture_build_command(*common, *options, *estimate);
    });
}

void add_import(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto options = std::make_shared<ImportOptions>();
    const auto paths = std::make_shared<std::vector<std::string>>();
    const auto watch = std::make_shared<bool>(false);
    CLI::App* command = add_texture_subcommand(group, "import", "Add your own images", common);
    command->add_option("paths", *paths, "Files and folders")->required()->type_name("PATH");
    command->add_option("--material", options->material,
                        "Their material; default: from their names");
    command->add_option("--tags", options->tags, "Search words")->delimiter(',');
    command->add_option("--author", options->author, "Their author");
    command->add_option("--licence,--license", options->licence, "Their licence [unknown]");
    command
        ->add_option("--per-picture", options->most_per_picture,
                     "Maximum number of samples per image [30]")
        ->transform(whole_number(1, 1000));
    command->add_flag("--strict", options->strict,
                      "Leave out images that do not look like textures");
    command->add_flag("--keep-originals", options->keep_originals,
                      "Copy the images into the library");
    command->add_flag("--watch", *watch,
                      "Keep importing new files of the folder until interrupted");
    command->footer("Example:\n  weft texture import ~/textures --author 'Ada' --licence CC0-1.0");
    on_run(*command, result,
           [=] { return texture_import_command(*common, *paths, *options, *watch); });
}

void add_filters(CLI::App& command, TextureSearchOptions& options) {
    command.add_option("--material", options.query.materials, "Only these materials")
        ->delimiter(',');
    command.add_option("--origin", options.origins, "procedural, package or file")
        ->delimiter(',')
        ->check(one_of({"procedural", "package", "file"}));
    command.add_option("--package", options.query.packages, "Only from these packages")
        ->delimiter(',');
    command.add_option("--licence,--license", options.query.licences, "Only under these licences")
        ->delimiter(',');
    command
        .add_option("--exclude-licences,--exclude-licenses", options.query.excluded_licences,
                    "Exclude these licences or families (GPL, CC-BY-SA, copyleft)")
        ->delimiter(',');
    command.add_option("--category", options.query.categories, "Only from these folders")
        ->delimiter(',');
    command.add_option("--collection", options.query.collection, "Only from this collection");
    command.add_flag("--favourites", options.query.favourites_only, "Only favourites");
    command.add_option("--rating", options.query.min_rating, "Minimum rating in stars")
        ->transform(whole_number(0, 5));
    command
        .add_option("--sort", options.sort,
                    "relevance, name, material, newest, rating, brightness, hue or scale")
        ->check(one_of(
            {"relevance", "name", "material", "newest", "rating", "brightness", "hue", "scale"}));
    command.add_flag("--descending", options.query.descending, "Reverse the order");
    command.add_option("--count", options.query.limit, "Results to show [20]")
        ->transform(whole_number(0, 1000000));
    command.add_option("--offset", options.query.offset, "Results to skip")
        ->transform(whole_number(0, 100000000));
}

void add_search(CLI::App& group, CommandResult& result) {
    for (const bool list : {false, true}) {
        const auto common = std::make_shared<TextureCommandOptions>();
        const auto options = std::make_shared<TextureSearchOptions>();
        const auto words = std::make_shared<std::vector<std::string>>();
        options->query.limit = 20;
        CLI::App* command =
            add_texture_subcommand(group, list ? "list" : "search",
                                   list ? "List samples" : "Find samples by words", common);
        if (!list) {
            command->add_option("words", *words, "What to look for")->required();
            command->footer(
                "Example:\n  weft texture search \"rough grey stone\" --exclude-licences GPL");
        }
        add_filters(*command, *options);
        on_run(*command, result, [=] {
            for (const std::string& word : *words)
                options->query.text += (options->query.text.empty() ? "" : " ") + word;
            return texture_search_command(*common, *options);
        });
    }
}

void add_similar(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto o = std::make_shared<TextureSimilarOptions>();
    CLI::App* command = add_texture_subcommand(
        group, "similar", "Find samples similar to a sample or an image", common);
    command->add_option("what", o->what, "Id of a sample, or an image")
        ->required()
        ->type_name("ID|PATH");
    command
        ->add_option("--rectangle", o->rectangle,
                     "Part of the image: x,y,width,height; default: its middle")
        ->type_name("");
    command->add_option("--count", o->count, "Results to show [20]")
        ->transform(whole_number(1, 100000));
    command->footer("Example:\n  weft texture similar frames/0001.png --rectangle 320,200,96,96");
    on_run(*command, result, [=] { return texture_similar_command(*common, *o); });
}

void add_recommend(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto o = std::make_shared<TextureRecommendOptions>();
    CLI::App* command = add_texture_subcommand(group, "recommend",
                                               "Suggest textures for regions of a frame", common);
    command->add_option("--plate", o->plate, "Frame, sequence or movie")->type_name("PATH");
    command->add_option("--project", o->project, "Instead of plate and mattes: a project")
        ->type_name("PATH");
    command->add_option("--region", o->regions, "Regions of the project; default: all");
    command->add_option("--frame", o->frame, "Number of the frame; default: the first")
        ->transform(whole_number());
    command
        ->add_option("--matte", o->mattes,
                     "Matte of a region (of that frame); several for several regions")
        ->type_name("PATH");
    command->add_option("--keep", o->keeps, "For each matte: id of a texture to keep, or -")
        ->delimiter(',');
    command->add_option("--material", o->materials, "For each matte: the material, or -")
        ->delimiter(',');
    command->add_option("--like", o->adjust.like, "More like this sample")->type_name("ID");
    const auto range = number(-1.0, 1.0);
    command->add_option("--warmer", o->adjust.warmer, "-1 colder … 1 warmer")->check(range);
    command->add_option("--brighter", o->adjust.brighter, "-1 darker … 1 brighter")->check(range);
    command->add_option("--rougher", o->adjust.rougher, "-1 smoother … 1 rougher")->check(range);
    command->add_option("--larger", o->adjust.larger, "-1 finer … 1 larger structure")
        ->check(range);
    command->add_option("--count", o->count, "Suggestions for each region [12]")
        ->transform(whole_number(1, 100));
    command->add_option("--diversity", o->diversity, "0 the best … 1 the most different [0.35]")
        ->check(number(0.0, 1.0));
    command
        ->add_option("--exclude-licences,--exclude-licenses", o->excluded_licences,
                     "Exclude these licences or families")
        ->delimiter(',');
    add_write_flags(*command, o->write);
    command->add_option("--sheet", o->sheet, "Write a contact sheet of the suggestions")
        ->type_name("PATH");
    command->footer(
        "Example:\n  weft texture recommend --plate 'frames/####.png' --matte masks/1001.png "
        "--warmer 0.5\n  weft texture recommend --project shot.weft --region wall");
    on_run(*command, result, [=] { return texture_recommend_command(*common, *o); });
}

void add_evaluate(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto o = std::make_shared<EvaluationOptions>();
    const auto renamed = std::make_shared<std::vector<std::string>>();
    CLI::App* command = add_texture_subcommand(
        group, "evaluate", "How often the material of an unseen photograph is recognised", common);
    command
        ->add_option(
            "folder", o->folder,
            "Folders of photographs, named after materials; default: cross-validation of the "
            "library in five parts by name")
        ->type_name("PATH");
    command
        ->add_option("--leave-out", o->leave_out,
                     "Samples to exclude: the same photographs, and names that "
                     "differ by a number (series: of two words and more; stem: all) [series]")
        ->transform(choice<LeaveOut>({{"photographs", LeaveOut::kPhotographs},
                                      {"series", LeaveOut::kSeries},
                                      {"stem", LeaveOut::kStem}}))
        ->type_name("");
    command
        ->add_option("--rename", *renamed, "FOLDER=MATERIAL, if a folder's name is not a material")
        ->delimiter(',');
    command->footer("Example:\n  weft texture evaluate photographs --leave-out stem");
    on_run(*command, result, [=]() -> CommandResult {
        for (const std::string& pair : *renamed) {
            const auto at = pair.find('=');
            if (at == std::string::npos)
                return fail(ErrorCode::kUsage,
                            "--rename must be FOLDER=MATERIAL, not '" + pair + "'.");
            o->renamed[pair.substr(0, at)] = pair.substr(at + 1);
        }
        return texture_evaluate_command(*common, *o);
    });
}

void add_rest(CLI::App& group, CommandResult& result) {
    const auto info = std::make_shared<TextureCommandOptions>();
    const auto id = std::make_shared<std::string>();
    CLI::App* command =
        add_texture_subcommand(group, "info", "Everything known about a sample", info);
    command->add_option("id", *id, "Id, or a prefix of 6 digits or more")
        ->required()
        ->type_name("ID");
    on_run(*command, result, [=] { return texture_info_command(*info, *id); });

    const auto stats = std::make_shared<TextureCommandOptions>();
    on_run(*add_texture_subcommand(group, "stats", "Numbers of samples", stats), result,
           [=] { return texture_stats_command(*stats); });
    const auto verify = std::make_shared<TextureCommandOptions>();
    on_run(*add_texture_subcommand(group, "verify", "Check every sample of the library", verify),
           result, [=] { return texture_verify_command(*verify); });
    const auto train = std::make_shared<TextureCommandOptions>();
    on_run(*add_texture_subcommand(group, "train", "Train the descriptor on the library", train),
           result, [=] { return texture_train_command(*train); });

    const auto model_common = std::make_shared<TextureCommandOptions>();
    const auto model = std::make_shared<TextureModelOptions>();
    command = add_texture_subcommand(
        group, "model", "Set the image-text model for searches and recommendations", model_common);
    command
        ->add_option("folder", model->folder,
                     "Folder with model.json; default: print the current one")
        ->type_name("PATH");
    command->add_flag("--none", model->none, "Use no model");
    command->footer("Example:\n  weft texture model ~/models/clip");
    on_run(*command, result, [=] { return texture_model_command(*model_common, *model); });

    add_evaluate(group, result);

    const auto common = std::make_shared<TextureCommandOptions>();
    const auto o = std::make_shared<TextureExportOptions>();
    command = add_texture_subcommand(group, "export", "Write samples as images, with their credits",
                                     common);
    command->add_option("ids", o->ids, "Ids of samples")->type_name("ID");
    command->add_option("--search", o->text, "Instead of ids: search words");
    command
        ->add_option("--origin", o->origins,
                     "With --search or --random: procedural, package or file")
        ->delimiter(',');
    command->add_option("-o,--output", o->output, "Folder; with --sheet an image")
        ->required()
        ->type_name("PATH");
    add_write_flags(*command, o->write);
    command->add_flag("--sheet", o->sheet, "Write one contact sheet");
    command->add_flag("--originals", o->originals, "Write the larger originals");
    command->add_option("--count", o->count, "Maximum number of samples [100]")
        ->transform(whole_number(1, 1000000));
    command->add_option("--columns", o->columns, "Columns of the sheet [20]")
        ->transform(whole_number(1, 200));
    command->add_option("--random", o->seed, "Choose at random with this seed")
        ->transform(whole_number(0, std::numeric_limits<std::int64_t>::max()));
    command->footer("Example:\n  weft texture export --random 7 --count 400 --sheet -o sheet.png");
    on_run(*command, result, [=] { return texture_export_command(*common, *o); });
}

}  // namespace

void add_texture_commands(CLI::App& app, CommandResult& result) {
    CLI::App* group = app.add_subcommand("texture", "Browse, search and build the texture library");
    group->require_subcommand(1);
    add_build(*group, result);
    add_import(*group, result);
    add_search(*group, result);
    add_similar(*group, result);
    add_recommend(*group, result);
    add_rest(*group, result);
    add_texture_keeping(*group, result);
}

}  // namespace weft
