// Upgrades of the project file's schema, oldest first. Each step converts version n to n + 1, knows
// no later version, and leaves unknown keys in place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "app/project/codec/json_codec.h"
#include "app/project/codec/project_json.h"
#include "engine/core/text.h"

namespace weft::json_codec {
namespace {

/// Moves `from` of an object to `group`.`to` of the same object.
Status move_into_group(Json& object, const char* from, const char* group, const char* to,
                       const std::string& path) {
    const auto found = object.find(from);
    if (found == object.end()) return {};
    Json value = std::move(*found);
    object.erase(found);
    Json& target = object[group];
    if (!target.is_null() && !target.is_object())
        return fail_at(path + group,
                       fmt::format("This is {}, but must be an object", type_of(target)));
    target[to] = std::move(value);
    return {};
}

/// Version 0: "matte" is a pattern, or an object of frame number → path.
Status upgrade_matte_0(Json& matte, const std::string& path) {
    if (matte.is_string()) {
        matte = Json{{"files", matte}};
        return {};
    }
    if (!matte.is_object())
        return fail_at(
            path, fmt::format("This is {}, but must be a pattern or keyframes", type_of(matte)));
    Json keyframes = Json::array();
    for (const auto& [text, file] : matte.items()) {
        int frame = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, frame);
        if (error != std::errc() || stop != end)
            return fail_at(path, fmt::format("'{}' is not a frame number", text.substr(0, 20)));
        keyframes.push_back(Json{{"frame", frame}, {"path", file}});
    }
    matte = Json{{"keyframes", std::move(keyframes)}};
    return {};
}

/// Version 0: "light" is "plate", "none" or the path of an illumination image.
void upgrade_light_0(Json& light) {
    if (!light.is_string()) return;
    const bool named = light == "plate" || light == "none";
    light = named ? Json{{"source", light}} : Json{{"source", "image"}, {"image", light}};
}

Status upgrade_region_0(Json& region, const std::string& path) {
    if (!region.is_object())
        return fail_at(path, fmt::format("This is {}, but must be an object", type_of(region)));
    const std::string inside = path + ".";
    if (const auto matte = region.find("matte"); matte != region.end())
        WEFT_CHECK_OK(upgrade_matte_0(*matte, inside + "matte"));
    if (const auto light = region.find("light"); light != region.end()) upgrade_light_0(*light);
    if (const auto texture = region.find("texture");
        texture != region.end() && texture->is_string())
        *texture = Json{{"sample", *texture}};
    struct Move {
        const char *from, *group, *to;
    };
    constexpr std::array<Move, 8> kMoves{{{"plane", "texture", "plane"},
                                          {"scale", "placement", "scale"},
                                          {"rotate", "placement", "rotate_deg"},
                                          {"offset", "placement", "offset_px"},
                                          {"seam", "synthesis", "seam"},
                                          {"overlap", "synthesis", "overlap_px"},
                                          {"light_form", "light", "form"},
                                          {"light_strength", "light", "strength"}}};
    for (const Move& m : kMoves)
        WEFT_CHECK_OK(move_into_group(region, m.from, m.group, m.to, inside));
    if (const auto mode = region.find("temporal"); mode != region.end() && mode->is_string())
        *mode = Json{{"mode", *mode}};
    return {};
}

/// 0 → 1. Version 0 predates the first release: "plate" and "output" are plain paths, and a region
/// holds all settings at one level, like the command-line flags.
Status upgrade_from_0(Json& document) {
    for (const char* key : {"plate", "output"})
        if (const auto found = document.find(key); found != document.end() && found->is_string())
            *found = Json{{"path", *found}};
    for (const char* key : {"quality", "seed", "frames"})
        WEFT_CHECK_OK(move_into_group(document, key, "settings", key, ""));
    const auto regions = document.find("regions");
    if (regions == document.end()) return {};
    if (!regions->is_array())
        return fail_at("regions", fmt::format("This is {}, but must be a list", type_of(*regions)));
    for (std::size_t i = 0; i < regions->size(); ++i)
        WEFT_CHECK_OK(upgrade_region_0((*regions)[i], fmt::format("regions[{}]", i)));
    return {};
}

/// Version 1 stored keys, lamps and layers as command-line text.
template <class Parse>
Status upgrade_text_1(Json& region, const char* group, const char* key, const std::string& path,
                      Parse parse) {
    const auto holder = region.find(group);
    if (holder == region.end() || !holder->is_object()) return {};
    const auto found = holder->find(key);
    if (found == holder->end() || !found->is_string()) return {};
    auto upgraded = parse(found->template get<std::string>());
    if (!upgraded) return fail_at(fmt::format("{}{}.{}", path, group, key), upgraded.error());
    *found = std::move(*upgraded);
    return {};
}

Expected<Json> keys_from_1(const std::string& text, std::size_t count) {
    WEFT_TRY(keyed, parse_keyed_numbers(text, count));
    return Json(write_keys(keyed));
}

/// Version 1 accepted any strength and clamped it when rendering.
Expected<Json> strength_keys_from_1(const std::string& text) {
    WEFT_TRY(keyed, parse_keyed_numbers(text));
    for (NumberKey& key : keyed.keys)
        key.numbers[0] = std::clamp(key.numbers[0], 0.0, 1.0);
    return Json(write_keys(keyed));
}

Expected<Json> lamps_from_1(const std::string& text) {
    WEFT_TRY(lamps, parse_lamps(text));
    return Json(write_lamps(lamps));
}

Expected<Json> layers_from_1(const std::string& text) {
    Json list = Json::array();
    if (text == "all") {
        // All that there were.
        for (const LayerInfo& layer : kLayers)
            if (layer.kind < LayerKind::kTexture) list.push_back(layer.name);
        return list;
    }
    for (const std::string_view name : split(text, ','))
        if (!name.empty()) list.push_back(name);
    return list;
}

/// 1 → 2. Keys over time, lamps and layers become lists.
Status upgrade_from_1(Json& document) {
    WEFT_CHECK_OK(upgrade_text_1(document, "output", "layers", "", layers_from_1));
    const auto regions = document.find("regions");
    if (regions == document.end() || !regions->is_array()) return {};
    const auto one = [](const std::string& text) { return keys_from_1(text, 1); };
    const auto two = [](const std::string& text) { return keys_from_1(text, 2); };
    for (std::size_t i = 0; i < regions->size(); ++i) {
        Json& region = (*regions)[i];
        const std::string path = fmt::format("regions[{}].", i);
        if (!region.is_object()) continue;
        for (const char* key : {"scale_keys", "rotate_keys"})
            WEFT_CHECK_OK(upgrade_text_1(region, "placement", key, path, one));
        WEFT_CHECK_OK(upgrade_text_1(region, "placement", "offset_keys", path, two));
        WEFT_CHECK_OK(upgrade_text_1(region, "light", "strength_keys", path, strength_keys_from_1));
        WEFT_CHECK_OK(upgrade_text_1(region, "light", "lamps", path, lamps_from_1));
    }
    return {};
}

/// 2 → 3. A new region takes the light's colour and the plate's exposure; one that was saved keeps
/// its look.
Status upgrade_from_2(Json& document) {
    const auto regions = document.find("regions");
    if (regions == document.end() || !regions->is_array()) return {};
    const auto keep = [](Json& region, const char* group, const char* key) {
        if (!region.contains(group)) region[group] = Json::object();
        Json& object = region[group];
        if (object.is_object() && !object.contains(key)) object[key] = 0.0;
    };
    for (Json& region : *regions) {
        if (!region.is_object()) continue;
        keep(region, "light", "cast");
        keep(region, "grade", "match");
    }
    return {};
}

/// 3 → 4. A new region takes its form from what the clip shows, and lays the patches of a periodic
/// sample on one lattice; one that was saved stays as it lay.
Status upgrade_from_3(Json& document) {
    const auto regions = document.find("regions");
    if (regions == document.end() || !regions->is_array()) return {};
    for (Json& region : *regions) {
        if (!region.is_object()) continue;
        if (!region.contains("form")) region["form"] = Json::object();
        Json& form = region["form"];
        if (form.is_object() && !form.contains("source")) form["source"] = "pass";
        if (!region.contains("texture")) region["texture"] = Json::object();
        Json& texture = region["texture"];
        if (texture.is_object() && !texture.contains("mode")) texture["mode"] = "synthesize";
    }
    return {};
}

/// 4 → 5. Version 5 adds settings whose absence means what version 4 did: nothing to change, but a
/// Weft that does not know them must not open the file, for it would render other pixels.
Status upgrade_from_4(Json& /*document*/) {
    return {};
}

/// 5 → 6. Likewise: version 6 adds zones that change the motion.
Status upgrade_from_5(Json& /*document*/) {
    return {};
}

using Upgrade = Status (*)(Json&);
/// kUpgrades[n] upgrades version n to n + 1.
constexpr std::array<Upgrade, kProjectSchemaVersion> kUpgrades{
    upgrade_from_0, upgrade_from_1, upgrade_from_2, upgrade_from_3, upgrade_from_4, upgrade_from_5};

/// The n of "weft.project/n".
std::optional<int> version_of(std::string_view schema) {
    if (!schema.starts_with(kProjectSchemaName)) return std::nullopt;
    schema.remove_prefix(kProjectSchemaName.size());
    if (!schema.starts_with('/')) return std::nullopt;
    schema.remove_prefix(1);
    int version = 0;
    const auto [end, error] =
        std::from_chars(schema.data(), schema.data() + schema.size(), version);
    if (error != std::errc() || end != schema.data() + schema.size() || version < 0)
        return std::nullopt;
    return version;
}

}  // namespace

Status upgrade_to_current(Json& document) {
    if (!document.is_object())
        return fail_at(
            "", fmt::format("It contains {}, so it is not a Weft project", type_of(document)),
            "open a file that Weft saved");
    const auto schema = document.find("schema");
    if (schema == document.end())
        return fail_at("schema", "This key is missing, so it is not a Weft project",
                       "open a file that Weft saved");
    if (!schema->is_string())
        return fail_at("schema", fmt::format("This is {}, but must be a string", type_of(*schema)));
    const std::string name = schema->get<std::string>();
    const std::optional<int> version = version_of(name);
    if (!version)
        return fail_at("schema",
                       fmt::format("'{}' is not a Weft project, which says '{}/{}'",
                                   name.substr(0, 60), kProjectSchemaName, kProjectSchemaVersion),
                       "open a file that Weft saved");
    if (*version > kProjectSchemaVersion)
        return fail_at(
            "schema",
            fmt::format("The project has version {}, and this Weft reads up to version {}",
                        *version, kProjectSchemaVersion),
            "update Weft, or open it with the Weft that wrote it");
    for (int n = *version; n < kProjectSchemaVersion; ++n)
        WEFT_CHECK_OK(kUpgrades[static_cast<std::size_t>(n)](document));
    document["schema"] = fmt::format("{}/{}", kProjectSchemaName, kProjectSchemaVersion);
    return {};
}

}  // namespace weft::json_codec
