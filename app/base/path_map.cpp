#include "app/base/path_map.h"

namespace weft {
namespace {

std::string without_slash(std::string path) {
    while (path.size() > 1 && path.back() == '/')
        path.pop_back();
    return path;
}

}  // namespace

Expected<RootMap> parse_root_map(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        return fail(ErrorCode::kUsage, "'" + text + "' maps no root.", "Write it like FROM=TO.");
    }
    return RootMap{without_slash(text.substr(0, equals)), without_slash(text.substr(equals + 1))};
}

Project with_mapped_roots(const Project& project, const std::vector<RootMap>& maps) {
    if (maps.empty()) return project;
    return map_paths(project, [&](const std::string& path) {
        for (const RootMap& map : maps) {
            if (path == map.from) return map.to;
            if (path.starts_with(map.from + "/")) return map.to + path.substr(map.from.size());
        }
        return path;
    });
}

}  // namespace weft
