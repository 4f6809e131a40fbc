#pragma once
#include <CLI/CLI.hpp>
#include <vector>

namespace weft {

/// The commands of a group that its --help lists.
[[nodiscard]] inline std::vector<const CLI::App*> shown_commands(const CLI::App& group) {
    return group.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); });
}

}  // namespace weft
