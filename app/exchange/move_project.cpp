#include "app/exchange/move_project.h"

#include <cctype>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/project/codec/project_file.h"
#include "engine/media/atomic_file.h"
#include "engine/media/sequence_pattern.h"
#include "texture_db/library/library.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& folder, const fs::path& path) {
    if (folder.empty()) return false;
    const fs::path relative = path.lexically_relative(folder);
    return !relative.empty() && relative.begin()->string() != ".." && relative != ".";
}

fs::path own_folder(const std::string& project, const char* what) {
    return fs::path(project_dir(project)) / (fs::path(project).stem().string() + what);
}

// The folder beside `to` that an own file goes to; nothing for other files.
std::optional<fs::path> new_folder(const std::string& path, const std::string& from,
                                   const std::string& to, const std::string& unsaved) {
    for (const char* what : {"_mattes", "_textures"})
        if (!from.empty() && is_below(own_folder(from, what), path)) return own_folder(to, what);
    if (!path.starts_with(unsaved)) return std::nullopt;
    return own_folder(to, path.find("/textures/") != std::string::npos ? "_textures" : "_mattes");
}

// The files that a path of the project names.
std::vector<fs::path> moved_files_of(const std::string& path) {
    std::error_code none;
    if (fs::is_regular_file(path, none)) return {path};
    const auto pattern = SequencePattern::parse(path);
    if (!pattern || pattern->is_single()) return {};
    std::vector<fs::path> out;
    if (const auto frames = pattern->list_frames())
        for (const int frame : *frames)
            out.emplace_back(pattern->path_for(frame));
    return out;
}

// A name beside `wanted` that no file has, so that another project's matte is never replaced.
fs::path free_name(const fs::path& wanted) {
    std::error_code none;
    fs::path path = wanted;
    for (int k = 2; fs::exists(path, none); ++k)
        path = wanted.parent_path() /
               (wanted.stem().string() + "_" + std::to_string(k) + wanted.extension().string());
    return path;
}

// Copies the credits (author, licence) too; the user's own textures have none.
Status copy_with_credit(const std::string& from, const std::string& to) {
    WEFT_CHECK_OK(make_folder_of(to, WriteRule::own()));
    WEFT_CHECK_OK(copy_file_atomically(from, to, WriteRule::own()));
    std::error_code none;
    const std::string credit = texture_credit_path(from);
    if (!fs::exists(credit, none)) return {};
    return copy_file_atomically(credit, texture_credit_path(to), WriteRule::own());
}

}  // namespace

std::string relative_to(const std::string& dir, const std::string& path) {
    if (dir.empty() || !path.starts_with('/')) return path;
    const fs::path relative = fs::path(path).lexically_relative(dir);
    if (relative.empty() || relative.begin()->string() == "..") return path;
    return relative.string();
}

std::string moved_output(const std::string& output, const std::string& from,
                         const std::string& to) {
    if (output.empty() || from.empty()) return output;
    const std::string dir = project_dir(from), old_name = fs::path(from).stem().string();
    const std::string new_name = fs::path(to).stem().string();
    const bool inside = !dir.empty() && is_below(dir, output);
    // The part of the path that tells the projects apart: below the old one's folder, or the last
    // folder and the name.
    const fs::path base = inside ? fs::path(dir) : fs::path(output).parent_path().parent_path();
    const fs::path new_base = inside ? fs::path(project_dir(to)) : base;
    const fs::path rest = fs::path(output).lexically_relative(base);
    fs::path renamed;
    bool named = false;
    for (const fs::path& part : rest) {
        std::string name = part.string();
        const bool is_old = !old_name.empty() && name.starts_with(old_name) &&
                            !std::isalnum(static_cast<unsigned char>(
                                name.size() > old_name.size() ? name[old_name.size()] : ' '));
        if (is_old) name.replace(0, old_name.size(), new_name);
        named |= is_old;
        renamed /= name;
    }
    return (named ? new_base / renamed : new_base / new_name / rest).string();
}

Project rebased(const Project& project, const std::string& from, const std::string& to,
                const MovedFiles& moved) {
    const std::string dir = project_dir(to);
    Project absolute = resolve_paths(project, project_dir(from));
    for (std::string* path :
         {&absolute.output.path, &absolute.output.movie, &absolute.output.layers_path})
        *path = moved_output(*path, from, to);
    return map_paths(absolute, [&](const std::string& path) {
        const auto found = moved.find(path);
        return found == moved.end() ? relative_to(dir, path) : found->second;
    });
}

Expected<MovedFiles> copy_own_files(const Project& project, const std::string& from,
                                    const std::string& to, const std::string& unsaved) {
    const std::string dir = project_dir(to);
    MovedFiles moved;
    Status failed;
    static_cast<void>(
        map_paths(resolve_paths(project, project_dir(from)), [&](const std::string& path) {
            const auto folder = new_folder(path, from, to, unsaved);
            if (!folder || moved.contains(path)) return path;
            const std::vector<fs::path> files = moved_files_of(path);
            if (files.empty()) return path;
            const bool single = files.front() == path;
            fs::path to_path = *folder / fs::path(path).filename();
            if (single) to_path = free_name(to_path);
            for (const fs::path& file : files) {
                const fs::path target = single ? to_path : *folder / file.filename();
                const Status copied = copy_with_credit(file.string(), target.string());
                if (!copied && failed)
                    failed = fail_in(copied.error(),
                                     file.string() + " cannot be copied beside the project");
            }
            moved[path] = relative_to(dir, to_path.string());
            return path;
        }));
    WEFT_CHECK_OK(failed);
    return moved;
}

}  // namespace weft
