#version 330 core
// The view transform: linear light, exposure, the screen's curve, gamma. For the screen only.
// WEFT_SCREEN: OpenColorIO's function stands before this text and takes the curve's place.
in vec2 uv;
out vec4 color;
uniform sampler2D picture_a;
uniform sampler2D picture_b;
uniform int mode;      // 0 one picture, 1 wipe, 2 difference
uniform float wipe;
uniform float gain;    // 2^exposure
uniform float inverse_gamma;
uniform int channel;   // 0 colour, 1-3 one channel, 4 luma
uniform int curve;     // 0 sRGB, 1 BT.1886 (gamma 2.4), 2 as it is
uniform ivec2 taps;       // under one pixel of the screen, when the picture is shown smaller
uniform vec2 footprint;   // of one pixel of the screen, in the picture's own 0..1

vec3 encode(vec3 v) {
#ifdef WEFT_SCREEN
    return max(weft_screen(vec4(v, 1.0)).rgb, vec3(0.0));
#else
    v = max(v, vec3(0.0));
    if (curve == 1) return pow(v, vec3(1.0 / 2.4));
    if (curve == 2) return v;
    return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), v));
#endif
}

vec3 light(sampler2D picture) {
    if (taps == ivec2(1)) return texture(picture, uv).rgb;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps.y; ++y)
        for (int x = 0; x < taps.x; ++x)
            sum += texture(picture, uv + ((vec2(x, y) + 0.5) / vec2(taps) - 0.5) * footprint).rgb;
    return sum / float(taps.x * taps.y);
}

vec3 shown(sampler2D picture) {
    vec3 v = light(picture) * gain;
    if (channel == 4) v = vec3(dot(v, vec3(0.2126, 0.7152, 0.0722)));
    else if (channel > 0) v = vec3(v[channel - 1]);
    return pow(encode(v), vec3(inverse_gamma));
}

void main() {
    if (mode == 1) {
        color = vec4(uv.x < wipe ? shown(picture_a) : shown(picture_b), 1.0);
    } else if (mode == 2) {
        color = vec4(abs(shown(picture_a) - shown(picture_b)) * 4.0, 1.0);
    } else {
        color = vec4(shown(picture_a), 1.0);
    }
}
