// The editor in a desktop window.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/editor/editor_app.h"
#include "app/editor/frame_pace.h"
#include "app/editor/pen.h"
#include "app/editor/run_modes.h"
#include "app/editor/second_window.h"
#include "ui/input/input_queue.h"

namespace weft {
namespace {

struct WindowState {
    EditorApp* app = nullptr;
    InputQueue input;
    std::unique_ptr<PenSource> pen = open_pen();
    bool event = true;  // an event occurred since the last frame
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

// ---- input -----------------------------------------------------------------------------------

// Shortcuts follow the printed character, whatever the keyboard layout.
int printed_key(int key, int scancode) {
    const char* name = glfwGetKeyName(key, scancode);
    if (!name || name[0] == 0 || name[1] != 0) return key;
    const auto letter = static_cast<unsigned char>(name[0]);
    if (letter >= 'a' && letter <= 'z') return letter - 'a' + 'A';
    return letter > 32 && letter < 127 ? letter : key;
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int) {
    if (action == GLFW_REPEAT) return;  // ImGui generates its own key repeat
    WindowState& state = state_of(window);
    state.event = true;
    state.input.key(printed_key(key, scancode), action == GLFW_PRESS);
}

void on_character(GLFWwindow* window, unsigned code) {
    state_of(window).event = true;
    state_of(window).input.character(code);
}

void on_button(GLFWwindow* window, int button, int action, int) {
    WindowState& state = state_of(window);
    state.event = true;
    // The moves before it say where it was pressed: by now the mouse may be elsewhere.
    if (!state.input.knows_mouse()) {
        double x = 0, y = 0;
        glfwGetCursorPos(window, &x, &y);
        state.input.move({static_cast<float>(x), static_cast<float>(y)});
    }
    state.input.button(button, action == GLFW_PRESS, glfwGetTime());
}

void on_move(GLFWwindow* window, double x, double y) {
    state_of(window).event = true;
    state_of(window).input.move({static_cast<float>(x), static_cast<float>(y)});
}

void on_wheel(GLFWwindow* window, double x, double y) {
    state_of(window).event = true;
    state_of(window).input.wheel(static_cast<float>(x), static_cast<float>(y));
}

void on_enter(GLFWwindow* window, int entered) {
    state_of(window).event = true;
    if (!entered) state_of(window).input.leave();
}

void on_focus(GLFWwindow* window, int focused) {
    state_of(window).event = true;
    if (!focused) state_of(window).input.release_all();
}

void listen(GLFWwindow* window) {
    glfwSetKeyCallback(window, on_key);
    glfwSetCharCallback(window, on_character);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetCursorPosCallback(window, on_move);
    glfwSetScrollCallback(window, on_wheel);
    glfwSetCursorEnterCallback(window, on_enter);
    glfwSetWindowFocusCallback(window, on_focus);
    glfwSetDropCallback(window, on_drop);
    glfwSetWindowCloseCallback(window, on_close);
    glfwSetWindowRefreshCallback(window, on_refresh);
}

// ---- drawing ---------------------------------------------------------------------------------

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

void draw(GLFWwindow* window, EditorApp& app, InputQueue& input) {
    FrameClock& clock = app.clock();
    clock.begin();
    clock.enter("fonts");
    float scale_x = 1, scale_y = 1;
    glfwGetWindowContentScale(window, &scale_x, &scale_y);
    if (app.update_look(static_cast<double>(scale_x))) ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_NewFrame();
    clock.enter("input");
    ImGui_ImplGlfw_NewFrame();
    input.feed(ImGui::GetIO());
    app.shell().state().mouse_path = input.path();
    PenSource* pen = state_of(window).pen.get();
    app.shell().state().pen_pressure = pen ? pen->pressure() : std::nullopt;
    app.frame(glfwGetTime());
    // Not counted: drawing and swapping wait for the GPU.
    clock.end();
    app.watch();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(0.07f, 0.07f, 0.07f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(window);
}

bool any_key_down() {
    const ImGuiIO& io = ImGui::GetIO();
    return std::any_of(std::begin(io.KeysDown), std::end(io.KeysDown), [](bool d) { return d; });
}

WindowMoment moment_of(EditorApp& app, const InputQueue& input) {
    const SessionView& view = app.session().view();
    WindowMoment out;
    out.now_s = glfwGetTime();
    out.at_hand = ImGui::IsAnyMouseDown() || any_key_down() || input.pending() || view.playing != 0;
    out.busy = ImGui::IsAnyItemActive() || app.waits();
    out.passing = app.works_long() ||
                  std::any_of(view.notices.begin(), view.notices.end(),
                              [](const Notice& n) { return n.kind != NoticeKind::kError; });
    out.changes = app.changes();
    return out;
}

void loop(GLFWwindow* window, EditorApp& app, WindowState& state, SecondWindow& second) {
    FramePace pace;
    while (!app.wants_to_leave()) {
        const double wait_s = pace.wait_s(moment_of(app, state.input));
        if (wait_s > 0)
            glfwWaitEventsTimeout(wait_s);
        else
            glfwPollEvents();
        WindowMoment moment = moment_of(app, state.input);
        const bool second_event = second.take_event();
        moment.event = std::exchange(state.event, false) || second_event;
        if (!pace.draws(moment)) continue;
        draw(window, app, state.input);
        second.draw(app);
    }
}

// As large as was asked for in units of the interface, and no larger than the screen has room for.
void fit_to_screen(GLFWwindow* window) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor) return;
    int x = 0, y = 0, most_w = 0, most_h = 0, w = 0, h = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &most_w, &most_h);
    glfwGetWindowSize(window, &w, &h);
    if (most_w <= 0 || most_h <= 0 || (w <= most_w && h <= most_h)) return;
    glfwSetWindowSize(window, std::min(w, most_w), std::min(h, most_h));
}

GLFWwindow* make_window(const EditorOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    const bool own_scale = options.ui_scale > 0;
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, own_scale ? GLFW_FALSE : GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "weft");
    const double scale = own_scale ? options.ui_scale : 1;
    GLFWwindow* window =
        glfwCreateWindow(static_cast<int>(options.width * scale),
                         static_cast<int>(options.height * scale), "Weft", nullptr, nullptr);
    if (window) fit_to_screen(window);
    return window;
}

}  // namespace

Expected<int> run_window(const EditorOptions& options) {
    if (!has_display() || !glfwInit()) {
        return fail(ErrorCode::kRenderFailed, "No display is available for the editor.",
                    "Set DISPLAY, or use the commands that need none: weft --help.");
    }
    GLFWwindow* window = make_window(options);
    if (!window) {
        glfwTerminate();
        return fail(ErrorCode::kRenderFailed,
                    "The display gives no OpenGL 3.3, which the editor needs.",
                    "Update the graphics driver, or use the commands that need none: weft --help.");
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
        listen(window);
        app.pictures().on_fullscreen = [window] { toggle_fullscreen(window); };
        SecondWindow second(window);
        // Keys pressed in the second window act on the main window.
        second.on_key = [window](int key, int code, int action) {
            on_key(window, key, code, action, 0);
        };
        app.pictures().on_second_window = [&second] { second.toggle(); };
        ImGui_ImplGlfw_InitForOpenGL(window, false);  // input comes through the queue
        ImGui_ImplOpenGL3_Init("#version 330 core");
        float scale = 1, other = 1;
        glfwGetWindowContentScale(window, &scale, &other);
        app.update_look(static_cast<double>(scale));
        started = app.start();
        if (started) loop(window, app, state, second);
        glfwHideWindow(window);  // workers may take some seconds to end
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
