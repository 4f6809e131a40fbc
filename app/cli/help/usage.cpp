#include "app/cli/help/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/cli/help/shown_commands.h"
#include "app/cli/option_values.h"

namespace weft {
namespace {

// The subcommand that the arguments led to.
const CLI::App& chosen(const CLI::App& app) {
    const CLI::App* at = &app;
    while (!at->get_subcommands().empty())
        at = at->get_subcommands().front();
    return *at;
}

std::vector<std::string> command_names(const CLI::App& group) {
    std::vector<std::string> names;
    for (const CLI::App* command : shown_commands(group))
        names.push_back(command->get_name());
    return names;
}

bool is_flag(const CLI::Option& option) {
    return option.get_type_size() == 0 || option.get_expected_max() == 0;
}

// The option whose name occurs as a word in CLI11's message.
const CLI::Option* named_in(const CLI::App& command, const std::string& text) {
    const CLI::Option* found = nullptr;
    const auto is_part = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '-';
    };
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        const std::size_t at = text.find(name);
        if (name.empty() || at == std::string::npos) continue;
        const std::size_t end = at + name.size();
        if ((at > 0 && is_part(text[at - 1])) || (end < text.size() && is_part(text[end])))
            continue;
        if (!found || name.size() > found->get_name().size()) found = option;
    }
    return found;
}

std::string missing_text(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_required() || option->count() > 0) continue;
        const bool named = option->get_name().starts_with("-");
        return fmt::format("{} is missing",
                           named ? option->get_name() : "The argument " + option->get_name());
    }
    return "An argument is missing";
}

// Message for a word that no option or argument accepts.
std::string extra_text(const CLI::App& app, const std::string& command) {
    const std::vector<std::string> left = app.remaining(true);
    const std::string first = left.empty() ? std::string() : left.front();
    if (first.starts_with("-"))
        return fmt::format("{} is not an option of {}", first.substr(0, first.find('=')), command);
    return fmt::format("{} does not take the argument '{}'", command, first);
}

// CLI11's "--name: message of our check".
std::string checked_text(const std::string& text) {
    const std::size_t at = text.find(": ");
    if (at == std::string::npos) return text;
    const std::string name = text.substr(0, at), said = text.substr(at + 2);
    return name + (said.starts_with("must ") ? " " : ": ") + said;
}

// CLI11 stores mutually exclusive options in a set of pointers, so their order varies; sort them.
std::string contradiction_text(const std::string& text) {
    static constexpr std::string_view kVerb = " excludes ";
    const std::size_t at = text.find(kVerb);
    if (at == std::string::npos) return "Two options contradict each other.";
    const auto [first, second] = std::minmax({text.substr(0, at), text.substr(at + kVerb.size())});
    return fmt::format("{} and {} contradict each other.", first, second);
}

std::string needed_text(const std::string& text) {
    static constexpr std::string_view kVerb = " requires ";
    const std::size_t at = text.find(kVerb);
    if (at == std::string::npos) return "An option needs another one.";
    return fmt::format("{} needs {}.", text.substr(0, at), text.substr(at + kVerb.size()));
}

std::string value_text(const CLI::App& command, const CLI::ParseError& error) {
    const CLI::Option* option = named_in(command, error.what());
    if (!option) return "An option has an invalid value.";
    const std::string name = option->get_name();
    if (is_flag(*option)) return name + " must be true or false.";
    if (dynamic_cast<const CLI::ConversionError*>(&error)) return name + " must be a number.";
    const int wanted = option->get_expected_min();
    return wanted > 1 ? fmt::format("{} needs {} values.", name, wanted) : name + " needs a value.";
}

class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() {
        constexpr std::size_t kNameColumns = 34;
        column_width(kNameColumns);
        for (const auto& [theirs, ours] : {std::pair{"TEXT", "NAME"},
                                           {"INT", "N"},
                                           {"UINT", "N"},
                                           {"FLOAT", "X"},
                                           {"REQUIRED", "(required)"},
                                           {"Needs", "with"},
                                           {"Excludes", "not with"},
                                           {"SUBCOMMAND", "COMMAND"},
                                           {"SUBCOMMANDS", "COMMANDS"},
                                           {"Subcommand", "Command"},
                                           {"Subcommands", "Commands"}})
            label(theirs, ours);
    }
};

}  // namespace

std::string command_of(const CLI::App& app) {
    std::string name = "weft";
    for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
        at = at->get_subcommands().front();
        name += " " + at->get_name();
    }
    return name;
}

Error usage_error(const CLI::App& app, const CLI::ParseError& error, int argc) {
    const CLI::App& command = chosen(app);
    const std::string name = command_of(app);
    const std::vector<std::string> names = command_names(command);
    const std::string help = fmt::format("Run '{} --help'.", name);
    std::string what, remedy = help;
    if (argc < 2) {
        what = "No command was given.";
    } else if (!names.empty()) {
        // A command group: the next word should name one of its commands.
        const std::vector<std::string> left = app.remaining(true);
        const auto word = std::find_if(left.begin(), left.end(),
                                       [](const std::string& w) { return !w.starts_with("-"); });
        what = word != left.end() ? fmt::format("'{}' is not a command of {}.", *word, name)
                                  : fmt::format("{} needs a command: {}.", name, either(names));
    } else if (dynamic_cast<const CLI::RequiredError*>(&error)) {
        what = missing_text(command) + ".";
    } else if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        what = extra_text(app, name) + ".";
    } else if (const auto* refused = dynamic_cast<const RefusedValue*>(&error)) {
        what = checked_text(refused->option + ": " + refused->error.message);
        remedy = refused->error.remedy;
    } else if (dynamic_cast<const CLI::ValidationError*>(&error)) {
        what = checked_text(error.what());
        remedy.clear();
    } else if (dynamic_cast<const CLI::ExcludesError*>(&error)) {
        what = contradiction_text(error.what());
        remedy = "Leave one out.";
    } else if (dynamic_cast<const CLI::RequiresError*>(&error)) {
        what = needed_text(error.what());
        remedy = "Give both or neither.";
    } else {
        what = value_text(command, error);
    }
    std::replace(what.begin(), what.end(), '\n', ' ');
    return {ErrorCode::kUsage, what, remedy, {}};
}

void use_our_help(CLI::App& app) {
    const auto formatter = std::make_shared<HelpFormatter>();
    app.formatter(formatter);
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!command->get_group().empty()) command->group("Commands");
        use_our_help(*command);
    }
}

}  // namespace weft
