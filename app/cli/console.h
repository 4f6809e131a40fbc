#pragma once
// What goes to which stream: results and progress to stdout, messages to stderr. With --json
// exactly one object goes to stdout and progress to stderr.

#include <cstdio>
#include <string>
#include <string_view>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace weft {

/// kOpenJd: the lines that Open Job Description reads on stdout.
enum class ProgressStyle { kPlain, kJson, kNone, kOpenJd };

/// Prints to a stream and flushes it, so that a farm's log is never behind. Control characters but
/// line breaks and tabs are escaped as JSON has it (engine/core/printable.h); what comes from files
/// and may hold line breaks goes through printable() before.
void print(std::FILE* stream, std::string_view text);
void print_warning(std::string_view text);
/// Prints the error to stderr, and among the progress too where Open Job Description listens.
void report_error(const Error& error);

/// Whether --json was given: stdout then belongs to the one object that conclude() prints, and
/// progress goes to stderr. Set once, before a command runs.
[[nodiscard]] bool json_output();
void set_json_output(bool on);

/// One line for each finished frame: "frame 1042 37/100 37.0% 1.84s"; other stages by name.
/// It goes to stdout, and to stderr with --json.
[[nodiscard]] ProgressFn progress_printer(ProgressStyle style);

/// A token that SIGINT and SIGTERM cancel, with the exit codes 130 and 143. What has not ended by
/// itself 1.5 s later is ended: the process then leaves no temporary file behind.
[[nodiscard]] CancelToken cancel_on_signals();

}  // namespace weft
