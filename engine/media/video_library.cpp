#include "engine/media/video_library.h"

#include <cstdlib>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>

namespace weft {

void silence_video_library() {
    static std::once_flag once;
    std::call_once(once, [] {
        // OpenCV sets FFmpeg's level from this variable when it opens its first movie; -8 is quiet.
        // A level that the user has set stays, as do the messages then wanted.
        setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    });
}

}  // namespace weft
