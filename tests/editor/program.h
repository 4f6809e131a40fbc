#pragma once
// Running the program under test.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace weft::test {

/// A folder of its own for everything that the program keeps, removed at the end.
class Sandbox {
  public:
    Sandbox();
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }

  private:
    std::filesystem::path folder_;
};

struct Finished {
    int code = -1;  ///< Exit code; −signal when it was killed.
    std::string errors;
};

/// `arguments` and a texture library that cannot be there: an editor in a new home else makes the
/// starter textures, two seconds of work in the middle of what is tested.
std::vector<std::string> without_library(std::vector<std::string> arguments);

/// Starts the program with the sandbox as its home. `display`: of X11, or empty for none.
[[nodiscard]] pid_t start(const Sandbox& sandbox, const std::vector<std::string>& arguments,
                          const std::string& display = {});
/// Whether it has ended; it is still to be finished.
[[nodiscard]] bool has_ended(pid_t pid);
[[nodiscard]] Finished finish(const Sandbox& sandbox, pid_t pid);
[[nodiscard]] Finished run(const Sandbox& sandbox, const std::vector<std::string>& arguments);
/// Whether it ended because nothing can be drawn on this machine.
[[nodiscard]] bool cannot_draw(const Finished& ended);
/// The processes that it has started and that still run.
[[nodiscard]] std::vector<pid_t> children_of(pid_t pid);
/// Whether there is such a process that has not ended.
[[nodiscard]] bool runs(pid_t pid);
/// Whether a program is there, on PATH.
[[nodiscard]] bool has_tool(const std::string& name);

}  // namespace weft::test
