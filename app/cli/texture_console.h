#pragma once
// Internal: what the files of `weft texture` have in common.

#include <memory>
#include <string>
#include <vector>

#include "app/cli/texture_commands.h"

namespace weft {

/// A subcommand of `weft texture` with --db, --json and --threads.
CLI::App* add_texture_subcommand(CLI::App& group, const std::string& name, const std::string& help,
                                 const std::shared_ptr<TextureCommandOptions>& common);
/// Adds `mark` and `kept`.
void add_texture_keeping(CLI::App& group, int& exit);
/// --db, or the user's own.
[[nodiscard]] std::string texture_library_path(const TextureCommandOptions& common);
/// Opened as --db and --threads say. `create`: also where there is none yet.
[[nodiscard]] Expected<std::shared_ptr<TextureLibrary>> open_texture_library(
    const TextureCommandOptions& common, bool create);
/// One line of a list of samples.
[[nodiscard]] std::string texture_hit_line(const std::string& id, float score,
                                           const std::string& material, const std::string& name,
                                           const std::vector<std::string>& reasons);
/// 0, or that of the error, which is printed.
[[nodiscard]] int texture_exit_code(const Status& status);

}  // namespace weft
