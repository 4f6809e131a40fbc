#pragma once
// The plate as the viewer shows it: opened in the background, decoded in the order of playback.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/preview/plate_opener.h"
#include "app/preview/plate_player.h"
#include "app/preview/playback.h"
#include "app/session/document/shutdowns.h"
#include "app/session/session_view.h"
#include "app/shot/drawn_mattes.h"

namespace weft {

/// Belongs to one thread and never blocks it. Plates have absolute paths.
class ShownPlate {
  public:
    /// The references must stay.
    ShownPlate(Playback& playback, Shutdowns& shutdowns, std::size_t budget_bytes)
        : playback_(playback), shutdowns_(shutdowns), budget_bytes_(budget_bytes) {}

    /// Opens another plate; nothing of the one before is shown any more.
    void open(const Plate& plate);
    /// Makes the next call of open() start anew.
    void forget() { opener_.forget(); }
    /// Takes over a plate that has been opened. Returns true if there is one.
    bool take();
    /// Moves the playhead during playback, and decodes what it comes to.
    void advance(double now_s);

    /// Null while no plate is open.
    [[nodiscard]] const std::shared_ptr<const FrameReader>& reader() const { return reader_; }
    /// The mattes of its shapes; null likewise.
    [[nodiscard]] const std::shared_ptr<const DrawnMattes>& drawn() const { return drawn_; }
    /// Of its pixels; square without a plate.
    [[nodiscard]] PixelAspect aspect() const {
        return reader_ ? PixelAspect(reader_->pixel_aspect()) : PixelAspect();
    }
    /// The picture that is shown; null: none.
    [[nodiscard]] const PicturePtr& picture() const { return picture_; }
    /// By index into the reader's frames, as far as known.
    [[nodiscard]] const std::vector<PlatePlayer::State>& states() const { return reading_.states; }
    [[nodiscard]] bool opening() const { return opener_.busy(); }
    /// Increases with every decoded frame.
    [[nodiscard]] std::uint64_t changes() const { return player_ ? player_->changes() : 0; }

    /// Reads what has been decoded. `plate`: as the document has it now.
    void update(const Plate& plate);
    void show(SessionView& view) const;
    /// The playhead, and what is to be said of its frame.
    void show_frame(SessionView& view) const;

  private:
    void describe(const Plate& plate);
    void read();

    Playback& playback_;
    Shutdowns& shutdowns_;
    const std::size_t budget_bytes_;
    PlateOpener opener_;
    std::shared_ptr<const FrameReader> reader_;
    std::shared_ptr<const DrawnMattes> drawn_;  // there is one while there is a reader
    std::shared_ptr<PlatePlayer> player_;       // likewise
    PlatePlayer::Reading reading_;
    PlateView view_;
    PicturePtr picture_;
};

}  // namespace weft
