#include "app/session/document/recent_projects.h"

#include <algorithm>

namespace weft {

void remember_recent(EditorSettings& settings, const std::string& path) {
    auto& recent = settings.recent;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    constexpr std::size_t kMost = 12;
    if (recent.size() > kMost) recent.resize(kMost);
    std::erase_if(settings.places, [&](const auto& project) {
        return std::ranges::find(recent, project.first) == recent.end();
    });
}

ProjectPlace place_left(const EditorSettings& settings, const std::string& path) {
    const auto found = settings.places.find(path);
    return found == settings.places.end() ? ProjectPlace{} : found->second;
}

void remember_place(EditorSettings& settings, const std::string& path, const ProjectPlace& place) {
    if (path.empty()) return;
    if (place == ProjectPlace{})
        settings.places.erase(path);
    else
        settings.places[path] = place;
}

}  // namespace weft
