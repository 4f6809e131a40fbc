extern "C" {
#include <libavutil/dict.h>
#include <libavutil/mathematics.h>
}

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/text.h"
#include "engine/media/frame_writer.h"
#include "engine/media/movie_pixels.h"
#include "engine/media/movies.h"
#include "engine/media/read_back.h"
#include "engine/media/video_library.h"

namespace weft {
namespace {

// Affects the result: x264's bytes depend on the number of threads, so it is the same everywhere.
constexpr int kEncoderThreads = 4;
// FFmpeg 5.1's FFV1 turns smaller pictures black.
constexpr int kMinLossless_px = 3;
// The limit of H.264's highest level and of x264. Beyond it FFmpeg 5.1 fails with a leak.
constexpr int kMaxLossy_px = 16384;
constexpr int kSlices = 4;

struct Dictionary {
    AVDictionary* entries = nullptr;
    ~Dictionary() { av_dict_free(&entries); }
    void set(const char* key, const char* value) { av_dict_set(&entries, key, value, 0); }
};

struct CloseOutput {
    void operator()(AVFormatContext* output) const {
        if (output->pb) avio_closep(&output->pb);
        avformat_free_context(output);
    }
};
using AvOutput = std::unique_ptr<AVFormatContext, CloseOutput>;

int round_up_to_even(int n) {
    return n + (n & 1);
}

AVRational frame_rate(double fps) {
    constexpr double kTwoDecimals = 0.005;
    constexpr int kLargestTerm = 65535;  // MPEG-4's
    const AVRational standard = standard_rate(fps, kTwoDecimals);
    return standard.num > 0 ? standard : av_d2q(fps, kLargestTerm);
}

// Describes the frames, before the codec's own settings. They are sRGB, and so is the transfer tag:
// players with colour management (QuickTime, Safari) then show what the PNG frames show. A BT.709
// tag would make them lift the shadows. Other players only use the matrix and the range.
void describe(AVCodecContext& codec, Size coded, AVRational fps, bool lossless, double aspect) {
    codec.width = coded.width;
    codec.height = coded.height;
    constexpr int kLargestAspectTerm = 1000;
    codec.sample_aspect_ratio = av_d2q(aspect, kLargestAspectTerm);
    codec.framerate = fps;
    codec.time_base = av_inv_q(fps);
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_IEC61966_2_1;
    codec.pix_fmt = lossless ? AV_PIX_FMT_BGR0 : AV_PIX_FMT_YUV420P;
    codec.colorspace = lossless ? AVCOL_SPC_RGB : AVCOL_SPC_BT709;
    codec.color_range = lossless ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    if (!lossless) codec.chroma_sample_location = AVCHROMA_LOC_LEFT;
    codec.thread_count = kEncoderThreads;
    codec.flags |= AV_CODEC_FLAG_BITEXACT;
}

void choose_quality(AVCodecContext& codec, AVRational fps, bool lossless, Dictionary& options) {
    if (lossless) {
        codec.level = 3;
        codec.gop_size = 1;
        codec.slices = kSlices;
        options.set("slicecrc", "1");
        return;
    }
    // One key frame per second, because reviewers step back and forth.
    codec.gop_size = std::max(1, static_cast<int>(std::lround(av_q2d(fps))));
    if (codec.codec_id == AV_CODEC_ID_H264) {
        options.set("preset", "fast");
        options.set("crf", "14");
        options.set("x264-params", "cpu-independent=1");
    } else {
        codec.flags |= AV_CODEC_FLAG_QSCALE;
        codec.global_quality = 2 * FF_QP2LAMBDA;
    }
}

const AVCodec* find_encoder(bool lossless) {
    if (lossless) return avcodec_find_encoder(AV_CODEC_ID_FFV1);
    const AVCodec* h264 = avcodec_find_encoder_by_name("libx264");
    return h264 ? h264 : avcodec_find_encoder(AV_CODEC_ID_MPEG4);
}

class VideoFile final : public MovieWriter {
  public:
    VideoFile(std::string path, TemporaryFile temporary, Size size, bool lossless, double aspect)
        : path_(std::move(path)),
          temporary_(std::move(temporary)),
          size_(size),
          lossless_(lossless),
          aspect_(aspect) {}

    Status open(double fps) {
        if (!open_codec(frame_rate(fps))) {
            return fail(ErrorCode::kUnreadable,
                        path_ + " cannot be written: this machine has no encoder for a movie of " +
                            size_text(size_) + " pixels.",
                        "Write numbered frames or the other kind of movie (.mp4, .mkv).");
        }
        return open_file();
    }

    Status add(ViewF3 display_rgb) override {
        if (closed_) return fail(ErrorCode::kUsage, path_ + " is closed already.");
        if (display_rgb.size() != size_) {
            return fail(ErrorCode::kUsage, path_ + ": all frames of a movie must have one size.");
        }
        if (failure_) return tl::unexpected(*failure_);
        // The encoder may still be reading the previous frame.
        WEFT_CHECK_OK(check(av_frame_make_writable(frame_.get())));
        if (lossless_) {
            fill_bgr0(display_rgb, *frame_);
        } else {
            fill_yuv420_bt709(display_rgb, *frame_);
        }
        frame_->pts = frames_++;
        return encode(frame_.get());
    }

    Status close() override {
        if (closed_) return fail(ErrorCode::kUsage, path_ + " is closed already.");
        closed_ = true;
        if (failure_) return tl::unexpected(*failure_);
        if (frames_ == 0) {
            return fail(ErrorCode::kRenderFailed, path_ + " was not written: it got no frames.");
        }
        WEFT_CHECK_OK(encode(nullptr));
        WEFT_CHECK_OK(check(av_write_trailer(output_.get())));
        WEFT_CHECK_OK(check(avio_closep(&output_->pb)));
        WEFT_CHECK_OK(check_written_movie(temporary_.name(), path_, {codec_->width, codec_->height},
                                          frames_));
        return temporary_.commit();
    }

  private:
    bool open_codec(AVRational fps) {
        const AVCodec* encoder = find_encoder(lossless_);
        codec_.reset(avcodec_alloc_context3(encoder));
        frame_.reset(av_frame_alloc());
        packet_.reset(av_packet_alloc());
        if (lossless_ && std::min(size_.width, size_.height) < kMinLossless_px) return false;
        if (!lossless_ && std::max(size_.width, size_.height) > kMaxLossy_px) return false;
        if (!encoder || !codec_ || !frame_ || !packet_) return false;
        // 4:2:0 has half as many columns and rows of chroma.
        const Size coded =
            lossless_ ? size_ : Size{round_up_to_even(size_.width), round_up_to_even(size_.height)};
        describe(*codec_, coded, fps, lossless_, aspect_);
        codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;  // both containers want it
        Dictionary options;
        choose_quality(*codec_, fps, lossless_, options);
        if (avcodec_open2(codec_.get(), encoder, &options.entries) < 0) return false;
        frame_->format = codec_->pix_fmt;
        frame_->width = coded.width;
        frame_->height = coded.height;
        frame_->color_primaries = codec_->color_primaries;
        frame_->color_trc = codec_->color_trc;
        frame_->colorspace = codec_->colorspace;
        frame_->color_range = codec_->color_range;
        frame_->chroma_location = codec_->chroma_sample_location;
        return av_frame_get_buffer(frame_.get(), 0) >= 0;
    }

    Status open_file() {
        const std::string url = file_url(temporary_.name());
        AVFormatContext* output = nullptr;
        WEFT_CHECK_OK(check(avformat_alloc_output_context2(
            &output, nullptr, lossless_ ? "matroska" : "mp4", url.c_str())));
        output_.reset(output);
        // Otherwise Matroska numbers its segments randomly, and both containers name the library's
        // version.
        output->flags |= AVFMT_FLAG_BITEXACT;
        stream_ = avformat_new_stream(output, nullptr);
        if (!stream_) return check(AVERROR(ENOMEM));
        WEFT_CHECK_OK(check(avcodec_parameters_from_context(stream_->codecpar, codec_.get())));
        stream_->time_base = codec_->time_base;
        stream_->avg_frame_rate = codec_->framerate;
        stream_->sample_aspect_ratio = codec_->sample_aspect_ratio;
        WEFT_CHECK_OK(check(avio_open(&output->pb, url.c_str(), AVIO_FLAG_WRITE)));
        Dictionary options;
        // The index in front lets a player start before the file is copied completely.
        if (!lossless_) options.set("movflags", "+faststart");
        return check(avformat_write_header(output, &options.entries));
    }

    /// A null frame flushes the encoder.
    Status encode(const AVFrame* frame) {
        WEFT_CHECK_OK(check(avcodec_send_frame(codec_.get(), frame)));
        while (true) {
            const int result = avcodec_receive_packet(codec_.get(), packet_.get());
            if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return {};
            WEFT_CHECK_OK(check(result));
            packet_->stream_index = stream_->index;
            packet_->duration = 1;
            av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
            WEFT_CHECK_OK(check(av_interleaved_write_frame(output_.get(), packet_.get())));
        }
    }

    /// Converts FFmpeg's result to an error and keeps the first failure. Containers ignore the
    /// disk's errors while they write, so these are checked too.
    Status check(int result) {
        const bool disk_failed = output_ && output_->pb && output_->pb->error < 0;
        if (disk_failed) result = output_->pb->error;
        if (result >= 0) return {};
        failure_ = video_write_error(path_, result);
        return tl::unexpected(*failure_);
    }

    std::string path_;
    TemporaryFile temporary_;
    Size size_;
    bool lossless_;
    double aspect_;  // width of a pixel over its height
    AvCodec codec_;
    AvOutput output_;
    AvFrame frame_;
    AvPacket packet_;
    AVStream* stream_ = nullptr;
    std::optional<Error> failure_;
    std::int64_t frames_ = 0;
    bool closed_ = false;
};

}  // namespace

Expected<std::unique_ptr<MovieWriter>> open_movie(const std::string& path, Size size, double fps,
                                                  double pixel_aspect, const WriteRule& rule) {
    silence_video_library();
    WEFT_CHECK_OK(check_movie(path, fps));
    const bool lossless = std::filesystem::path(path).extension() == ".mkv";
    if (size.empty()) return fail(ErrorCode::kUsage, path + ": a movie needs frames with a size.");
    WEFT_TRY(temporary, TemporaryFile::create(path, rule));
    auto file = std::make_unique<VideoFile>(path, std::move(temporary), size, lossless,
                                            pixel_aspect > 0 ? pixel_aspect : 1.0);
    WEFT_CHECK_OK(file->open(fps));
    return file;
}

}  // namespace weft
