#include "engine/media/movie_decoder.h"

extern "C" {
#include <libavutil/display.h>
}

#include <cmath>
#include <cstdint>
#include <string_view>

#include "engine/core/input_file.h"

namespace weft {
namespace {

// Demuxers for the movie extensions (sequence_folder.cpp). FFmpeg has others that read lists of
// further files: concat, HLS, DASH. Sound files are accepted so that they can be reported.
constexpr const char* kContainers = "mov,matroska,avi,mxf,mpeg,mpegvideo,mpegts,asf,ogg,wav,mp3";

double as_double(AVRational r) {
    return r.den != 0 ? static_cast<double>(r.num) / r.den : 0.0;
}

// WebM keeps the alpha of VP8 and VP9 in a second picture beside each packet, which FFmpeg's own
// decoders leave out; libvpx's read it.
const AVCodec* decoder_with_alpha(const AVStream& stream, const AVCodec* codec) {
    const AVDictionaryEntry* mode = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
    if (!mode || std::string_view(mode->value) != "1") return codec;
    const AVCodecID id = stream.codecpar->codec_id;
    const char* name = id == AV_CODEC_ID_VP9   ? "libvpx-vp9"
                       : id == AV_CODEC_ID_VP8 ? "libvpx"
                                               : nullptr;
    const AVCodec* found = name ? avcodec_find_decoder_by_name(name) : nullptr;
    return found ? found : codec;
}

}  // namespace

bool MovieDecoder::rewind() {
    codec_.reset();
    input_.reset();
    stream_ = nullptr;
    sound_only_ = false;
    discarded_ = 0;
    draining_ = false;
    frame_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (!frame_ || !packet_) return false;

    if (!check_input_file(path_)) return false;
    // A movie is one local file: a play list in it must not open other files or the network.
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    av_dict_set(&options, "format_whitelist", kContainers, 0);
    AVFormatContext* opened = nullptr;
    const int result = avformat_open_input(&opened, file_url(path_).c_str(), nullptr, &options);
    av_dict_free(&options);
    if (result < 0) return false;
    input_.reset(opened);
    if (avformat_find_stream_info(input_.get(), nullptr) < 0) return false;
    const AVCodec* codec = nullptr;
    const int best = av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    // A song's cover is a video stream.
    const bool cover =
        best >= 0 && (input_->streams[best]->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
    if (best < 0 || cover) {
        sound_only_ =
            av_find_best_stream(input_.get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0) >= 0;
        return false;
    }
    for (unsigned i = 0; i < input_->nb_streams; ++i) {
        if (static_cast<int>(i) != best) input_->streams[i]->discard = AVDISCARD_ALL;
    }
    stream_ = input_->streams[best];
    return open_codec(decoder_with_alpha(*stream_, codec));
}

bool MovieDecoder::open_codec(const AVCodec* codec) {
    codec_.reset(avcodec_alloc_context3(codec));
    if (!codec_ || avcodec_parameters_to_context(codec_.get(), stream_->codecpar) < 0) return false;
    codec_->pkt_timebase = stream_->time_base;
    codec_->thread_count = 0;  // one a processor; the pictures do not depend on it
    return avcodec_open2(codec_.get(), codec, nullptr) >= 0;
}

// Sends the decoder one more packet of its stream, or the end of the stream.
void MovieDecoder::feed() {
    while (av_read_frame(input_.get(), packet_.get()) >= 0) {
        const bool ours = packet_->stream_index == stream_->index;
        if (ours) {
            discarded_ += (packet_->flags & AV_PKT_FLAG_DISCARD) != 0;
            // A damaged packet loses its frame, not the movie.
            static_cast<void>(avcodec_send_packet(codec_.get(), packet_.get()));
        }
        av_packet_unref(packet_.get());
        if (ours) return;
    }
    draining_ = true;
    static_cast<void>(avcodec_send_packet(codec_.get(), nullptr));
}

const AVFrame* MovieDecoder::next() {
    if (!codec_) return nullptr;
    // While draining, each damaged frame that is still inside gives one error.
    int errors_left = 256;
    while (true) {
        const int result = avcodec_receive_frame(codec_.get(), frame_.get());
        if (result == 0) return frame_.get();
        if (result == AVERROR_EOF) return nullptr;
        if (!draining_) {
            feed();
        } else if (--errors_left == 0) {
            return nullptr;
        }
    }
}

double MovieDecoder::fps() const {
    const double stored = as_double(av_guess_frame_rate(input_.get(), stream_, nullptr));
    if (!(stored > 0 && stored < 10000)) return 0;
    const AVRational standard = standard_rate(stored, 1e-4);
    return standard.num > 0 ? as_double(standard) : stored;
}

double MovieDecoder::tick_s() const {
    return as_double(stream_->time_base);
}

int MovieDecoder::claimed_frames() const {
    double frames = static_cast<double>(stream_->nb_frames);
    if (!(frames > 0) && stream_->duration != AV_NOPTS_VALUE) {
        frames = static_cast<double>(stream_->duration) * as_double(stream_->time_base) * fps();
    } else if (!(frames > 0) && input_->duration != AV_NOPTS_VALUE && input_->nb_streams == 1) {
        frames = static_cast<double>(input_->duration) / AV_TIME_BASE * fps();
    }
    frames = std::round(frames) - discarded_;
    return frames > 0 && frames < 1e8 ? static_cast<int>(frames) : 0;
}

double MovieDecoder::pixel_aspect() const {
    const double aspect = as_double(av_guess_sample_aspect_ratio(input_.get(), stream_, nullptr));
    if (!(aspect > 0.05 && aspect < 20)) return 1;
    return rotation_deg() % 180 == 0 ? aspect : 1 / aspect;
}

int MovieDecoder::rotation_deg() const {
    const std::uint8_t* matrix =
        av_stream_get_side_data(stream_, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
    if (!matrix) return 0;
    const double counter_clockwise =
        av_display_rotation_get(reinterpret_cast<const std::int32_t*>(matrix));
    if (!std::isfinite(counter_clockwise)) return 0;
    const int quarters = static_cast<int>(std::lround(-counter_clockwise / 90.0));
    return ((quarters % 4) + 4) % 4 * 90;
}

}  // namespace weft
