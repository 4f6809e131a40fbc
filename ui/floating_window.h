#pragma once
// How windows look that float over the rest.

#include <imgui.h>

#include "ui/theme.h"

namespace weft::ui {

/// Begins a window of the panel's colour with a border and round corners, without a title bar.
/// ImGui::End() belongs to every call. `flags` come on top of its own.
void begin_floating(const Theme& theme, const char* id, ImVec2 at, ImVec2 size, ImVec2 padding,
                    ImGuiWindowFlags flags = 0);

}  // namespace weft::ui
