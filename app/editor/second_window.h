#pragma once
// The picture alone in a window of its own.

#include <functional>
#include <utility>

struct GLFWwindow;

namespace weft {

class EditorApp;

/// Shares the main window's OpenGL. One thread.
class SecondWindow {
  public:
    explicit SecondWindow(GLFWwindow* main) : main_(main) {}
    ~SecondWindow();
    SecondWindow(const SecondWindow&) = delete;
    SecondWindow& operator=(const SecondWindow&) = delete;

    /// Opens it, filling another screen where there is one, or closes it.
    void toggle();
    /// Shows what the viewer shows; the main window's context is current before and after.
    void draw(EditorApp& app);
    /// Whether something has happened to it since the last call, so that it wants to be drawn.
    [[nodiscard]] bool stirred() { return std::exchange(stirred_, false); }
    /// Keys that it has no use for itself: GLFW's key, scan code and action.
    std::function<void(int, int, int)> on_key;

  private:
    void close();
    void listen();
    GLFWwindow* main_;
    GLFWwindow* window_ = nullptr;
    bool fresh_ = true;
    bool stirred_ = false;
};

}  // namespace weft
