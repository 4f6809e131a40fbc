#pragma once
// What the result is compared with: the plate, a finished render, or a result that was stored.

#include <string>

#include "ui/base/ctx.h"

namespace weft::ui {

/// The picture that the result is compared with on this frame; null while it is read, or where
/// there is none.
[[nodiscard]] PicturePtr compared_picture(Ctx& c);
/// Its name: "Plate", "render_v001", "Stored, frame 12".
[[nodiscard]] std::string compared_name(const Ctx& c);
/// Keeps the result of this frame, to compare another look with it.
void store_result(Ctx& c);
/// The choice, in the viewer's bar.
void compare_choice(Ctx& c, float width);

}  // namespace weft::ui
