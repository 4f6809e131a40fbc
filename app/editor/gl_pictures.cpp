#define GL_GLEXT_PROTOTYPES
#include "app/editor/gl_pictures.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cmath>

#include "app/editor/gl_program.h"
#include "app/editor/shader_sources.h"
#include "engine/core/child_process.h"

namespace weft {
namespace {

constexpr int kSecondWindow = 1000;  // its slot; the viewer's panes have small numbers

GLint at(GLuint program, const char* name) {
    return glGetUniformLocation(program, name);
}

}  // namespace

struct GlPictures::Order {
    const GlPictures* host = nullptr;
    bool is_matte = false;
    PictureDraw picture;
    MatteDraw matte;
    GLuint a = 0, b = 0;
};

GlPictures::GlPictures() = default;

GlPictures::~GlPictures() {
    for (const auto& [key, matte] : mattes_)
        glDeleteTextures(1, &matte.id);
    if (picture_program_) glDeleteProgram(picture_program_);
    if (matte_program_) glDeleteProgram(matte_program_);
    if (quad_buffer_) glDeleteBuffers(1, &quad_buffer_);
    if (quad_) glDeleteVertexArrays(1, &quad_);
}

Status GlPictures::make_shaders() {
    std::string log;
    picture_program_ = link_program(shaders::kViewerVert, shaders::kPictureFrag, log);
    matte_program_ = link_program(shaders::kViewerVert, shaders::kMatteFrag, log);
    if (!picture_program_ || !matte_program_) {
        return fail(ErrorCode::kRenderFailed,
                    "The display needs OpenGL 3.3, which this driver does not give. " + log);
    }
    constexpr float kCorners[] = {0, 0, 1, 0, 0, 1, 1, 1};
    glGenVertexArrays(1, &quad_);
    glGenBuffers(1, &quad_buffer_);
    glBindVertexArray(quad_);
    glBindBuffer(GL_ARRAY_BUFFER, quad_buffer_);
    glBufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    glBindVertexArray(0);
    return {};
}

void GlPictures::begin_frame() {
    orders_.clear();
    textures_.begin_frame();
}

// Finishes an upload before starting the next one; otherwise no frame of a large plate would ever
// be complete during playback.
unsigned GlPictures::texture_at(int place, const PicturePtr& wanted) {
    Place& p = places_[place];
    if (!wanted) {
        p = {};
        return 0;
    }
    if (!p.next || p.next == p.shown) p.next = wanted;
    if (textures_.in_pieces(p.next)) p.shown = p.next;
    return textures_.in_pieces(p.shown);
}

ImTextureID GlPictures::texture(const PicturePtr& picture) {
    if (!picture || picture->srgb.empty()) return nullptr;
    const unsigned id = textures_.whole(picture, GlTextures::Values::kCodes);
    return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(id));
}

unsigned GlPictures::matte_texture(std::uint64_t key, const MatteDraw& draw, ViewU8x1 pixels) {
    Matte& texture = mattes_[key];
    const bool fresh = texture.id == 0 || !(texture.size == pixels.size());
    if (!fresh && texture.version == draw.version) return texture.id;
    if (texture.id == 0) glGenTextures(1, &texture.id);
    glBindTexture(GL_TEXTURE_2D, texture.id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(pixels.stride()));
    const Recti part = draw.changed.intersected(rect_of(pixels.size()));
    if (fresh || part.empty()) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, pixels.width(), pixels.height(), 0, GL_RED,
                     GL_UNSIGNED_BYTE, pixels.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, part.x0, part.y0, part.width(), part.height(), GL_RED,
                        GL_UNSIGNED_BYTE, pixels.pixel(part.x0, part.y0));
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    texture.version = draw.version;
    texture.size = pixels.size();
    return texture.id;
}

void GlPictures::draw(ImDrawList& list, const PictureDraw& draw) {
    if (const std::string words = screen_.prepare(draw.display.screen);
        !words.empty() && on_problem)
        on_problem("This graphics driver does not take the view " + draw.display.screen->name.view +
                   "; sRGB is shown instead. " + words);
    Order& order = orders_.emplace_back();
    order.host = this;
    order.picture = draw;
    order.a = texture_at(2 * draw.pane, draw.a);
    order.b = texture_at(2 * draw.pane + 1, draw.b);
    if (!order.a) return;
    list.AddCallback(run, &order);
    list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

void GlPictures::draw(ImDrawList& list, const MatteDraw& draw) {
    if (draw.pixels.empty()) return;
    Order& order = orders_.emplace_back();
    order.host = this;
    order.is_matte = true;
    order.matte = draw;
    order.a = matte_texture(draw.key, draw, draw.pixels);
    if (!draw.where.empty()) order.b = matte_texture(draw.key + 1, draw, draw.where);
    list.AddCallback(run, &order);
    list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

void GlPictures::run(const ImDrawList*, const ImDrawCmd* command) {
    const Order& order = *static_cast<const Order*>(command->UserCallbackData);
    order.host->execute(order);
}

void GlPictures::execute(const Order& order) const {
    const ImGuiIO& io = ImGui::GetIO();
    const float sx = io.DisplayFramebufferScale.x, sy = io.DisplayFramebufferScale.y;
    const auto clip = [&](ImVec2 min, ImVec2 max) {
        const float height = io.DisplaySize.y * sy;
        glScissor(static_cast<GLint>(min.x * sx), static_cast<GLint>(height - max.y * sy),
                  std::max(0, static_cast<GLint>((max.x - min.x) * sx)),
                  std::max(0, static_cast<GLint>((max.y - min.y) * sy)));
    };
    const auto place = [&](GLuint program, ImVec2 min, ImVec2 max) {
        glUseProgram(program);
        glUniform4f(at(program, "place"), min.x, min.y, max.x, max.y);
        glUniform2f(at(program, "screen"), io.DisplaySize.x, io.DisplaySize.y);
    };
    const auto bind = [&](GLenum unit, GLuint texture, GLuint program, const char* name) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, texture);
        glUniform1i(at(program, name), static_cast<GLint>(unit));
    };
    glBindVertexArray(quad_);
    if (order.is_matte) {
        const MatteDraw& m = order.matte;
        clip(m.clip_min, m.clip_max);
        place(matte_program_, m.min, m.max);
        bind(1, order.b ? order.b : order.a, matte_program_, "where_matte");
        bind(0, order.a, matte_program_, "matte");
        const ImVec4 tint = ImGui::ColorConvertU32ToFloat4(m.color);
        glUniform4f(at(matte_program_, "tint"), tint.x, tint.y, tint.z, tint.w);
        glUniform1f(at(matte_program_, "opacity"), m.opacity);
        glUniform1i(at(matte_program_, "outline"), m.outline);
        glUniform1i(at(matte_program_, "heat"), m.heat);
        glUniform1i(at(matte_program_, "limited"), order.b != 0);
        glEnable(GL_BLEND);
    } else {
        const PictureDraw& p = order.picture;
        clip(p.clip_min, p.clip_max);
        const GLuint program = program_for(p.display);
        place(program, p.min, p.max);
        bind_picture(program, 1, order.b ? order.b : order.a, "picture_b", p.smooth);
        bind_picture(program, 0, order.a, "picture_a", p.smooth);
        set_footprint(program, p.a->size, (p.max.x - p.min.x) * sx, (p.max.y - p.min.y) * sy);
        glUniform1i(at(program, "mode"), static_cast<GLint>(p.mode));
        glUniform1f(at(program, "wipe"), p.wipe);
        set_display(program, p.display);
        glDisable(GL_BLEND);
    }
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glActiveTexture(GL_TEXTURE0);
}

void GlPictures::bind_picture(unsigned program, unsigned unit, unsigned texture, const char* name,
                              bool smooth) const {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
    glUniform1i(at(program, name), static_cast<GLint>(unit));
}

// For a picture shown reduced, the shader averages the texels under each screen pixel. Taps are at
// most two texels apart, because bilinear filtering covers two texels.
void GlPictures::set_footprint(unsigned program, Size picture, float width, float height) const {
    const float across = static_cast<float>(picture.width) / std::max(1.0f, width);
    const float down = static_cast<float>(picture.height) / std::max(1.0f, height);
    const auto taps = [](float texels) {
        return texels <= 1.05f ? 1 : std::clamp(static_cast<int>(std::ceil(texels / 2)), 2, 8);
    };
    glUniform2i(at(program, "taps"), taps(across), taps(down));
    glUniform2f(at(program, "footprint"), 1 / std::max(1.0f, width), 1 / std::max(1.0f, height));
}

unsigned GlPictures::program_for(const DisplaySettings& display) const {
    return display.screen && screen_.program() ? screen_.program() : picture_program_;
}

void GlPictures::set_display(unsigned program, const DisplaySettings& display) const {
    glUniform1f(at(program, "gain"), std::exp2(display.exposure));
    glUniform1f(at(program, "inverse_gamma"), 1.0f / std::max(0.01f, display.gamma));
    glUniform1i(at(program, "channel"), static_cast<GLint>(display.channel));
    glUniform1i(at(program, "curve"), static_cast<GLint>(display.curve));
    if (program != picture_program_) screen_.bind();
}

void GlPictures::show_alone(const PicturePtr& picture, const DisplaySettings& display, float aspect,
                            int width, int height, bool fresh) {
    glViewport(0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    const unsigned id = texture_at(kSecondWindow, picture);
    if (!id) return;
    if (fresh) {
        // Vertex arrays are not shared between OpenGL contexts.
        glGenVertexArrays(1, &alone_);
        glBindVertexArray(alone_);
        glBindBuffer(GL_ARRAY_BUFFER, quad_buffer_);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    }
    glBindVertexArray(alone_);
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    const auto pw = static_cast<float>(picture->size.width) * aspect;
    const auto ph = static_cast<float>(picture->size.height);
    const float zoom = std::min(w / pw, h / ph);
    const ImVec2 shown(zoom * pw, zoom * ph);
    const float x = (w - shown.x) / 2, y = (h - shown.y) / 2;
    const GLuint program = program_for(display);
    glUseProgram(program);
    glUniform4f(at(program, "place"), x, y, x + shown.x, y + shown.y);
    glUniform2f(at(program, "screen"), w, h);
    bind_picture(program, 1, id, "picture_b", true);
    bind_picture(program, 0, id, "picture_a", true);
    set_footprint(program, picture->size, shown.x, shown.y);
    glUniform1i(at(program, "mode"), 0);
    set_display(program, display);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glBindVertexArray(0);
}

void GlPictures::reveal(const std::string& path) {
    ProcessOptions quiet;
    quiet.errors = "/dev/null";
    static_cast<void>(start_process({"xdg-open", path}, quiet));
}

}  // namespace weft
