#pragma once
// What a start of the program is made of, as it goes to start_server.cpp and as a plain start takes
// it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::test {

/// The environment variable that holds the server's end of the socket (SOCK_SEQPACKET). One message
/// asks for a start; the answers are the child's pid_t at once, and the int of waitpid when it has
/// ended.
inline constexpr char kStartSocket[] = "WEFT_START_SOCKET";
/// Bytes of one message; what is longer is started plainly.
inline constexpr std::size_t kLargestRequest = 100'000;

struct StartRequest {
    std::vector<std::string> words;        ///< The program's path and its arguments.
    std::vector<std::string> environment;  ///< NAME=VALUE.
    std::string folder;                    ///< To run in.
    std::string out_path, err_path;        ///< Files that take standard output and standard error.
    std::uint64_t largest_file_bytes = 0;  ///< RLIMIT_FSIZE; 0: none.

    [[nodiscard]] std::string encoded() const;
    static StartRequest decoded(std::string_view bytes);
    /// Makes this process what is asked for, but for words and environment. Safe between fork and
    /// exec. Returns false if the folder is not there.
    [[nodiscard]] bool enter() const;
};

}  // namespace weft::test
