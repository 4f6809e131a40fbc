#pragma once
// Movies as mattes: the plate's first frame and the movie's belong together.

#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/media/frame_reader.h"
#include "engine/media/matte_files.h"

namespace weft {

/// The files of a matte, holdout, zone or line pass of this plate. Errors: MatteFiles::parse().
[[nodiscard]] Expected<MatteFiles> matte_files(const std::string& text, const FrameReader& plate);

/// The frame whose matte belongs to a frame of the plate: where the plate repeats a frame in place
/// of a missing one, and the matte has none for that either, the repeated one.
[[nodiscard]] int matte_frame(const MatteFiles& files, int frame, const FrameReader& plate);

/// The frames of `frames` for which a matte or a pass has a file; all for a still, and without one.
[[nodiscard]] Expected<std::vector<int>> frames_with_files(const std::string& text,
                                                           const FrameReader& plate,
                                                           std::vector<int> frames);

/// Warnings of the region's movies: those of each, and that it has more or fewer frames than the
/// plate, so that the two may not belong together. Errors: Usage for a movie that ids or
/// Cryptomatte objects are to be picked from; those of opening it.
[[nodiscard]] Expected<std::vector<std::string>> check_matte_movies(const Region& region,
                                                                    const FrameReader& plate);

}  // namespace weft
