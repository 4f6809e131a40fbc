#include "app/base/find_program.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace weft {
namespace {

namespace fs = std::filesystem;

bool is_executable(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::string find_program(const std::string& command) {
    if (command.empty()) return {};
    if (command.find('/') != std::string::npos)
        return is_executable(command) ? command : std::string();
    const char* folders = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
    std::istringstream list(folders ? folders : "");
    for (std::string folder; std::getline(list, folder, ':');) {
        const fs::path path = fs::path(folder) / command;
        if (is_executable(path)) return path.string();
    }
    return {};
}

}  // namespace weft
