#pragma once
// Folders and paths of the file browser.

#include <string>

#include "ui/base/ctx.h"

namespace weft::ui {

[[nodiscard]] std::string home();
/// A path that begins with "~" from the root.
[[nodiscard]] std::string from_home(const std::string& path);
[[nodiscard]] std::string parent_of(const std::string& folder);
[[nodiscard]] std::string joined(const std::string& folder, const std::string& name);

/// Where a project is saved first: beside the project, else where the last one is, else at home;
/// never among the plate's frames.
[[nodiscard]] std::string folder_to_save(const Ctx& c);

/// The path of the name that is typed, which may be a path itself, with its extension.
[[nodiscard]] std::string path_to_save(const BrowserState& b);

/// Whether that would lie in the folder of the plate's frames.
[[nodiscard]] bool saves_among_frames(const Ctx& c, const BrowserState& b);

/// The output's name in another folder.
[[nodiscard]] std::string output_in(const std::string& folder, const std::string& output);

}  // namespace weft::ui
