// weft doctor: checks what is available on this machine and says how to fix what is missing.

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "app/base/find_program.h"
#include "app/cli/commands.h"
#include "engine/media/movies.h"
#include "gpu/cuda_backend.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// kAbsent: optional; Weft works without it.
enum class Standing { kOk, kAbsent, kFix };

struct Finding {
    std::string what, state, advice;
    Standing standing = Standing::kOk;
};

Finding cpu_finding() {
    const auto choice = choose_backend("cpu");
    if (choice) return {"backend cpu", choice->backend->description(), ""};
    return {"backend cpu", choice.error().text(), "The build is broken: install Weft again.",
            Standing::kFix};
}

Finding cuda_finding() {
    if (const auto choice = choose_backend("cuda"))
        return {"backend cuda", choice->backend->description(), ""};
    // The message of `auto` without the backend's name.
    std::string why = "no CUDA device is available";
    if (const auto best = choose_backend("auto"))
        for (const std::string& line : best->passed_over)
            if (line.starts_with("cuda: ")) why = line.substr(6);
    return {"backend cuda", why, "", Standing::kAbsent};
}

Finding cache_finding() {
    const std::string path = cache_root({});
    std::error_code error;
    fs::create_directories(path, error);
    const bool good = !path.empty() && access(path.c_str(), W_OK | X_OK) == 0;
    if (good) return {"cache", path, ""};
    return {"cache", path.empty() ? "none" : path,
            "It cannot be written: set HOME, XDG_CACHE_HOME or --cache.", Standing::kFix};
}

Finding ocio_finding() {
    const char* ocio = std::getenv("OCIO");
    if (!ocio || !*ocio) return {"OpenColorIO", "built-in spaces (no $OCIO)", ""};
    std::error_code error;
    if (fs::exists(ocio, error)) return {"OpenColorIO", ocio, ""};
    return {"OpenColorIO", ocio, "$OCIO is not the path of a file: correct or unset it.",
            Standing::kFix};
}

Finding movie_finding() {
    const std::string movies = movie_library();
    if (movies.empty()) return {"movies", "not in this build", "", Standing::kAbsent};
    return {"movies", movies, ""};
}

Finding demo_finding(const std::string& assets) {
    std::error_code error;
    const std::string folder = absolute_path(assets);
    if (fs::exists(fs::path(assets) / "demo" / "demo.weft", error))
        return {"demo shot", folder, ""};
    return {"demo shot", folder, "Install Weft again, or give --assets.", Standing::kFix};
}

Finding display_finding() {
    for (const char* name : {"WAYLAND_DISPLAY", "DISPLAY"})
        if (const char* display = std::getenv(name); display && *display)
            return {"display", std::string(name) + "=" + display, ""};
    return {"display", "neither DISPLAY nor WAYLAND_DISPLAY is set, so the editor cannot open", "",
            Standing::kAbsent};
}

Finding slurm_finding() {
    if (!find_program("sbatch").empty()) return {"Slurm", "sbatch found", ""};
    return {"Slurm", "sbatch is not installed; weft submit --run cannot submit", "",
            Standing::kAbsent};
}

std::string finding_line(const Finding& f) {
    switch (f.standing) {
        case Standing::kOk:
            return "ok   " + f.what + ": " + f.state + "\n";
        case Standing::kAbsent:
            return "--   " + f.what + ": not available: " + f.state + "\n";
        case Standing::kFix:
            return "FIX  " + f.what + ": " + f.state + "\n     " + f.advice + "\n";
    }
    return {};
}

}  // namespace

CommandResult doctor_command(const std::string& assets) {
    std::string version = version_answer().text;
    version.pop_back();  // the line break
    Answer answer;
    answer.json = {{"schema", "weft.doctor/1"}, {"findings", Json::array()}};
    for (const Finding& f : {Finding{"version", version, ""}, cpu_finding(), cuda_finding(),
                             cache_finding(), movie_finding(), ocio_finding(), demo_finding(assets),
                             display_finding(), slurm_finding()}) {
        const bool fix = f.standing == Standing::kFix;
        answer.json["findings"].push_back({{"what", f.what},
                                           {"state", f.state},
                                           {"available", f.standing == Standing::kOk},
                                           {"good", !fix},
                                           {"advice", f.advice}});
        answer.text += finding_line(f);
        if (fix) answer.exit = exit_code(ErrorCode::kUnreadable);
    }
    return answer;
}

}  // namespace weft
