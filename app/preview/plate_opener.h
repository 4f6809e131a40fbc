#pragma once
// Opens plates in the background.

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/color/color_space.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// A plate that can be read, with the transforms of its colour space to the display.
struct OpenedPlate {
    std::shared_ptr<const FrameReader> reader;
    std::shared_ptr<const ColorTransform> srgb, linear;
    std::string space;  ///< Name of the plate's colour space.
};

/// Opens one plate at a time; a newer request replaces an older one. All members are for one
/// thread, and none waits, except for the destructor.
class PlateOpener {
  public:
    /// Starts to open `plate`, whose path is absolute, unless it is the one of the last call.
    /// Returns true if it is another one. With an empty path nothing is opened.
    bool open(const Plate& plate);
    /// Makes the next call of open() start anew.
    void forget() { asked_.reset(); }
    /// Returns true while a plate is being opened.
    [[nodiscard]] bool busy() const { return opening_.valid(); }
    /// How many frames of a movie have been counted so far.
    [[nodiscard]] int counted() const { return counted_ ? counted_->load() : 0; }
    /// The plate, or the error, once after it has been opened. Errors: those of open_plate() and of
    /// the colour space.
    [[nodiscard]] std::optional<Expected<OpenedPlate>> take();

  private:
    std::optional<Plate> asked_;
    std::future<Expected<OpenedPlate>> opening_;
    std::shared_ptr<std::atomic<int>> counted_;  // also by who counts for an abandoned one
    std::vector<std::future<Expected<OpenedPlate>>> abandoned_;
};

}  // namespace weft
