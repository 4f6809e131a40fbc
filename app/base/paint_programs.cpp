#include "app/base/paint_programs.h"

#include <array>
#include <filesystem>

#include "app/base/find_program.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// GIMP 2.10.34 of Debian 12 reads no OpenRaster.
struct Known {
    const char *name, *command, *ending;
};
constexpr std::array kKnown{Known{"Krita", "krita", ".ora"}, Known{"GIMP", "gimp", ".tif"},
                            Known{"MyPaint", "mypaint", ".ora"}};

}  // namespace

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
