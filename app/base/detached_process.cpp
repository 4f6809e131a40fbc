#include "app/base/detached_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

extern char** environ;

namespace weft {

pid_t start_detached(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& variables, const std::string& output,
                     const std::string& errors) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), kNew, 0644);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), kNew, 0644);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    std::vector<char*> argv, environment;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    for (char** entry = environ; *entry; ++entry)
        environment.push_back(*entry);
    for (const std::string& variable : variables)
        environment.push_back(const_cast<char*>(variable.c_str()));
    environment.push_back(nullptr);
    pid_t pid = -1;
    if (posix_spawn(&pid, argv[0], &actions, &attributes, argv.data(), environment.data()) != 0)
        pid = -1;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return pid;
}

std::vector<std::string> WrittenLines::next() {
    if (!file_) {
        if (auto opened = InputFile::open(path_)) file_ = std::move(*opened);
    }
    char buffer[4096];
    while (file_) {
        const std::size_t got = file_->read_at(offset_, buffer, sizeof buffer).value_or(0);
        if (got == 0) break;
        pending_.append(buffer, got);
        offset_ += got;
    }
    std::vector<std::string> out;
    for (std::size_t end = pending_.find('\n'); end != std::string::npos;
         end = pending_.find('\n')) {
        out.push_back(pending_.substr(0, end));
        pending_.erase(0, end + 1);
    }
    return out;
}

}  // namespace weft
