#include "app/base/paint_programs.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace weft {
namespace {

namespace fs = std::filesystem;

// GIMP 2.10 lost its OpenRaster filter in Debian 12 with Python 2.
struct Known {
    const char *name, *command, *ending;
};
constexpr std::array kKnown{Known{"Krita", "krita", ".ora"}, Known{"GIMP", "gimp", ".tif"},
                            Known{"MyPaint", "mypaint", ".ora"}};

bool is_executable(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::string find_program(const std::string& command) {
    if (command.empty()) return {};
    if (command.find('/') != std::string::npos)
        return is_executable(command) ? command : std::string();
    const char* folders = std::getenv("PATH");
    std::istringstream list(folders ? folders : "");
    for (std::string folder; std::getline(list, folder, ':');) {
        const fs::path path = fs::path(folder) / command;
        if (is_executable(path)) return path.string();
    }
    return {};
}

std::vector<PaintProgram> installed_paint_programs() {
    std::vector<PaintProgram> out;
    for (const Known& one : kKnown)
        if (!find_program(one.command).empty()) out.push_back({one.name, one.command, one.ending});
    return out;
}

PaintProgram paint_program_of(const std::string& command) {
    const std::string file = fs::path(command).filename().string();
    for (const Known& one : kKnown)
        if (file.starts_with(one.command)) return {one.name, command, one.ending};
    return {file, command, ".tif"};
}

}  // namespace weft
