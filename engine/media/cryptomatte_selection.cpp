#include "engine/media/cryptomatte_selection.h"

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

constexpr std::string_view kEscaped = ",\"*\\";

// The end of the quoted name that begins at `from`, behind its closing quote; npos if a comma or
// the end of the text does not follow there, so that it is no quoted name.
std::size_t quoted_end(std::string_view text, std::size_t from) {
    if (from >= text.size() || text[from] != '"') return std::string_view::npos;
    const std::size_t close = text.find('"', from + 1);
    if (close == std::string_view::npos) return close;
    const std::size_t next = text.find_first_not_of(' ', close + 1);
    const bool ends = next == std::string_view::npos || text[next] == ',';
    return ends ? close + 1 : std::string_view::npos;
}

// Reads an unquoted name up to the comma, and leaves `at` there.
std::string plain_name(std::string_view text, std::size_t& at) {
    std::string name;
    std::size_t kept = 0;  // trailing spaces behind this do not count
    for (; at < text.size() && text[at] != ','; ++at) {
        const bool escape = text[at] == '\\' && at + 1 < text.size() &&
                            kEscaped.find(text[at + 1]) != std::string_view::npos;
        if (escape) ++at;
        name += text[at] == '*' && !escape ? kAnyText : text[at];
        if (escape || text[at] != ' ') kept = name.size();
    }
    name.resize(kept);
    return name;
}

}  // namespace

std::vector<std::string> split_crypto_names(std::string_view text) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at <= text.size(); ++at) {
        at = std::min(text.find_first_not_of(' ', at), text.size());
        if (const std::size_t end = quoted_end(text, at); end != std::string_view::npos) {
            names.emplace_back(text.substr(at + 1, end - at - 2));
            at = std::min(text.find(',', end), text.size());
        } else {
            names.push_back(plain_name(text, at));
        }
    }
    return names;
}

std::string escaped_crypto_name(std::string_view name) {
    const bool spaces = name.starts_with(' ') || name.ends_with(' ');
    if (spaces && name.find('"') == std::string_view::npos) return '"' + std::string(name) + '"';
    std::string out;
    for (const char c : name) {
        if (kEscaped.find(c) != std::string_view::npos) out += '\\';
        out += c == kAnyText ? '*' : c;
    }
    return out;
}

}  // namespace weft
