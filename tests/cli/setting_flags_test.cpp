// Settings in messages on the command line: every setting is an existing option; old flag names are
// accepted but hidden.
#include "app/cli/setting_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/cli/command_line.h"
#include "app/project/codec/project_file.h"
#include "app/project/parameters.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

bool has_option(const CLI::App& app, const std::string& name) {
    const auto options =
        app.get_options([&](const CLI::Option* option) { return option->check_name(name); });
    if (!options.empty()) return true;
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    return std::any_of(commands.begin(), commands.end(),
                       [&](const CLI::App* command) { return has_option(*command, name); });
}

TEST(SettingFlags, AreOptionsAndCommandsOfTheProgram) {
    CommandResult result;
    CLI::App app;
    add_commands(app, result, [](const EditArguments&) -> Expected<int> { return 0; });
    for (const std::string_view key : setting::kAll) {
        SCOPED_TRACE(std::string(key));
        const std::string flag = setting_flag({key});
        ASSERT_FALSE(flag.empty());
        if (flag.starts_with("-")) {
            EXPECT_TRUE(has_option(app, flag)) << flag;
            continue;
        }
        ASSERT_TRUE(flag.starts_with("'weft ") && flag.ends_with("'")) << flag;
        const std::string word = flag.substr(6, flag.find_first_of(" '", 6) - 6);
        EXPECT_NO_THROW(static_cast<void>(app.get_subcommand(word))) << flag;
    }
}

TEST(SettingFlags, IncludeTheirValues) {
    EXPECT_EQ(setting_flag({setting::kReferenceFrame, "1012"}), "--reference-frame 1012");
    EXPECT_EQ(setting_flag({setting::kTrustFolder, "/proj"}), "'weft trust /proj'");
    EXPECT_EQ(setting_flag({"placement.scale"}), "--scale");
    EXPECT_EQ(setting_flag({"placement.nothing"}), "");
}

class OldFlags : public CliTest {};

TEST_F(OldFlags, AreAcceptedAndHidden) {
    const std::string help = run({"region", "set", "--help"}).out;
    int old_flags = 0;
    for (const auto& parameter : region_parameters()) {
        if (parameter.old_flag.empty()) continue;
        ++old_flags;
        EXPECT_THAT(help, HasSubstr(std::string(parameter.flag)));
        EXPECT_THAT(help, Not(HasSubstr(std::string(parameter.old_flag))));
    }
    EXPECT_GT(old_flags, 0);

    const std::string path = (folder_ / "a.weft").string();
    expect_success(run({"new", path, "--plate", "frames/####.png"}));
    expect_success(run({"region", "add", path, "--name", "wall", "--matte", "masks/####.png",
                        "--texture", "a.png", "--focus", "0.5", "--light-form", "detail"}));
    expect_success(run({"region", "set", path, "wall", "--matte-carry", "forward"}));
    const auto project = load_project(path);
    ASSERT_TRUE(project) << project.error().text();
    const Region& region = *project->regions.front();
    EXPECT_EQ(region.finish.focus, 0.5);
    EXPECT_EQ(region.light.form, LightForm::kDetail);
    EXPECT_EQ(region.matte->propagate_direction, PropagationDirection::kForward);
}

}  // namespace
}  // namespace weft::test
