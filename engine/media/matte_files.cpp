#include "engine/media/matte_files.h"

#include <algorithm>
#include <utility>

#include "engine/core/setting.h"
#include "engine/media/matte_code.h"
#include "engine/media/matte_movie.h"
#include "engine/media/plates.h"
#include "engine/media/raster_errors.h"

namespace weft {

Expected<MatteFiles> MatteFiles::parse(const std::string& text, int first) {
    WEFT_TRY(pattern, SequencePattern::parse(text));
    const bool movie = pattern.is_single() && has_movie_extension(text);
    return MatteFiles(std::move(pattern), movie, first);
}

MatteFiles MatteFiles::single(const std::string& path) {
    return {SequencePattern::single(path), false, 0};
}

Expected<std::vector<int>> MatteFiles::list_frames() const {
    if (!movie_) return pattern_.list_frames();
    WEFT_TRY(movie, MatteMovie::open(pattern_.text()));
    std::vector<int> frames;
    for (int k = 0; k < movie->frame_count(); ++k)
        frames.push_back(first_ + k);
    return frames;
}

Expected<Hash128> MatteFiles::stamp(int frame) const {
    return stamp_file(path_for(frame), movie_ ? frame - first_ : 0);
}

Status MatteFiles::check_select(const MatteSelect& select) const {
    if (!movie_ || (!select.value && select.crypto.empty())) return {};
    return fail(ErrorCode::kUsage,
                pattern_.text() + " is a movie, which holds no ids and no Cryptomatte objects.",
                "Give the renderer's pictures, or use the movie as it is, without a value" +
                    by({{setting::kMatteValue}}) + ".");
}

Expected<Matte> MatteFiles::read(int frame, const MatteSelect& select, Size expected) const {
    if (!movie_) return read_matte(path_for(frame), select, expected);
    WEFT_CHECK_OK(check_select(select));
    const std::string& path = pattern_.text();
    WEFT_TRY(movie, MatteMovie::open(path));
    WEFT_CHECK_OK(check_plate_size(path, "it", movie->size(), expected, "scale or crop it"));
    WEFT_TRY(matte, movie->read(frame - first_, select.channel));
    if (select.invert) invert_matte(matte);
    return matte;
}

}  // namespace weft
