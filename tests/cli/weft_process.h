#pragma once
// Runs the real program as a child process.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace weft::test {

struct Outcome {
    int exit = -1;  ///< 128 + the signal's number where a signal ended the process.
    std::string out, err;
};

struct ProcessOptions {
    std::filesystem::path folder;                    ///< The child's working directory.
    std::map<std::string, std::string> environment;  ///< Besides the test's own.
    std::uint64_t largest_file_bytes = 0;            ///< RLIMIT_FSIZE; 0: none.
    std::filesystem::path standard_output;           ///< Empty: kept for Outcome::out.
    /// When this file exists, `signal` is sent to the child.
    std::filesystem::path signal_when;
    /// Or this long after the start, where it is above 0.
    std::chrono::microseconds signal_after{0};
    int signal = 0;
};

/// The child's exit code and what it wrote. Blocks until it has ended.
Outcome run_weft(const std::vector<std::string>& arguments, const ProcessOptions& options);

}  // namespace weft::test
