#include "ui/files/browser_paths.h"

#include <cstdlib>

namespace weft::ui {
namespace {

// The folder of the plate's frames; empty for a movie.
std::string plate_folder(const Ctx& c) {
    const std::string& plate = c.view.plate.path;
    const bool sequence = plate.find('#') != std::string::npos ||
                          plate.find('%') != std::string::npos ||
                          plate.find('@') != std::string::npos;
    return sequence ? parent_of(plate) : std::string();
}

// What is typed as a name may be a path: from the root, from home, or from the folder shown.
std::string typed_path(const std::string& folder, const std::string& name) {
    const std::string path = from_home(name);
    return path.starts_with('/') ? path : joined(folder, name);
}

}  // namespace

std::string home() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing in the program sets a variable.
    const char* path = std::getenv("HOME");
    return path && *path ? path : "/";
}

std::string from_home(const std::string& path) {
    return path == "~" || path.starts_with("~/") ? home() + path.substr(1) : path;
}

std::string parent_of(const std::string& folder) {
    const std::size_t slash = folder.find_last_of('/');
    return slash == 0 || slash == std::string::npos ? "/" : folder.substr(0, slash);
}

std::string joined(const std::string& folder, const std::string& name) {
    return folder == "/" ? "/" + name : folder + "/" + name;
}

std::string folder_to_save(const Ctx& c) {
    std::string folder = !c.view.path.empty()         ? parent_of(c.view.path)
                         : !c.settings.recent.empty() ? parent_of(c.settings.recent.front())
                                                      : home();
    return folder == plate_folder(c) && c.view.path.empty() ? parent_of(folder) : folder;
}

std::string path_to_save(const BrowserState& b) {
    const std::string path = typed_path(b.folder, b.name);
    return path.ends_with(".weft") ? path : path + ".weft";
}

bool saves_among_frames(const Ctx& c, const BrowserState& b) {
    const std::string path = path_to_save(b);
    return path != c.view.path && parent_of(path) == plate_folder(c);
}

std::string output_in(const std::string& folder, const std::string& output) {
    const std::string name = output.substr(output.find_last_of('/') + 1);
    return joined(folder, name.empty() ? "####.png" : name);
}

}  // namespace weft::ui
