#include "engine/lighting/painted_light.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kDownscale = 2;
constexpr float kLeastGain = 0.01f, kMostGain = 100.0f;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\n";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char by) {
    std::vector<std::string_view> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(by, from), text.size());
        parts.push_back(trimmed(text.substr(from, to - from)));
        from = to + 1;
    }
    return parts;
}

std::string quoted(std::string_view text) {
    return std::string(1, '\'').append(text).append(1, '\'');
}

tl::unexpected<Error> not_a_number(std::string_view text) {
    return fail(ErrorCode::kUsage, quoted(text) + " is not a number");
}

Expected<std::vector<float>> numbers_of(std::string_view text) {
    std::vector<float> out;
    constexpr std::string_view kBetween = ", \t\n";
    for (std::size_t at = 0;
         (at = text.find_first_not_of(kBetween, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        float number = 0;
        const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, number);
        if (error != std::errc() || stop != text.data() + end || !std::isfinite(number))
            return not_a_number(text.substr(at, end - at));
        out.push_back(number);
        at = end;
    }
    return out;
}

// Adds "FRAME: numbers" or, as the only key, "numbers".
Status add_key(KeyedNumbers& into, std::string_view text, bool only, std::size_t wanted) {
    const std::size_t colon = text.find(':');
    int frame = 0;
    if (colon == std::string_view::npos && !only)
        return fail(ErrorCode::kUsage, "Each of several keys needs its frame: FRAME: numbers");
    if (colon != std::string_view::npos) {
        const std::string_view number = trimmed(text.substr(0, colon));
        const auto [stop, error] =
            std::from_chars(number.data(), number.data() + number.size(), frame);
        if (error != std::errc() || stop != number.data() + number.size())
            return not_a_number(number);
        text = text.substr(colon + 1);
    }
    WEFT_TRY(numbers, numbers_of(text));
    if (numbers.size() != wanted) {
        return fail(ErrorCode::kUsage, quoted(trimmed(text)) + " has " +
                                           std::to_string(numbers.size()) + " numbers instead of " +
                                           std::to_string(wanted));
    }
    into.keys.emplace_back(frame, std::move(numbers));
    return {};
}

Status put_in_order(KeyedNumbers& numbers) {
    std::sort(numbers.keys.begin(), numbers.keys.end());
    const auto twice = std::adjacent_find(numbers.keys.begin(), numbers.keys.end(),
                                          [](auto& a, auto& b) { return a.first == b.first; });
    if (twice == numbers.keys.end()) return {};
    return fail(ErrorCode::kUsage, "Frame " + std::to_string(twice->first) + " has two keys");
}

struct KindInfo {
    LampKind kind;
    std::string_view name;
    std::size_t numbers;
};
constexpr KindInfo kKinds[] = {{LampKind::kPoint, "point", 4},
                               {LampKind::kDirectional, "directional", 2},
                               {LampKind::kGradient, "gradient", 6}};

Expected<Lamp> parse_lamp(std::string_view text) {
    const std::size_t space = std::min(text.find_first_of(" \t\n"), text.size());
    const std::string_view name = text.substr(0, space);
    const auto* info = std::find_if(std::begin(kKinds), std::end(kKinds),
                                    [&](const KindInfo& k) { return k.name == name; });
    if (info == std::end(kKinds)) {
        return fail(ErrorCode::kUsage, "There is no lamp " + quoted(name) +
                                           "; there are point, directional and gradient");
    }
    Lamp lamp;
    lamp.kind = info->kind;
    const auto keys = split(text.substr(space), '|');
    for (const std::string_view key : keys)
        WEFT_CHECK_OK(add_key(lamp.numbers, key, keys.size() == 1, info->numbers));
    WEFT_CHECK_OK(put_in_order(lamp.numbers));
    return lamp;
}

float held(float gain) {
    return std::clamp(gain, kLeastGain, kMostGain);
}

// The gain of a lamp at a plate position.
float gain_at(LampKind kind, const std::vector<float>& n, float x, float y, Size full) {
    switch (kind) {
        case LampKind::kPoint: {
            const float dx = x - n[0], dy = y - n[1];
            const float r2 = (dx * dx + dy * dy) / std::max(1e-6f, n[2] * n[2]);
            const float fall = std::max(0.0f, 1.0f - r2);
            return 1.0f + (held(n[3]) - 1.0f) * fall * fall;
        }
        case LampKind::kDirectional: {
            const float angle = n[0] * std::numbers::pi_v<float> / 180.0f;
            const float half_w = 0.5f * static_cast<float>(full.width);
            const float half_h = 0.5f * static_cast<float>(full.height);
            // Long double: see docs/decisions/0002-determinism.md. y points down.
            const auto c = static_cast<float>(std::cos(static_cast<long double>(angle))),
                       s = static_cast<float>(-std::sin(static_cast<long double>(angle)));
            const float reach = std::abs(c) * half_w + std::abs(s) * half_h;
            const float t = ((x - half_w) * c + (y - half_h) * s) / std::max(1e-6f, reach);
            return std::exp(t * std::log(held(n[1])));
        }
        case LampKind::kGradient: {
            const float dx = n[2] - n[0], dy = n[3] - n[1];
            const float t =
                std::clamp(((x - n[0]) * dx + (y - n[1]) * dy) / std::max(1e-6f, dx * dx + dy * dy),
                           0.0f, 1.0f);
            return held(n[4]) + t * (held(n[5]) - held(n[4]));
        }
    }
    return 1.0f;
}

}  // namespace

std::vector<float> KeyedNumbers::at(int frame) const {
    if (keys.empty()) return {};
    const auto after = std::upper_bound(keys.begin(), keys.end(), frame,
                                        [](int f, const auto& key) { return f < key.first; });
    if (after == keys.begin()) return keys.front().second;
    if (after == keys.end()) return keys.back().second;
    const auto& [first, from] = *(after - 1);
    const float t = static_cast<float>(frame - first) / static_cast<float>(after->first - first);
    std::vector<float> out = from;
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] += t * (after->second[k] - from[k]);
    return out;
}

Expected<KeyedNumbers> parse_keyed_number(std::string_view text, std::size_t count) {
    KeyedNumbers out;
    std::vector<std::string_view> keys;
    for (const std::string_view part : split(trimmed(text), ' ')) {
        if (!part.empty()) keys.push_back(part);
    }
    for (const std::string_view key : keys)
        WEFT_CHECK_OK(add_key(out, key, keys.size() == 1, count));
    WEFT_CHECK_OK(put_in_order(out));
    return out;
}

Expected<std::vector<Lamp>> parse_lamps(std::string_view text) {
    std::vector<Lamp> lamps;
    for (const std::string_view part : split(text, ';')) {
        if (part.empty()) continue;
        auto lamp = parse_lamp(part);
        if (!lamp) return fail_in(std::move(lamp).error(), "Lamp " + quoted(part));
        lamps.push_back(std::move(*lamp));
    }
    return lamps;
}

Shading painted_shading(const std::vector<Lamp>& lamps, int frame, Size full) {
    Shading shading{ImageF1(reduced_size(full, kDownscale), 1.0f), kDownscale, full};
    for (const Lamp& lamp : lamps) {
        const std::vector<float> numbers = lamp.numbers.at(frame);
        parallel_rows(shading.value.height(), 16, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                for (int x = 0; x < shading.value.width(); ++x) {
                    shading.value.row(y)[x] *=
                        gain_at(lamp.kind, numbers, (static_cast<float>(x) + 0.5f) * kDownscale,
                                (static_cast<float>(y) + 0.5f) * kDownscale, full);
                }
            }
        });
    }
    return shading;
}

}  // namespace weft
