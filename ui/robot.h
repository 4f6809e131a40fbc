#pragma once
// Drives the panels as a hand would: finds widgets by their labels, moves the mouse, presses keys.
// For scripts and tests.

#include <functional>
#include <string>
#include <vector>

#include "ui/shell.h"

namespace weft {

/// Works on the current ImGui context, whose input it owns. `frame` draws one frame.
class Robot {
  public:
    Robot(Shell& shell, std::function<void()> frame);

    void frames(int count = 1);
    /// The last item whose name is `name` or ends with "/name"; null when it is not on the screen.
    [[nodiscard]] const DrawnItem* find(const std::string& name) const;
    /// All return false when there is no such item.
    bool click(const std::string& name, int times = 1);
    bool hover(const std::string& name);
    /// Drags an item's middle by so many screen pixels.
    bool drag(const std::string& name, ImVec2 by);
    bool drag_onto(const std::string& from, const std::string& to);
    void move(ImVec2 to);
    void press(int button = 0);
    void release(int button = 0);
    void wheel(float steps);
    /// A chord as in a shortcut: "Ctrl+Z".
    bool key(const std::string& chord);
    void hold(const std::string& chord, bool down);
    void type(const std::string& text);
    /// A stroke through these screen points, one a frame.
    void stroke(const std::vector<ImVec2>& points);

  private:
    Shell& shell_;
    std::function<void()> frame_;
};

}  // namespace weft
