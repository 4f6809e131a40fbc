#include "app/editor/second_window.h"

#include <GLFW/glfw3.h>

#include "app/editor/editor_app.h"

namespace weft {
namespace {

SecondWindow* self_of(GLFWwindow* window) {
    return static_cast<SecondWindow*>(glfwGetWindowUserPointer(window));
}

// A monitor other than the main window's; null if there is none.
GLFWmonitor* other_screen(GLFWwindow* main) {
    int count = 0, x = 0, y = 0;
    GLFWmonitor** all = glfwGetMonitors(&count);
    glfwGetWindowPos(main, &x, &y);
    for (int k = 0; k < count; ++k) {
        int left = 0, top = 0;
        glfwGetMonitorPos(all[k], &left, &top);
        const GLFWvidmode* mode = glfwGetVideoMode(all[k]);
        const bool here =
            mode && x >= left && x < left + mode->width && y >= top && y < top + mode->height;
        if (!here) return all[k];
    }
    return nullptr;
}

}  // namespace

SecondWindow::~SecondWindow() {
    close();
}

void SecondWindow::close() {
    if (window_) glfwDestroyWindow(window_);
    window_ = nullptr;
    glfwMakeContextCurrent(main_);
}

void SecondWindow::listen() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int code, int action, int mods) {
        SecondWindow& second = *self_of(window);
        second.event_ = true;
        const bool leave =
            key == GLFW_KEY_ESCAPE || (key == GLFW_KEY_F11 && (mods & GLFW_MOD_SHIFT));
        if (leave && action == GLFW_PRESS)
            glfwSetWindowShouldClose(window, GLFW_TRUE);
        else if (second.on_key)
            second.on_key(key, code, action);
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self_of(w)->event_ = true; });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) { self_of(w)->event_ = true; });
    glfwSetFramebufferSizeCallback(window_,
                                   [](GLFWwindow* w, int, int) { self_of(w)->event_ = true; });
}

void SecondWindow::toggle() {
    if (window_) return close();
    GLFWmonitor* screen = other_screen(main_);
    const GLFWvidmode* mode = screen ? glfwGetVideoMode(screen) : nullptr;
    window_ = glfwCreateWindow(mode ? mode->width : 960, mode ? mode->height : 540, "Weft: picture",
                               mode ? screen : nullptr, main_);
    if (!window_) return;
    listen();
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(0);  // only the main window waits for vertical sync
    glfwMakeContextCurrent(main_);
    fresh_ = true;
}

void SecondWindow::draw(EditorApp& app) {
    if (!window_) return;
    if (glfwWindowShouldClose(window_)) return close();
    const SessionView& view = app.session().view();
    const ViewerState& viewer = app.shell().state().viewer;
    const bool plate = viewer.hold_original || viewer.compare == Compare::kPlate;
    const PicturePtr& shown =
        !plate && view.result_picture ? view.result_picture : view.plate_picture;
    int width = 0, height = 0;
    glfwMakeContextCurrent(window_);
    glfwGetFramebufferSize(window_, &width, &height);
    app.pictures().show_alone(shown, on_screen(viewer.display, view), viewer.aspect, width, height,
                              fresh_);
    fresh_ = false;
    glfwSwapBuffers(window_);
    glfwMakeContextCurrent(main_);
}

}  // namespace weft
