#pragma once
#include <functional>
#include <string>

#include "engine/core/error.h"

namespace weft {

/// What `weft edit` was given. The editor itself lies above the command line and is handed in.
struct EditArguments {
    std::string project;     ///< A project or a plate; empty: the welcome screen.
    bool demo = false;       ///< Open the demo shot.
    bool paused = false;     ///< Begin with the analysis paused.
    std::string library;     ///< Texture library; empty: the user's own.
    std::string assets;      ///< Folder of what Weft brings along.
    std::string script;      ///< Steps to carry out without a window.
    std::string screenshot;  ///< Picture of the last of them.
    std::string size = "1600x900";
    double ui_scale = 0;  ///< 0: the monitor's.
    bool light = false;
};
/// Returns the exit code. Blocks until the editor is closed.
using EditCommand = std::function<Expected<int>(const EditArguments&)>;

}  // namespace weft
