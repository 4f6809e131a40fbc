#include "engine/core/keyed_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/frame_range.h"
#include "engine/core/text.h"

namespace weft {
namespace {

using Key = std::pair<int, std::vector<double>>;

tl::unexpected<Error> not_a_number(std::string_view text) {
    return fail(ErrorCode::kUsage,
                quoted(text) + " is not a number. Write each key like 12:0.5, frame and value.");
}

Expected<std::vector<double>> numbers_of(std::string_view text) {
    std::vector<double> out;
    constexpr std::string_view kBetween = ", \t\n";
    for (std::size_t at = 0;
         (at = text.find_first_not_of(kBetween, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        double number = 0;
        const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, number);
        if (error != std::errc() || stop != text.data() + end ||
            !std::isfinite(static_cast<float>(number)))
            return not_a_number(text.substr(at, end - at));
        out.push_back(number);
        at = end;
    }
    return out;
}

auto position(auto& keys, int frame) {
    return std::lower_bound(keys.begin(), keys.end(), frame,
                            [](const Key& key, int f) { return key.first < f; });
}

// The arithmetic of T, on numbers that were rounded to T before.
template <class T>
std::vector<T> interpolated(const std::vector<Key>& keys, int frame) {
    if (keys.empty()) return {};
    const auto after = std::upper_bound(keys.begin(), keys.end(), frame,
                                        [](int f, const Key& key) { return f < key.first; });
    const Key& first = after == keys.begin() ? *after : *(after - 1);
    std::vector<T> out(first.second.begin(), first.second.end());
    if (after == keys.begin() || after == keys.end()) return out;
    const T share =
        static_cast<T>(frame - first.first) / static_cast<T>(after->first - first.first);
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] += share * (static_cast<T>(after->second[k]) - out[k]);
    return out;
}

}  // namespace

bool KeyedNumbers::has(int frame) const {
    const auto found = position(keys, frame);
    return found != keys.end() && found->first == frame;
}

std::vector<double> KeyedNumbers::at(int frame) const {
    return interpolated<double>(keys, frame);
}

std::vector<float> KeyedNumbers::float_at(int frame) const {
    return interpolated<float>(keys, frame);
}

void KeyedNumbers::set(int frame, std::vector<double> numbers) {
    const auto found = position(keys, frame);
    if (found != keys.end() && found->first == frame)
        found->second = std::move(numbers);
    else
        keys.insert(found, {frame, std::move(numbers)});
}

void KeyedNumbers::erase(int frame) {
    std::erase_if(keys, [frame](const Key& key) { return key.first == frame; });
}

Expected<Key> parse_key(std::string_view text, bool only, std::size_t count) {
    const std::size_t colon = text.find(':');
    int frame = 0;
    if (colon == std::string_view::npos && !only)
        return fail(ErrorCode::kUsage,
                    "With several keys, each needs its frame, as in FRAME: numbers");
    if (colon != std::string_view::npos) {
        const std::string_view number = trimmed(text.substr(0, colon));
        const auto [stop, error] =
            std::from_chars(number.data(), number.data() + number.size(), frame);
        if (error != std::errc() || stop != number.data() + number.size() ||
            !is_frame_number(frame))
            return not_a_number(number);
        text = text.substr(colon + 1);
    }
    WEFT_TRY(numbers, numbers_of(text));
    if (numbers.size() != count) {
        return fail(ErrorCode::kUsage, quoted(trimmed(text)) + " has " +
                                           std::to_string(numbers.size()) + " numbers instead of " +
                                           std::to_string(count));
    }
    return Key{frame, std::move(numbers)};
}

Expected<KeyedNumbers> sorted_keys(std::vector<Key> keys) {
    std::stable_sort(keys.begin(), keys.end(),
                     [](const Key& a, const Key& b) { return a.first < b.first; });
    const auto twice = std::adjacent_find(
        keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.first == b.first; });
    if (twice == keys.end()) return KeyedNumbers{std::move(keys)};
    return fail(ErrorCode::kUsage, "Frame " + std::to_string(twice->first) + " has two keys");
}

Expected<KeyedNumbers> parse_keyed_numbers(std::string_view text, std::size_t count) {
    std::vector<std::string_view> parts;
    for (const std::string_view part : split(trimmed(text), ' '))
        if (!part.empty()) parts.push_back(part);
    std::vector<Key> keys;
    for (const std::string_view part : parts) {
        WEFT_TRY(key, parse_key(part, parts.size() == 1, count));
        keys.push_back(std::move(key));
    }
    return sorted_keys(std::move(keys));
}

std::string keyed_text(const KeyedNumbers& keyed) {
    std::string out;
    for (const auto& [frame, numbers] : keyed.keys) {
        if (!out.empty()) out += " ";
        out += std::to_string(frame) + ":";
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (k > 0) out += ',';
            out += shortest_text(numbers[k]);
        }
    }
    return out;
}

}  // namespace weft
