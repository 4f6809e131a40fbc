#pragma once
// Opening documents: new ones, project files, plates, and those that a crash left behind.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/editor_settings.h"
#include "app/base/recovery.h"
#include "app/session/document/document.h"
#include "app/session/document/document_files.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/session_view.h"

namespace weft {

/// Belongs to one thread, on which it reads project files.
class DocumentOpening {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        DocumentFiles& files;
        DocumentTasks& tasks;
        Notices& notices;
        EditorSettings& settings;  ///< The recent projects.
        std::string assets;        ///< Folder that has demo/demo.weft.
        std::string state_folder;  ///< See editor_state_folder().
        bool offer_recovery = true;
    };
    explicit DocumentOpening(Uses uses);

    void open_new();
    void close();
    void open_project(const std::string& path);
    void open_demo();
    /// A folder, a pattern, a movie, a picture or a project file.
    void open_any(const std::string& path);
    /// The frame whose file was opened, once; empty: another thing was.
    [[nodiscard]] std::optional<int> take_first_frame() {
        return std::exchange(first_frame_, std::nullopt);
    }
    /// Opens the newest document that a crash left behind, or gives it up.
    void recover(bool accept);
    /// Looks for more of them. Call it in every update.
    void find_more_recoverable(double now_s);
    void show(SessionView& view) const;

  private:
    void start(Project project, std::string path);
    [[nodiscard]] std::string recovery_folder() const;

    Uses use_;
    std::vector<RecoveredProject> recoverable_;
    double first_look_s_ = -1;
    double look_after_s_ = 1;  // since the first look: time of the next one
    std::optional<int> first_frame_;
};

}  // namespace weft
