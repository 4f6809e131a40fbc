#include "engine/core/frame_range.h"

#include <charconv>
#include <set>

namespace weft {
namespace {

constexpr long long kMaxFrames = 1'000'000;

// Reads an integer at the front of `text` and removes it.
bool take_int(std::string_view& text, int& value) {
    const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (ec != std::errc{}) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

struct Span {
    int first, last, step;
};

bool parse_span(std::string_view text, Span& span) {
    if (!take_int(text, span.first)) return false;
    span.last = span.first;
    span.step = 1;
    if (text.empty()) return true;
    if (text.front() != '-') return false;
    text.remove_prefix(1);
    if (!take_int(text, span.last) || span.last < span.first) return false;
    if (text.empty()) return true;
    if (text.front() != 'x') return false;
    text.remove_prefix(1);
    return take_int(text, span.step) && text.empty() && span.step >= 1;
}

}  // namespace

Expected<std::vector<int>> parse_frame_list(std::string_view text) {
    const std::string whole(text);
    std::set<int> frames;
    long long named = 0;  // repeats counted, which take as long
    while (true) {
        const std::size_t comma = text.find(',');
        Span span{};
        if (!parse_span(text.substr(0, comma), span)) {
            return fail(ErrorCode::kUsage, "Cannot read the frames '" + whole + "'.",
                        "Write them like 1-40, 1-100x2, -5--1 or 1,4,9-12.");
        }
        if (!is_frame_number(span.first) || !is_frame_number(span.last)) {
            return fail(ErrorCode::kUsage,
                        "The frames '" + whole + "' go beyond -100000000 to 100000000.",
                        "Renumber the shot, or correct the list.");
        }
        const auto count = (static_cast<long long>(span.last) - span.first) / span.step + 1;
        named += count;
        if (named > kMaxFrames) {
            return fail(ErrorCode::kUsage, "'" + whole + "' has more than a million frames.",
                        "Shorten the list.");
        }
        for (long long f = span.first; f <= span.last; f += span.step) {
            frames.insert(static_cast<int>(f));
        }
        if (comma == std::string_view::npos) break;
        text.remove_prefix(comma + 1);
    }
    return std::vector<int>(frames.begin(), frames.end());
}

std::string format_frame_list(const std::vector<int>& frames) {
    std::string out;
    for (std::size_t i = 0; i < frames.size();) {
        // The longest run of equal steps from i; two frames alone are written as two numbers.
        std::size_t j = i + 1;
        const int step = j < frames.size() ? frames[j] - frames[i] : 1;
        while (j < frames.size() && frames[j] - frames[j - 1] == step)
            ++j;
        if (j - i == 2 && step != 1) j = i + 1;
        if (!out.empty()) out += ',';
        out += std::to_string(frames[i]);
        if (j - i > 1) out += '-' + std::to_string(frames[j - 1]);
        if (j - i > 1 && step != 1) out += 'x' + std::to_string(step);
        i = j;
    }
    return out;
}

}  // namespace weft
