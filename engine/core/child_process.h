#pragma once
// Child processes.

#include <sys/types.h>

#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

struct ProcessOptions {
    std::string folder;  ///< Working directory; empty: this process's.
    // Files for the streams; output files are created or truncated. Empty: inherited.
    std::string input, output, errors;
    int output_to = -1;  ///< A file descriptor for output and errors, instead of files.
    /// In a process group of its own: Ctrl+C in the terminal does not reach it.
    bool own_group = false;
};

/// Starts `arguments[0]` without a shell; a name without a slash is searched on PATH. Errors:
/// Unreadable if there is no such program or folder, NoSpace if no further process can be created.
/// Thread-safe.
[[nodiscard]] Expected<pid_t> start_process(const std::vector<std::string>& arguments,
                                            const ProcessOptions& options);

/// Waits until a process from start_process() has ended. Returns its exit code; 128 + the signal if
/// it was killed, as in shells; 127 if there is no such child.
[[nodiscard]] int wait_for_process(pid_t child);

}  // namespace weft
