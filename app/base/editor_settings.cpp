#include "app/base/editor_settings.h"

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/input_file.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string xdg_folder(const char* variable, const char* below_home) {
    if (const char* given = std::getenv(variable); given && *given)
        return (fs::path(given) / "weft").string();
    const char* home = std::getenv("HOME");
    return (fs::path(home && *home ? home : "/tmp") / below_home / "weft").string();
}

template <class T>
void take(const Json& json, const char* key, T& into) {
    try {
        if (json.contains(key)) into = json.at(key).get<T>();
    } catch (const Json::exception&) {
        // Values of a wrong type keep the default.
    }
}

// [in, out, frame], null where it is not set.
Json places_json(const std::map<std::string, ProjectPlace>& places) {
    const auto number = [](std::optional<int> frame) { return frame ? Json(*frame) : Json(); };
    Json out = Json::object();
    for (const auto& [project, place] : places)
        out[project] = Json::array({number(place.in), number(place.out), number(place.frame)});
    return out;
}

void take_places(const Json& json, std::map<std::string, ProjectPlace>& into) {
    if (!json.contains("marked") || !json.at("marked").is_object()) return;
    const auto number = [](const Json& frame) {
        return frame.is_number_integer() ? std::optional(frame.get<int>()) : std::nullopt;
    };
    for (const auto& [project, place] : json.at("marked").items()) {
        if (!place.is_array() || place.size() < 2) continue;
        into[project] = {number(place[0]), number(place[1]), {}};
        if (place.size() > 2) into[project].frame = number(place[2]);  // files before had none
    }
}

}  // namespace

std::string editor_settings_path() {
    return xdg_folder("XDG_CONFIG_HOME", ".config") + "/editor.json";
}

std::string editor_state_folder() {
    return xdg_folder("XDG_STATE_HOME", ".local/state");
}

EditorSettings load_editor_settings(const std::string& path) {
    EditorSettings out;
    const auto text = read_file(path, "The settings");
    if (!text) return out;
    const Json json = Json::parse(*text, nullptr, false);
    if (!json.is_object()) return out;
    take(json, "dark", out.dark);
    take(json, "grey_surround", out.grey_surround);
    take(json, "ui_scale", out.ui_scale);
    take(json, "keys", out.keys);
    take(json, "sizes", out.sizes);
    take(json, "recent", out.recent);
    take_places(json, out.places);
    take(json, "favourites", out.favourites);
    take(json, "recent_textures", out.recent_textures);
    take(json, "collections", out.collections);
    take(json, "texture_folders", out.texture_folders);
    take(json, "tour_seen", out.tour_seen);
    take(json, "render_speed", out.render_speed);
    take(json, "matte_opacity", out.matte_opacity);
    take(json, "correct_only_where_painted", out.here_only);
    take(json, "paint_program", out.paint_program);
    take(json, "screen_display", out.screen_display);
    take(json, "screen_view", out.screen_view);
    return out;
}

Status save_editor_settings(const std::string& path, const EditorSettings& s) {
    std::error_code error;
    fs::create_directories(fs::path(path).parent_path(), error);
    const Json json{{"dark", s.dark},
                    {"grey_surround", s.grey_surround},
                    {"ui_scale", s.ui_scale},
                    {"keys", s.keys},
                    {"sizes", s.sizes},
                    {"recent", s.recent},
                    {"marked", places_json(s.places)},
                    {"favourites", s.favourites},
                    {"recent_textures", s.recent_textures},
                    {"collections", s.collections},
                    {"texture_folders", s.texture_folders},
                    {"tour_seen", s.tour_seen},
                    {"render_speed", s.render_speed},
                    {"matte_opacity", s.matte_opacity},
                    {"correct_only_where_painted", s.here_only},
                    {"paint_program", s.paint_program},
                    {"screen_display", s.screen_display},
                    {"screen_view", s.screen_view}};
    return write_file_atomically(
        path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", WriteRule::own());
}

}  // namespace weft
