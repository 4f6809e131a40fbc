#pragma once
// A process that goes on when this one ends.

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace weft {

/// Starts a program in a process group of its own, so that an interrupt in the terminal does not
/// stop it. Its standard output goes to the file `output`, not to a pipe, so that it continues when
/// this process ends; its errors go to `errors`. `variable`: "NAME=value", added to its
/// environment. Returns its id, or −1 if it cannot be started.
[[nodiscard]] pid_t start_detached(const std::vector<std::string>& arguments,
                                   const std::string& variable, const std::string& output,
                                   const std::string& errors);

/// Calls `line` for every line of the child's output until it ends; returns its exit status as of
/// waitpid().
[[nodiscard]] int follow_detached(pid_t pid, const std::string& output,
                                  const std::function<void(const std::string&)>& line);

}  // namespace weft
