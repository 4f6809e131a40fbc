#pragma once
// Checks of what an option is given. Their messages are sentences about the option ("must be a
// whole number from 0 to 1024, not 'abc'."), to which usage.cpp adds its name.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// For Option::transform(): whole decimal numbers from `least` to `most`.
constexpr std::int64_t kLeastInt = std::numeric_limits<std::int32_t>::min(),
                       kMostInt = std::numeric_limits<std::int32_t>::max();
[[nodiscard]] CLI::Validator whole_number(std::int64_t least = kLeastInt,
                                          std::int64_t most = kMostInt);
/// For Option::check(): finite numbers from `least` to `most`.
[[nodiscard]] CLI::Validator number(double least, double most);
/// For Option::check(): one of these words.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);

/// "a, b or c"
[[nodiscard]] std::string either(const std::vector<std::string>& words);

/// For Option::transform(): one of these words, for the value beside it.
template <class Value>
[[nodiscard]] CLI::Validator choice(std::vector<std::pair<std::string, Value>> values) {
    std::vector<std::string> words;
    for (const auto& [word, value] : values)
        words.push_back(word);
    return CLI::Validator(
        [values = std::move(values), known = one_of(std::move(words))](std::string& text) {
            std::string wrong = known(text);
            for (const auto& [word, value] : values) {
                if (word != text) continue;
                text = std::to_string(static_cast<int>(value));  // as CLI11 reads an enumeration
                break;
            }
            return wrong;
        },
        "");
}

}  // namespace weft
