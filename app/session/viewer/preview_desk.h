#pragma once
// What the preview is asked for, and what of its results is shown.

#include <cstdint>
#include <optional>
#include <vector>

#include "app/mattes/matte_shelf.h"
#include "app/preview/playback.h"
#include "app/preview/preview.h"
#include "app/session/document/document.h"
#include "app/session/document/selection.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class PreviewDesk {
  public:
    /// The references must stay.
    struct Uses {
        Preview& preview;
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        const MatteShelf& shelf;
    };
    explicit PreviewDesk(Uses uses) : use_(uses) {}

    // ---- what is asked for ----
    /// Something has changed that its pictures depend on.
    void ask() { pending_ = true; }
    /// Something is still to be asked for.
    [[nodiscard]] bool pending() const { return pending_; }
    void show_layer(const std::optional<LayerKind>& layer) { set(layer_, layer); }
    void show_overlay(Overlay overlay) { set(overlay_, overlay); }
    void show_stages(bool shown) { set(stages_, shown); }
    void set_quality(Quality quality) { set(quality_, quality); }
    /// Files of textures were written by others.
    void show_files(std::uint64_t version) { set(files_, version); }
    /// Requests what is asked for, and `cards` after it. Call it in every update.
    void request(double now_s, const std::vector<CardRequest>& cards);
    /// Another document was opened: nothing of the one before is shown.
    void forget();

    // ---- what came ----
    void read();
    [[nodiscard]] const PreviewReading& reading() const { return reading_; }
    /// The frame of the last read().
    [[nodiscard]] int read_frame() const { return read_frame_; }
    /// A region can be rendered.
    [[nodiscard]] bool has_subject() const { return has_subject_; }
    /// The document with only regions enabled that can be shown, at preview quality.
    [[nodiscard]] Project subject() const;
    void show(SessionView& view) const;

  private:
    template <class T>
    void set(T& shown, const T& wanted) {
        shown = wanted;
        ask();
    }
    [[nodiscard]] bool awaits_dragged_picture(double now_s) const;
    void propagate_mattes();
    [[nodiscard]] PreviewRequest request_for(Project subject,
                                             const std::vector<CardRequest>& cards) const;

    Uses use_;
    bool pending_ = false, has_subject_ = false;
    bool stages_ = false;
    std::optional<LayerKind> layer_;
    Overlay overlay_ = Overlay::kNone;
    Quality quality_ = Quality::kDraft;
    std::uint64_t files_ = 0;
    std::optional<double> dragged_at_s_;  // of the last request, if it was for an edit being tried
    PreviewReading reading_;
    int read_frame_ = 0;
    bool failed_ = false;  // what was read last
    PicturePtr last_result_;
    int last_result_frame_ = 0;
};

}  // namespace weft
