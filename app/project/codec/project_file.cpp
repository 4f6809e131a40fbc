#include "app/project/codec/project_file.h"

#include <filesystem>

#include "app/project/codec/project_json.h"
#include "app/project/codec/update_project.h"
#include "engine/media/atomic_file.h"

namespace weft {
Expected<Project> load_project(const std::string& path) {
    WEFT_TRY(file, read_project(path));
    return std::move(file.project);
}

WriteRule in_place() {
    WriteRule rule;
    rule.existing = Existing::kReplace;
    rule.follow_link = true;
    return rule;
}

Status save_project(const std::string& path, const Project& project, const WriteRule& rule) {
    const auto text = project_to_json(project);
    if (!text) return fail_in(text.error(), path);
    return write_file_atomically(path, *text, rule);
}

std::string project_dir(const std::string& project_path) {
    return std::filesystem::path(project_path).parent_path().string();
}

std::string resolve_path(const std::string& dir, const std::string& path) {
    if (names_library_texture(path)) return path;
    if (path.empty() || dir.empty() || std::filesystem::path(path).is_absolute()) return path;
    return (std::filesystem::path(dir) / path).string();
}

Project resolve_paths(const Project& project, const std::string& dir) {
    return map_paths(project, [&](const std::string& path) { return resolve_path(dir, path); });
}

}  // namespace weft
