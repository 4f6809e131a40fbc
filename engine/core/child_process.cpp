#include "engine/core/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace weft {
namespace {

class SpawnSettings {
  public:
    SpawnSettings() {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
    }
    ~SpawnSettings() {
        posix_spawnattr_destroy(&attributes_);
        posix_spawn_file_actions_destroy(&actions_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    void read_from(const std::string& path) {
        if (!path.empty())
            posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, path.c_str(), O_RDONLY, 0);
    }
    void write_to(int stream, const std::string& path) {
        if (!path.empty())
            posix_spawn_file_actions_addopen(&actions_, stream, path.c_str(),
                                             O_WRONLY | O_CREAT | O_TRUNC, 0644);
    }
    void write_to(int stream, int descriptor) {
        if (descriptor >= 0) posix_spawn_file_actions_adddup2(&actions_, descriptor, stream);
    }
    void run_in(const std::string& folder) {
        if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    }
    void leave_group() {
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }
    [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

Expected<pid_t> start_process(const std::vector<std::string>& arguments,
                              const ProcessOptions& options) {
    SpawnSettings settings;
    settings.read_from(options.input);
    settings.write_to(STDOUT_FILENO, options.output);
    settings.write_to(STDERR_FILENO, options.errors);
    settings.write_to(STDOUT_FILENO, options.output_to);
    settings.write_to(STDERR_FILENO, options.output_to);
    settings.run_in(options.folder);
    if (options.own_group) settings.leave_group();
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = -1;
    const int failed = posix_spawnp(&child, argv[0], settings.actions(), settings.attributes(),
                                    argv.data(), environ);
    if (failed == 0) return child;
    const bool short_of = failed == EAGAIN || failed == ENOMEM || failed == ENOSPC;
    return fail(short_of ? ErrorCode::kNoSpace : ErrorCode::kUnreadable,
                arguments.front() + " cannot be started: " + std::strerror(failed) + ".");
}

int wait_for_process(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace weft
