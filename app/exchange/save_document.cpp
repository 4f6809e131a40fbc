#include "app/exchange/save_document.h"

#include <filesystem>

#include "app/project/codec/project_file.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 5;

std::string backup_path(const std::string& path) {
    const fs::path whole(path);
    const std::string begin = (whole.parent_path() / whole.stem()).string() + "_backup_";
    std::error_code none;
    for (int number = 1;; ++number) {
        std::string free = begin;
        const std::string digits = std::to_string(number);
        free.append(digits.size() < 3 ? 3 - digits.size() : 0, '0').append(digits).append(".weft");
        if (!fs::exists(free, none)) return free;
    }
}

// What the file holds is replaced by mine, or mine by what the file holds.
Expected<std::string> keep_what_loses(const DocumentSave& what) {
    const std::string backup = backup_path(what.path);
    if (what.answer->wins == MergeSide::kMine)
        WEFT_CHECK_OK(copy_file_atomically(what.path, backup, WriteRule{}));
    else
        WEFT_CHECK_OK(save_project(backup, what.project, WriteRule{}));
    return backup;
}

tl::unexpected<Error> always_changing(const std::string& path) {
    return fail(ErrorCode::kUnreadable, path + " is changed by another program again and again.",
                "Save under another name.");
}

// Merges what others changed into what is about to be saved. Returns false on conflicts without an
// answer.
Expected<bool> merge_theirs(const DocumentSave& what, DocumentSaved& out) {
    auto theirs = read_project(what.path);
    if (!theirs)
        return fail_in(std::move(theirs).error(),
                       "The file was changed by another program and cannot be read. Save under "
                       "another name, or restore it");
    const bool answered = what.answer && what.answer->theirs == theirs->hash;
    WEFT_TRY(merged,
             merge_projects(what.known ? what.known->project : Project(), what.project,
                            theirs->project, answered ? what.answer->wins : MergeSide::kMine));
    out.merged = std::move(merged.changed);
    if (!merged.conflicts.empty() && !answered) {
        out.now = std::move(*theirs);
        out.conflicts = std::move(merged.conflicts);
        return false;
    }
    if (!merged.conflicts.empty()) {
        WEFT_TRY(backup, keep_what_loses(what));
        out.backup = std::move(backup);
    }
    out.renumbered = std::move(merged.renumbered);
    out.now.project = std::move(merged.project);
    return true;
}

Expected<DocumentSaved> save_in_place(const DocumentSave& what) {
    for (int k = 0; k < kTries; ++k) {
        DocumentSaved out;
        out.now.project = what.project;
        WEFT_TRY(lock, lock_project(what.path));
        WEFT_TRY(there, project_hash(what.path));
        if (there && !(what.known && what.known->hash == *there)) {
            WEFT_TRY(merged, merge_theirs(what, out));
            if (!merged) return out;
        }
        WEFT_TRY(saved, replace_project(what.path, out.now.project, there));
        if (!saved) continue;
        out.now.hash = *saved;
        return out;
    }
    return always_changing(what.path);
}

Expected<DocumentSaved> save_elsewhere(const DocumentSave& what) {
    DocumentSaved out;
    WEFT_TRY(moved, copy_own_files(what.project, what.from, what.path, what.unsaved));
    out.now.project = rebased(what.project, what.from, what.path, moved);
    out.moved = std::move(moved);
    for (int k = 0; k < kTries; ++k) {
        WEFT_TRY(lock, lock_project(what.path));
        WEFT_TRY(there, project_hash(what.path));
        if (there && what.new_only)
            return fail(ErrorCode::kUsage, what.path + " was just saved by another program.",
                        "Save again.");
        if (there && out.backup.empty()) {
            out.backup = backup_path(what.path);
            WEFT_CHECK_OK(copy_file_atomically(what.path, out.backup, WriteRule{}));
        }
        WEFT_TRY(saved, replace_project(what.path, out.now.project, there));
        if (!saved) continue;
        out.now.hash = *saved;
        return out;
    }
    return always_changing(what.path);
}

Project with_ids(const Project& project, const std::map<RegionId, RegionId>& ids) {
    Project out = project;
    for (Leaf<Region>& region : out.regions)
        if (const auto found = ids.find(region->id); found != ids.end())
            region = region.with([&](Region& changed) { changed.id = found->second; });
    return out;
}

}  // namespace

Expected<DocumentSaved> save_document(const DocumentSave& what) {
    return what.path == what.from ? save_in_place(what) : save_elsewhere(what);
}

Expected<Project> with_merged(const Project& before, const Project& current,
                              const DocumentSaved& saved) {
    if (current == before) return saved.now.project;
    WEFT_TRY(merged,
             merge_projects(with_ids(before, saved.renumbered), with_ids(current, saved.renumbered),
                            saved.now.project, MergeSide::kMine));
    return std::move(merged.project);
}

}  // namespace weft
