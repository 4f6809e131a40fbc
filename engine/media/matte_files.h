#pragma once
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

/// A matte for every frame: numbered pictures, one picture for all frames, or a movie.
class MatteFiles {
  public:
    /// `first`: the plate's first frame, to which a movie's first one belongs. Errors: those of
    /// SequencePattern::parse(). No file is opened.
    [[nodiscard]] static Expected<MatteFiles> parse(const std::string& text, int first);
    /// One picture, also if its name looks like a pattern.
    [[nodiscard]] static MatteFiles single(const std::string& path);

    /// One picture for all frames.
    [[nodiscard]] bool is_single() const { return pattern_.is_single() && !movie_; }
    [[nodiscard]] bool is_movie() const { return movie_; }
    /// The file that a frame is in.
    [[nodiscard]] std::string path_for(int frame) const { return pattern_.path_for(frame); }
    /// The frames that have a picture, ascending; none for a single one. Errors: those of
    /// SequencePattern::list_frames() and MatteMovie::open().
    [[nodiscard]] Expected<std::vector<int>> list_frames() const;
    /// Changes whenever the frame's matte may have changed.
    [[nodiscard]] Expected<Hash128> stamp(int frame) const;
    /// Errors: Usage for ids or Cryptomatte objects of a movie, which has neither.
    [[nodiscard]] Status check_select(const MatteSelect& select) const;
    /// Errors: those of check_select(), read_matte() and MatteMovie::read().
    [[nodiscard]] Expected<Matte> read(int frame, const MatteSelect& select, Size expected) const;

  private:
    MatteFiles(SequencePattern pattern, bool movie, int first)
        : pattern_(std::move(pattern)), movie_(movie), first_(first) {}

    SequencePattern pattern_;
    bool movie_;
    int first_;
};

}  // namespace weft
