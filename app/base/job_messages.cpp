#include "app/base/job_messages.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "app/project/parameters.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

template <class Owner>
bool is_key(std::span<const Parameter<Owner>> table, std::string_view key) {
    return std::any_of(table.begin(), table.end(),
                       [&](const Parameter<Owner>& entry) { return entry.full_key() == key; });
}

// "{key}" or "{key=value}" of a known setting.
std::string named(std::string_view inside, bool& known) {
    const std::size_t equals = inside.find('=');
    const std::string_view key = inside.substr(0, equals);
    known = std::find(setting::kAll.begin(), setting::kAll.end(), key) != setting::kAll.end() ||
            is_key(region_parameters(), key) || is_key(project_parameters(), key) ||
            is_key(matte_parameters(), key) || is_key(zone_parameters(), key);
    if (!known) return {};
    return setting_name({key, equals == std::string_view::npos
                                  ? std::string()
                                  : std::string(inside.substr(equals + 1))});
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
        text.replace(at, from.size(), to);
}

}  // namespace

std::string with_setting_names(const std::string& message) {
    std::string out;
    bool left_out = false;
    for (std::size_t at = 0; at < message.size();) {
        const std::size_t end = message[at] == '{' ? message.find('}', at) : std::string::npos;
        bool known = false;
        std::string name;
        if (end != std::string::npos)
            name = named(std::string_view(message).substr(at + 1, end - at - 1), known);
        if (!known) {
            out += message[at++];
            continue;
        }
        left_out |= name.empty();
        out += name;
        at = end + 1;
    }
    // A list of settings of which this program has none, or not all.
    if (left_out) {
        replace_all(out, "(, ", "(");
        replace_all(out, ", , ", ", ");
        replace_all(out, ", )", ")");
        replace_all(out, " ()", "");
    }
    return out;
}

}  // namespace weft
