#include "app/cli/option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace weft {
namespace {

// from_chars() rejects a plus sign.
template <class Number>
bool read_number(std::string_view text, Number& out) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            std::int64_t value = 0;
            if (!read_number(text, value) || value < least || value > most) {
                if (least == kLeastInt)
                    return fmt::format("must be a whole number, not '{}'.", text);
                if (most >= kMostInt)
                    return fmt::format("must be a whole number of at least {}, not '{}'.", least,
                                       text);
                return fmt::format("must be a whole number from {} to {}, not '{}'.", least, most,
                                   text);
            }
            text = std::to_string(value);  // CLI11 would read 010 as octal
            return {};
        },
        "");
}

CLI::Validator number(double least, double most) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            double value = 0;
            if (read_number(text, value) && value >= least && value <= most) return {};
            return most < std::numeric_limits<double>::max()
                       ? fmt::format("must be a number from {} to {}, not '{}'.", least, most, text)
                       : fmt::format("must be a number of at least {}, not '{}'.", least, text);
        },
        "");
}

std::string either(const std::vector<std::string>& words) {
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i)
        out += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return out;
}

CLI::Validator one_of(std::vector<std::string> words) {
    return CLI::Validator(
        [words = std::move(words)](std::string& text) -> std::string {
            if (std::find(words.begin(), words.end(), text) != words.end()) return {};
            return fmt::format("must be {}, not '{}'.", either(words), text);
        },
        "");
}

}  // namespace weft
