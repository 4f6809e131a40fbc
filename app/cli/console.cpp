#include "app/cli/console.h"

#include <csignal>

#include <nlohmann/json.hpp>

namespace weft {
namespace {

// Signal handlers may touch nothing but this flag.
const CancelToken& signal_token() {
    static const CancelToken token;
    return token;
}

void on_signal(int signal) {
    signal_token().cancel(signal == SIGINT ? 130 : 143);
}

std::string plain_line(const ProgressEvent& e) {
    char line[160];
    const double percent =
        e.total > 0 ? 100.0 * static_cast<double>(e.done) / static_cast<double>(e.total) : 100.0;
    const bool rendered = e.stage == "render";
    std::snprintf(line, sizeof line, "%s%sframe %d %lld/%lld %.1f%% %.2fs\n",
                  rendered ? "" : e.stage.c_str(), rendered ? "" : " ", e.frame,
                  static_cast<long long>(e.done), static_cast<long long>(e.total), percent,
                  e.seconds);
    return line;
}

std::string json_line(const ProgressEvent& e) {
    return nlohmann::ordered_json{{"stage", e.stage},
                                  {"frame", e.frame},
                                  {"done", e.done},
                                  {"total", e.total},
                                  {"seconds", e.seconds}}
               .dump() +
           "\n";
}

}  // namespace

void print(std::FILE* stream, std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stream);
    std::fflush(stream);
}

void print_warning(std::string_view text) {
    print(stderr, "weft: warning: " + std::string(text) + "\n");
}

int report_error(const Error& error) {
    print(stderr, "weft: " + error.text() + "\n");
    return exit_code(error.code);
}

ProgressFn progress_printer(ProgressStyle style, bool to_stderr) {
    if (style == ProgressStyle::kNone) return {};
    return [style, stream = to_stderr ? stderr : stdout](const ProgressEvent& event) {
        print(stream, style == ProgressStyle::kPlain ? plain_line(event) : json_line(event));
    };
}

CancelToken cancel_on_signals() {
    const CancelToken token = signal_token();
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    return token;
}

}  // namespace weft
