#pragma once
// Rules for writing at a path. Every file that Weft writes goes through engine/media/atomic_file.h
// with one of them.

#include <sys/types.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

/// The files that a run reads and must not change, and the folders that it may write to. Filled
/// once, then shared and immutable; check() is thread-safe.
class WriteFence {
  public:
    /// From now on, writing is only allowed inside `folder` and folders added before. It need not
    /// exist yet. Errors: Usage if `folder` is a file.
    [[nodiscard]] Status add_root(const std::string& folder);
    /// Protects the file at `path` under all its names (hard links, symbolic links, "..", case). A
    /// file that does not exist is protected by its name.
    void protect(const std::string& path);
    /// Protects every frame of the pattern, whether its file exists or not.
    void protect_frames(const SequencePattern& pattern);

    /// `shown`: the path as the user wrote it, for messages. `real`: absolute, without symbolic
    /// links in its folder part. Errors: Usage (an input, or outside the root).
    [[nodiscard]] Status check(const std::string& shown, const std::string& real) const;
    /// The same for a folder that is about to be created.
    [[nodiscard]] Status check_folder(const std::string& folder) const;

  private:
    struct Frames {
        std::string folder;  // real
        SequencePattern name;
    };
    std::string real_name(const std::string& path);
    [[nodiscard]] bool allows(const std::string& real_folder) const;

    std::vector<std::string> roots_;  // real; none: anywhere
    std::set<std::pair<dev_t, ino_t>> files_;
    std::set<std::string> names_;  // real
    std::vector<Frames> frames_;
    std::map<std::string, std::string> real_folders_;  // by the folder as it was written
};

enum class Existing {
    kRefuse,  ///< An existing file stays: Usage, naming it.
    kReplace
};

/// The default is the most restrictive one.
struct WriteRule {
    Existing existing = Existing::kRefuse;
    /// Follows a symbolic link at the path: only for a project that the user opened through it.
    /// Otherwise the link itself is replaced.
    bool follow_link = false;
    /// Allows /dev/stdout, a pipe or another device.
    bool device = false;
    std::shared_ptr<const WriteFence> fence = nullptr;  ///< Null: no inputs, no root.

    /// For Weft's own files: caches, settings, recovery, temporaries.
    [[nodiscard]] static WriteRule own() { return {Existing::kReplace, false, false, nullptr}; }
};

/// The rule for existing files, with or without --overwrite.
[[nodiscard]] inline Existing existing_by(bool overwrite) {
    return overwrite ? Existing::kReplace : Existing::kRefuse;
}

/// "PATH exists already. Use --overwrite, or another name."
[[nodiscard]] Error exists_already(const std::string& path);

/// The folder of `path` (the current folder if it has none), absolute and without symbolic links,
/// and the file's name in it. Parts that do not exist yet are kept as written.
[[nodiscard]] std::string real_path(const std::string& path);

}  // namespace weft
