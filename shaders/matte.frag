#version 330 core
// A matte in a region's colour with a line along its edge, or values as heat.
in vec2 uv;
out vec4 color;
uniform sampler2D matte;
uniform sampler2D where_matte;
uniform vec4 tint;
uniform float opacity;
uniform int outline;
uniform int heat;      // 0 colour, 1 heat
uniform int limited;   // 1: only inside where_matte

// Control points along inferno (Smith and van der Walt 2015).
const vec3 kHeat[9] = vec3[9](
    vec3(0.000, 0.000, 0.016), vec3(0.122, 0.047, 0.282), vec3(0.333, 0.059, 0.427),
    vec3(0.533, 0.133, 0.416), vec3(0.729, 0.212, 0.333), vec3(0.890, 0.349, 0.200),
    vec3(0.976, 0.549, 0.039), vec3(0.976, 0.788, 0.196), vec3(0.988, 1.000, 0.643));

vec3 heat_color(float v) {
    float at = clamp(v, 0.0, 1.0) * 8.0;
    int k = min(int(at), 7);
    return mix(kHeat[k], kHeat[k + 1], at - float(k));
}

void main() {
    float v = texture(matte, uv).r;
    float inside = limited == 1 ? texture(where_matte, uv).r : 1.0;
    if (heat == 1) {
        // The stronger, the more opaque, so that the picture stays visible.
        color = vec4(heat_color(v), inside * clamp(v * 1.6, 0.0, 1.0) * opacity);
        return;
    }
    float alpha = v * inside * opacity;
    if (outline == 1) {
        // A line of about 1.5 screen pixels where the matte crosses a half.
        float slope = max(fwidth(v), 1.0 / 255.0), reach = 1.2;
        vec2 pixel = fwidth(uv), texels = pixel * vec2(textureSize(matte, 0));
        if (max(texels.x, texels.y) > 1.0) {
            // Derivatives are those of 2 x 2 pixels, and miss every other edge of a matte that is
            // shown smaller than it is.
            vec4 around = vec4(texture(matte, uv + vec2(pixel.x, 0.0)).r,
                               texture(matte, uv - vec2(pixel.x, 0.0)).r,
                               texture(matte, uv + vec2(0.0, pixel.y)).r,
                               texture(matte, uv - vec2(0.0, pixel.y)).r);
            float low = min(min(around.x, around.y), min(around.z, around.w));
            float high = max(max(around.x, around.y), max(around.z, around.w));
            slope = max(high - low, 1.0 / 255.0);
            reach = 0.8;
        }
        float line = 1.0 - clamp(abs(v - 0.5) / (slope * reach), 0.0, 1.0);
        alpha = max(alpha, line * 0.95);
    }
    color = vec4(tint.rgb, alpha * tint.a);
}
