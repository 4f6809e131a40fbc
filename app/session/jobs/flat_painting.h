#pragma once
// A region's surface is written as a still picture and opened in a paint program.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/base/editor_settings.h"
#include "app/base/paint_programs.h"
#include "app/mattes/matte_shelf.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Gathers the surface by `weft flatten` as a child process on a snapshot of the document, makes
/// the picture the region's texture as one step of the history, and starts the program with it.
/// What is saved there is shown by TextureFiles. One at a time. Belongs to one thread and never
/// blocks it.
class FlatPainting {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        const ShownPlate& plate;
        MatteShelf& shelf;
        DocumentTasks& tasks;
        Notices& notices;
        const EditorSettings& settings;  ///< The paint program.
        const std::vector<PaintProgram>& programs;
        std::function<void()> end_painting;
        std::string program;       ///< The weft program.
        std::string state_folder;  ///< See editor_state_folder().
    };
    explicit FlatPainting(Uses uses);
    /// Ends what is being gathered; paint programs go on.
    ~FlatPainting();

    /// A region that already shows a picture of its own is only opened.
    void paint(const PaintFlat& action);
    /// Ends the gathering; nothing of it stays.
    void stop();
    [[nodiscard]] bool busy() const { return run_ != nullptr; }
    /// Call it in every update.
    void watch();
    void show(SessionView& view) const;

  private:
    struct Run;

    void begin(Run& run);
    void take_back(const Run& run);
    void open_in(const PaintProgram& program, const std::string& picture);
    /// A free name for the picture of a region, in a folder beside the project.
    [[nodiscard]] std::string new_picture(const Region& region, const PaintProgram& program) const;

    Uses use_;
    std::shared_ptr<Run> run_;
    int runs_ = 0;
    // Processes that have not ended yet: of paint programs, and of runs that were stopped, whose
    // files go then.
    struct Ending {
        int process;
        std::shared_ptr<Run> stopped;
    };
    std::vector<Ending> ending_;
};

}  // namespace weft
