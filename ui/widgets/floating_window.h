#pragma once
// The style of floating windows.

#include <imgui.h>

#include "ui/base/theme.h"

namespace weft::ui {

/// Begins a window with the panel's colour, a border and round corners, without a title bar. Always
/// call ImGui::End(). `flags` are added to its own.
void begin_floating(const Theme& theme, const char* id, ImVec2 at, ImVec2 size, ImVec2 padding,
                    ImGuiWindowFlags flags = 0);

}  // namespace weft::ui
