#include "engine/core/setting.h"

#include <atomic>

namespace weft {
namespace {

std::atomic<SettingNamer> g_namer{nullptr};

std::string key_and_value(const SettingRef& setting) {
    std::string out(setting.key);
    return setting.value.empty() ? out : out + " " + setting.value;
}

}  // namespace

void set_setting_namer(SettingNamer namer) {
    g_namer = namer;
}

std::string setting_name(const SettingRef& setting) {
    const SettingNamer namer = g_namer;
    return namer ? namer(setting) : key_and_value(setting);
}

std::string by(std::initializer_list<SettingRef> settings) {
    return by(std::span<const SettingRef>(settings.begin(), settings.size()));
}

std::string by(std::span<const SettingRef> settings) {
    std::string names;
    for (const SettingRef& setting : settings) {
        const std::string name = setting_name(setting);
        if (!name.empty()) names += (names.empty() ? "" : ", ") + name;
    }
    return names.empty() ? names : " (" + names + ")";
}

}  // namespace weft
