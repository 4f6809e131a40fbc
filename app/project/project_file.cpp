#include "app/project/project_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/project/json_limits.h"
#include "app/project/project_json.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

Expected<std::string> read_text(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        return fail(ErrorCode::kUnreadable, "There is no such project file");
    // A pipe or a device might never end.
    if (!std::filesystem::is_regular_file(status))
        return fail(ErrorCode::kUnreadable, "This is a folder or a device, not a project file");
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return fail(ErrorCode::kUnreadable, "It cannot be opened (" +
                                                std::generic_category().message(errno) +
                                                "); check its permissions");
    // One byte more than allowed, so that the parser sees that it is too large; its size may lie.
    std::string text(kMaxJsonBytes + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) return fail(ErrorCode::kUnreadable, "It cannot be read; check the disk");
    text.resize(static_cast<std::size_t>(file.gcount()));
    text.shrink_to_fit();
    return text;
}

}  // namespace

Expected<Project> load_project(const std::string& path) {
    auto text = read_text(path);
    if (!text) return fail_in(std::move(text).error(), path);
    auto project = project_from_json(*text);
    if (!project) return fail_in(std::move(project).error(), path);
    return project;
}

Status save_project(const std::string& path, const Project& project) {
    const auto text = project_to_json(project);
    if (!text) return fail_in(text.error(), path);
    return write_file_atomically(path, *text);
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
