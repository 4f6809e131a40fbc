#define GL_GLEXT_PROTOTYPES
#include "app/editor/gl_program.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace weft {
namespace {

GLuint compile(GLenum kind, const char* source, std::string& log) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char text[1024] = "";
    glGetShaderInfoLog(shader, sizeof text, nullptr, text);
    log += text;
    glDeleteShader(shader);
    return 0;
}

}  // namespace

unsigned link_program(const char* vertex, const char* fragment, std::string& log) {
    const GLuint v = compile(GL_VERTEX_SHADER, vertex, log);
    const GLuint f = v ? compile(GL_FRAGMENT_SHADER, fragment, log) : 0;
    if (!v || !f) {
        glDeleteShader(v);
        return 0;
    }
    const GLuint program = glCreateProgram();
    glAttachShader(program, v);
    glAttachShader(program, f);
    glLinkProgram(program);
    glDeleteShader(v);
    glDeleteShader(f);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good) return program;
    char text[1024] = "";
    glGetProgramInfoLog(program, sizeof text, nullptr, text);
    log += text;
    glDeleteProgram(program);
    return 0;
}

}  // namespace weft
