#include "tests/cli/weft_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/support/places.h"

namespace weft::test {
namespace {

std::string read_all(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Runs in the child between fork and exec: only calls that are safe there.
[[noreturn]] void become(const std::vector<char*>& argv, const std::vector<char*>& environment,
                         const ProcessOptions& options, const std::string& out,
                         const std::string& err) {
    constexpr int kCreate = O_WRONLY | O_CREAT | O_TRUNC;
    const int out_fd = open(out.c_str(), kCreate, 0600), err_fd = open(err.c_str(), kCreate, 0600);
    dup2(out_fd, STDOUT_FILENO);
    dup2(err_fd, STDERR_FILENO);
    if (chdir(options.folder.c_str()) != 0) _exit(126);
    if (options.largest_file_bytes > 0) {
        const rlimit limit{options.largest_file_bytes, options.largest_file_bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    execve(argv[0], argv.data(), environment.data());
    _exit(127);
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

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> out;
    for (std::string& word : words)
        out.push_back(word.data());
    out.push_back(nullptr);
    return out;
}

int wait_for(pid_t child, const ProcessOptions& options) {
    bool sent = options.signal == 0;
    const auto start = std::chrono::steady_clock::now();
    const auto is_time = [&] {
        return options.signal_after.count() > 0
                   ? std::chrono::steady_clock::now() - start >= options.signal_after
                   : std::filesystem::exists(options.signal_when);
    };
    for (;;) {
        int status = 0;
        const pid_t ended = waitpid(child, &status, sent ? 0 : WNOHANG);
        if (ended == child) return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        if (!sent && is_time()) {
            kill(child, options.signal);
            sent = true;
        }
        if (!sent) std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
}

}  // namespace

Outcome run_weft(const std::vector<std::string>& arguments, const ProcessOptions& options) {
    std::vector<std::string> words{weft_program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables = environment_with(options.environment);
    const std::vector<char*> argv = pointers(words), environment = pointers(variables);

    const std::string kept = (options.folder / ".stdout").string();
    const std::string out =
        options.standard_output.empty() ? kept : options.standard_output.string();
    const std::string err = (options.folder / ".stderr").string();
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) become(argv, environment, options, out, err);
    Outcome outcome;
    outcome.exit = wait_for(child, options);
    if (out == kept) outcome.out = read_all(out);
    outcome.err = read_all(err);
    std::filesystem::remove(kept);
    std::filesystem::remove(err);
    return outcome;
}

}  // namespace weft::test
