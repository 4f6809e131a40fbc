#include "app/session/document/recent_projects.h"

#include <algorithm>

namespace weft {

void remember_recent(EditorSettings& settings, const std::string& path) {
    auto& recent = settings.recent;
    std::erase(recent, path);
    recent.insert(recent.begin(), path);
    constexpr std::size_t kMost = 12;
    if (recent.size() > kMost) recent.resize(kMost);
    std::erase_if(settings.marked, [&](const auto& project) {
        return std::ranges::find(recent, project.first) == recent.end();
    });
}

MarkedRange marked_range(const EditorSettings& settings, const std::string& path) {
    const auto found = settings.marked.find(path);
    return found == settings.marked.end() ? MarkedRange{} : found->second;
}

void remember_marked_range(EditorSettings& settings, const std::string& path,
                           const MarkedRange& range) {
    if (path.empty()) return;
    if (range == MarkedRange{})
        settings.marked.erase(path);
    else
        settings.marked[path] = range;
}

}  // namespace weft
