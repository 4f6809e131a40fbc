#pragma once
// The folders whose projects may write outside their folder. A project from an untrusted source may
// not, because it could name any of the user's files as its output.

#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

struct TrustedFolder {
    std::string path;    ///< Absolute, without symbolic links.
    bool below = false;  ///< With all folders below it.
    bool operator==(const TrustedFolder&) const = default;
};

/// The user's list of trusted folders, stored in a file. It is read on every call and written as a
/// whole; if two programs write it at the same time, the later one wins.
class TrustList {
  public:
    /// `file` empty: the list is empty and cannot be changed.
    explicit TrustList(std::string file) : file_(std::move(file)) {}
    /// $XDG_CONFIG_HOME/weft/trusted.json, or ~/.config/weft/trusted.json.
    [[nodiscard]] static TrustList of_user();

    static constexpr std::size_t kMostFolders = 1000;

    /// Oldest first. A missing or damaged list is empty.
    [[nodiscard]] std::vector<TrustedFolder> folders() const;
    /// Returns true if the project's folder is in the list, or below an entry that includes
    /// subfolders.
    [[nodiscard]] bool trusts(const std::string& project_file) const;
    /// Returns the folder as it was added. At kMostFolders the oldest entry is dropped. Errors:
    /// Unreadable (no such folder, or the list cannot be written), Usage (a name that is not
    /// UTF-8).
    [[nodiscard]] Expected<std::string> add(const std::string& folder, bool below);
    /// Errors: Usage when the folder is not in the list.
    [[nodiscard]] Status remove(const std::string& folder);
    [[nodiscard]] const std::string& file() const { return file_; }

  private:
    [[nodiscard]] Status write(const std::vector<TrustedFolder>& folders) const;
    std::string file_;
};

/// The outputs that `project` itself names (frames, layers, movie; resolved paths) and that lie
/// outside the folder of `project_file` after symbolic links are resolved.
[[nodiscard]] std::vector<std::string> outputs_outside(const Project& project,
                                                       const std::string& project_file);

/// Outputs that the user, not the project, named for this run.
struct NamedByUser {
    bool frames = false, layers = false, movie = false;
    bool trust = false;       ///< --trust
    std::string output_root;  ///< --output-root; empty: none.
};
/// Errors: Refused when an output lies outside the project's folder, the user did not name or allow
/// it, and the folder is not trusted. The message names the output and what to do.
[[nodiscard]] Status check_trust(const Project& project, const std::string& project_file,
                                 const NamedByUser& by_user, const TrustList& trusted);

/// The folders of the project's outputs, absolute, without duplicates.
[[nodiscard]] std::vector<std::string> output_folders(const Project& project);

/// The folders that a run of an untrusted project may write to: the project's own and those that
/// the user named. Empty for a project that is trusted or allowed.
[[nodiscard]] std::vector<std::string> permitted_roots(const Project& project,
                                                       const std::string& project_file,
                                                       const NamedByUser& by_user,
                                                       const TrustList& trusted);

}  // namespace weft
