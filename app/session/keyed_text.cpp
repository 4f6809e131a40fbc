#include "app/session/keyed_text.h"

#include <cstdio>
#include <iterator>

#include "engine/lighting/painted_light.h"

namespace weft {

KeyedValues read_keyed(const std::string& text, std::size_t count) {
    KeyedValues out;
    if (text.empty()) return out;
    const auto parsed = parse_keyed_number(text, count);
    if (!parsed) return out;
    for (const auto& [frame, values] : parsed->keys)
        out[frame].assign(values.begin(), values.end());
    return out;
}

std::string keyed_text(const KeyedValues& keys) {
    std::string out;
    for (const auto& [frame, values] : keys) {
        if (!out.empty()) out += " ";
        out += std::to_string(frame) + ":";
        for (std::size_t k = 0; k < values.size(); ++k) {
            char number[32];
            std::snprintf(number, sizeof number, "%s%.6g", k ? "," : "", values[k]);
            out += number;
        }
    }
    return out;
}

std::vector<double> keyed_at(const KeyedValues& keys, int frame) {
    const auto after = keys.lower_bound(frame);
    if (after == keys.end()) return keys.rbegin()->second;
    if (after->first == frame || after == keys.begin()) return after->second;
    const auto before = std::prev(after);
    const double part = static_cast<double>(frame - before->first) /
                        static_cast<double>(after->first - before->first);
    std::vector<double> out = before->second;
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] += part * (after->second[k] - out[k]);
    return out;
}

}  // namespace weft
