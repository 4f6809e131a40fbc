#include "app/cli/help/man_page.h"

#include <sstream>

#include "app/cli/help/shown_commands.h"
#include "app/render/report.h"

namespace weft {
namespace {

constexpr const char* kHead = R"(.SH NAME
weft \- replace textures in animation
.SH SYNOPSIS
.B weft
.I COMMAND
.RI [ ARGUMENT ...]
.br
.B weft edit
.RI [ PROJECT ]
.SH DESCRIPTION
.B weft
puts a new texture on a surface of a shot. Without a command it opens the editor. Every other command runs without a
window, a display, a GPU or a network. With
.B \-\-json
a command prints one JSON object on standard output, errors too.
)";

constexpr const char* kTail = R"(.SH EXIT STATUS
0 done; 1 render failed; 2 usage; 3 unreadable; 4 missing frames; 5 no such backend; 6 out of disk or memory; 7 refused
by policy; 8 verification differs; 130 interrupted; 143 terminated.
.SH ENVIRONMENT
.TP
.B OCIO
an OpenColorIO config, whose spaces can be named
.TP
.B XDG_CACHE_HOME
where analyses are kept, below weft
.TP
.B WEFT_ISA
scalar, avx2 or avx512: the result is the same
.SH EXAMPLES
.nf
weft replace \-\-plate 'frames/####.png' \-\-matte 'masks/####.png' \-\-texture wool.jpg \-o 'out/####.png'
weft render shot.weft \-\-resume
weft submit shot.weft \-\-to slurm \-o farm \-\-run
.fi
)";

// Escapes hyphens and leading control characters.
std::string troff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            out += c;
        }
    }
    return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

void write_options(const CLI::App& command, std::ostream& out) {
    for (const CLI::Option* option : command.get_options()) {
        const std::string first = option->get_name();
        if (option->get_group().empty() || first == "--help" || first == "--json") continue;
        const bool positional = option->get_positional();
        const std::string name =
            positional ? option->get_name(true) : option->get_name(false, true);
        out << ".TP\n.B " << troff(name) << '\n';
        if (!option->get_description().empty()) out << troff(option->get_description()) << '\n';
    }
}

void write_section(const CLI::App& command, const std::string& name, std::ostream& out) {
    out << ".SS " << troff(name) << '\n' << troff(command.get_description()) << ".\n";
    const auto commands = shown_commands(command);
    if (commands.empty()) write_options(command, out);
    for (const CLI::App* part : commands)
        write_section(*part, name + " " + part->get_name(), out);
}

}  // namespace

std::string man_page(const CLI::App& app) {
    std::ostringstream out;
    out << ".\\\" Made by: weft man > packaging/linux/weft.1\n"
        << ".TH WEFT 1 \"\" \"weft " << kVersion << "\" \"User commands\"\n"
        << kHead << ".SH COMMANDS\n";
    for (const CLI::App* command : shown_commands(app))
        write_section(*command, command->get_name(), out);
    out << kTail;
    return out.str();
}

}  // namespace weft
