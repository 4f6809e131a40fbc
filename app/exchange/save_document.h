#pragma once
// Saving the editor's document over a file that others may have changed since it was opened.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/exchange/merge_project.h"
#include "app/exchange/move_project.h"
#include "app/project/codec/update_project.h"

namespace weft {

/// What the artist said to conflicts with the version of the file that has this hash.
struct SaveAnswer {
    MergeSide wins = MergeSide::kMine;
    Hash128 theirs;
};

struct DocumentSave {
    std::string path;  ///< Absolute.
    std::string from;  ///< Where the document is; empty: never saved.
    Project project;   ///< As `from` names its files.
    /// What `from` held when it was opened or last saved; none: not known.
    std::optional<ProjectOnDisk> known;
    std::string unsaved;  ///< As copy_own_files() has it.
    std::optional<SaveAnswer> answer;
    bool new_only = false;  ///< Never replaces a file.
};

struct DocumentSaved {
    /// What is on the disk now. With conflicts nothing was written: what is there.
    ProjectOnDisk now;
    std::vector<MergeConflict> conflicts;
    std::vector<std::string> merged;  ///< As MergedProject::changed; empty: nobody changed it.
    std::map<RegionId, RegionId> renumbered;  ///< As MergedProject has it.
    std::string backup;                       ///< The copy of what was replaced; empty: none.
    MovedFiles moved;
};

/// Writes the document. If another program has changed the file, its changes are merged in; where
/// both changed the same, nothing is written and the conflicts are returned, unless `answer` is
/// about them. What is replaced then, and a project that is replaced under another name, is kept as
/// NAME_backup_001.weft beside it. Waits for other writers. Errors: those of copying, reading and
/// writing.
[[nodiscard]] Expected<DocumentSaved> save_document(const DocumentSave& what);

/// The document `current`, which was `before` when save_document() was called, with what that
/// merged in; what was changed meanwhile stays as in `current`. Errors: as merge_projects().
[[nodiscard]] Expected<Project> with_merged(const Project& before, const Project& current,
                                            const DocumentSaved& saved);

}  // namespace weft
