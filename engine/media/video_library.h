#pragma once
// Internal: access to FFmpeg's libraries, silenced, with smart pointers and error messages.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <memory>
#include <string>

#include "engine/core/error.h"

namespace weft {

/// Prevents FFmpeg from writing to stderr, because our errors report failures. Call before every
/// use; acts once.
void silence_video_library();

template <auto Free>
struct AvFree {
    template <class T>
    void operator()(T* object) const {
        Free(&object);
    }
};
using AvFrame = std::unique_ptr<AVFrame, AvFree<av_frame_free>>;
using AvPacket = std::unique_ptr<AVPacket, AvFree<av_packet_free>>;
using AvCodec = std::unique_ptr<AVCodecContext, AvFree<avcodec_free_context>>;
using AvInput = std::unique_ptr<AVFormatContext, AvFree<avformat_close_input>>;

/// A name that FFmpeg opens as this file only: "a:b.mp4" would be a protocol.
[[nodiscard]] std::string file_url(const std::string& path);

/// The whole rate at `fps`, or the NTSC rate (24000/1001 and the like) within `tolerance` frames
/// per second of it, else {0, 1}. People write NTSC rates with two or three decimals, and Matroska
/// in nanoseconds.
[[nodiscard]] AVRational standard_rate(double fps, double tolerance);

/// The error for an FFmpeg call that failed while `path` was written. NoSpace if the disk or the
/// memory is full, Unreadable for other system errors, else RenderFailed.
[[nodiscard]] Error video_write_error(const std::string& path, int av_error);

}  // namespace weft
