#pragma once
// weft texture …: the texture library from the command line.

#include <string>
#include <vector>

#include "app/cli/answer.h"
#include "app/cli/write_flags.h"
#include "bench/retrieval/evaluate.h"
#include "texture_db/library/library.h"
#include "texture_db/sources/build.h"
#include "texture_db/sources/import.h"

namespace weft {

/// Options of every `weft texture` subcommand.
struct TextureCommandOptions {
    std::string db;  ///< Empty: the default library.
    int threads = 0;
};

struct TextureSearchOptions {
    SearchQuery query;
    std::string sort = "relevance";
    std::vector<std::string> origins;
};

struct TextureSimilarOptions {
    std::string what;       ///< Id, or an image.
    std::string rectangle;  ///< "x,y,width,height" in the image; empty: its centre.
    int count = 20;
};

struct TextureRecommendOptions {
    std::string plate;
    std::string project;               ///< A project, instead of plate and mattes.
    std::vector<std::string> regions;  ///< Regions of the project by name or id; empty: all.
    int frame = -1;                    ///< Number of the plate's frame; -1: the first.
    std::vector<std::string> mattes;
    std::vector<std::string> keeps;      ///< Texture to keep for each matte, "-" for none.
    std::vector<std::string> materials;  ///< Material for each matte, "-" for none.
    RecommendAdjustments adjust;
    int count = 12;
    float diversity = 0.35f;
    std::vector<std::string> excluded_licences;
    std::string sheet;  ///< Contact sheet of the suggestions; empty: none.
    WriteFlags write;
};

struct TextureModelOptions {
    std::string folder;  ///< Empty: print the current one.
    bool none = false;
};

struct TextureExportOptions {
    std::vector<std::string> ids;
    std::string text;    ///< Search words, instead of ids.
    std::string output;  ///< Folder; with `sheet`, an image.
    bool sheet = false, originals = false;
    WriteFlags write;
    int count = 100;
    int columns = 20;
    std::uint64_t seed = 0;  ///< 0: no random choice.
    std::vector<std::string> origins;
};

CommandResult texture_build_command(const TextureCommandOptions& common,
                                    const BuildOptions& options, bool only_estimate);
CommandResult texture_import_command(const TextureCommandOptions& common,
                                     const std::vector<std::string>& paths,
                                     const ImportOptions& options, bool watch);
CommandResult texture_search_command(const TextureCommandOptions& common,
                                     const TextureSearchOptions& options);
CommandResult texture_similar_command(const TextureCommandOptions& common,
                                      const TextureSimilarOptions& options);
CommandResult texture_recommend_command(const TextureCommandOptions& common,
                                        const TextureRecommendOptions& options);
CommandResult texture_info_command(const TextureCommandOptions& common, const std::string& id);
CommandResult texture_stats_command(const TextureCommandOptions& common);
CommandResult texture_export_command(const TextureCommandOptions& common,
                                     const TextureExportOptions& options);
CommandResult texture_verify_command(const TextureCommandOptions& common);
CommandResult texture_train_command(const TextureCommandOptions& common);
CommandResult texture_model_command(const TextureCommandOptions& common,
                                    const TextureModelOptions& o);
CommandResult texture_evaluate_command(const TextureCommandOptions& common,
                                       const EvaluationOptions& options);

}  // namespace weft
