#pragma once
// The picture alone in a window of its own.

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

  private:
    void close();
    GLFWwindow* main_;
    GLFWwindow* window_ = nullptr;
    bool fresh_ = true;
};

}  // namespace weft
