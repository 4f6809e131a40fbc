#pragma once
// A movie as a matte.

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// The frames of one movie as mattes, by number from 0. Thread-safe.
class MatteMovie {
  public:
    /// The movie at `path`. Opening it decodes all of it, so the last ones stay open in this
    /// process until their files change. Errors: those of open_plate() for a movie; MissingFrames
    /// if there is no such file.
    [[nodiscard]] static Expected<std::shared_ptr<const MatteMovie>> open(const std::string& path);

    explicit MatteMovie(std::string path, std::shared_ptr<const FrameReader> movie);

    [[nodiscard]] int frame_count() const { return static_cast<int>(movie_->frames().size()); }
    [[nodiscard]] Size size() const { return movie_->size(); }
    /// Of the movie itself, as of a plate.
    [[nodiscard]] std::vector<std::string> warnings() const { return movie_->warnings(); }
    /// Coverage of frame `index`. `channel`: "R", "G", "B", "A" or "Y"; empty: "A" if the alpha of
    /// any of up to 24 frames, spread over all, is not opaque everywhere, else "Y", for all frames.
    /// Errors: MissingFrames beyond the movie; Unreadable if it has no such channel or the frame
    /// cannot be decoded.
    [[nodiscard]] Expected<Matte> read(int index, const std::string& channel) const;
    /// Judges up to 24 frames by the default channel until one satisfies. Returns the warning.
    /// Errors: as MatteJudge::check(); Unreadable for a frame that cannot be decoded.
    [[nodiscard]] Expected<std::string> judge() const;

  private:
    struct Kept {
        int index;
        std::string channel;
        Matte matte;
    };
    [[nodiscard]] Expected<std::string> default_channel() const;
    [[nodiscard]] const Kept* find(int index, const std::string& channel) const;
    void keep(Kept matte) const;

    std::string path_;
    std::shared_ptr<const FrameReader> movie_;
    mutable std::mutex mutex_;
    mutable std::string default_channel_;
    mutable std::deque<Kept> kept_;  // latest last
};

}  // namespace weft
