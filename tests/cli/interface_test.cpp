// Rules for every command and option, taken from the program's own command line, so that new ones
// are covered.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/cli/command_line.h"
#include "app/cli/help/bash_completion.h"
#include "app/cli/help/man_page.h"
#include "app/cli/help/shown_commands.h"
#include "app/cli/help/usage.h"
#include "tests/cli/cli_fixture.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

// The command line as run_cli() makes it.
struct CommandLine {
    CommandResult result;
    CLI::App app;

    CommandLine() {
        add_commands(app, result, [](const EditArguments&) -> Expected<int> { return 0; });
    }
    // The message of usage_error() for words that cannot be parsed.
    Error refuse(const Words& words) {
        std::vector<std::string> all{"weft"};
        all.insert(all.end(), words.begin(), words.end());
        std::vector<const char*> argv;
        for (const std::string& word : all)
            argv.push_back(word.c_str());
        try {
            app.parse(static_cast<int>(argv.size()), argv.data());
        } catch (const CLI::ParseError& error) {
            return usage_error(app, error, static_cast<int>(argv.size()));
        }
        ADD_FAILURE() << "it was parsed";
        return {};
    }
};

void collect(const CLI::App& group, const Words& path, std::vector<Words>& out) {
    const auto commands =
        group.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); });
    if (!path.empty()) out.push_back(path);
    for (const CLI::App* command : commands) {
        Words longer = path;
        longer.push_back(command->get_name());
        collect(*command, longer, out);
    }
}

std::vector<Words> every_command() {
    std::vector<Words> out;
    collect(CommandLine().app, {}, out);
    return out;
}

const CLI::App& find(const CLI::App& app, const Words& path) {
    const CLI::App* at = &app;
    for (const std::string& word : path)
        at = at->get_subcommand(word);
    return *at;
}

std::string joined(const Words& path, const char* between) {
    std::string out;
    for (const std::string& word : path)
        out += (out.empty() ? "" : between) + word;
    return out;
}

std::string file(const std::string& name) {
    std::ifstream stream(source_folder() + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Words long_names(const CLI::App& command) {
    Words out;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;
        for (const std::string& name : option->get_lnames())
            if (name != "help" && name != "json") out.push_back("--" + name);
    }
    return out;
}

class EveryCommand : public CliTest, public ::testing::WithParamInterface<Words> {};

TEST_P(EveryCommand, HasJsonInItsHelp) {
    Words words = GetParam();
    words.push_back("--help");
    const Outcome outcome = run(words);
    expect_success(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("--json"));
    for (const char* theirs : {"INT", "UINT", "FLOAT", "{", " in [", "REQUIRED", "Excludes"})
        EXPECT_THAT(outcome.out, Not(HasSubstr(theirs)));
}

TEST_P(EveryCommand, AnswersAnErrorWithOneObject) {
    Words words = GetParam();
    words.insert(words.end(), {"--no-such-option", "--json"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit, 2);
    const Json answer = Json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(answer.is_object()) << outcome.out;
    EXPECT_EQ(answer["schema"], "weft.error/1");
    EXPECT_EQ(answer["exit_code"], 2);
    EXPECT_EQ(answer["error"]["code"], 2);
    EXPECT_EQ(answer["error"]["name"], "usage");
    EXPECT_FALSE(answer["error"].value("remedy", "").empty()) << outcome.out;
    expect_one_line(outcome.err, {answer["error"]["message"].get<std::string>()});
}

INSTANTIATE_TEST_SUITE_P(Interface, EveryCommand, ::testing::ValuesIn(every_command()),
                         [](const auto& command) { return joined(command.param, "_"); });

// Value errors contain no text of the libraries.
TEST(Interface, ValueErrorsAreInWeftsOwnWords) {
    int refused = 0;
    for (const Words& path : every_command()) {
        CommandLine line;  // parses one after the other: to make it takes longer than the parsing
        for (const std::string& option : long_names(find(line.app, path))) {
            for (const char* value : {"abc", "-1e99", "99999999999999999999"}) {
                Words words = path;
                // Missing required options, or unknown ones, run nothing.
                words.insert(words.end(), {option + "=" + value, "--no-such-option"});
                const Error error = line.refuse(words);
                SCOPED_TRACE(joined(words, " ") + ": " + error.text());
                EXPECT_EQ(error.code, ErrorCode::kUsage);
                for (const char* theirs :
                     {"Could not convert", "Check ", "not in range", "FAILED", "Value ", "->", "{",
                      "excludes", "requires", "TEXT", "INT"})
                    EXPECT_THAT(error.text(), Not(HasSubstr(theirs)));
                refused += error.text().find(value) != std::string::npos;
            }
        }
    }
    EXPECT_GT(refused, 100) << "options that take numbers or choices name what they were given";
}

struct Slip {
    Words words;
    std::string said, field;
};

class Slips : public ::testing::TestWithParam<Slip> {};

TEST_P(Slips, AreReportedInAFullSentence) {
    const Error error = CommandLine().refuse(GetParam().words);
    EXPECT_EQ(error.text(), GetParam().said);
    EXPECT_EQ(error_json(error)["error"].value("field", ""), GetParam().field);
}

INSTANTIATE_TEST_SUITE_P(
    Interface, Slips,
    ::testing::Values(
        Slip{{"doctor", "--nosuch"},
             "--nosuch is not an option of weft doctor. Run 'weft doctor --help'.",
             "--nosuch"},
        Slip{{"region", "frob"},
             "'frob' is not a command of weft region. Run 'weft region --help'.",
             ""},
        Slip{{"frob"}, "'frob' is not a command of weft. Run 'weft --help'.", ""},
        Slip{{"region"},
             "weft region needs a command: add, set, remove, correct or list. Run 'weft region "
             "--help'.",
             ""},
        Slip{{"synth", "a.png"}, "--output is missing. Run 'weft synth --help'.", "--output"},
        Slip{{"render"}, "The argument project is missing. Run 'weft render --help'.", ""},
        Slip{{"doctor", "x"},
             "weft doctor does not take the argument 'x'. Run 'weft doctor --help'.",
             ""},
        Slip{{"render", "a.weft", "--threads", "abc"},
             "--threads must be a whole number from 0 to 1024, not 'abc'.",
             "--threads"},
        Slip{{"render", "a.weft", "--threads", "2.5"},
             "--threads must be a whole number from 0 to 1024, not '2.5'.",
             "--threads"},
        Slip{{"render", "a.weft", "--progress", "loud"},
             "--progress must be plain, json, none or openjd, not 'loud'.",
             "--progress"},
        Slip{{"render", "a.weft", "--overwrite=perhaps"},
             "--overwrite must be true or false. Run 'weft render --help'.",
             "--overwrite"},
        Slip{{"render", "a.weft", "--report"},
             "--report needs a value. Run 'weft render --help'.",
             "--report"},
        Slip{{"region", "add", "a.weft", "--corners", "1,2", "3,4"},
             "--corners needs 4 values. Run 'weft region add --help'.",
             "--corners"},
        Slip{{"texture", "mark", "abcdef", "--favourite", "--no-favourite"},
             "--favourite and --no-favourite contradict each other. Leave one out.",
             "--favourite"},
        Slip{{"texture", "kept", "--words", "grey"},
             "--words needs --save-search. Give both or neither.",
             "--words"}));

// `word` occurs in `text`, not as the beginning of a longer option.
bool mentions(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const char after = at + word.size() < text.size() ? text[at + word.size()] : ' ';
        if (!std::isalnum(static_cast<unsigned char>(after)) && after != '-') return true;
    }
    return false;
}

TEST(Interface, AnErrorsFieldIsItsOptionOrItsPlaceInTheProject) {
    const auto field = [](const Error& error) {
        return error_json(error)["error"].value("field", "none");
    };
    const std::string wrong = "This is a string, but must be a number";
    EXPECT_EQ(
        field({ErrorCode::kUnreadable, "regions[0].placement.scale: " + wrong, "", {"a.weft"}}),
        "regions[0].placement.scale");
    EXPECT_EQ(field({ErrorCode::kUsage,
                     "No texture is set.",
                     "Set one.",
                     {"regions[1] 'wall': texture.sample", "shot.weft"}}),
              "regions[1].texture.sample");
    EXPECT_EQ(field({ErrorCode::kUsage, "--scale must be 1 to 2, not 0", "", {}}), "--scale");
    EXPECT_EQ(field({ErrorCode::kUnreadable, "It is not valid JSON", "", {"bad.weft"}}), "none");
    const auto refused = error_json({ErrorCode::kRefused, "No.", "Choose another.", {"a: b"}});
    EXPECT_EQ(Json::parse(refused["error"].dump()),
              Json::parse(R"({"code": 7, "name": "refused", "message": "a: b: No. Choose another.",
                              "remedy": "Choose another."})"));
}

TEST(Interface, DocumentsHaveEveryCommandAndOption) {
    const std::string shared = file("docs/CLI.md");
    const CommandLine line;
    for (const Words& path : every_command()) {
        std::string page = shared;
        if (path.front() == "texture") page += file("docs/TEXTURES.md");
        if (path.front() == "submit") page += file("docs/FARM.md");
        EXPECT_TRUE(mentions(page, "weft " + joined(path, " ")) ||
                    mentions(page, "`" + path.back()))
            << joined(path, " ");
        for (const CLI::Option* option : find(line.app, path).get_options()) {
            const auto names = option->get_lnames();
            if (names.empty() || option->get_group().empty() || names.front() == "help") continue;
            EXPECT_TRUE(
                std::any_of(names.begin(), names.end(),
                            [&](const std::string& name) { return mentions(page, "--" + name); }))
                << joined(path, " ") << " --" << names.front();
        }
    }
}

TEST(Interface, TheManualPageIsThatOfTheProgram) {
    EXPECT_EQ(file("packaging/linux/weft.1"), man_page(CommandLine().app))
        << "weft man > packaging/linux/weft.1";
}

// Runs the completion as bash does; the last word is unfinished.
using FileAsCommand = CliTest;

// As "Open with" starts it. Without a screen it says so, instead of calling the file no command.
TEST_F(FileAsCommand, OpensTheEditor) {
    make_shot(1);
    options_.environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    expect_failure(run({"frames/0001.png"}), 1, {"display"});
    const Outcome none = run({"frames/none.png"});
    EXPECT_EQ(none.exit, 2);
    EXPECT_THAT(none.err, ::testing::Not(::testing::HasSubstr("display")));
}

class Completion : public CliTest {
  protected:
    std::set<std::string> complete(const Words& words) const {
        std::string line = "cd '" + folder_.string() + "' && bash -c 'source \"" + source_folder() +
                           "/packaging/linux/weft.bash\"; COMP_WORDS=(weft";
        for (const std::string& word : words)
            line += " \"" + word + "\"";
        line += "); COMP_CWORD=" + std::to_string(words.size()) +
                "; _weft; printf \"%s\\n\" \"${COMPREPLY[@]}\"'";
        std::FILE* pipe = ::popen(line.c_str(), "r");
        std::string out;
        for (char part[256]; pipe && std::fgets(part, sizeof part, pipe);)
            out += part;
        if (pipe) ::pclose(pipe);
        std::set<std::string> found;
        std::istringstream stream(out);
        for (std::string word; std::getline(stream, word);)
            if (!word.empty()) found.insert(word);
        return found;
    }
};

TEST_F(Completion, IsThatOfTheProgram) {
    EXPECT_EQ(file("packaging/linux/weft.bash"), bash_completion(CommandLine().app))
        << "weft completion > packaging/linux/weft.bash";
}

TEST_F(Completion, KnowsEveryCommandAndOption) {
    const CommandLine line;
    std::filesystem::create_directory(folder_ / "region");
    std::filesystem::create_directory(folder_ / "texture");
    std::vector<Words> all = every_command();
    all.push_back({});
    for (Words path : all) {
        SCOPED_TRACE(joined(path, " "));
        const CLI::App& command = find(line.app, path);
        std::set<std::string> commands;
        for (const CLI::App* part : shown_commands(command))
            commands.insert(part->get_name());
        path.emplace_back("");
        if (!commands.empty()) {
            EXPECT_EQ(complete(path), commands);
            continue;
        }
        path.back() = "--";
        const std::set<std::string> offered = complete(path);
        for (const std::string& option : long_names(command))
            EXPECT_TRUE(offered.contains(option)) << option;
    }
    EXPECT_EQ(complete({"region", "a"}), (std::set<std::string>{"add"}));
    EXPECT_TRUE(complete({"region", "add", "shot.weft", "--sca"}).contains("--scale"));
    EXPECT_TRUE(complete({"render", ""}).empty()) << "files, by bash itself";
}

}  // namespace
}  // namespace weft::test
