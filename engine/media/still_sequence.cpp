#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/plate_decode.h"
#include "engine/media/plates.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

Error missing_frame(const SequencePattern& pattern, int frame) {
    const std::string file = pattern.path_for(frame);
    return {ErrorCode::kMissingFrames,
            "Frame " + std::to_string(frame) + " is missing in " + pattern.text() + ": file " +
                file + " not found.",
            "Supply it, or leave it out of the frames.",
            {}};
}

class StillSequence final : public FrameReader {
  public:
    StillSequence(SequencePattern pattern, std::vector<int> frames, ReadOptions options,
                  RasterInfo first)
        : pattern_(std::move(pattern)),
          frames_(std::move(frames)),
          options_(std::move(options)),
          first_(std::move(first)) {}

    const std::vector<int>& frames() const override { return frames_; }
    Size size() const override { return first_.size; }
    double fps() const override { return first_.fps; }
    double pixel_aspect() const override { return first_.pixel_aspect; }
    PixelDepth depth() const override { return depth_of(first_.kind); }
    bool display_encoded() const override { return is_display_encoded(first_.kind); }
    FileColor color() const override { return first_.color; }
    std::string path_of(int frame) const override { return pattern_.path_for(frame); }

    std::vector<std::string> warnings() const override {
        const std::vector<std::string>& views = first_.views;
        if (views.size() < 2 || !options_.layer.empty()) return {};
        std::string others;
        for (std::size_t k = 1; k < views.size(); ++k)
            others += (k > 1 ? ", " : "") + views[k];
        return {"The plate " + pattern_.text() + " is stereo; its first view, " + views[0] +
                ", is used. Give a layer for another one (" + others + ")" +
                by({{setting::kPlateLayer, views[1]}}) + "."};
    }

    Expected<PlateFrame> read(int frame) const override {
        const std::string path = path_of(frame);
        if (is_missing(frame, path)) return tl::unexpected(missing_frame(pattern_, frame));
        WEFT_TRY(raster, read_raster(path, {options_.layer, {}, false}));
        if (raster.info.size != first_.size) {
            return tl::unexpected(unreadable(path,
                                             "it is " + size_text(raster.info.size) +
                                                 " but the first frame is " +
                                                 size_text(first_.size),
                                             "All frames of a plate must have one size."));
        }
        return to_plate(raster);
    }

    Expected<Hash128> stamp(int frame) const override {
        const std::string path = path_of(frame);
        if (is_missing(frame, path)) return tl::unexpected(missing_frame(pattern_, frame));
        return stamp_file(path, frame);
    }

  private:
    // A single file has only one frame, although every number leads to its path.
    bool is_missing(int frame, const std::string& path) const {
        if (pattern_.is_single() && frame != frames_.front()) return true;
        struct stat status {};
        return ::stat(path.c_str(), &status) != 0 && (errno == ENOENT || errno == ENOTDIR);
    }

    SequencePattern pattern_;
    std::vector<int> frames_;
    ReadOptions options_;
    RasterInfo first_;
};

}  // namespace

Expected<Hash128> stamp_file(const std::string& path, int frame) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return fail(ErrorCode::kMissingFrames, path + " is missing.", "Supply it again.");
    }
    // What is not a regular file has none; reading it will be refused.
    const FileStamp stamp = stamp_of(path).value_or(FileStamp());
    Hasher hasher;
    hasher.text(path).value(frame).value(stamp.bytes).value(stamp.modified_ns);
    hasher.value(stamp.changed_ns).value(stamp.device).value(stamp.inode);
    return hasher.finish();
}

Expected<std::shared_ptr<const FrameReader>> open_still_sequence(const SequencePattern& pattern,
                                                                 const ReadOptions& options) {
    std::vector<int> frames{number_in_name(pattern.text()).value_or(options.movie_start)};
    if (!pattern.is_single()) {
        const auto folder = std::filesystem::path(pattern.text()).parent_path();
        std::error_code ignored;
        frames.clear();
        if (folder.empty() || std::filesystem::exists(folder, ignored)) {
            WEFT_TRY(listed, pattern.list_frames());
            frames = std::move(listed);
        }
        if (frames.empty()) {
            return fail(ErrorCode::kMissingFrames,
                        "No frames match " + pattern.text() + ": there is no file such as " +
                            pattern.path_for(1) + ".",
                        "Check the path.");
        }
    }
    WEFT_TRY(first, probe_raster(pattern.path_for(frames.front()), {options.layer, {}, false}));
    return std::make_shared<StillSequence>(pattern, std::move(frames), options, first);
}

}  // namespace weft
