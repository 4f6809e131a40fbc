#pragma once
#include <string>

namespace weft::ui {

/// The folder that a file or a pattern such as `out/####.png` lies in, without the last slash; "."
/// if it names none.
[[nodiscard]] inline std::string folder_of(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? std::string(".") : path.substr(0, slash);
}

}  // namespace weft::ui
