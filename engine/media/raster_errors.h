#pragma once
// Internal: messages and checks that both decoders share.

#include <cstdint>
#include <exception>
#include <new>
#include <string>

#include "engine/core/error.h"
#include "engine/core/geometry.h"

namespace weft {

/// "PATH cannot be read: REASON. WHAT TO DO"
[[nodiscard]] Error unreadable(const std::string& path, const std::string& reason,
                               const std::string& advice);
/// Blender 3.4 cuts a channel's name at 64 characters; those that become alike are lost.
[[nodiscard]] inline bool is_cut_name(const std::string& channel) {
    constexpr std::size_t kMostCharacters = 63;
    return channel.size() >= kMostCharacters;
}
inline constexpr const char* kShorterNames =
    "Blender cuts channels' names at 64 characters, so that some are lost: give the view layer a "
    "name of at most 40 characters.";

[[nodiscard]] Error animated(const std::string& path);
[[nodiscard]] Error damaged(const std::string& path, const std::string& reason);

/// Errors: NoSpace if a picture of this size takes more than decode_limit_bytes(), so that the
/// system does not kill the process half way.
[[nodiscard]] Status check_memory(const std::string& path, Size size, int channels);

/// Errors: Unreadable if `have`, the size of `what` ("its motion"), differs from the plate's. An
/// empty plate size allows any.
[[nodiscard]] Status check_plate_size(const std::string& path, const std::string& what, Size have,
                                      Size plate, const std::string& advice);

/// Calls `body()` and converts exceptions of OpenImageIO's libraries into errors about the file.
template <class F>
auto guarded(const std::string& path, const F& body) -> decltype(body()) {
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, path + " does not fit into memory.");
    } catch (const std::exception& e) {
        return tl::unexpected(damaged(path, e.what()));
    }
}

}  // namespace weft
