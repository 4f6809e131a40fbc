// A window of the desktop.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <vector>

#include "app/editor/editor_app.h"
#include "app/editor/run_modes.h"

namespace weft {
namespace {

struct WindowState {
    EditorApp* app = nullptr;
    bool event = true;  // something happened since the last frame
    int windowed[4] = {80, 80, 1600, 900};
};

WindowState& state_of(GLFWwindow* window) {
    return *static_cast<WindowState*>(glfwGetWindowUserPointer(window));
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
    WindowState& state = state_of(window);
    state.event = true;
    if (count > 0) state.app->shell().open_dropped(paths[0], state.app->session().view());
}

void on_close(GLFWwindow* window) {
    glfwSetWindowShouldClose(window, GLFW_FALSE);
    state_of(window).event = true;
    state_of(window).app->shell().ask_to_leave();
}

void on_refresh(GLFWwindow* window) {
    state_of(window).event = true;
}

void toggle_fullscreen(GLFWwindow* window) {
    WindowState& state = state_of(window);
    if (glfwGetWindowMonitor(window)) {
        glfwSetWindowMonitor(window, nullptr, state.windowed[0], state.windowed[1],
                             state.windowed[2], state.windowed[3], 0);
        return;
    }
    glfwGetWindowPos(window, &state.windowed[0], &state.windowed[1]);
    glfwGetWindowSize(window, &state.windowed[2], &state.windowed[3]);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (mode)
        glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void draw(GLFWwindow* window, EditorApp& app) {
    float scale_x = 1, scale_y = 1;
    glfwGetWindowContentScale(window, &scale_x, &scale_y);
    if (app.update_look(static_cast<double>(scale_x))) ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    app.frame(glfwGetTime());
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(0.07f, 0.07f, 0.07f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window);
}

// Draws when something has happened, plays at full rate, else sleeps.
void loop(GLFWwindow* window, EditorApp& app, WindowState& state) {
    std::uint64_t seen = 0;
    int settle = 3;  // ImGui needs a few frames to come to rest after an event
    while (!app.wants_to_leave()) {
        const ImGuiIO& io = ImGui::GetIO();
        const ImVec2 mouse = io.MousePos;
        const bool down = ImGui::IsAnyMouseDown() || ImGui::IsAnyItemActive();
        if (settle > 0 || down || !app.idle())
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(0.1);
        const ImVec2 now(io.MousePos);
        double x = 0, y = 0;
        glfwGetCursorPos(window, &x, &y);
        const bool moved = static_cast<float>(x) != mouse.x || static_cast<float>(y) != mouse.y;
        const std::uint64_t news = app.news();
        if (moved || state.event || news != seen || down || !app.idle() || io.MouseWheel != 0 ||
            io.InputQueueCharacters.Size > 0)
            settle = 3;
        for (int key = 0; key < 512 && settle < 3; ++key)
            if (io.KeysDown[key]) settle = 3;
        (void)now;
        seen = news;
        state.event = false;
        if (settle == 0) continue;
        --settle;
        draw(window, app);
    }
}

GLFWwindow* make_window(const EditorOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "weft");
    return glfwCreateWindow(options.width, options.height, "Weft", nullptr, nullptr);
}

}  // namespace

Expected<int> run_window(const EditorOptions& options) {
    if (!has_display() || !glfwInit()) {
        return fail(ErrorCode::kRenderFailed,
                    "There is no display to open the editor on. Set DISPLAY, or use the commands "
                    "that need none: weft --help.");
    }
    GLFWwindow* window = make_window(options);
    if (!window) {
        glfwTerminate();
        return fail(ErrorCode::kRenderFailed,
                    "The display gives no OpenGL 3.3, which the editor needs. Update the graphics "
                    "driver, or use the commands that need none: weft --help.");
    }
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(window, 960, 600, GLFW_DONT_CARE, GLFW_DONT_CARE);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    Status started;
    {
        WindowState state;
        EditorApp app(options);
        state.app = &app;
        glfwSetWindowUserPointer(window, &state);
        glfwSetDropCallback(window, on_drop);
        glfwSetWindowCloseCallback(window, on_close);
        glfwSetWindowRefreshCallback(window, on_refresh);
        app.pictures().on_fullscreen = [window] { toggle_fullscreen(window); };
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 330 core");
        float scale = 1, other = 1;
        glfwGetWindowContentScale(window, &scale, &other);
        app.update_look(static_cast<double>(scale));
        started = app.start();
        if (started) loop(window, app, state);
        app.close();
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
    }
    ImGui::DestroyContext();
    glfwDestroyWindow(window);
    glfwTerminate();
    if (!started) return tl::unexpected<Error>(started.error());
    return 0;
}

}  // namespace weft
