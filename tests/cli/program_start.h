#pragma once
// Starts a program, where possible as a copy of one that is loaded already (start_server.cpp).

#include <sys/types.h>

#include <memory>
#include <optional>

#include "tests/cli/start_request.h"

namespace weft::test {

/// A child process. Its owner waits for its end before it goes.
class Start {
  public:
    Start() = default;
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;
    virtual ~Start() = default;
    [[nodiscard]] virtual pid_t process() const = 0;
    /// The status of waitpid, once it has ended. Blocks until then unless `at_once`.
    virtual std::optional<int> ended(bool at_once) = 0;
};

/// `served`: as a copy, which takes a twentieth of the time. Plainly all the same where a sanitizer
/// is at work, or where another start is being served. Any thread.
std::unique_ptr<Start> start_program(const StartRequest& request, bool served);

}  // namespace weft::test
