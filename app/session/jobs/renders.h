#pragma once
// Renders of the document as jobs.

#include <cstdint>
#include <functional>
#include <string>

#include "app/base/editor_settings.h"
#include "app/mattes/matte_shelf.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/document_trust.h"
#include "app/session/document/notices.h"
#include "app/session/jobs/job_desk.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class Renders {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const ShownPlate& plate;
        DocumentTrust& trust;
        MatteShelf& shelf;
        DocumentTasks& tasks;
        Notices& notices;
        EditorSettings& settings;
        std::function<void()> end_stroke;
        std::string program;       ///< The weft program that renders.
        std::string state_folder;  ///< See editor_state_folder().
    };
    explicit Renders(Uses uses);

    void submit(const SubmitJob& action);
    void command(const CommandJob& action) { jobs_.command(action); }
    [[nodiscard]] std::string log_tail(int id) const { return jobs_.log_tail(id); }
    /// Increases with every change of a job.
    [[nodiscard]] std::uint64_t changes() const { return jobs_.changes(); }
    /// Reports the jobs that have ended. Call it in every update.
    void watch();
    void show(SessionView& view) const { view.jobs = jobs_.jobs(); }

  private:
    /// Absolute; empty if it was never saved.
    [[nodiscard]] std::string project_file() const;

    Uses use_;
    JobDesk jobs_;
};

}  // namespace weft
