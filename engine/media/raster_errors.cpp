#include "engine/media/raster_errors.h"

#include <algorithm>

#include "engine/core/setting.h"
#include "engine/core/text.h"
#include "engine/media/decode_limit.h"

namespace weft {

Error unreadable(const std::string& path, const std::string& reason, const std::string& advice) {
    return {ErrorCode::kUnreadable, path + " cannot be read: " + reason + ".", advice, {}};
}

Error animated(const std::string& path) {
    return unreadable(path, "it is an animation, several pictures in one file",
                      "Export its frames as numbered pictures or as a movie, or save the one that "
                      "is meant by itself.");
}

Error damaged(const std::string& path, const std::string& reason) {
    std::string one_line = reason.empty() ? "the file ends early" : reason;
    std::replace(one_line.begin(), one_line.end(), '\n', ' ');
    while (!one_line.empty() && (one_line.back() == '.' || one_line.back() == ' ')) {
        one_line.pop_back();
    }
    return unreadable(path, "it is truncated, damaged or not a picture (" + one_line + ")",
                      "Write or copy it again.");
}

Status check_memory(const std::string& path, Size size, int channels) {
    const double bytes = static_cast<double>(size.width) * size.height * channels * sizeof(float);
    if (bytes <= static_cast<double>(decode_limit_bytes())) return {};
    return fail(
        ErrorCode::kNoSpace,
        path + " does not fit into memory: it has " + size_text(size) +
            " pixels, and a picture may take " + std::to_string(decode_limit_bytes() >> 20) +
            " MB decoded (a quarter of this machine's memory, or half of the memory limit).",
        "Scale it down, or allow more memory" + by({{setting::kMemory}}) + ".");
}

Status check_plate_size(const std::string& path, const std::string& what, Size have, Size plate,
                        const std::string& advice) {
    if (plate.empty() || have == plate) return {};
    return tl::unexpected(
        unreadable(path, what + " is " + size_text(have) + " but the plate is " + size_text(plate),
                   "Both must have one size: " + advice + "."));
}

}  // namespace weft
