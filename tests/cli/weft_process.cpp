#include "tests/cli/weft_process.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "tests/cli/program_start.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

std::string read_all(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The test's environment with some variables replaced.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
    std::vector<std::string> all;
    for (char** entry = environ; *entry; ++entry) {
        const std::string text(*entry);
        if (!changes.contains(text.substr(0, text.find('=')))) all.push_back(text);
    }
    for (const auto& [name, value] : changes)
        all.push_back(name + "=" + value);
    return all;
}

// What libraries read while they are loaded must be there by then.
bool may_be_served(const ProcessOptions& options) {
    static const std::set<std::string> read_later = {"TMPDIR", "HOME", "XDG_CACHE_HOME", "OCIO"};
    return std::all_of(options.environment.begin(), options.environment.end(),
                       [](const auto& entry) { return read_later.contains(entry.first); });
}

// Returns the status of waitpid.
int wait_for(Start& start, const ProcessOptions& options) {
    bool sent = options.signal == 0;
    const auto begin = std::chrono::steady_clock::now();
    const auto is_time = [&] {
        return options.signal_after.count() > 0
                   ? std::chrono::steady_clock::now() - begin >= options.signal_after
                   : std::filesystem::exists(options.signal_when);
    };
    for (;;) {
        if (const auto status = start.ended(!sent)) return *status;
        if (!sent && is_time()) {
            kill(start.process(), options.signal);
            sent = true;
        }
        if (!sent) std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
}

}  // namespace

Outcome run_weft(const std::vector<std::string>& arguments, const ProcessOptions& options) {
    StartRequest request;
    request.words = {weft_program()};
    request.words.insert(request.words.end(), arguments.begin(), arguments.end());
    request.environment = environment_with(options.environment);
    request.folder = options.folder.string();
    const std::string kept = (options.folder / ".stdout").string();
    request.out_path = options.standard_output.empty() ? kept : options.standard_output.string();
    request.err_path = (options.folder / ".stderr").string();
    request.largest_file_bytes = options.largest_file_bytes;
    Outcome outcome;
    {
        const auto start = start_program(request, may_be_served(options));
        const int status = wait_for(*start, options);
        outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    if (request.out_path == kept) outcome.out = read_all(kept);
    outcome.err = read_all(request.err_path);
    std::filesystem::remove(kept);
    std::filesystem::remove(request.err_path);
    return outcome;
}

}  // namespace weft::test
