#include "engine/media/sequence_files.h"

#include <filesystem>
#include <utility>

namespace weft {

std::vector<std::string> existing_files(const SequencePattern& pattern,
                                        const std::vector<int>& frames) {
    std::vector<std::string> paths;
    std::error_code ignored;
    for (const int frame : frames) {
        std::string path = pattern.path_for(frame);
        if (std::filesystem::exists(path, ignored)) paths.push_back(std::move(path));
        if (pattern.is_single()) break;
    }
    return paths;
}

}  // namespace weft
