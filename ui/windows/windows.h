#pragma once
// Floating windows and dialogs.

#include "ui/base/ctx.h"

namespace weft::ui {

void notices(Ctx& c);
void command_palette(Ctx& c);
void shortcut_sheet(Ctx& c);
void settings_window(Ctx& c);
void shot_window(Ctx& c);
void history_window(Ctx& c);
void about_window(Ctx& c);
void tour(Ctx& c);

}  // namespace weft::ui
