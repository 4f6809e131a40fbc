#pragma once
// What the screen is shown through: views of the OpenColorIO config in $OCIO.

#include <memory>
#include <string>
#include <vector>

#include "app/base/editor_settings.h"
#include "app/session/action.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/session_view.h"
#include "engine/color/screen_view.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class Screens {
  public:
    /// The references must stay.
    Screens(DocumentTasks& tasks, Notices& notices, EditorSettings& settings)
        : tasks_(tasks), notices_(notices), settings_(settings) {}

    /// Reads the config in the background; then shows the screen that was chosen last.
    void look();
    void choose(const ScreenName& name);
    /// Writes what has changed since the last call.
    void show(SessionView& view);

  private:
    void prepare(const ScreenName& name);

    DocumentTasks& tasks_;
    Notices& notices_;
    EditorSettings& settings_;
    ScreenName wanted_;  // shown or being prepared
    ScreenName name_{"", kScreenSrgb};
    std::shared_ptr<const ScreenView> screen_;
    std::vector<ScreenName> screens_;
    std::vector<std::string> spaces_;
    bool changed_ = false;
};

}  // namespace weft
