#include "engine/core/keyed_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/frame_range.h"
#include "engine/core/text.h"

namespace weft {
namespace {

tl::unexpected<Error> not_a_number(std::string_view text) {
    return fail(ErrorCode::kUsage, quoted(text) + " is not a number.",
                "Write each key like 12:0.5, frame and value.");
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
                            [](const NumberKey& key, int f) { return key.frame < f; });
}

// The slopes at a smooth key: those of Fritsch and Butland (1984), a weighted harmonic mean of the
// slopes to both neighbours, with which a cubic Hermite is monotone between its keys (Fritsch &
// Carlson 1980). Level at a turning point, at the first and the last key, and after a hold, which
// arrives with a step.
template <class T>
T slope_at(const std::vector<NumberKey>& keys, std::size_t at, std::size_t which) {
    if (at == 0 || at + 1 == keys.size() || keys[at - 1].after == KeyInterpolation::kHold) return 0;
    const NumberKey &before = keys[at - 1], &here = keys[at], &after = keys[at + 1];
    const T h0 = static_cast<T>(here.frame) - static_cast<T>(before.frame);
    const T h1 = static_cast<T>(after.frame) - static_cast<T>(here.frame);
    const T v = static_cast<T>(here.numbers[which]);
    const T d0 = (v - static_cast<T>(before.numbers[which])) / h0;
    const T d1 = (static_cast<T>(after.numbers[which]) - v) / h1;
    // Compared by sign: a product of small slopes would be rounded to zero.
    if (d0 == 0 || d1 == 0 || (d0 > 0) != (d1 > 0)) return 0;
    const T share = (h0 + 2 * h1) / (3 * (h0 + h1));
    return 1 / (share / d0 + (1 - share) / d1);
}

template <class T>
T smooth_between(const std::vector<NumberKey>& keys, std::size_t from, std::size_t which, T share) {
    const T a = static_cast<T>(keys[from].numbers[which]);
    const T b = static_cast<T>(keys[from + 1].numbers[which]);
    const T length = static_cast<T>(keys[from + 1].frame) - static_cast<T>(keys[from].frame);
    const T rest = 1 - share;
    const T value =
        a + (b - a) * share * share * (3 - 2 * share) +
        length * share * rest *
            (slope_at<T>(keys, from, which) * rest - slope_at<T>(keys, from + 1, which) * share);
    return std::clamp(value, std::min(a, b), std::max(a, b));
}

// The arithmetic of T, on numbers that were rounded to T before.
template <class T>
std::vector<T> interpolated(const std::vector<NumberKey>& keys, int frame) {
    if (keys.empty()) return {};
    const auto after = std::upper_bound(keys.begin(), keys.end(), frame,
                                        [](int f, const NumberKey& key) { return f < key.frame; });
    const NumberKey& first = after == keys.begin() ? *after : *(after - 1);
    std::vector<T> out(first.numbers.begin(), first.numbers.end());
    if (after == keys.begin() || after == keys.end() || first.after == KeyInterpolation::kHold)
        return out;
    const T share =
        static_cast<T>(frame - first.frame) / static_cast<T>(after->frame - first.frame);
    const auto from = static_cast<std::size_t>(after - keys.begin()) - 1;
    for (std::size_t k = 0; k < out.size(); ++k) {
        if (first.after == KeyInterpolation::kSmooth)
            out[k] = smooth_between<T>(keys, from, k, share);
        else
            out[k] += share * (static_cast<T>(after->numbers[k]) - out[k]);
    }
    return out;
}

}  // namespace

std::string_view name_of(KeyInterpolation interpolation) {
    for (const auto& [known, name] : kKeyInterpolations)
        if (known == interpolation) return name;
    return {};
}

Expected<KeyInterpolation> parse_interpolation(std::string_view name) {
    for (const auto& [known, called] : kKeyInterpolations)
        if (called == name) return known;
    return fail(ErrorCode::kUsage, quoted(name.substr(0, 60)) + " is no interpolation",
                "use linear, smooth or hold");
}

bool KeyedNumbers::has(int frame) const {
    return key(frame) != nullptr;
}

const NumberKey* KeyedNumbers::key(int frame) const {
    const auto found = position(keys, frame);
    return found != keys.end() && found->frame == frame ? &*found : nullptr;
}

std::vector<double> KeyedNumbers::at(int frame) const {
    return interpolated<double>(keys, frame);
}

std::vector<float> KeyedNumbers::float_at(int frame) const {
    return interpolated<float>(keys, frame);
}

void KeyedNumbers::set(int frame, std::vector<double> numbers) {
    const auto found = position(keys, frame);
    if (found != keys.end() && found->frame == frame) {
        found->numbers = std::move(numbers);
        return;
    }
    const auto after = found == keys.begin() ? KeyInterpolation::kLinear : std::prev(found)->after;
    keys.insert(found, {frame, std::move(numbers), after});
}

void KeyedNumbers::erase(int frame) {
    std::erase_if(keys, [frame](const NumberKey& key) { return key.frame == frame; });
}

Expected<NumberKey> parse_key(std::string_view text, bool only, std::size_t count) {
    NumberKey key;
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos && !only)
        return fail(ErrorCode::kUsage,
                    "With several keys, each needs its frame, as in FRAME: numbers");
    if (colon != std::string_view::npos) {
        const std::string_view number = trimmed(text.substr(0, colon));
        const auto [stop, error] =
            std::from_chars(number.data(), number.data() + number.size(), key.frame);
        if (error != std::errc() || stop != number.data() + number.size() ||
            !is_frame_number(key.frame))
            return not_a_number(number);
        text = text.substr(colon + 1);
    }
    if (const std::size_t second = text.find(':'); second != std::string_view::npos) {
        WEFT_TRY(after, parse_interpolation(trimmed(text.substr(second + 1))));
        key.after = after;
        text = text.substr(0, second);
    }
    WEFT_TRY(numbers, numbers_of(text));
    if (numbers.size() != count) {
        return fail(ErrorCode::kUsage, quoted(trimmed(text)) + " has " +
                                           std::to_string(numbers.size()) + " numbers instead of " +
                                           std::to_string(count));
    }
    key.numbers = std::move(numbers);
    return key;
}

Expected<KeyedNumbers> sorted_keys(std::vector<NumberKey> keys) {
    std::stable_sort(keys.begin(), keys.end(),
                     [](const NumberKey& a, const NumberKey& b) { return a.frame < b.frame; });
    const auto twice = std::adjacent_find(
        keys.begin(), keys.end(),
        [](const NumberKey& a, const NumberKey& b) { return a.frame == b.frame; });
    if (twice == keys.end()) return KeyedNumbers{std::move(keys)};
    return fail(ErrorCode::kUsage, "Frame " + std::to_string(twice->frame) + " has two keys");
}

Expected<KeyedNumbers> parse_keyed_numbers(std::string_view text, std::size_t count) {
    std::vector<std::string_view> parts;
    for (const std::string_view part : split(trimmed(text), ' '))
        if (!part.empty()) parts.push_back(part);
    std::vector<NumberKey> keys;
    for (const std::string_view part : parts) {
        WEFT_TRY(key, parse_key(part, parts.size() == 1, count));
        keys.push_back(std::move(key));
    }
    return sorted_keys(std::move(keys));
}

std::string keyed_text(const KeyedNumbers& keyed) {
    std::string out;
    for (const NumberKey& key : keyed.keys) {
        if (!out.empty()) out += " ";
        out += std::to_string(key.frame) + ":";
        for (std::size_t k = 0; k < key.numbers.size(); ++k) {
            if (k > 0) out += ',';
            out += shortest_text(key.numbers[k]);
        }
        if (key.after != KeyInterpolation::kLinear) out += ":" + std::string(name_of(key.after));
    }
    return out;
}

}  // namespace weft
