#pragma once
// Drives the panels like a user: finds widgets by label, moves the mouse, presses keys. For scripts
// and tests.

#include <functional>
#include <string>
#include <vector>

#include "ui/shell/shell.h"

namespace weft {

/// Controls the input of the current ImGui context. `frame` draws one frame.
class Robot {
  public:
    Robot(Shell& shell, std::function<void()> frame);

    void frames(int count = 1);
    /// The last item named `name` or ending in "/name"; null if it is not on screen.
    [[nodiscard]] const DrawnItem* find(const std::string& name) const;
    /// The functions below return false if there is no such item.
    bool click(const std::string& name, int times = 1);
    bool hover(const std::string& name);
    /// Drags the centre of an item by `by` screen pixels.
    bool drag(const std::string& name, ImVec2 by);
    bool drag_onto(const std::string& from, const std::string& to);
    void move(ImVec2 to);
    void press(int button = 0);
    void release(int button = 0);
    void wheel(float steps);
    /// Presses a chord such as "Ctrl+Z".
    bool key(const std::string& chord);
    void hold(const std::string& chord, bool down);
    void type(const std::string& text);
    /// Draws a stroke through these screen points, one per frame.
    void stroke(const std::vector<ImVec2>& points);

  private:
    Shell& shell_;
    std::function<void()> frame_;
};

}  // namespace weft
