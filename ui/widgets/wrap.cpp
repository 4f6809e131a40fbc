#include "ui/widgets/wrap.h"

namespace weft::ui {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Whether a line may end at the space at `at`.
bool may_break(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, at), after = text.substr(at + 1);
    if (before.ends_with("±")) return false;
    const bool unit = after.starts_with("%") || after.starts_with("px") || after.starts_with("±") ||
                      after.starts_with("×");
    return !(unit && (before.empty() || is_digit(before.back()) || before.ends_with("°")));
}

// The place of the next space that a line may end at, or the end.
std::size_t next_break(std::string_view text, std::size_t from) {
    for (std::size_t at = from; at < text.size(); ++at)
        if (text[at] == ' ' && may_break(text, at)) return at;
    return text.size();
}

void add_paragraph(std::string_view text, float width,
                   const std::function<float(std::string_view)>& measure, std::string& out) {
    std::size_t line = 0, end = next_break(text, 0);
    while (end < text.size()) {
        const std::size_t next = next_break(text, end + 1);
        if (measure(text.substr(line, next - line)) > width) {
            out.append(text.substr(line, end - line)).push_back('\n');
            line = end + 1;
        }
        end = next;
    }
    out.append(text.substr(line));
}

}  // namespace

std::string wrapped_at_words(std::string_view text, float width,
                             const std::function<float(std::string_view)>& measure) {
    std::string out;
    for (;;) {
        const std::size_t end = text.find('\n');
        add_paragraph(text.substr(0, end), width, measure, out);
        if (end == std::string_view::npos) return out;
        out.push_back('\n');
        text.remove_prefix(end + 1);
    }
}

}  // namespace weft::ui
