#pragma once
// Output streams: results and progress go to stdout, messages to stderr. With --json, stdout holds
// exactly one object and progress goes to stderr.

#include <cstdio>
#include <string>
#include <string_view>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace weft {

/// kOpenJd: lines that Open Job Description parses from stdout.
enum class ProgressStyle { kPlain, kJson, kNone, kOpenJd };

/// Prints and flushes, so a farm's log is always current. Control characters other than line breaks
/// and tabs are escaped as in JSON (engine/core/printable.h). Pass text from files, which may
/// contain line breaks, through printable() first.
void print(std::FILE* stream, std::string_view text);
void print_warning(std::string_view text);
/// Prints the error to stderr, and to the progress stream for Open Job Description.
void report_error(const Error& error);

/// Returns true if --json was given. Set once, before a command runs.
[[nodiscard]] bool json_output();
void set_json_output(bool on);

/// Prints one line per finished frame: "frame 1042 37/100 37.0% 1.84s", or the name of another
/// stage. To stdout, or to stderr with --json.
[[nodiscard]] ProgressFn progress_printer(ProgressStyle style);

/// A token that SIGINT and SIGTERM cancel (exit codes 130 and 143). If the process does not stop
/// within 1.5 s it is ended; temporary files are removed first.
[[nodiscard]] CancelToken cancel_on_signals();

}  // namespace weft
