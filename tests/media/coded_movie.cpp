#include "tests/media/coded_movie.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

#include <cstdint>
#include <stdexcept>

namespace weft {
namespace {

void need(bool fulfilled, const char* what) {
    if (!fulfilled) throw std::runtime_error(std::string("coded movie: ") + what);
}

void put_sample(AVFrame& frame, const AVComponentDescriptor& c, int x, int y, int code) {
    std::uint8_t* at = frame.data[c.plane] +
                       static_cast<std::ptrdiff_t>(y) * frame.linesize[c.plane] +
                       static_cast<std::ptrdiff_t>(x) * c.step + c.offset;
    if (c.depth > 8) {
        *reinterpret_cast<std::uint16_t*>(at) = static_cast<std::uint16_t>(code << c.shift);
    } else {
        *at = static_cast<std::uint8_t>(code);
    }
}

void fill_bars(AVFrame& frame, const std::vector<Codes>& bars) {
    const auto format = static_cast<AVPixelFormat>(frame.format);
    const AVPixFmtDescriptor& d = *av_pix_fmt_desc_get(format);
    for (int i = 0; i < d.nb_components; ++i) {
        const bool chroma = (i == 1 || i == 2) && !(d.flags & AV_PIX_FMT_FLAG_RGB);
        const int width = chroma ? AV_CEIL_RSHIFT(frame.width, d.log2_chroma_w) : frame.width;
        const int height = chroma ? AV_CEIL_RSHIFT(frame.height, d.log2_chroma_h) : frame.height;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::size_t bar =
                    static_cast<std::size_t>(x) * bars.size() / static_cast<std::size_t>(width);
                put_sample(frame, d.comp[i], x, y, bars[bar][static_cast<std::size_t>(i)]);
            }
        }
    }
}

}  // namespace

bool has_encoder(const std::string& name) {
    return avcodec_find_encoder_by_name(name.c_str()) != nullptr;
}

void write_bars(const std::string& path, const CodedMovie& movie, const std::vector<Codes>& bars) {
    write_frames(path, movie, std::vector<std::vector<Codes>>(movie.stamps.size(), bars));
}

void write_frames(const std::string& path, const CodedMovie& movie,
                  const std::vector<std::vector<Codes>>& frames) {
    AVFormatContext* file = nullptr;
    need(avformat_alloc_output_context2(&file, nullptr, nullptr, path.c_str()) >= 0, "container");
    AVCodecContext* codec = avcodec_alloc_context3(
        movie.encoder.empty() ? avcodec_find_encoder(AV_CODEC_ID_FFV1)
                              : avcodec_find_encoder_by_name(movie.encoder.c_str()));
    codec->width = movie.size.width;
    codec->height = movie.size.height;
    codec->time_base = {1, 24};
    codec->pix_fmt = movie.format;
    codec->colorspace = movie.matrix;
    codec->color_range = movie.range;
    codec->color_trc = movie.transfer;
    if (movie.encoder.empty()) codec->level = 3;
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    need(avcodec_open2(codec, nullptr, nullptr) >= 0, "encoder");
    AVStream* stream = avformat_new_stream(file, nullptr);
    avcodec_parameters_from_context(stream->codecpar, codec);
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = {24, 1};
    if (movie.rotation_deg != 0) {
        auto* matrix = reinterpret_cast<std::int32_t*>(
            av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, 9 * sizeof(std::int32_t)));
        av_display_rotation_set(matrix, movie.rotation_deg);
    }
    need(avio_open(&file->pb, path.c_str(), AVIO_FLAG_WRITE) >= 0, "file");
    need(avformat_write_header(file, nullptr) >= 0, "header");

    AVFrame* frame = av_frame_alloc();
    frame->format = movie.format;
    frame->width = movie.size.width;
    frame->height = movie.size.height;
    frame->interlaced_frame = frame->top_field_first = movie.interlaced ? 1 : 0;
    need(av_frame_get_buffer(frame, 0) >= 0, "frame");
    AVPacket* packet = av_packet_alloc();
    const auto write_packets = [&] {
        while (avcodec_receive_packet(codec, packet) >= 0) {
            packet->duration = 1;
            av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
            need(av_write_frame(file, packet) >= 0, "write");
        }
    };
    for (std::size_t k = 0; k < movie.stamps.size(); ++k) {
        need(av_frame_make_writable(frame) >= 0, "writable");
        fill_bars(*frame, frames[k]);
        frame->pts = movie.stamps[k];
        need(avcodec_send_frame(codec, frame) >= 0, "send");
        write_packets();
    }
    need(avcodec_send_frame(codec, nullptr) >= 0, "flush");
    write_packets();
    need(av_write_trailer(file) >= 0, "trailer");
    av_packet_free(&packet);
    av_frame_free(&frame);
    avcodec_free_context(&codec);
    avio_closep(&file->pb);
    avformat_free_context(file);
}

MovieTags tags_of(const std::string& path) {
    AVFormatContext* file = nullptr;
    need(avformat_open_input(&file, path.c_str(), nullptr, nullptr) >= 0, "open");
    need(avformat_find_stream_info(file, nullptr) >= 0, "streams");
    const AVStream& stream = *file->streams[0];
    const AVCodecParameters& p = *stream.codecpar;
    const MovieTags tags{
        avcodec_get_name(p.codec_id), p.color_space, p.color_range, p.color_primaries, p.color_trc,
        stream.avg_frame_rate};
    avformat_close_input(&file);
    return tags;
}

}  // namespace weft
