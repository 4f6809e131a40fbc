#include <cstdio>
#include <filesystem>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/cli/cli.h"
#include "app/editor/editor.h"

namespace weft {
namespace {

Expected<int> edit(const EditArguments& given) {
    EditorOptions options;
    options.project = given.project;
    options.demo = given.demo;
    options.paused = given.paused;
    options.assets = given.assets;
    options.script = given.script;
    options.screenshot = given.screenshot;
    options.ui_scale = given.ui_scale;
    options.light = given.light;
    options.texture_library = given.library;
    std::error_code error;
    options.program = std::filesystem::read_symlink("/proc/self/exe", error).string();
    constexpr int kLeast = 320, kMost = 16384;
    if (std::sscanf(given.size.c_str(), "%dx%d", &options.width, &options.height) != 2 ||
        options.width < kLeast || options.height < kLeast || options.width > kMost ||
        options.height > kMost) {
        return fail(
            ErrorCode::kUsage,
            "--size must be a width and a height of 320 to 16384 px, not '" + given.size + "'.",
            "Write it like 1600x900.");
    }
    return run_editor(options);
}

// A command has neither a dot nor a slash in its name.
bool is_file(const std::string& word) {
    std::error_code none;
    return word.find_first_of("./") != std::string::npos && !word.starts_with('-') &&
           std::filesystem::exists(word, none);
}

}  // namespace
}  // namespace weft

int main(int argc, char** argv) {
#ifdef __GLIBC__
    // Images are allocated in one thread and freed in another. With glibc's default of one heap per
    // thread, freed memory is not reused and the peak grows with the shot: 1.76 GB instead of 1.54
    // GB for six 4K frames.
    mallopt(M_ARENA_MAX, 1);
#endif
    // Without a command, open the editor if a display is available.
    char command[] = "edit";
    char* with_edit[] = {argv[0], command, nullptr};
    if (argc < 2 && weft::has_display()) return weft::run_cli(2, with_edit, weft::edit);
    // A file instead of a command is opened, as other programs do.
    if (argc == 2 && weft::is_file(argv[1])) {
        char* with_file[] = {argv[0], command, argv[1], nullptr};
        return weft::run_cli(3, with_file, weft::edit);
    }
    return weft::run_cli(argc, argv, weft::edit);
}
