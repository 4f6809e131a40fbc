#pragma once
// Saving the document, also over a file that others have changed.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "app/base/editor_settings.h"
#include "app/exchange/save_document.h"
#include "app/mattes/matte_shelf.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/document_files.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/document_trust.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/session_view.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class DocumentSaving {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        Selection& selection;  ///< Merging may give regions other numbers.
        DocumentFiles& files;
        DocumentTrust& trust;
        DocumentTasks& tasks;
        Notices& notices;
        MatteShelf& shelf;
        EditorSettings& settings;  ///< The recent projects.
        std::function<void()> end_stroke;
        std::string state_folder;
    };
    explicit DocumentSaving(Uses uses) : use_(std::move(uses)) {}

    void save(const std::string& path) { begin({path, {}, false}); }
    /// Under the next free version of its name.
    void save_version();
    void answer(const AnswerSave& answer);

    /// Another document was opened.
    void forget() { question_.reset(); }
    void show(SessionView& view) const;

  private:
    struct Wanted {
        std::string path;
        std::optional<SaveAnswer> answer;
        bool new_only = false;  // as DocumentSave has it
    };
    void begin(const Wanted& wanted);
    [[nodiscard]] bool is_plate_folder(const std::string& folder) const;
    [[nodiscard]] DocumentSave request(const Wanted& wanted, const std::string& whole) const;
    void finish(const DocumentSave& what, const Expected<DocumentSaved>& done, std::uint64_t serial,
                bool here);
    void take(const DocumentSave& what, const DocumentSaved& done, std::uint64_t serial);

    Uses use_;
    bool saving_ = false;
    std::optional<SaveQuestion> question_;
};

}  // namespace weft
