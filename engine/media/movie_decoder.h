#pragma once
// Internal: the frames of one movie file, in display order.

#include <string>

#include "engine/media/video_library.h"

namespace weft {

/// Decodes the best video stream from its start to its end. It never seeks: seeking inside a
/// container lands on the wrong frame in some files. One thread.
class MovieDecoder {
  public:
    explicit MovieDecoder(std::string path) : path_(std::move(path)) {}

    /// Restarts before the first frame. False if the file is not a movie.
    [[nodiscard]] bool rewind();
    /// After rewind() was false: the file has sound, but no pictures.
    [[nodiscard]] bool has_sound_only() const { return sound_only_; }
    /// The next frame, valid until the next call; null after the last. Skips frames that cannot be
    /// decoded.
    [[nodiscard]] const AVFrame* next();

    // After rewind():
    [[nodiscard]] double fps() const;  ///< 0 when the file does not say.
    /// Seconds between the units of a frame's time stamp.
    [[nodiscard]] double tick_s() const;
    /// The number of frames by the container; 0 if it does not say.
    [[nodiscard]] int claimed_frames() const;
    /// True if that is only its duration times its rate, which does not reveal a variable rate.
    [[nodiscard]] bool claims_by_duration() const { return stream_->nb_frames <= 0; }
    /// Width of a pixel over its height.
    [[nodiscard]] double pixel_aspect() const;
    /// Clockwise rotation for display: 0, 90, 180 or 270 degrees.
    [[nodiscard]] int rotation_deg() const;

  private:
    bool open_codec(const AVCodec* codec);
    void feed();

    std::string path_;
    AvInput input_;
    AvCodec codec_;
    AvFrame frame_;
    AvPacket packet_;
    AVStream* stream_ = nullptr;
    int discarded_ = 0;  // packets that the container's edit list leaves out
    bool draining_ = false;
    bool sound_only_ = false;
};

}  // namespace weft
