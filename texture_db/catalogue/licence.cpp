#include "texture_db/catalogue/licence.h"

#include <algorithm>
#include <span>

#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "texture_db/describe/material_words.h"

namespace weft {
namespace {

// "gpl-2+" belongs to the family "gpl": the name, then a version. "cc-by-sa-3.0" is not in "cc-by".
bool in_family(const std::string& licence, const std::string& family) {
    if (licence == family) return true;
    if (!licence.starts_with(family)) return false;
    const std::string rest = licence.substr(family.size());
    if (rest[0] >= '0' && rest[0] <= '9') return true;
    return (rest[0] == '-' || rest[0] == ' ') && rest.size() > 1 &&
           ((rest[1] >= '0' && rest[1] <= '9') || rest[1] == 'v');
}

bool has(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

bool one_excluded(const std::string& licence, const std::vector<std::string>& excluded) {
    for (const std::string& given : excluded) {
        const std::string family = lower_case(given);
        if (in_family(licence, family)) return true;
        if (family == "copyleft" && (has(licence, "gpl") || has(licence, "-sa") ||
                                     has(licence, "gfdl") || has(licence, "mpl")))
            return true;
        if (family == "attribution" && (has(licence, "-by") || has(licence, "gfdl"))) return true;
        if (family == "non-commercial" && has(licence, "-nc")) return true;
        if (family == "unknown" && licence.empty()) return true;
    }
    return false;
}

constexpr std::string_view kFamilies[] = {"copyleft", "attribution", "non-commercial", "unknown"};
constexpr std::string_view kLicences[] = {
    "AGPL",     "Apache",        "Artistic",    "BSD",      "CC0",      "CC-BY",
    "CC-BY-NC", "CC-BY-NC-ND",   "CC-BY-NC-SA", "CC-BY-ND", "CC-BY-SA", "Expat",
    "GFDL",     "GPL",           "ISC",         "LGPL",     "MIT",      "MPL",
    "OFL",      "public-domain", "Unlicense",   "WTFPL",    "Zlib"};

bool is_known(const std::string& name, const std::vector<std::string>& own) {
    const std::string text = lower_case(name);
    const auto same = [&](std::string_view other) { return text == lower_case(other); };
    const auto covers = [&](std::string_view other) { return in_family(text, lower_case(other)); };
    const auto among = [&](const std::string& licence) {
        return licence_excluded(licence, {name});
    };
    return std::any_of(std::begin(kFamilies), std::end(kFamilies), same) ||
           std::any_of(std::begin(kLicences), std::end(kLicences), covers) ||
           std::any_of(own.begin(), own.end(), among);
}

std::string listed(std::span<const std::string_view> names) {
    std::string out;
    for (const std::string_view name : names)
        out += (out.empty() ? "" : ", ") + std::string(name);
    return out;
}

std::vector<std::string> split_at(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    for (std::size_t at = 0;;) {
        const std::size_t end = text.find(separator, at);
        parts.push_back(text.substr(at, end - at));
        if (end == std::string::npos) return parts;
        at = end + separator.size();
    }
}

}  // namespace

std::vector<std::string> licence_list(std::string_view text) {
    std::vector<std::string> out;
    for (const std::string& part : split_at(std::string(text), ",")) {
        const auto from = part.find_first_not_of(' ');
        if (from != std::string::npos)
            out.push_back(part.substr(from, part.find_last_not_of(' ') - from + 1));
    }
    return out;
}

bool licence_excluded(std::string_view licence, const std::vector<std::string>& excluded) {
    if (excluded.empty()) return false;
    std::string text = lower_case(licence);
    std::replace(text.begin(), text.end(), ',', ' ');
    // "A or B": one allowed licence is enough.
    const auto alternatives = split_at(text, " or ");
    return std::all_of(alternatives.begin(), alternatives.end(), [&](const std::string& choice) {
        const auto together = split_at(choice, " and ");
        return std::any_of(together.begin(), together.end(), [&](std::string part) {
            part = joined_words(split_words(part));
            return one_excluded(part, excluded);
        });
    });
}

Status check_licence_names(const std::vector<std::string>& excluded,
                           const std::vector<std::string>& own) {
    for (const std::string& name : excluded) {
        if (is_known(name, own)) continue;
        return fail(
            ErrorCode::kUsage,
            setting_name({setting::kExcludedLicences}) + ": licence '" + name + "' is unknown.",
            "Use one of " + listed(kLicences) +
                ", each with any version, "
                "or one of the families " +
                listed(kFamilies) + ".");
    }
    return {};
}

Status check_licences(const std::vector<TextureCredit>& textures,
                      const std::vector<std::string>& excluded) {
    std::vector<std::string> own;
    for (const TextureCredit& texture : textures)
        own.push_back(texture.licence);
    WEFT_CHECK_OK(check_licence_names(excluded, own));
    std::string refused;
    for (const TextureCredit& texture : textures) {
        if (!licence_excluded(texture.licence, excluded)) continue;
        if (!refused.empty()) refused += "; ";
        refused += "'" + texture.name + "'" +
                   (texture.region.empty() ? "" : " of region '" + texture.region + "'") + " is " +
                   (texture.licence.empty() ? "of unknown licence" : texture.licence) +
                   (texture.author.empty() ? "" : " by " + texture.author);
    }
    if (refused.empty()) return {};
    std::string names;
    for (const std::string& name : excluded)
        names += (names.empty() ? "" : ", ") + name;
    return fail(ErrorCode::kRefused,
                "The project excludes textures under " + names + ": " + refused + ".",
                "Choose other textures, or change the project's licence policy.");
}

}  // namespace weft
