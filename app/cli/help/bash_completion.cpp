#include "app/cli/help/bash_completion.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "app/cli/help/shown_commands.h"

namespace weft {
namespace {

constexpr const char* kFunction = R"(
_weft() {
    local current=${COMP_WORDS[COMP_CWORD]} command=weft depth=1 word
    # Only words that are commands lead on; a folder of the same name beside them does not count.
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ " ${_weft_commands[$command]-} " == *" $word "* ]] || break
        command+=" $word"
        depth=$((depth + 1))
    done
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "${_weft_options[$command]}" -- "$current")
    elif [[ ${_weft_commands[$command]-} && $depth -eq $COMP_CWORD ]]; then
        mapfile -t COMPREPLY < <(compgen -W "${_weft_commands[$command]}" -- "$current")
    fi
}
complete -o default -F _weft weft
)";

struct Tables {
    std::ostringstream commands, options;
};

void write_row(std::ostream& out, const std::string& command, std::vector<std::string> words) {
    std::sort(words.begin(), words.end());
    out << "    ['" << command << "']='";
    for (const std::string& word : words)
        out << (&word == words.data() ? "" : " ") << word;
    out << "'\n";
}

std::vector<std::string> long_options(const CLI::App& command) {
    std::vector<std::string> out;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;
        for (const std::string& name : option->get_lnames())
            out.push_back("--" + name);
    }
    return out;
}

void write_command(const CLI::App& command, const std::string& path, Tables& tables) {
    write_row(tables.options, path, long_options(command));
    std::vector<std::string> names;
    for (const CLI::App* part : shown_commands(command)) {
        names.push_back(part->get_name());
        write_command(*part, path + " " + part->get_name(), tables);
    }
    if (!names.empty()) write_row(tables.commands, path, std::move(names));
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
    Tables tables;
    write_command(app, "weft", tables);
    return "# Completion for weft. Made by: weft completion > packaging/linux/weft.bash\n"
           "declare -gA _weft_commands=(\n" +
           tables.commands.str() + ")\ndeclare -gA _weft_options=(\n" + tables.options.str() +
           ")\n" + kFunction;
}

}  // namespace weft
