#pragma once
// Programs that this one starts.

#include <sys/types.h>

#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

struct ProcessOptions {
    std::string folder;  ///< Where it runs; empty: in this one's.
    // Files; those that are written are made anew. Empty: what this process has.
    std::string input, output, errors;
    int output_to = -1;      ///< A descriptor for output and errors, instead of files.
    bool own_group = false;  ///< An interrupt in this process's terminal is not for it.
};

/// Starts `arguments[0]`, which is looked for on PATH when it has no slash, without a shell in
/// between. Errors: Unreadable when there is no such program or folder, NoSpace when there can be
/// no further process. Thread-safe.
[[nodiscard]] Expected<pid_t> start_process(const std::vector<std::string>& arguments,
                                            const ProcessOptions& options);

/// Waits until the process that was started has ended. Its exit code; 128 + the signal when it was
/// killed, as shells have it; 127 when there is no such child.
[[nodiscard]] int wait_for_process(pid_t child);

}  // namespace weft
