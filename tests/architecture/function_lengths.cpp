#include "tests/architecture/function_lengths.h"

#include <algorithm>
#include <cctype>

namespace weft::architecture {
namespace {

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

// The end of the text from `at` to `end`; the end of the text if it is not closed.
std::size_t past(std::string_view text, std::size_t at, std::string_view end) {
    const std::size_t found = text.find(end, at);
    return found == std::string_view::npos ? text.size() : found + end.size();
}

std::size_t past_literal(std::string_view text, std::size_t at) {
    const char quote = text[at++];
    while (at < text.size() && text[at] != quote && text[at] != '\n')
        at += text[at] == '\\' ? 2 : 1;
    return std::min(at + 1, text.size());
}

// A raw string R"tag( … )tag"; `at` is the position of the quote.
std::size_t past_raw_literal(std::string_view text, std::size_t at) {
    const std::size_t open = std::min(text.find('(', at), text.size());
    return past(text, open, ")" + std::string(text.substr(at + 1, open - at - 1)) + "\"");
}

std::size_t past_directive(std::string_view text, std::size_t at) {
    while (at < text.size() && text[at] != '\n')
        at += text[at] == '\\' ? 2 : 1;
    return std::min(at, text.size());
}

// The end of the comment, literal or preprocessor line at `at`; `at` if there is none.
std::size_t past_skipped(std::string_view text, std::size_t at) {
    const std::string_view rest = text.substr(at);
    const char before = at > 0 ? text[at - 1] : '\n';
    if (rest.starts_with("//")) return std::min(text.find('\n', at), text.size());
    if (rest.starts_with("/*")) return past(text, at + 2, "*/");
    if (rest[0] == '"' && before == 'R') return past_raw_literal(text, at);
    if (rest[0] == '"') return past_literal(text, at);
    // The quote in 1'000 does not begin a literal.
    if (rest[0] == '\'' && !is_word(before)) return past_literal(text, at);
    if (rest[0] == '#') {
        const std::size_t line = text.find_last_of('\n', at);
        const std::size_t begin = line == std::string_view::npos ? 0 : line + 1;
        if (text.substr(begin, at - begin).find_first_not_of(" \t") == std::string_view::npos)
            return past_directive(text, at);
    }
    return at;
}

// The text with skipped parts blanked; line numbers stay.
std::string code_of(std::string_view text) {
    std::string out(text);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = past_skipped(text, at);
        for (std::size_t k = at; k < end; ++k)
            if (out[k] != '\n') out[k] = ' ';
        at = std::max(end, at + 1);
    }
    return out;
}

enum class Brace { kScope, kFunction, kVariable, kPart };

bool has_word(std::string_view head, std::string_view word) {
    for (std::size_t at = head.find(word); at != std::string_view::npos;
         at = head.find(word, at + 1)) {
        const bool begins = at == 0 || !is_word(head[at - 1]);
        const std::size_t end = at + word.size();
        if (begins && (end == head.size() || !is_word(head[end]))) return true;
    }
    return false;
}

// The beginning of a declaration without template parameters.
std::string_view past_templates(std::string_view head) {
    while (head.starts_with("template")) {
        std::size_t at = std::min(head.find('<'), head.size());
        int depth = 0;
        for (; at < head.size(); ++at) {
            depth += head[at] == '<' ? 1 : head[at] == '>' ? -1 : 0;
            if (depth == 0) break;
        }
        head.remove_prefix(std::min(at + 1, head.size()));
        head.remove_prefix(std::min(head.find_first_not_of(" \t\n"), head.size()));
    }
    return head;
}

// The same without the contents of (…) and […].
std::string flat(std::string_view declaration) {
    const std::string_view head = past_templates(declaration);
    std::string out;
    int depth = 0;
    for (const char c : head) {
        if (c == '(' || c == '[') ++depth;
        if (depth == 0) out += c;
        if (c == ')' || c == ']') {
            --depth;
            if (depth == 0) out += c;
        }
    }
    return out;
}

// The kind of block that a brace opens after the declaration `head`.
Brace brace_after(std::string_view head) {
    const std::string text = flat(head);
    const std::size_t last = text.find_last_not_of(" \t\n");
    if (last == std::string::npos) return Brace::kScope;
    if (has_word(text, "namespace") || has_word(text, "extern")) return Brace::kScope;
    const std::size_t parameters = text.find(')');
    const bool type = has_word(text, "struct") || has_word(text, "class") ||
                      has_word(text, "union") || has_word(text, "enum");
    const std::size_t assigned = text.find('=');
    const bool names_operator = has_word(text, "operator");
    if (assigned != std::string::npos && !names_operator && !type) return Brace::kVariable;
    if (parameters == std::string::npos) return type ? Brace::kScope : Brace::kVariable;
    if (type && text.find_first_of(":", 0) != std::string::npos && text[last] != ')')
        return Brace::kScope;
    // A member initialiser list: its braces follow a name; the body's brace follows ')' or '}'.
    const std::size_t colon = text.find(':', parameters);
    const bool initialisers = colon != std::string::npos && text.compare(colon, 2, "::") != 0;
    if (initialisers && (is_word(text[last]) || text[last] == '>')) return Brace::kPart;
    return Brace::kFunction;
}

// "Session::act" of "void Session::act(const Action& action)"; the variable of "const auto f = [".
std::string name_of(std::string_view head, Brace kind) {
    std::size_t end = std::min(head.find(kind == Brace::kVariable ? '=' : '('), head.size());
    const std::size_t named = head.find("operator");
    if (named != std::string_view::npos && kind == Brace::kFunction)
        end = std::min(
            head.find('(', named + (head.substr(named).starts_with("operator()") ? 10 : 8)),
            head.size());
    while (end > 0 && std::isspace(static_cast<unsigned char>(head[end - 1])))
        --end;
    std::size_t begin = named != std::string_view::npos && named < end ? named : end;
    while (begin > 0 &&
           (is_word(head[begin - 1]) || head[begin - 1] == ':' || head[begin - 1] == '~'))
        --begin;
    return std::string(head.substr(begin, end - begin));
}

}  // namespace

std::vector<FunctionLength> function_lengths(std::string_view source) {
    const std::string code = code_of(source);
    std::vector<FunctionLength> out;
    std::vector<Brace> open;
    std::string head;
    int line = 1, inside = 0, parentheses = 0;
    FunctionLength current;
    for (const char c : code) {
        if (c == '\n') ++line;
        if (inside > 0) {
            inside += c == '{' ? 1 : c == '}' ? -1 : 0;
            if (inside > 0) continue;
            current.lines = line - current.line + 1;
            if (open.back() == Brace::kFunction || open.back() == Brace::kVariable)
                out.push_back(current);
            // A variable ends at its semicolon; an initialiser belongs to its function.
            head = open.back() == Brace::kPart ? head + "}" : std::string();
            open.pop_back();
            continue;
        }
        if (c == '(' || c == ')') parentheses += c == '(' ? 1 : -1;
        const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
        const bool label =
            c == ':' && (head == "public" || head == "private" || head == "protected");
        if ((c == ';' && parentheses == 0) || label) {
            head.clear();
        } else if (c == '{') {
            const Brace kind = parentheses > 0 ? Brace::kPart : brace_after(head);
            open.push_back(kind);
            if (kind == Brace::kScope) {
                head.clear();
                continue;
            }
            inside = 1;
            if (kind != Brace::kPart) current.name = name_of(head, kind);
        } else if (c == '}') {
            if (!open.empty()) open.pop_back();
            head.clear();
        } else if (!blank || !head.empty()) {
            if (head.empty()) current.line = line;
            head += c;
        }
    }
    return out;
}

}  // namespace weft::architecture
