// weft trust.

#include <memory>

#include "app/base/trust.h"
#include "app/cli/command_line.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

struct TrustOptions {
    std::string folder, remove;
    bool list = false;
};

// The current list.
Answer list_answer(const TrustList& trusted) {
    Answer answer;
    answer.json = {
        {"schema", "weft.trust/1"}, {"file", trusted.file()}, {"folders", Json::array()}};
    for (const TrustedFolder& folder : trusted.folders()) {
        answer.json["folders"].push_back({{"path", folder.path}, {"below", folder.below}});
        answer.text += folder.path + (folder.below ? "  with all folders below\n" : "\n");
    }
    return answer;
}

CommandResult trust_command(const TrustOptions& options) {
    if (options.list + !options.folder.empty() + !options.remove.empty() != 1)
        return fail(ErrorCode::kUsage, "Give a folder to trust, or --remove FOLDER, or --list.");
    TrustList trusted = TrustList::of_user();
    if (options.list) return list_answer(trusted);
    std::string told = "Removed " + options.remove + ".\n";
    if (!options.folder.empty()) {
        WEFT_TRY(added, trusted.add(options.folder, true));
        told = "Trusted " + added + " with all folders below.\n";
    } else {
        WEFT_CHECK_OK(trusted.remove(options.remove));
    }
    Answer answer = list_answer(trusted);
    answer.text = told;
    return answer;
}

}  // namespace

void add_trust_command(CLI::App& app, CommandResult& result) {
    CLI::App* command =
        app.add_subcommand("trust", "Let the projects of a folder write outside it");
    const auto options = std::make_shared<TrustOptions>();
    command->add_option("folder", options->folder, "Folder of projects, with all folders below")
        ->type_name("PATH");
    command->add_option("--remove", options->remove, "Remove this folder from the list")
        ->type_name("PATH");
    command->add_flag("--list", options->list, "Print the trusted folders");
    command->footer(
        "A project in an untrusted folder writes only inside that folder, or where you say (-o, "
        "--output-root).\n"
        "Examples:\n  weft trust /proj/sh010\n  weft trust --list\n  weft trust --remove "
        "/proj/sh010");
    on_run(*command, result, [=] { return trust_command(*options); });
}

}  // namespace weft
