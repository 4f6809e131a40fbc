#include "engine/media/video_library.h"

extern "C" {
#include <libavutil/error.h>
#include <libavutil/log.h>
}

#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <mutex>

#include "engine/media/atomic_file.h"
#include "engine/media/movies.h"

namespace weft {

std::string movie_library() {
    const unsigned v = avcodec_version();
    return "FFmpeg's libavcodec " + std::to_string(AV_VERSION_MAJOR(v)) + "." +
           std::to_string(AV_VERSION_MINOR(v)) + "." + std::to_string(AV_VERSION_MICRO(v)) + ", " +
           avcodec_license();
}

Status require_movies(const std::string& /*path*/) {
    return {};
}

void silence_video_library() {
    static std::once_flag once;
    // A callback instead of a log level, which other users of the library in this process may set.
    std::call_once(once, [] { av_log_set_callback([](void*, int, const char*, std::va_list) {}); });
}

std::string file_url(const std::string& path) {
    return "file:" + path;
}

AVRational standard_rate(double fps, double tolerance) {
    // NTSC rates are multiples of 24 or 30, divided by 1.001.
    constexpr double kWhole = 1e-4;
    const int whole = static_cast<int>(std::lround(fps));
    if (whole <= 0) return {0, 1};
    if (std::abs(fps - whole) < kWhole) return {whole, 1};
    const bool ntsc =
        (whole % 24 == 0 || whole % 30 == 0) && std::abs(fps - whole / 1.001) < tolerance;
    return ntsc ? AVRational{whole * 1000, 1001} : AVRational{0, 1};
}

Error video_write_error(const std::string& path, int av_error) {
    // FFmpeg's own codes are tags of four letters; the system's are small numbers.
    constexpr int kLastErrno = 4095;
    const int system = AVUNERROR(av_error);
    if (system == ENOMEM) {
        return {ErrorCode::kNoSpace,
                path + " cannot be written: the machine is out of memory.",
                "Close other programs.",
                {}};
    }
    if (system > 0 && system <= kLastErrno && system != EINVAL) {
        return system_error(path, "cannot be written", system);
    }
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(av_error, text, sizeof text);
    return {ErrorCode::kRenderFailed,
            path + " cannot be written: the encoder says \"" + text + "\".",
            "Write numbered frames or the other kind of movie (.mp4, .mkv).",
            {}};
}

}  // namespace weft
