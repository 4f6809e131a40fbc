#include "app/session/mattes/matte_folder.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "engine/core/hash.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// In the names of mattes: two editors may paint in one project at the same time, and a frozen frame
// must not be that of an earlier session.
const std::string& editor_tag() {
    static const std::string tag = [] {
        char host[256] = {};
        gethostname(host, sizeof host - 1);
        Hasher hasher;
        hasher.text(host).value(getpid());
        hasher.value(std::chrono::system_clock::now().time_since_epoch().count());
        constexpr std::size_t kDigits = 6;
        return hasher.finish().hex().substr(0, kDigits);
    }();
    return tag;
}

}  // namespace

std::string MatteFolder::new_path(RegionId region, int frame) {
    const std::string name =
        "region" + std::to_string(region) + "_" + std::to_string(frame) + "_" + editor_tag() + "_";
    const std::string& project = document_.path();
    const fs::path folder =
        project.empty()
            ? fs::path(state_folder_) / "unsaved" / std::to_string(getpid())
            : fs::path(document_.folder()) / (fs::path(project).stem().string() + "_mattes");
    for (;;) {
        const fs::path path = folder / (name + std::to_string(++serial_) + ".png");
        std::error_code error;
        if (!fs::exists(path, error)) return path.string();
    }
}

std::string MatteFolder::beside_project(const std::string& path) const {
    return document_.path().empty()
               ? path
               : fs::path(path).lexically_relative(document_.folder()).string();
}

}  // namespace weft
