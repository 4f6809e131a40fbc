#pragma once
// Measures the finished frames of an output against the plate, for the review.

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "app/session/session_view.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_reader.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// What is measured; used by one thread.
struct MeasuredResult {
    std::shared_ptr<const FrameReader> plate;
    std::string pattern;  ///< Of the output.
    /// The region's matte on a frame of the plate.
    std::function<Expected<Matte>(int frame)> matte;
    /// The track of its texture; it may fail.
    std::function<Expected<LatticeField>(int before, int now)> track;
};

/// The report of a measurement in progress. Thread-safe with its mutex.
struct SharedReport {
    std::mutex mutex;
    QualityReport report;
    std::atomic<bool> cancelled{false};
};

/// Adds a row for each frame; stops when it is cancelled. Slow. Errors: those of reading, and of
/// `matte`.
[[nodiscard]] Status measure_result(const MeasuredResult& what, SharedReport& shared);

}  // namespace weft
