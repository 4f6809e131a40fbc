#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/media/frame_writer.h"
#include "engine/media/video_library.h"

namespace weft {
namespace {

int round_up_to_even(int n) {
    return n + (n & 1);
}

std::uint8_t code_of(float v) {
    const float scaled = v * 255.0f + 0.5f;
    if (!(scaled >= 0.0f)) return 0;  // NaN too
    return scaled >= 255.0f ? std::uint8_t{255} : static_cast<std::uint8_t>(scaled);
}

Error cannot_encode(const std::string& path) {
    return {ErrorCode::kUnreadable,
            path +
                " cannot be written: this machine has no encoder for it. Write numbered frames "
                "or the other kind of movie (.mp4, .mkv).",
            {}};
}

class VideoFile final : public MovieWriter {
  public:
    VideoFile(std::string path, TemporaryFile temporary, cv::VideoWriter writer, Size size,
              Size coded)
        : path_(std::move(path)),
          temporary_(std::move(temporary)),
          writer_(std::move(writer)),
          size_(size),
          bgr_(coded.height, coded.width, CV_8UC3) {}

    Status add(ViewF3 display_rgb) override {
        if (closed_) return fail(ErrorCode::kUsage, path_ + " is closed already.");
        if (display_rgb.size() != size_) {
            return fail(ErrorCode::kUsage, path_ + ": all frames of a movie must have one size.");
        }
        for (int y = 0; y < bgr_.rows; ++y) {
            // Rows and columns beyond the picture repeat its last one.
            const float* in = display_rgb.row(std::min(y, size_.height - 1));
            auto* out = bgr_.ptr<std::uint8_t>(y);
            for (int x = 0; x < bgr_.cols; ++x, out += 3) {
                const float* p = in + static_cast<std::ptrdiff_t>(std::min(x, size_.width - 1)) * 3;
                for (int c = 0; c < 3; ++c)
                    out[c] = code_of(p[2 - c]);
            }
        }
        try {
            writer_.write(bgr_);
        } catch (const cv::Exception& e) {
            return fail(ErrorCode::kRenderFailed, path_ + " cannot be written: " + e.err + ".");
        }
        ++frames_;
        return {};
    }

    Status close() override {
        if (closed_) return fail(ErrorCode::kUsage, path_ + " is closed already.");
        closed_ = true;
        writer_.release();
        if (frames_ == 0) {
            return fail(ErrorCode::kRenderFailed, path_ + " was not written: it got no frames.");
        }
        WEFT_CHECK_OK(check_written());
        return temporary_.commit();
    }

  private:
    // The encoder does not report a full disk, but what it wrote cannot be read back then.
    Status check_written() const {
        cv::VideoCapture check;
        int frames = 0;
        try {
            if (check.open(temporary_.name(), cv::CAP_FFMPEG)) {
                while (check.grab())
                    ++frames;
            }
        } catch (const cv::Exception&) {
            frames = 0;
        }
        if (frames == frames_) return {};
        return fail(ErrorCode::kNoSpace,
                    path_ + " cannot be written: only " + std::to_string(frames) + " of " +
                        std::to_string(frames_) +
                        " frames reached the disk, which is probably full. Free some space.");
    }

    std::string path_;
    TemporaryFile temporary_;
    cv::VideoWriter writer_;
    Size size_;
    cv::Mat bgr_;
    int frames_ = 0;
    bool closed_ = false;
};

bool open_writer(cv::VideoWriter& writer, const std::string& name, const char* code, Size size,
                 double fps) {
    try {
        return writer.open(name, cv::CAP_FFMPEG,
                           cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]), fps,
                           cv::Size(size.width, size.height), true);
    } catch (const cv::Exception&) {
        return false;
    }
}

}  // namespace

Expected<std::unique_ptr<MovieWriter>> open_movie(const std::string& path, Size size, double fps) {
    silence_video_library();
    const std::string extension = std::filesystem::path(path).extension().string();
    const bool lossless = extension == ".mkv";
    if (!lossless && extension != ".mp4") {
        return fail(ErrorCode::kUsage, path + ": unknown kind of movie. Use .mp4 or .mkv.");
    }
    if (size.empty() || !(fps > 0) || !std::isfinite(fps)) {
        return fail(ErrorCode::kUsage, path + ": a movie needs a size and a frame rate above 0.");
    }
    // OpenCV would cut odd sizes down to even ones, whatever the codec.
    const Size coded{round_up_to_even(size.width), round_up_to_even(size.height)};
    WEFT_TRY(temporary, TemporaryFile::create(path));
    cv::VideoWriter writer;
    const std::vector<const char*> codes =
        lossless ? std::vector<const char*>{"FFV1"} : std::vector<const char*>{"avc1", "mp4v"};
    const bool opened = std::any_of(codes.begin(), codes.end(), [&](const char* code) {
        return open_writer(writer, temporary.name(), code, coded, fps);
    });
    if (!opened) return tl::unexpected(cannot_encode(path));
    return std::make_unique<VideoFile>(path, std::move(temporary), std::move(writer), size, coded);
}

}  // namespace weft
