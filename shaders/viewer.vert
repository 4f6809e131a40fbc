#version 330 core
// A rectangle on the screen, in screen pixels.
layout(location = 0) in vec2 corner;  // 0 or 1
uniform vec4 place;   // x0 y0 x1 y1 of the whole picture, screen pixels
uniform vec2 screen;  // size in pixels
out vec2 uv;
void main() {
    uv = corner;
    vec2 p = mix(place.xy, place.zw, corner);
    gl_Position = vec4(p.x / screen.x * 2.0 - 1.0, 1.0 - p.y / screen.y * 2.0, 0.0, 1.0);
}
