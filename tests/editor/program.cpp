#include "tests/editor/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/support/places.h"

extern char** environ;

namespace weft::test {

namespace fs = std::filesystem;

Sandbox::Sandbox() {
    std::string name = (fs::temp_directory_path() / "weft_editor_XXXXXX").string();
    folder_ = mkdtemp(name.data());
}

Sandbox::~Sandbox() {
    std::error_code error;
    fs::remove_all(folder_, error);
}

std::vector<std::string> without_library(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--db", "/proc/no library"});
    return arguments;
}

pid_t start(const Sandbox& sandbox, const std::vector<std::string>& arguments,
            const std::string& display) {
    std::vector<std::string> environment;
    for (char** entry = environ; *entry; ++entry) {
        const std::string text = *entry;
        if (text.starts_with("DISPLAY=") || text.starts_with("WAYLAND_DISPLAY=") ||
            text.starts_with("HOME=") || text.starts_with("XDG_"))
            continue;
        environment.push_back(text);
    }
    environment.push_back("HOME=" + sandbox.in("home"));
    if (!display.empty()) environment.push_back("DISPLAY=" + display);
    std::vector<char*> argv, envp;
    std::string program = weft_program();
    argv.push_back(program.data());
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    for (std::string& entry : environment)
        envp.push_back(entry.data());
    envp.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string errors = sandbox.in("stderr");
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    pid_t pid = -1;
    if (posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), envp.data()) != 0) pid = -1;
    posix_spawn_file_actions_destroy(&actions);
    return pid;
}

bool has_ended(pid_t pid) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == pid;
}

Finished finish(const Sandbox& sandbox, pid_t pid) {
    Finished out;
    int status = 0;
    if (pid > 0 && waitpid(pid, &status, 0) == pid)
        out.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    std::ifstream file(sandbox.in("stderr"));
    out.errors.assign(std::istreambuf_iterator<char>(file), {});
    return out;
}

Finished run(const Sandbox& sandbox, const std::vector<std::string>& arguments) {
    return finish(sandbox, start(sandbox, arguments));
}

bool cannot_draw(const Finished& ended) {
    return ended.errors.find("OpenGL 3.3 is not available") != std::string::npos ||
           ended.errors.find("cannot draw without a display") != std::string::npos;
}

std::vector<pid_t> children_of(pid_t pid) {
    std::vector<pid_t> out;
    std::error_code error;
    for (const auto& task :
         fs::directory_iterator("/proc/" + std::to_string(pid) + "/task", error)) {
        std::ifstream file(task.path() / "children");
        for (pid_t child = 0; file >> child;)
            out.push_back(child);
    }
    return out;
}

bool runs(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t name_end = text.rfind(')');
    return name_end != std::string::npos && text.compare(name_end + 2, 1, "Z") != 0;
}

bool has_tool(const std::string& name) {
    std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "");
    for (std::string folder; std::getline(path, folder, ':');)
        if (access((folder + "/" + name).c_str(), X_OK) == 0) return true;
    return false;
}

}  // namespace weft::test
