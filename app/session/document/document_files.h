#pragma once
// The files around the document: inputs that are missing, copies of all inputs, and where it
// renders to.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/mattes/matte_shelf.h"
#include "app/session/document/collect_run.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/session_view.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class DocumentFiles {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        DocumentTasks& tasks;
        Notices& notices;
        MatteShelf& shelf;  ///< Painted mattes are among the files.
        std::function<void()> end_stroke;
        std::string texture_library;
    };
    explicit DocumentFiles(Uses uses) : use_(std::move(uses)) {}

    void look_for_missing();
    /// Looks for them in `folder` and its subfolders.
    void relink(const std::string& folder);
    void find_render_folder();
    /// Copies the project with its inputs into a new folder below `folder`. One at a time. It goes
    /// on when another shot is opened: its files were named when it began.
    void collect(const std::string& folder);
    void cancel_collect();

    /// Another document was opened.
    void forget() { missing_.clear(); }
    /// What is missing and where it renders to.
    void show(SessionView& view) const;
    void show_collecting(SessionView& view) const;

  private:
    Uses use_;
    std::vector<std::string> missing_;
    std::string render_folder_;
    std::optional<CollectRun> collecting_;
};

/// "v001"
[[nodiscard]] std::string version_text(int version);

}  // namespace weft
