// Without a window: EGL without a surface draws into a framebuffer, driven by a script.
#define GL_GLEXT_PROTOTYPES
#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <backends/imgui_impl_opengl3.h>

#include "app/base/background.h"
#include "app/editor/editor_app.h"
#include "app/editor/run_modes.h"
#include "app/editor/script.h"
#include "engine/core/stopwatch.h"
#include "engine/media/frame_writer.h"

namespace weft {
namespace {

class EglContext {
  public:
    EglContext() = default;
    ~EglContext() {
        if (display_ == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    [[nodiscard]] Status open() {
        display_ =
            eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY) display_ = eglGetDisplay(EGL_DEFAULT_DISPLAY);
        EGLint major = 0, minor = 0;
        if (!eglInitialize(display_, &major, &minor) || !eglBindAPI(EGL_OPENGL_API)) return no_gl();
        const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display_, wanted, &config, 1, &count) || count < 1) return no_gl();
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
        if (context_ == EGL_NO_CONTEXT ||
            !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            return no_gl();
        return {};
    }

  private:
    static tl::unexpected<Error> no_gl() {
        return fail(ErrorCode::kRenderFailed, "OpenGL 3.3 is not available without a display.",
                    "Install the software renderer (libgl1-mesa-dri), or run under a display.");
    }
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

class Canvas {
  public:
    Canvas(int width, int height) : width_(width), height_(height) {
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D, texture_);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     nullptr);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    }
    ~Canvas() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteTextures(1, &texture_);
    }
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    void begin() const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, width_, height_);
        glClearColor(0.07f, 0.07f, 0.07f, 1);
        glDisable(GL_SCISSOR_TEST);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    [[nodiscard]] Status write(const std::string& path, const WriteRule& rule) const {
        std::vector<unsigned char> bytes(static_cast<std::size_t>(width_) *
                                         static_cast<std::size_t>(height_) * 3);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
        ImageF3 picture(width_, height_);
        const std::size_t row = static_cast<std::size_t>(width_) * 3;
        for (int y = 0; y < height_; ++y) {
            const unsigned char* from =
                bytes.data() + row * static_cast<std::size_t>(height_ - 1 - y);
            for (std::size_t k = 0; k < row; ++k)
                picture.row(y)[k] = static_cast<float>(from[k]) / 255.0f;
        }
        WriteOptions options;
        options.jpeg_quality = 88;
        options.rule = rule;
        return write_image(path, picture, {}, options);
    }

  private:
    int width_, height_;
    GLuint texture_ = 0, framebuffer_ = 0;
};

}  // namespace

Expected<int> run_offscreen(const EditorOptions& options) {
    EglContext context;
    WEFT_CHECK_OK(context.open());
    keep_thread_priority();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {static_cast<float>(options.width), static_cast<float>(options.height)};
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    // GLFW's key codes for ImGui's named keys.
    const std::pair<ImGuiKey, int> keys[] = {
        {ImGuiKey_Tab, 258},     {ImGuiKey_LeftArrow, 263}, {ImGuiKey_RightArrow, 262},
        {ImGuiKey_UpArrow, 265}, {ImGuiKey_DownArrow, 264}, {ImGuiKey_Home, 268},
        {ImGuiKey_End, 269},     {ImGuiKey_Delete, 261},    {ImGuiKey_Backspace, 259},
        {ImGuiKey_Enter, 257},   {ImGuiKey_Escape, 256},    {ImGuiKey_A, 65},
        {ImGuiKey_C, 67},        {ImGuiKey_V, 86},          {ImGuiKey_X, 88},
        {ImGuiKey_Y, 89},        {ImGuiKey_Z, 90},          {ImGuiKey_Space, 32}};
    for (const auto& [name, key] : keys)
        io.KeyMap[name] = key;
    Expected<int> result = 0;
    {
        EditorApp app(options);
        const Canvas canvas(options.width, options.height);
        ImGui_ImplOpenGL3_Init("#version 330 core");
        app.update_look(1);
        const auto begin = Clock::now();
        const auto frame = [&] {
            app.clock().begin();
            if (app.update_look(1)) ImGui_ImplOpenGL3_DestroyFontsTexture();
            io.DeltaTime = 1.0f / 60.0f;
            ImGui_ImplOpenGL3_NewFrame();
            app.frame(seconds_since(begin));
            app.clock().end();
            app.watch();
        };
        // Draws only frames that are written. Without vertical sync, a software renderer would
        // queue frames that nobody sees.
        const auto write = [&](const std::string& path) {
            canvas.begin();
            ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
            glFinish();
            return canvas.write(path, app.session().export_rule());
        };
        Status done = app.start();
        if (done) done = run_script(options.script, app, frame, write);
        if (done && !options.screenshot.empty()) done = write(options.screenshot);
        app.close();
        if (!done) result = tl::unexpected<Error>(done.error());
        ImGui_ImplOpenGL3_Shutdown();
    }
    ImGui::DestroyContext();
    return result;
}

}  // namespace weft
