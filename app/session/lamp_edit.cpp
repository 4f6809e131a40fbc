#include "app/session/lamp_edit.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/lighting/painted_light.h"

namespace weft {
namespace {

std::vector<Lamp> lamps_of(std::string_view text) {
    if (text.empty()) return {};
    auto lamps = parse_lamps(text);
    return lamps ? std::move(*lamps) : std::vector<Lamp>{};
}

std::string text_of(const Lamp& lamp) {
    static constexpr const char* kNames[] = {"point", "directional", "gradient"};
    std::string out = kNames[static_cast<int>(lamp.kind)];
    const char* before = " ";
    for (const auto& [frame, numbers] : lamp.numbers.keys) {
        out += before;
        if (lamp.numbers.keys.size() > 1) out += fmt::format("{}: ", frame);
        for (std::size_t k = 0; k < numbers.size(); ++k)
            out += fmt::format("{}{:g}", k ? " " : "", numbers[k]);
        before = " | ";
    }
    return out;
}

std::string text_of(const std::vector<Lamp>& lamps) {
    std::string out;
    for (const Lamp& lamp : lamps)
        out += (out.empty() ? "" : "; ") + text_of(lamp);
    return out;
}

}  // namespace

std::vector<LampHandle> lamps_at(std::string_view text, int frame) {
    std::vector<LampHandle> out;
    for (const Lamp& lamp : lamps_of(text))
        out.push_back({static_cast<LampHandle::Kind>(lamp.kind), lamp.numbers.at(frame),
                       lamp.numbers.keys.size() > 1});
    return out;
}

std::string with_lamp(std::string_view text, std::size_t index, int frame,
                      const std::vector<float>& numbers, bool key) {
    std::vector<Lamp> lamps = lamps_of(text);
    if (index >= lamps.size()) return std::string(text);
    auto& keys = lamps[index].numbers.keys;
    if (keys.size() < 2 && !key) {
        keys = {{keys.empty() ? frame : keys.front().first, numbers}};
        return text_of(lamps);
    }
    const auto at = std::lower_bound(keys.begin(), keys.end(), frame,
                                     [](const auto& k, int f) { return k.first < f; });
    if (at != keys.end() && at->first == frame)
        at->second = numbers;
    else
        keys.insert(at, {frame, numbers});
    return text_of(lamps);
}

std::string with_new_lamp(std::string_view text, const LampHandle& handle) {
    std::vector<Lamp> lamps = lamps_of(text);
    Lamp lamp;
    lamp.kind = static_cast<LampKind>(handle.kind);
    lamp.numbers.keys = {{0, handle.numbers}};
    lamps.push_back(std::move(lamp));
    return text_of(lamps);
}

std::string without_lamp(std::string_view text, std::size_t index) {
    std::vector<Lamp> lamps = lamps_of(text);
    if (index < lamps.size()) lamps.erase(lamps.begin() + static_cast<std::ptrdiff_t>(index));
    return text_of(lamps);
}

}  // namespace weft
