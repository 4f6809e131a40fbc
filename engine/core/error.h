#pragma once
// Errors are values. A function that can fail returns Expected<T>; libraries that throw are caught
// once, at the boundary where they are called.

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace weft {

/// What kind of failure, and the process's exit code for it (documented in docs/CLI.md, stable).
enum class ErrorCode : int {
    kRenderFailed = 1,
    kUsage = 2,       ///< Contradictory or impossible request.
    kUnreadable = 3,  ///< A project or an input that cannot be read, or is of the wrong kind.
    kMissingFrames = 4,
    kNoBackend = 5,
    kNoSpace = 6,  ///< Out of disk or memory.
    kRefused = 7,  ///< Refused by policy.
    kDiffers = 8,  ///< Verification found a difference.
    kInterrupted = 130,
    kTerminated = 143,
};

[[nodiscard]] inline int exit_code(ErrorCode code) {
    return static_cast<int>(code);
}

/// What happened to what, and what to do about it, each on one line without a line break; `context`
/// holds the callers' words, innermost first. A message that ends in a full stop is followed by a
/// remedy of whole sentences; one without by a clause ("… is not a number", "give each key its
/// frame"). The remedy is empty where there is nothing to do.
struct Error {
    ErrorCode code = ErrorCode::kRenderFailed;
    std::string message;
    std::string remedy;
    std::vector<std::string> context;

    /// Message and remedy, "It is there. Choose another." or "it is not a number; remove it".
    [[nodiscard]] std::string sentence() const;
    /// "context: sentence" in one line, outermost context first.
    [[nodiscard]] std::string text() const;
};

template <class T>
using Expected = tl::expected<T, Error>;
using Status = Expected<void>;

[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message,
                                                std::string remedy = {}) {
    return tl::unexpected<Error>(Error{code, std::move(message), std::move(remedy), {}});
}

/// The same error with one more context in front.
[[nodiscard]] inline tl::unexpected<Error> fail_in(Error error, std::string context) {
    error.context.push_back(std::move(context));
    return tl::unexpected<Error>(std::move(error));
}

}  // namespace weft

// Leaves the function with the error of an Expected, or goes on. WEFT_TRY(var, expr) also takes the
// value out: WEFT_TRY(frame, reader.read(12));
#define WEFT_CONCAT_(a, b) a##b
#define WEFT_CONCAT(a, b) WEFT_CONCAT_(a, b)
#define WEFT_CHECK_OK(expr)                                                         \
    do {                                                                            \
        if (auto weft_status = (expr); !weft_status)                                \
            return ::tl::unexpected<::weft::Error>(std::move(weft_status).error()); \
    } while (false)
#define WEFT_TRY(var, expr)                                       \
    auto WEFT_CONCAT(weft_try_, __LINE__) = (expr);               \
    if (!WEFT_CONCAT(weft_try_, __LINE__))                        \
        return ::tl::unexpected<::weft::Error>(                   \
            std::move(WEFT_CONCAT(weft_try_, __LINE__)).error()); \
    auto var = std::move(*WEFT_CONCAT(weft_try_, __LINE__))
