#pragma once
// Changed mattes become part of the document: their pixels go to files, their keyframes to the
// history.

#include <optional>
#include <string>

#include "app/mattes/matte_painting.h"
#include "app/mattes/matte_shelf.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/mattes/matte_folder.h"
#include "app/session/mattes/paint_target.h"

namespace weft {

/// What the history calls a change: of a whole matte ("Paint wall"), to which the frame is added,
/// and of a part of one ("Correct "), to which the layer and the frame are.
struct ChangeLabels {
    std::string whole, part;
};

/// Belongs to one thread. Each change is one step of the history.
class KeptMattes {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        const Selection& selection;  ///< The zone that begins with a matte.
        MatteFolder& folder;
        MatteShelf& shelf;
        PropagatedMattes& propagated;
        Notices& notices;
    };
    explicit KeptMattes(Uses uses) : use_(uses) {}

    /// `matte` becomes the keyframe of its frame. `shape`: what it was drawn from.
    void keep(MattePtr matte, const MattePlace& place, const std::string& label,
              const std::optional<RotoShape>& shape = {});
    /// A change of what began with `part`, or of a whole matte without one. Without a matte nothing
    /// was changed.
    void keep_change(ChangedMatte made, const std::optional<ConfirmedMatte>& part,
                     const MattePlace& place, const ChangeLabels& labels,
                     const std::optional<RotoShape>& shape = {});
    /// `matte` counts where it was `changed`, in addition to what was confirmed `before`. `what`:
    /// begins the label.
    void keep_part(MattePtr matte, const Matte& changed, const ConfirmedMatte& before,
                   const MattePlace& place, const std::string& what);
    /// `now` is what is confirmed on the frame.
    void keep_confirmed(const ConfirmedMatte& now, const MattePlace& place,
                        const std::string& what);
    /// `matte` becomes the only keyframe of a layer whose mattes came from files.
    void keep_instead(const MattePtr& matte, const MattePlace& place);
    /// The keyframe of one frame of the selected layer to another.
    void copy_keyframe(int from, int to);
    /// The layer becomes `matte`.
    void commit_layer(const Region& region, int layer, const MatteSource& matte,
                      const std::string& label);

    /// Returns true if the last kept mattes have been written since the last call.
    [[nodiscard]] bool were_written();

  private:
    [[nodiscard]] Edit layer_edit(const Region& region, int layer, const MatteSource& matte) const;
    [[nodiscard]] std::string write(const MattePtr& matte, const MattePlace& place);

    Uses use_;
    bool unwritten_ = false;  // as of the last update
};

}  // namespace weft
