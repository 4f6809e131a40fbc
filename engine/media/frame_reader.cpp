#include "engine/media/frame_reader.h"

#include <filesystem>
#include <system_error>

#include "engine/media/plates.h"
#include "engine/media/raster_errors.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

// A plate whose files do not say how wide its pixels are, or not what is true.
class ReshapedPlate final : public FrameReader {
  public:
    ReshapedPlate(std::shared_ptr<const FrameReader> plate, double pixel_aspect)
        : plate_(std::move(plate)), pixel_aspect_(pixel_aspect) {}

    const std::vector<int>& frames() const override { return plate_->frames(); }
    Size size() const override { return plate_->size(); }
    double fps() const override { return plate_->fps(); }
    PixelDepth depth() const override { return plate_->depth(); }
    bool display_encoded() const override { return plate_->display_encoded(); }
    FileColor color() const override { return plate_->color(); }
    double pixel_aspect() const override { return pixel_aspect_; }
    std::vector<std::string> warnings() const override { return plate_->warnings(); }
    std::string path_of(int frame) const override { return plate_->path_of(frame); }
    Expected<PlateFrame> read(int frame) const override { return plate_->read(frame); }
    Expected<Hash128> stamp(int frame) const override { return plate_->stamp(frame); }
    int shown_frame(int frame) const override { return plate_->shown_frame(frame); }

  private:
    std::shared_ptr<const FrameReader> plate_;
    double pixel_aspect_;
};

Expected<std::shared_ptr<const FrameReader>> open_files(const std::string& path,
                                                        const ReadOptions& options) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        WEFT_TRY(pattern, find_sequence(path));
        return open_still_sequence(pattern, options);
    }
    const bool exists = std::filesystem::exists(path, ignored);
    if (has_movie_extension(path) && (exists || path.find_first_of("#@%") == std::string::npos)) {
        return open_movie_plate(path, options);
    }
    if (!exists) {
        WEFT_TRY(pattern, SequencePattern::parse(path));
        if (!pattern.is_single()) return open_still_sequence(pattern, options);
        return fail(ErrorCode::kMissingFrames, path + " not found.",
                    "Give a pattern such as plate.####.exr or a movie.");
    }
    if (!has_picture_extension(path)) {
        return tl::unexpected(unreadable(path, "it is neither a picture nor a movie by its name",
                                         "Give a pattern such as plate.####.exr or a movie."));
    }
    return open_still_sequence(SequencePattern::single(path), options);
}

}  // namespace

Expected<std::shared_ptr<const FrameReader>> open_plate(const std::string& path,
                                                        const ReadOptions& options) {
    WEFT_TRY(plate, open_files(path, options));
    if (!options.pixel_aspect || *options.pixel_aspect == plate->pixel_aspect()) return plate;
    return std::make_shared<ReshapedPlate>(std::move(plate), *options.pixel_aspect);
}

}  // namespace weft
