#include "app/editor/editor.h"

#include <cstdlib>

#include "app/editor/run_modes.h"
#include "engine/core/setting.h"
#include "ui/parameters/setting_labels.h"

namespace weft {

bool has_display() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

Expected<int> run_editor(const EditorOptions& options) {
    set_setting_namer(ui::setting_label);
    if (!options.script.empty() || !options.screenshot.empty()) return run_offscreen(options);
    return run_window(options);
}

}  // namespace weft
