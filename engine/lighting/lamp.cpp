#include "engine/lighting/lamp.h"

#include <algorithm>

#include "engine/core/text.h"

namespace weft {
namespace {

Expected<Lamp> parse_lamp(std::string_view text) {
    const std::size_t space = std::min(text.find_first_of(" \t\n"), text.size());
    const std::string_view name = text.substr(0, space);
    const auto* const info = std::find_if(kLampKinds.begin(), kLampKinds.end(),
                                          [&](const LampKindInfo& k) { return k.name == name; });
    if (info == kLampKinds.end()) {
        return fail(ErrorCode::kUsage, "Unknown lamp " + quoted(name) + ".",
                    "Use point, directional or gradient");
    }
    std::vector<NumberKey> keys;
    const auto parts = split(text.substr(space), '|');
    for (const std::string_view part : parts) {
        WEFT_TRY(key, parse_key(part, parts.size() == 1, info->numbers));
        keys.push_back(std::move(key));
    }
    WEFT_TRY(numbers, sorted_keys(std::move(keys)));
    return Lamp{info->kind, std::move(numbers)};
}

std::string lamp_text(const Lamp& lamp) {
    std::string out(info_of(lamp.kind).name);
    const auto& keys = lamp.numbers.keys;
    const bool names_frames = keys.size() > 1 || (keys.size() == 1 && keys[0].frame != 0);
    const char* before = " ";
    for (const auto& [frame, numbers, after] : keys) {
        out += before;
        if (names_frames) out += std::to_string(frame) + ": ";
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (k > 0) out += ' ';
            out += shortest_text(numbers[k]);
        }
        if (names_frames && after != KeyInterpolation::kLinear)
            out += ": " + std::string(name_of(after));
        before = " | ";
    }
    return out;
}

}  // namespace

void set_numbers(Lamp& lamp, int frame, std::vector<double> numbers) {
    if (lamp.numbers.keys.size() == 1)
        lamp.numbers.keys[0].numbers = std::move(numbers);
    else
        lamp.numbers.set(frame, std::move(numbers));
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

std::string lamps_text(const std::vector<Lamp>& lamps) {
    std::string out;
    for (const Lamp& lamp : lamps) {
        if (!out.empty()) out += "; ";
        out += lamp_text(lamp);
    }
    return out;
}

}  // namespace weft
