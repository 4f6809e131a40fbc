#pragma once
#include <functional>
#include <string>

#include "engine/core/error.h"

namespace weft {

/// Arguments of `weft edit`. The editor is a higher layer than the command line, so it is passed
/// in.
struct EditArguments {
    std::string project;     ///< A project or a plate; empty: the welcome screen.
    bool demo = false;       ///< Open the demo shot.
    bool paused = false;     ///< Start with the analysis paused.
    std::string library;     ///< Texture library; empty: the user's own.
    std::string assets;      ///< Folder of the installed assets.
    std::string script;      ///< Script to run without a window.
    std::string screenshot;  ///< Image of the last step.
    std::string size = "1600x900";
    double ui_scale = 0;  ///< 0: the monitor's.
    bool light = false;
};
/// Blocks until the editor is closed. Returns the exit code.
using EditCommand = std::function<Expected<int>(const EditArguments&)>;

}  // namespace weft
