#define GL_GLEXT_PROTOTYPES
#include "app/editor/gl_screen.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <string_view>

#include "app/editor/gl_program.h"
#include "app/editor/shader_sources.h"

namespace weft {
namespace {

constexpr unsigned kFirstUnit = 2;  // units 0 and 1 hold the pictures

GLuint upload(const ScreenShader::Table& table, GLenum target) {
    GLuint id = 0;
    glGenTextures(1, &id);
    glBindTexture(target, id);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    const GLint inside = table.channels == 1 ? GL_R32F : GL_RGB32F;
    const GLenum outside = table.channels == 1 ? GL_RED : GL_RGB;
    const float* values = table.values.data();
    if (target == GL_TEXTURE_1D)
        glTexImage1D(target, 0, inside, table.width, 0, outside, GL_FLOAT, values);
    else if (target == GL_TEXTURE_2D)
        glTexImage2D(target, 0, inside, table.width, table.height, 0, outside, GL_FLOAT, values);
    else
        glTexImage3D(target, 0, inside, table.width, table.height, table.depth, 0, outside,
                     GL_FLOAT, values);
    const GLint filter = table.nearest ? GL_NEAREST : GL_LINEAR;
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(target, axis, GL_CLAMP_TO_EDGE);
    return id;
}

// Inserts the view's code after the first line: a #version line must stay first.
std::string with_screen(std::string_view picture, const std::string& screen) {
    const std::size_t first_line = picture.find('\n') + 1;
    std::string out(picture.substr(0, first_line));
    out += "#define WEFT_SCREEN\n" + screen;
    out += picture.substr(first_line);
    return out;
}

}  // namespace

GlScreen::~GlScreen() {
    clear();
}

void GlScreen::clear() {
    for (const Table& table : tables_)
        glDeleteTextures(1, &table.id);
    tables_.clear();
    if (program_) glDeleteProgram(program_);
    program_ = 0;
}

std::string GlScreen::prepare(const std::shared_ptr<const ScreenView>& view) {
    if (view == view_) return {};
    view_ = view;
    clear();
    if (!view) return {};
    std::string log;
    program_ = link_program(shaders::kViewerVert,
                            with_screen(shaders::kPictureFrag, view->shader.source).c_str(), log);
    if (!program_) return log.empty() ? "no reason given" : log;
    for (const ScreenShader::Table& table : view->shader.tables) {
        const GLenum target = table.dimensions == 1   ? GL_TEXTURE_1D
                              : table.dimensions == 2 ? GL_TEXTURE_2D
                                                      : GL_TEXTURE_3D;
        tables_.push_back({upload(table, target), target});
    }
    return {};
}

void GlScreen::bind() const {
    for (std::size_t k = 0; k < tables_.size(); ++k) {
        const unsigned unit = kFirstUnit + static_cast<unsigned>(k);
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(tables_[k].target, tables_[k].id);
        glUniform1i(glGetUniformLocation(program_, view_->shader.tables[k].sampler.c_str()),
                    static_cast<GLint>(unit));
    }
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace weft
