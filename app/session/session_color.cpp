// View transforms: the views of the OpenColorIO config in $OCIO.
#include <algorithm>

#include "app/base/background.h"
#include "app/session/session.h"

namespace weft {

// In the background: a large config takes a large part of a second to read.
void Session::look_for_screens() {
    file_tasks_.start([this]() -> Finish {
        auto screens = list_screens();
        auto spaces = list_color_spaces();
        return [this, screens = std::move(screens), spaces = std::move(spaces)] {
            if (!screens) return notify(NoticeKind::kWarning, screens.error().text());
            view_.screens = *screens;
            if (spaces) view_.color_spaces = *spaces;
            if (screens->empty()) return;
            const ScreenName kept{settings_->screen_display, settings_->screen_view};
            const bool known =
                std::find(screens->begin(), screens->end(), kept) != screens->end() ||
                (kept.display.empty() && !kept.view.empty());
            choose_screen(known ? kept : screens->front(), false);
        };
    });
}

void Session::choose_screen(const ScreenName& name, bool remember) {
    wanted_screen_ = name;
    if (remember) {
        settings_->screen_display = name.display;
        settings_->screen_view = name.view;
    }
    if (name.display.empty()) {
        view_.screen_name = name;
        view_.screen.reset();
        return;
    }
    file_tasks_.start([this, name]() -> Finish {
        auto made = make_screen_view(name);
        return [this, name, made = std::move(made)] {
            if (!(wanted_screen_ == name)) return;
            if (!made) return notify(NoticeKind::kWarning, made.error().text());
            view_.screen_name = name;
            view_.screen = *made;
        };
    });
}

}  // namespace weft
