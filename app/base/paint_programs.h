#pragma once
#include <string>
#include <vector>

namespace weft {

/// A program in which a still picture is painted on.
struct PaintProgram {
    std::string name;     ///< "Krita"
    std::string command;  ///< What starts it, as a shell would find it; no arguments.
    std::string ending;   ///< Of the kind of picture that it takes with all that Weft writes.
    bool operator==(const PaintProgram&) const = default;
};

/// Those of the known programs that are installed, the most suitable first. Looks through $PATH.
[[nodiscard]] std::vector<PaintProgram> installed_paint_programs();

/// One that the user names by its command. OpenRaster where it is known to read that, else TIFF.
[[nodiscard]] PaintProgram paint_program_of(const std::string& command);

}  // namespace weft
