#include "app/session/viewer/screens.h"

#include <algorithm>
#include <utility>

#include "engine/color/color_space.h"

namespace weft {

// In the background: a large config takes a large part of a second to read.
void Screens::look() {
    tasks_.start([this]() -> DocumentTasks::Finish {
        auto screens = list_screens();
        auto spaces = list_color_spaces();
        return [this, screens = std::move(screens), spaces = std::move(spaces)] {
            if (!screens) return notices_.add(NoticeKind::kWarning, screens.error().text());
            screens_ = *screens;
            if (spaces) spaces_ = *spaces;
            changed_ = true;
            if (screens->empty()) return;
            const ScreenName kept{settings_.screen_display, settings_.screen_view};
            const bool known =
                std::find(screens->begin(), screens->end(), kept) != screens->end() ||
                (kept.display.empty() && !kept.view.empty());
            prepare(known ? kept : screens->front());
        };
    });
}

void Screens::choose(const ScreenName& name) {
    settings_.screen_display = name.display;
    settings_.screen_view = name.view;
    prepare(name);
}

void Screens::prepare(const ScreenName& name) {
    wanted_ = name;
    if (name.display.empty()) {
        name_ = name;
        screen_.reset();
        changed_ = true;
        return;
    }
    tasks_.start([this, name]() -> DocumentTasks::Finish {
        auto made = make_screen_view(name);
        return [this, name, made = std::move(made)] {
            if (!(wanted_ == name)) return;
            if (!made) return notices_.add(NoticeKind::kWarning, made.error().text());
            name_ = name;
            screen_ = *made;
            changed_ = true;
        };
    });
}

void Screens::show(SessionView& view) {
    if (!std::exchange(changed_, false)) return;
    view.screens = screens_;
    view.color_spaces = spaces_;
    view.screen_name = name_;
    view.screen = screen_;
}

}  // namespace weft
