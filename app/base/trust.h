#pragma once
// Which folders' projects may write outside of their folder. A project from elsewhere may not: it
// could name any file of the user as its output.

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

/// The user's list of trusted folders, a file. Read at every call, written whole; of two programs
/// that write it at the same time, the later one counts.
class TrustList {
  public:
    /// `file` empty: nothing is trusted, and nothing can be.
    explicit TrustList(std::string file) : file_(std::move(file)) {}
    /// $XDG_CONFIG_HOME/weft/trusted.json, or ~/.config/weft/trusted.json.
    [[nodiscard]] static TrustList of_user();

    static constexpr std::size_t kMostFolders = 1000;

    /// The oldest first. A list that is missing or damaged holds nothing.
    [[nodiscard]] std::vector<TrustedFolder> folders() const;
    /// True for a project file whose folder is in the list or below one that is trusted with all
    /// below it.
    [[nodiscard]] bool trusts(const std::string& project_file) const;
    /// Returns the folder as it was added. The oldest goes when there are kMostFolders. Errors:
    /// Unreadable (no such folder, a list that cannot be written), Usage (a name that is not
    /// UTF-8).
    [[nodiscard]] Expected<std::string> add(const std::string& folder, bool below);
    /// Errors: Usage when it is not in the list.
    [[nodiscard]] Status remove(const std::string& folder);
    [[nodiscard]] const std::string& file() const { return file_; }

  private:
    [[nodiscard]] Status write(const std::vector<TrustedFolder>& folders) const;
    std::string file_;
};

/// The outputs that `project` itself names (frames, layers, movie; paths resolved) and that would
/// lie outside of the folder of `project_file`, symbolic links considered.
[[nodiscard]] std::vector<std::string> outputs_outside(const Project& project,
                                                       const std::string& project_file);

/// What was not named by the project but by the user, for this run.
struct NamedByUser {
    bool frames = false, layers = false, movie = false;
    bool trust = false;       ///< --trust
    std::string output_root;  ///< --output-root; empty: none.
};
/// Errors: Refused, naming the first output outside of the project's folder, and what to do, when
/// neither the user named or allowed it nor `trusted` holds the folder.
[[nodiscard]] Status check_trust(const Project& project, const std::string& project_file,
                                 const NamedByUser& by_user, const TrustList& trusted);

/// The folders of the project's outputs, absolute, each once.
[[nodiscard]] std::vector<std::string> output_folders(const Project& project);

/// Where a run may write when its project is not trusted: the project's folder and those of what
/// the user named. None for a project that is trusted or allowed.
[[nodiscard]] std::vector<std::string> permitted_roots(const Project& project,
                                                       const std::string& project_file,
                                                       const NamedByUser& by_user,
                                                       const TrustList& trusted);

}  // namespace weft
