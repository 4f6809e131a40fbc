#include "app/project/codec/update_project.h"

#include <filesystem>

#include "app/project/codec/json_limits.h"
#include "app/project/codec/project_file.h"
#include "app/project/codec/project_json.h"
#include "engine/core/input_file.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

Hash128 hash_of(const std::string& text) {
    return Hasher().bytes(text.data(), text.size()).finish();
}

}  // namespace

Expected<ProjectOnDisk> read_project(const std::string& path) {
    WEFT_TRY(text, read_file(path, "The project", kMaxJsonBytes));
    auto project = project_from_json(text);
    if (!project) return fail_in(std::move(project).error(), path);
    return ProjectOnDisk{std::move(*project), hash_of(text)};
}

Expected<std::optional<Hash128>> project_hash(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return std::nullopt;
    WEFT_TRY(hash, hash_of_contents(path, "The project"));
    return hash;
}

Expected<std::optional<Hash128>> replace_project(const std::string& path, const Project& project,
                                                 const std::optional<Hash128>& expected) {
    const auto text = project_to_json(project);
    if (!text) return fail_in(text.error(), path);
    WEFT_TRY(before, project_hash(path));
    if (before != expected) return std::nullopt;
    WriteRule rule = in_place();
    if (!expected) rule.existing = Existing::kRefuse;
    WEFT_TRY(temporary, TemporaryFile::create(path, rule));
    WEFT_CHECK_OK(temporary.write(std::as_bytes(std::span(text->data(), text->size()))));
    WEFT_CHECK_OK(temporary.flush());
    // As late as possible: syncing may take long.
    WEFT_TRY(now, project_hash(path));
    if (now != expected) return std::nullopt;
    WEFT_CHECK_OK(temporary.commit_unflushed());
    return hash_of(*text);
}

Expected<Project> update_project(const std::string& path, const ProjectEdit& edit,
                                 std::chrono::milliseconds wait) {
    constexpr int kTries = 5;
    for (int k = 0; k < kTries; ++k) {
        WEFT_TRY(lock, FileLock::take(path, wait));
        WEFT_TRY(before, read_project(path));
        WEFT_TRY(after, edit(before.project));
        WEFT_TRY(saved, replace_project(path, after, before.hash));
        if (saved) return after;
    }
    return fail(ErrorCode::kUnreadable,
                path + " is changed by another program again and again while this one writes it.",
                "Close that program and try again.");
}

}  // namespace weft
