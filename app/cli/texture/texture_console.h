#pragma once
// Internal: helpers shared by the files of `weft texture`.

#include <memory>
#include <string>
#include <vector>

#include "app/cli/texture/texture_commands.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds a subcommand of `weft texture` with --db and --threads.
CLI::App* add_texture_subcommand(CLI::App& group, const std::string& name, const std::string& help,
                                 const std::shared_ptr<TextureCommandOptions>& common);
/// Adds the commands `mark` and `kept`.
void add_texture_keeping(CLI::App& group, CommandResult& result);
/// --db, or the user's own.
[[nodiscard]] std::string texture_library_path(const TextureCommandOptions& common);
/// Opens the library given by --db with --threads. `create`: creates it if it does not exist.
[[nodiscard]] Expected<std::shared_ptr<TextureLibrary>> open_texture_library(
    const TextureCommandOptions& common, bool create);
/// Errors: Usage for a licence that is known to neither Weft nor the library.
[[nodiscard]] Status check_exclusions(TextureLibrary& library,
                                      const std::vector<std::string>& excluded);
/// One line of a list of samples.
[[nodiscard]] std::string texture_hit_line(const std::string& id, float score,
                                           const std::string& material, const std::string& name,
                                           const std::vector<std::string>& reasons);

}  // namespace weft
