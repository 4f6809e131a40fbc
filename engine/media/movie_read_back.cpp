#include <cstdint>
#include <string>

#include "engine/core/input_file.h"
#include "engine/core/text.h"
#include "engine/media/read_back.h"
#include "engine/media/video_library.h"

namespace weft {
namespace {

AvInput open_movie_file(const std::string& file) {
    silence_video_library();
    if (!check_input_file(file)) return nullptr;
    AVFormatContext* opened = nullptr;
    const std::string url = file_url(file);
    if (avformat_open_input(&opened, url.c_str(), nullptr, nullptr) < 0) return nullptr;
    return AvInput(opened);
}

// The movie's last video stream; null without one.
const AVStream* video_stream(const AVFormatContext& movie) {
    const AVStream* found = nullptr;
    for (unsigned k = 0; k < movie.nb_streams; ++k) {
        if (movie.streams[k]->codecpar->codec_type == AVMEDIA_TYPE_VIDEO) found = movie.streams[k];
    }
    return found;
}

}  // namespace

Status check_written_movie(const std::string& file, const std::string& path, Size size,
                           std::int64_t frames) {
    const AvInput movie = open_movie_file(file);
    if (!movie) return tl::unexpected(read_back_error(path, "cannot be opened"));
    const AVStream* const video = video_stream(*movie);
    if (!video) return tl::unexpected(read_back_error(path, "has no pictures"));
    const Size found{video->codecpar->width, video->codecpar->height};
    const AvPacket packet(av_packet_alloc());
    std::int64_t count = 0;
    while (packet && av_read_frame(movie.get(), packet.get()) >= 0) {
        if (packet->stream_index == video->index) ++count;
        av_packet_unref(packet.get());
    }
    if (found == size && count == frames) return {};
    return tl::unexpected(read_back_error(
        path, "has " + std::to_string(count) + " frames of " + size_text(found) +
                  " pixels instead of " + std::to_string(frames) + " of " + size_text(size)));
}

bool is_review_movie(const std::string& file, Size size) {
    const AvInput movie = open_movie_file(file);
    const AVStream* const video = movie ? video_stream(*movie) : nullptr;
    if (!video || movie->nb_streams != 1) return false;
    const AVCodecParameters& codec = *video->codecpar;
    if (codec.codec_id == AV_CODEC_ID_FFV1) return Size{codec.width, codec.height} == size;
    const Size even{size.width + size.width % 2, size.height + size.height % 2};
    return Size{codec.width, codec.height} == even && codec.color_trc == AVCOL_TRC_IEC61966_2_1 &&
           codec.color_space == AVCOL_SPC_BT709;
}

}  // namespace weft
