#pragma once
// Pictures in OpenGL: a texture cache by picture id, and the display shaders.

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>

#include "app/editor/gl_screen.h"
#include "app/editor/gl_textures.h"
#include "ui/base/picture_host.h"

namespace weft {

/// Needs a current OpenGL 3.3 context during its lifetime. Belongs to one thread.
class GlPictures final : public PictureHost {
  public:
    GlPictures();
    ~GlPictures() override;
    /// Errors: a shader that does not compile, with the driver's message.
    [[nodiscard]] Status make_shaders();

    [[nodiscard]] ImTextureID texture(const PicturePtr& picture) override;
    void draw(ImDrawList& list, const PictureDraw& draw) override;
    void draw(ImDrawList& list, const MatteDraw& draw) override;
    void set_clipboard(const std::string& text) override { ImGui::SetClipboardText(text.c_str()); }
    void reveal(const std::string& path) override;
    void toggle_fullscreen() override {
        if (on_fullscreen) on_fullscreen();
    }
    void toggle_second_window() override {
        if (on_second_window) on_second_window();
    }
    /// Draws one picture, fitted to `size`, into the current context, which shares this one's
    /// textures. `aspect`: pixel aspect ratio; `fresh`: the first call in that context.
    void show_alone(const PicturePtr& picture, const DisplaySettings& display, float aspect,
                    int width, int height, bool fresh);
    /// Clears the last frame's draw calls and frees textures that have not been used for a while.
    void begin_frame();
    /// Returns true while a picture of the last frame is being uploaded.
    [[nodiscard]] bool pending() const { return textures_.pending(); }
    std::function<void()> on_fullscreen, on_second_window;
    std::function<void(std::string)> on_problem;  ///< Called with a message for the user.

  private:
    struct Order;
    struct Matte {
        unsigned id = 0;
        std::uint64_t version = 0;
        Size size;
    };
    // A slot on the screen: the last complete picture and the next one.
    struct Place {
        PicturePtr shown, next;
    };
    [[nodiscard]] unsigned texture_at(int place, const PicturePtr& wanted);
    [[nodiscard]] unsigned matte_texture(std::uint64_t key, const MatteDraw& draw, ViewU8x1 pixels);
    static void run(const ImDrawList* list, const ImDrawCmd* command);
    void execute(const Order& order) const;
    [[nodiscard]] unsigned program_for(const DisplaySettings& display) const;
    void set_display(unsigned program, const DisplaySettings& display) const;
    void bind_picture(unsigned program, unsigned unit, unsigned texture, const char* name,
                      bool smooth) const;
    void set_footprint(unsigned program, Size picture, float width, float height) const;

    GlTextures textures_;
    GlScreen screen_;
    std::map<int, Place> places_;
    std::map<std::uint64_t, Matte> mattes_;
    // a list, because draw lists hold pointers to its entries until the frame ends
    std::list<Order> orders_;
    unsigned picture_program_ = 0, matte_program_ = 0, quad_ = 0, quad_buffer_ = 0;
    unsigned alone_ = 0;  // vertex array of the second context
};

}  // namespace weft
