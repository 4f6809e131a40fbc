#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <utility>

#include "engine/media/plate_decode.h"
#include "engine/media/plates.h"
#include "engine/media/raster_errors.h"
#include "engine/media/video_library.h"

namespace weft {
namespace {

constexpr std::size_t kRecentBudget_bytes = std::size_t{48} << 20;

// The frames of one movie in order. Seeking inside a container lands on the wrong frame in some
// files, so going back means decoding again from the start; on the way the frames before the wanted
// one are kept, because whoever goes back one frame will go back another.
class Decoder {
  public:
    explicit Decoder(std::string path) : path_(std::move(path)) {}

    /// Starts again before the first frame. False when the file is no movie.
    bool rewind() {
        recent_.clear();
        next_ = 0;
        try {
            return capture_.open(path_, cv::CAP_FFMPEG);
        } catch (const cv::Exception&) {
            return false;
        }
    }

    /// Decodes the next frame without fetching it.
    bool grab() {
        try {
            if (!capture_.grab()) return false;
        } catch (const cv::Exception&) {
            return false;
        }
        ++next_;
        return true;
    }

    /// The frame just grabbed, as 8-bit BGR; empty when it cannot be had.
    cv::Mat retrieve() {
        cv::Mat bgr;
        try {
            if (!capture_.retrieve(bgr) || bgr.type() != CV_8UC3) return {};
        } catch (const cv::Exception&) {
            return {};
        }
        bgr = bgr.clone();  // the capture reuses its own buffer
        keep(next_ - 1, bgr);
        return bgr;
    }

    /// Frame `index`, counted from 0; empty when it cannot be decoded.
    cv::Mat frame(int index) {
        for (const auto& [i, bgr] : recent_) {
            if (i == index) return bgr;
        }
        const bool backwards = index < next_;
        if (backwards && !rewind()) return {};
        const int keep_from = backwards ? index - kept_frames_ + 1 : index;
        while (next_ < index) {
            if (!grab()) return {};
            if (next_ - 1 >= keep_from) retrieve();
        }
        return grab() ? retrieve() : cv::Mat();
    }

    double property(int id) const { return capture_.get(id); }

  private:
    void keep(int index, const cv::Mat& bgr) {
        const std::size_t bytes = std::max<std::size_t>(1, bgr.total() * bgr.elemSize());
        kept_frames_ =
            static_cast<int>(std::clamp<std::size_t>(kRecentBudget_bytes / bytes, 1, 64));
        recent_.emplace_back(index, bgr);
        while (static_cast<int>(recent_.size()) > kept_frames_)
            recent_.pop_front();
    }

    std::string path_;
    cv::VideoCapture capture_;
    int next_ = 0;  // the frame that grab() would decode
    int kept_frames_ = 1;
    std::deque<std::pair<int, cv::Mat>> recent_;
};

Raster to_raster(const cv::Mat& bgr) {
    Raster raster;
    raster.info = {{bgr.cols, bgr.rows}, SampleKind::kU8, 0.0};
    raster.channels = 3;
    std::vector<std::uint8_t> rgb(bgr.total() * 3);
    auto out = rgb.begin();
    for (int y = 0; y < bgr.rows; ++y) {
        const std::uint8_t* in = bgr.ptr<std::uint8_t>(y);
        for (int x = 0; x < bgr.cols; ++x, in += 3) {
            *out++ = in[2];
            *out++ = in[1];
            *out++ = in[0];
        }
    }
    raster.samples = std::move(rgb);
    return raster;
}

struct MovieFacts {
    Size size;
    double fps = 0;
    int frames = 0;   ///< That can be decoded.
    int claimed = 0;  ///< What the container says; 0 when it does not.
};

class MoviePlate final : public FrameReader {
  public:
    MoviePlate(std::string path, int start, MovieFacts facts)
        : path_(std::move(path)), facts_(facts), decoder_(path_) {
        for (int i = 0; i < facts.frames; ++i)
            frames_.push_back(start + i);
    }

    const std::vector<int>& frames() const override { return frames_; }
    Size size() const override { return facts_.size; }
    double fps() const override { return facts_.fps; }
    PixelDepth depth() const override { return PixelDepth::kU8; }
    bool display_encoded() const override { return true; }
    std::string path_of(int /*frame*/) const override { return path_; }

    Expected<PlateFrame> read(int frame) const override {
        WEFT_CHECK_OK(check_range(frame));
        cv::Mat bgr;
        {
            const std::lock_guard lock(mutex_);
            if (!open_ && !(open_ = decoder_.rewind())) {
                return tl::unexpected(damaged(path_, "it could be opened before"));
            }
            bgr = decoder_.frame(frame - frames_.front());
        }
        if (bgr.empty()) {
            return tl::unexpected(
                damaged(path_, "frame " + std::to_string(frame) + " cannot be decoded any more"));
        }
        if (Size{bgr.cols, bgr.rows} != facts_.size) {
            return tl::unexpected(damaged(
                path_, "frame " + std::to_string(frame) + " has another size than the first"));
        }
        return to_plate(to_raster(bgr));
    }

    Expected<Hash128> stamp(int frame) const override {
        WEFT_CHECK_OK(check_range(frame));
        return stamp_file(path_, frame);
    }

    std::vector<std::string> warnings() const override {
        if (facts_.claimed <= facts_.frames) return {};
        return {path_ + " says it has " + std::to_string(facts_.claimed) + " frames, but only " +
                std::to_string(facts_.frames) +
                " can be decoded. It may be cut off: compare it with its source."};
    }

  private:
    Status check_range(int frame) const {
        if (frame >= frames_.front() && frame <= frames_.back()) return {};
        return fail(ErrorCode::kMissingFrames,
                    "Frame " + std::to_string(frame) + " is missing in " + path_ + ", which has " +
                        std::to_string(frames_.front()) + " to " + std::to_string(frames_.back()) +
                        ". Leave it out of the frames, or change --movie-start.");
    }

    std::string path_;
    MovieFacts facts_;
    std::vector<int> frames_;
    mutable std::mutex mutex_;
    mutable Decoder decoder_;
    mutable bool open_ = false;
};

}  // namespace

Expected<std::shared_ptr<const FrameReader>> open_movie_plate(const std::string& path,
                                                              const ReadOptions& options) {
    silence_video_library();
    WEFT_CHECK_OK(stamp_file(path, 0));
    Decoder decoder(path);
    if (!decoder.rewind()) {
        return tl::unexpected(unreadable(path, "it is not a movie, or is cut off before its index",
                                         "Copy or export it again."));
    }
    MovieFacts facts;
    const double fps = decoder.property(cv::CAP_PROP_FPS);
    const double claimed = decoder.property(cv::CAP_PROP_FRAME_COUNT);
    facts.fps = std::isfinite(fps) && fps > 0 && fps < 10000 ? fps : 0;
    facts.claimed =
        std::isfinite(claimed) && claimed > 0 && claimed < 1e8 ? static_cast<int>(claimed) : 0;
    const cv::Mat first = decoder.grab() ? decoder.retrieve() : cv::Mat();
    if (first.empty()) {
        return tl::unexpected(unreadable(path, "it is a movie without frames that can be decoded",
                                         "Copy or export it again."));
    }
    facts.size = {first.cols, first.rows};
    // Containers lie about their number of frames, so they are counted.
    facts.frames = 1;
    while (decoder.grab())
        ++facts.frames;
    return std::make_shared<MoviePlate>(path, options.movie_start, facts);
}

}  // namespace weft
