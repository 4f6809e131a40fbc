#pragma once
// Pictures in OpenGL: textures by the pictures' ids, and the shaders that show them.

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>

#include "ui/picture_host.h"

namespace weft {

/// Needs a current OpenGL 3.3 context for its whole life. One thread.
class GlPictures final : public PictureHost {
  public:
    GlPictures();
    ~GlPictures() override;
    /// Errors: a shader that does not compile, with the driver's words.
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
    /// Draws a picture alone, as large as fits, into the current context, which shares this one's
    /// textures; `fresh`: for the first time there.
    void show_alone(const PicturePtr& picture, const DisplaySettings& display, int width,
                    int height, bool fresh);
    /// Forgets the orders of the last frame and textures that were not used for a while.
    void begin_frame();
    std::function<void()> on_fullscreen, on_second_window;

  private:
    struct Order;
    struct Texture {
        unsigned id = 0;
        std::size_t bytes = 0;
        std::uint64_t used = 0;
        std::uint64_t version = 0;  // of a matte
        bool has_smaller = false;
        Size size;
    };
    [[nodiscard]] unsigned texture_of(const PicturePtr& picture, bool smooth, bool shrunk);
    [[nodiscard]] unsigned matte_texture(std::uint64_t key, const MatteDraw& draw, ViewU8x1 pixels);
    void trim();
    static void run(const ImDrawList* list, const ImDrawCmd* command);
    void execute(const Order& order) const;
    void set_display(const DisplaySettings& display) const;

    std::map<std::uint64_t, Texture> pictures_, mattes_;
    std::list<Order> orders_;  // stable addresses: draw lists point to them until the frame is over
    std::size_t bytes_ = 0;
    std::uint64_t frame_ = 0;
    unsigned picture_program_ = 0, matte_program_ = 0, quad_ = 0, quad_buffer_ = 0;
    unsigned alone_ = 0;  // the vertex array of the second context
};

}  // namespace weft
