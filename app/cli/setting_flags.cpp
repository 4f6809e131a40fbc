#include "app/cli/setting_flags.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "app/project/parameters.h"

namespace weft {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

// Settings outside the parameter tables.
constexpr std::array kFlags{Entry{setting::kBackend, "--backend"},
                            Entry{setting::kCache, "--cache"},
                            Entry{setting::kChunk, "--chunk"},
                            Entry{setting::kCryptoFiles, "--crypto-files"},
                            Entry{setting::kHoldout, "--holdout"},
                            Entry{setting::kZone, "--zone"},
                            Entry{setting::kLibrary, "--db"},
                            Entry{setting::kMatte, "--matte"},
                            Entry{setting::kMemory, "--memory"},
                            Entry{setting::kOutput, "-o"},
                            Entry{setting::kOutputRoot, "--output-root"},
                            Entry{setting::kOverwrite, "--overwrite"},
                            Entry{setting::kPackages, "--packages"},
                            Entry{setting::kRecipe, "--recipe"},
                            Entry{setting::kRegion, "--region"},
                            Entry{setting::kRestart, "--restart"},
                            Entry{setting::kResume, "--resume"},
                            Entry{setting::kSkipExisting, "--skip-existing"},
                            Entry{setting::kTrustOnce, "--trust"},
                            Entry{setting::kTruth, "--truth"},
                            Entry{setting::kVersionUp, "--version-up"}};

constexpr std::array kCommands{Entry{setting::kAddRegion, "region add"},
                               Entry{setting::kBuildLibrary, "texture build"},
                               Entry{setting::kImportTextures, "texture import"},
                               Entry{setting::kListTextures, "texture list"},
                               Entry{setting::kListTrusted, "trust --list"},
                               Entry{setting::kSaveLook, "look save"},
                               Entry{setting::kTrainLibrary, "texture train"},
                               Entry{setting::kTrustFolder, "trust"},
                               Entry{setting::kUseModel, "texture model"},
                               Entry{setting::kVerifyLibrary, "texture verify"}};

template <std::size_t N>
std::string_view found_in(const std::array<Entry, N>& entries, std::string_view key) {
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [&](const Entry& entry) { return entry.first == key; });
    return at == entries.end() ? std::string_view() : at->second;
}

template <class Owner>
std::string_view flag_in(std::span<const Parameter<Owner>> table, std::string_view key) {
    const auto at = std::find_if(table.begin(), table.end(), [&](const Parameter<Owner>& entry) {
        return entry.full_key() == key;
    });
    return at == table.end() ? std::string_view() : at->flag;
}

}  // namespace

std::string setting_flag(const SettingRef& setting) {
    const std::string value = setting.value.empty() ? "" : " " + setting.value;
    if (const auto command = found_in(kCommands, setting.key); !command.empty())
        return "'weft " + std::string(command) + value + "'";
    std::string_view flag = found_in(kFlags, setting.key);
    if (flag.empty()) flag = flag_in(region_parameters(), setting.key);
    if (flag.empty()) flag = flag_in(project_parameters(), setting.key);
    return flag.empty() ? std::string() : std::string(flag) + value;
}

bool names_settings_by_key() {
    const char* names = std::getenv("WEFT_SETTING_NAMES");
    return names && std::string_view(names) == "keys";
}

std::string setting_in_braces(const SettingRef& setting) {
    return "{" + std::string(setting.key) + (setting.value.empty() ? "" : "=" + setting.value) +
           "}";
}

}  // namespace weft
