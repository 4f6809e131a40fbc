#include "app/cli/zone_texts.h"

#include <algorithm>

#include "app/project/parameters.h"

namespace weft {
namespace {

Expected<Zone> parse_zone(const std::string& text) {
    const std::size_t equals = text.find('='), at = text.find('@');
    if (equals == std::string::npos || at == std::string::npos || at < equals)
        return fail(ErrorCode::kUsage, "--zone '" + text + "' is not KIND=VALUE@MATTE.",
                    "Write it like light=0.3@12=a.png.");
    Zone zone;
    const auto set = [&](std::string_view key, const std::string& value) -> Status {
        for (const Parameter<Zone>& parameter : zone_parameters()) {
            if (parameter.key != key) continue;
            WEFT_TRY(parsed, parse_parameter(parameter, value));
            return set_parameter(zone, parameter, std::move(parsed));
        }
        return {};
    };
    auto done = set("kind", text.substr(0, equals));
    if (done) done = set("value", text.substr(equals + 1, at - equals - 1));
    if (done) done = add_matte_text(zone.matte, text.substr(at + 1));
    if (!done) return fail_in(std::move(done).error(), "--zone");
    return zone;
}

}  // namespace

Expected<std::vector<Zone>> parse_zones(const std::vector<std::string>& texts,
                                        const std::string& crypto_files) {
    std::vector<Zone> zones;
    for (const std::string& text : texts) {
        WEFT_TRY(zone, parse_zone(text));
        if (!zone.matte.select.crypto.empty()) zone.matte.files = crypto_files;
        const auto same = std::find_if(zones.begin(), zones.end(), [&](const Zone& other) {
            return other.kind == zone.kind && other.value == zone.value &&
                   !other.matte.keyframes.empty() && !zone.matte.keyframes.empty();
        });
        if (same == zones.end()) {
            zones.push_back(std::move(zone));
            continue;
        }
        const auto& [frame, key] = *zone.matte.keyframes.begin();
        if (!same->matte.keyframes.emplace(frame, key).second)
            return fail(ErrorCode::kUsage,
                        "--zone: Frame " + std::to_string(frame) + " of a zone has two mattes.",
                        "Give one.");
    }
    return zones;
}

}  // namespace weft
