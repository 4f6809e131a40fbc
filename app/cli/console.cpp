#include "app/cli/console.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/core/printable.h"
#include "engine/core/text.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

bool speaks_openjd = false;
bool answers_json = false;

// The only data that signal handlers access. Never destroyed, because a signal or end_in_time() may
// come during exit.
const CancelToken& signal_token() {
    static const auto* const token = new CancelToken;
    return *token;
}
int signal_pipe[2] = {-1, -1};

void on_signal(int signal) {
    const int saved = errno;
    signal_token().cancel(signal == SIGINT ? 130 : 143);
    const char byte = 0;
    [[maybe_unused]] const ssize_t written = ::write(signal_pipe[1], &byte, 1);
    errno = saved;
}

// Ends the process if cancelling takes too long. Work checks the token between steps, and one step
// of a large plate may be slow. No incomplete frame becomes visible, because frames are written
// under temporary names; those are removed here.
void end_in_time() {
    constexpr auto kGrace = std::chrono::milliseconds(1500);
    char byte = 0;
    while (::read(signal_pipe[0], &byte, 1) != 1) {
        if (errno != EINTR) return;
    }
    std::this_thread::sleep_for(kGrace);
    abandon_temporaries();
    static constexpr char kMessage[] = "weft: Stopped on request.\n";
    [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
    ::_exit(signal_token().reason());
}

std::string plain_line(const ProgressEvent& e) {
    char line[160];
    const double percent =
        e.total > 0 ? 100.0 * static_cast<double>(e.done) / static_cast<double>(e.total) : 100.0;
    const std::string stage = e.stage == WorkStage::kRender ? "" : e.name() + " ";
    std::snprintf(line, sizeof line, "%sframe %d %lld/%lld %.1f%% %.2fs\n", stage.c_str(), e.frame,
                  static_cast<long long>(e.done), static_cast<long long>(e.total), percent,
                  e.seconds);
    return line;
}

// Open Job Description wants a percentage that never decreases within a task; a task has one stage
// or a few.
std::string openjd_lines(const ProgressEvent& e) {
    char line[160];
    const double percent =
        e.total > 0 ? 100.0 * static_cast<double>(e.done) / static_cast<double>(e.total) : 100.0;
    std::snprintf(line, sizeof line, "openjd_status: %s frame %d\nopenjd_progress: %.1f\n",
                  e.name().c_str(), e.frame, percent);
    return line;
}

std::string json_line(const ProgressEvent& e) {
    return nlohmann::ordered_json{{"stage", e.name()},
                                  {"frame", e.frame},
                                  {"done", e.done},
                                  {"total", e.total},
                                  {"seconds", e.seconds}}
               .dump() +
           "\n";
}

// With --json, stdout holds only the answer.
std::FILE* progress_stream() {
    return answers_json ? stderr : stdout;
}

}  // namespace

void print(std::FILE* stream, std::string_view text) {
    const std::string safe = printable(text, LineBreaks::kKeep);
    std::fwrite(safe.data(), 1, safe.size(), stream);
    std::fflush(stream);
}

void print_warning(std::string_view text) {
    print(stderr, "weft: warning: " + printable(text) + "\n");
}

void report_error(const Error& error) {
    const std::string line = printable(shortened_words(error.text()));
    print(stderr, "weft: " + line + "\n");
    if (speaks_openjd) print(progress_stream(), "openjd_fail: " + line + "\n");
}

bool json_output() {
    return answers_json;
}

void set_json_output(bool on) {
    answers_json = on;
}

ProgressFn progress_printer(ProgressStyle style) {
    if (style == ProgressStyle::kNone) return {};
    if (style == ProgressStyle::kOpenJd) {
        speaks_openjd = true;
        return [](const ProgressEvent& event) { print(progress_stream(), openjd_lines(event)); };
    }
    return [style, stream = progress_stream()](const ProgressEvent& event) {
        print(stream, style == ProgressStyle::kPlain ? plain_line(event) : json_line(event));
    };
}

CancelToken cancel_on_signals() {
    const CancelToken token = signal_token();
    static std::once_flag once;
    std::call_once(once, [] {
        if (::pipe(signal_pipe) == 0) std::thread(end_in_time).detach();
    });
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    return token;
}

}  // namespace weft
