#pragma once
// Validators of option values. Their messages are sentences about the option ("must be a whole
// number from 0 to 1024, not 'abc'."); usage.cpp adds the option's name.

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

/// For Option::transform(): one of these words, replaced by its value.
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
                // CLI11 reads enumerations as numbers
                text = std::to_string(static_cast<int>(value));
                break;
            }
            return wrong;
        },
        "");
}

}  // namespace weft
