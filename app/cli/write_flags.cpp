#include "app/cli/write_flags.h"

#include <CLI/CLI.hpp>

namespace weft {

void add_output_root_flag(CLI::App& command, std::string& root) {
    command
        .add_option("--output-root", root,
                    "Write nothing outside this folder, also not through links, except the cache")
        ->type_name("FOLDER");
}

void add_write_flags(CLI::App& command, WriteFlags& flags) {
    command.add_flag("--overwrite", flags.overwrite, "Replace existing files");
    add_output_root_flag(command, flags.root);
}

Expected<WriteRule> write_rule(const WriteFlags& flags, const std::vector<std::string>& reads,
                               const Project& project) {
    WEFT_TRY(fence, make_fence(project, {flags.root, reads}));
    WriteRule rule;
    rule.existing = existing_by(flags.overwrite);
    rule.fence = fence;
    return rule;
}

}  // namespace weft
