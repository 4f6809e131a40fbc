#pragma once
// A second window that shows the viewer's picture only.

#include <functional>
#include <utility>

struct GLFWwindow;

namespace weft {

class EditorApp;

/// Shares the main window's OpenGL objects. Belongs to one thread.
class SecondWindow {
  public:
    explicit SecondWindow(GLFWwindow* main) : main_(main) {}
    ~SecondWindow();
    SecondWindow(const SecondWindow&) = delete;
    SecondWindow& operator=(const SecondWindow&) = delete;

    /// Opens the window, full screen on another monitor if there is one, or closes it.
    void toggle();
    /// Draws the viewer's picture. The main window's context is current before and after.
    void draw(EditorApp& app);
    /// Returns true if it must be redrawn because of an event since the last call.
    [[nodiscard]] bool take_event() { return std::exchange(event_, false); }
    /// Receives its key presses: GLFW's key, scan code and action.
    std::function<void(int, int, int)> on_key;

  private:
    void close();
    void listen();
    GLFWwindow* main_;
    GLFWwindow* window_ = nullptr;
    bool fresh_ = true;
    bool event_ = false;
};

}  // namespace weft
