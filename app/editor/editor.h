#pragma once
// The editor's window.

#include <string>

#include "engine/core/error.h"

namespace weft {

struct EditorOptions {
    std::string project;          ///< A project, a plate, or empty: the welcome screen.
    bool demo = false;            ///< Open the demo shot.
    bool paused = false;          ///< Begin with the analysis paused.
    std::string program;          ///< The weft that renders jobs.
    std::string assets;           ///< Folder with demo/ and textures/.
    std::string texture_library;  ///< Empty: the user's own.
    // Without a window, for tests and screenshots:
    std::string script;      ///< Path of a script; empty: none.
    std::string screenshot;  ///< Where to write the last picture; empty: nowhere.
    int width = 1600, height = 900;
    double ui_scale = 0;  ///< 0: the monitor's or the settings'.
    bool light = false;
};

/// Runs until the window is closed, or the script is over. Returns the exit code. Errors:
/// RenderFailed when there is no display or no OpenGL 3.3 (the message says what to do).
[[nodiscard]] Expected<int> run_editor(const EditorOptions& options);

/// Whether a window can be opened here.
[[nodiscard]] bool has_display();

}  // namespace weft
