#pragma once
// A process that goes on when this one ends.

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/input_file.h"

namespace weft {

/// Starts a program in a process group of its own, so that an interrupt in the terminal does not
/// stop it. Its standard output goes to the file `output`, not to a pipe, so that it continues when
/// this process ends; its errors go to `errors`. `variables`: each "NAME=value", added to its
/// environment. Returns its id, or −1 if it cannot be started.
[[nodiscard]] pid_t start_detached(const std::vector<std::string>& arguments,
                                   const std::vector<std::string>& variables,
                                   const std::string& output, const std::string& errors);

/// The lines that another process writes to a file, as far as they are there. The file must not be
/// replaced by another one.
class WrittenLines {
  public:
    explicit WrittenLines(std::string path) : path_(std::move(path)) {}
    /// The lines that were completed since the last call; none without the file.
    [[nodiscard]] std::vector<std::string> next();

  private:
    std::string path_, pending_;
    std::optional<InputFile> file_;
    std::uint64_t offset_ = 0;
};

}  // namespace weft
