#pragma once
// The editor's window.

#include <string>

#include "engine/core/error.h"

namespace weft {

struct EditorOptions {
    std::string project;          ///< A project or a plate; empty: the welcome screen.
    bool demo = false;            ///< Open the demo shot.
    bool paused = false;          ///< Start with the analysis paused.
    std::string program;          ///< The weft program that renders jobs.
    std::string assets;           ///< Folder with demo/ and textures/.
    std::string texture_library;  ///< Empty: the user's own.
    // Without a window, for tests and screenshots:
    /// Script to run without a window, for tests and screenshots; empty: none.
    std::string script;
    std::string screenshot;  ///< Path for an image of the last frame; empty: none.
    int width = 1600, height = 900;
    double ui_scale = 0;  ///< 0: the monitor's or the settings'.
    bool light = false;
};

/// Runs until the window is closed or the script ends. Returns the exit code. Errors: RenderFailed
/// when there is no display or no OpenGL 3.3.
[[nodiscard]] Expected<int> run_editor(const EditorOptions& options);

/// Returns true if a window can be opened.
[[nodiscard]] bool has_display();

}  // namespace weft
