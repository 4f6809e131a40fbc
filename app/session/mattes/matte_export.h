#pragma once
// Writes mattes to files: exported or frozen.

#include <functional>
#include <string>
#include <vector>

#include "app/mattes/matte_shelf.h"
#include "app/preview/playback.h"
#include "app/preview/preview.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/mattes/matte_folder.h"
#include "app/session/viewer/shown_plate.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class MatteExport {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        const Preview& preview;  ///< Has the propagated mattes.
        MatteShelf& shelf;
        MatteFolder& folder;
        DocumentTasks& tasks;
        Notices& notices;
        std::function<void()> end_stroke;
    };
    explicit MatteExport(Uses uses) : use_(std::move(uses)) {}

    /// Writes the selected layer's mattes of the marked range, else of the whole shot.
    void export_to(const std::string& pattern);
    /// Keeps the selected region's mattes of that range as they are now.
    void freeze();
    /// Lets them follow again.
    void thaw();

  private:
    enum class Edges : std::uint8_t { kAsShown, kNone };
    using Then = std::function<void(const std::vector<int>& frames)>;
    /// With or without the edge tools; then calls `then` with the frames.
    void write(const std::string& pattern, Edges edges, Then then);
    [[nodiscard]] const Region* region() const {
        return use_.selection.of(use_.document.project());
    }

    Uses use_;
};

/// Files may be replaced, but no input of the project. `absolute`: with absolute paths;
/// `project_file`: empty if there is none.
[[nodiscard]] WriteRule export_rule_of(const Project& absolute, const std::string& project_file);

}  // namespace weft
