// Marble, ceramic, lava and water.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {

void marble(Dice& dice, Relief& relief, Label& label) {
    // 0 veined, 1 fine net, 2 breccia, 3 onyx bands, 4 travertine
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"veined marble", "netted marble", "breccia marble", "banded onyx",
                                "travertine"};
    constexpr std::uint32_t kStone[]{0xece8e1, 0x2a2c2d, 0x3f5248, 0xd9c3a5,
                                     0xa06a58, 0xc9cdd0, 0x6b4a42, 0xd8d0c4};
    const Rgb base =
        kind == 4 ? shifted(rgb(0xcdb592), 0, dice.uniform(0.5f, 1.1f), dice.uniform(0.85f, 1.15f))
                  : dice.color(kStone);
    const bool dark = base.r + base.g + base.b < 1.2f;
    const Rgb vein =
        dark ? mix(rgb(0xe6dfd0), base, 0.15f)
             : shifted(base, dice.uniform(-0.04f, 0.04f), 1.4f, dice.uniform(0.4f, 0.65f));
    const Rgb second = shifted(base, dice.uniform(-0.03f, 0.03f), 1.3f, dark ? 1.7f : 0.84f);
    const std::uint32_t seed = dice.seed();
    const float turn = dice.uniform(0, 3.14f), scale = dice.uniform(0.75f, 1.4f),
                strength = dice.uniform(0.6f, 1);
    relief.each([&](float px, float py, Texel& t) {
        const float a = (px * std::cos(turn) + py * std::sin(turn)) * scale,
                    b = (-px * std::sin(turn) + py * std::cos(turn)) * scale;
        const float wx = a + 16 * fbm(a / 44, b / 44, 4, seed),
                    wy = b + 16 * fbm(a / 44, b / 44, 4, seed + 1);
        const float cloud = clamp01(0.5f + 0.9f * fbm(wx / 30, wy / 30, 4, seed + 2));
        Rgb color = mix(base, second, 0.75f * cloud);
        const auto line = [&](float size, float width, std::uint32_t s) {
            const float n = std::abs(fbm(wx / size, wy / (size * 2.4f), 3, s));
            return 1 - smooth(0, width, n);
        };
        if (kind == 0) {
            color = mix(color, vein,
                        strength * 0.85f * line(42, 0.06f, seed + 3) * (0.4f + 0.6f * cloud));
            color = mix(color, vein,
                        strength * 0.5f * line(19, 0.05f, seed + 4) * smooth(0.3f, 0.8f, cloud));
        } else if (kind == 1) {
            const Cells c = cells(wx / 17, wy / 17, 1, seed + 5),
                        d = cells(wx / 8, wy / 8, 1, seed + 6);
            color = mix(color, vein, strength * (1 - smooth(0.01f, 0.07f, c.edge)));
            color = mix(
                color, vein,
                0.45f * strength * (1 - smooth(0.01f, 0.06f, d.edge)) * smooth(0.4f, 0.8f, cloud));
        } else if (kind == 2) {
            const Cells c = cells(wx / 18, wy / 18, 1, seed + 7);
            const float own = static_cast<float>(c.id & 255u) / 255.0f;
            color = mix(shifted(color, 0.03f * (own - 0.5f), 1, 0.72f + 0.56f * own), vein,
                        0.9f * (1 - smooth(0.02f, 0.10f, c.edge)));
            color = mix(color, vein, 0.5f * line(24, 0.05f, seed + 8));
        } else if (kind == 3) {
            const float band = wy / 6 + 1.2f * fbm(wx / 50, wy / 20, 3, seed + 9);
            const float f = noise(band, 3, seed + 10);
            color = mix(mix(base, second, clamp01(0.5f + f)), vein,
                        0.5f * smooth(0.2f, 0.7f, noise(band * 2.3f, 9, seed + 11)));
        } else {
            const float band = noise(b / 5 + fbm(a / 40, b / 18, 3, seed + 12), a / 90, seed + 13);
            const float hole = smooth(0.42f, 0.55f, fbm(a / 11, b / 2.8f, 3, seed + 14));
            color = mix(base * (1 + 0.12f * band), base * 0.5f, 0.85f * hole);
            t.height = -1.5f * hole;
        }
        t.color = color * (1 + 0.03f * noise(px / 0.8f, py / 0.8f, seed + 15));
        t.height += 0.05f * noise(px / 20, py / 20, seed + 16);
        t.shine = 0.3f;
    });
    label.name = kNames[kind];
    label.tags = {"stone", "polished", "veined"};
    label.light.relief = 0.6f;
    label.light.gloss = 60;
    label.light.highlight = 0.15f;
}

void ceramic(Dice& dice, Relief& relief, Label& label) {
    // 0 crackle glaze, 1 speckled stoneware, 2 thrown rings, 3 dripping glaze, 4 painted motif
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"crackle glaze ceramic", "speckled stoneware", "thrown pottery",
                                "dripped glaze ceramic", "painted porcelain"};
    constexpr std::uint32_t kGlaze[]{0xd9e0d6, 0x9fc0b0, 0x6f98a8, 0xc9b27a, 0xe6e0d0,
                                     0x8a4a34, 0x3f6b7a, 0xb8c4a0, 0x5d7a4a, 0xcfd8e0};
    const Rgb base = kind == 4 ? rgb(0xeeece6) : dice.color(kGlaze);
    const Rgb other = dice.color(kGlaze),
              ink = shifted(rgb(0x24477f), dice.uniform(-0.06f, 0.06f), dice.uniform(0.7f, 1.2f),
                            dice.uniform(0.7f, 1.3f));
    const std::uint32_t seed = dice.seed();
    const float net = dice.uniform(9, 18), shine = dice.uniform(0.6f, 1), ring = dice.uniform(4, 8),
                period = dice.uniform(30, 46);
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 40, y / 40, 3, seed);
        float height = 0.35f * broad;
        Rgb color = base * (1 + 0.05f * broad);
        if (kind == 0) {
            const float wx = x + 1.6f * fbm(x / 9, y / 9, 2, seed + 1),
                        wy = y + 1.6f * fbm(x / 9, y / 9, 2, seed + 2);
            const Cells c = cells(wx / net, wy / net, 1, seed + 3),
                        d = cells(wx / net * 2.3f, wy / net * 2.3f, 1, seed + 4);
            const float major = 1 - smooth(0.15f, 0.7f, c.edge * net),
                        minor = 1 - smooth(0.1f, 0.45f, d.edge * net / 2.3f);
            color = mix(color, base * 0.33f, 0.85f * major + 0.3f * minor * (1 - major));
            height -= 0.25f * major;
        } else if (kind == 1) {
            for (const float s : {2.6f, 4.6f}) {
                const Cells c = cells(x / s, y / s, 1, seed + 5);
                if (static_cast<float>(c.id >> 8 & 255u) / 255.0f > 0.35f) continue;
                const float r = 0.1f + 0.16f * static_cast<float>(c.id & 255u) / 255.0f;
                color = mix(color, rgb(0x3f2f24), 0.8f * (1 - smooth(r * 0.6f, r, c.first)));
            }
        } else if (kind == 2) {
            const float r = y / ring + 0.4f * fbm(x / 60, y / 12, 2, seed + 6);
            const float wave = std::sin(r * 6.2831853f);
            height += 0.75f * wave;
            color = mix(color, base * 0.66f, 0.35f * (0.5f - 0.5f * wave));
            color = mix(color, rgb(0x4a3426),
                        0.35f * smooth(0.5f, 0.7f, noise(x / 1.5f, y / 1.5f, seed + 7)));
        } else if (kind == 3) {
            // Runs of glaze: rounded tongues of uneven length from a common rim, over and over.
            const int run = floor_int(x / 9);
            const float u = 2 * fraction(x / 9) - 1;
            const float rim = 62, at = fraction(y / rim + 0.1f) * rim;
            const int row = floor_int(y / rim + 0.1f);
            const float end =
                10 + 34 * hash01(seed, run, row) + 4.5f * std::sqrt(std::max(0.0f, 1 - u * u));
            const float over =
                at < 12
                    ? 1.0f
                    : smooth(0.6f, -0.6f, at - end) *
                          smooth(1.0f, 0.86f, std::abs(u) + 0.12f * noise(x / 6, y / 9, seed + 9));
            color = mix(color, other * (1 + 0.06f * broad - 0.12f * smooth(0.4f, 1, std::abs(u))),
                        over);
            height += 1.5f * over * (at < 12 ? 1.0f : std::sqrt(std::max(0.05f, 1 - 0.8f * u * u)));
        } else {
            const float u = fraction(x / period) - 0.5f, v = fraction(y / period) - 0.5f;
            const float r = std::sqrt(u * u + v * v), angle = std::atan2(v, u);
            const float petals = r * (1.35f - 0.5f * std::abs(std::cos(angle * 3)));
            float paint =
                smooth(0.31f, 0.28f, petals) * (0.55f + 0.45f * smooth(0.0f, 0.3f, petals));
            paint = std::max(paint, r < 0.08f ? 1.0f : 0.0f);
            const float vine = std::abs(v + 0.36f + 0.06f * std::sin(u * 12.566f));
            paint = std::max(paint, smooth(0.035f, 0.02f, std::min(vine, std::abs(vine - 1))));
            color =
                mix(color, ink * (0.85f + 0.4f * clamp01(0.5f + noise(x / 3, y / 3, seed + 10))),
                    paint * 0.92f);
        }
        t.color = color;
        t.height = height + 0.08f * noise(x / 3, y / 3, seed + 11);
        t.shine = shine;
    });
    label.name = kNames[kind];
    label.tags = {"pottery", "glaze", "porcelain", "glossy"};
    if (kind == 0) label.tags.push_back("cracked");
    label.light.gloss = 50;
    label.light.highlight = 0.75f;
    label.light.relief = 0.75f;
    label.light.elevation_deg = dice.uniform(62, 78);
}

void lava(Dice& dice, Relief& relief, Label& label) {
    const int kind = dice.whole(0, 2);
    static const char* kNames[]{"cracked lava", "flowing lava", "cooling lava"};
    const std::uint32_t seed = dice.seed();
    const float size = dice.uniform(16, 30),
                heat = kind == 2 ? dice.uniform(0.3f, 0.5f) : dice.uniform(0.7f, 1.1f),
                turn = dice.uniform(0, 3.14f);
    relief.each([&](float px, float py, Texel& t) {
        const float a = px * std::cos(turn) + py * std::sin(turn),
                    b = -px * std::sin(turn) + py * std::cos(turn);
        const float wx = a + 7 * fbm(a / 24, b / 24, 4, seed),
                    wy = b + 7 * fbm(a / 24, b / 24, 4, seed + 1);
        const float rough = fbm(px / 6, py / 6, 5, seed + 2, 0.6f);
        float glow = 0;
        if (kind == 1) {
            glow = smooth(-0.25f, 0.55f, fbm(wx / 26, wy / 52, 5, seed + 3));
        } else {
            const Cells c = cells(wx / size, wy / size, 1, seed + 4),
                        d = cells(wx / size * 2.2f, wy / size * 2.2f, 1, seed + 5);
            glow = std::max(1 - smooth(0.0f, 0.17f, c.edge + 0.02f * rough),
                            0.6f * (1 - smooth(0, 0.1f, d.edge)));
        }
        glow = clamp01(glow * heat + 0.12f * rough * glow);
        const Rgb hot = glow < 0.5f ? mix(rgb(0x2a0c06), rgb(0xd83a0a), glow * 2)
                                    : mix(rgb(0xd83a0a), rgb(0xffd45a), (glow - 0.5f) * 2);
        t.color = mix(rgb(0x2a2524) * (1 + 0.3f * rough), hot * (0.9f + 0.9f * glow),
                      smooth(0.08f, 0.35f, glow));
        t.height = 3.5f * (1 - glow) + 1.8f * rough * (1 - glow);
    });
    label.name = kNames[kind];
    label.tags = {"magma", "molten", "hot", "glowing"};
    label.light.relief = 0.6f;
    label.light.occlusion = 0.05f;
    label.light.ambient = 0.7f;
    label.light.highlight = 0;
}

void water(Dice& dice, Relief& relief, Label& label) {
    // 0 sea, 1 ripples, 2 pool with caustics, 3 rough sea, 4 pond
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"sea water", "rippled water", "pool water", "rough sea",
                                "pond water"};
    constexpr std::uint32_t kDeep[]{0x1f4a5d, 0x2a5a6b, 0x1d3d52, 0x2f6a70, 0x35504a};
    constexpr std::uint32_t kSky[]{0xa9c4d6, 0xc9d6dd, 0x8fb3cf, 0xd8d3c4, 0xb5c9cf};
    const Rgb deep = kind == 4 ? shifted(rgb(0x3a4a2f), 0, dice.uniform(0.6f, 1.2f),
                                         dice.uniform(0.7f, 1.2f))
                               : dice.color(kDeep),
              sky = dice.color(kSky);
    const Rgb pool = shifted(rgb(0x3fb0c0), dice.uniform(-0.04f, 0.03f), dice.uniform(0.7f, 1.1f),
                             dice.uniform(0.8f, 1.05f));
    const std::uint32_t seed = dice.seed();
    const float length = kind == 3 ? dice.uniform(24, 36) : dice.uniform(10, 19),
                wind = dice.uniform(0, 6.28f), steep = kind == 3 ? 1.5f : dice.uniform(0.6f, 1.0f);
    const float flat = dice.uniform(1.8f, 3.2f);
    const auto surface = [&](float x, float y) {
        // Waves round the wind's direction, sharpened at the crests.
        const float a = x * std::cos(wind) + y * std::sin(wind),
                    b = -x * std::sin(wind) + y * std::cos(wind);
        const float wa = a + 0.5f * length * noise(a / length / 1.7f, b / length / 2.5f, seed);
        const float big = 1 - 2 * std::abs(noise(wa / length, b / (length * flat), seed + 1));
        const float mid =
            1 - 2 * std::abs(noise(wa / length * 2.1f + 7, b / (length * flat) * 1.9f, seed + 2));
        const float small = noise(a / length * 4.4f, b / length * 2.4f, seed + 3);
        return steep * length * (0.11f * big + 0.05f * mid + 0.014f * small);
    };
    relief.each([&](float x, float y, Texel& t) {
        if (kind == 2) {
            const float wx = x + 4 * fbm(x / 17, y / 17, 2, seed),
                        wy = y + 4 * fbm(x / 17, y / 17, 2, seed + 1);
            const Cells c = cells(wx / length, wy / length, 1, seed + 2),
                        d = cells(wx / length * 1.6f + 9, wy / length * 1.6f, 1, seed + 3);
            const float light = std::pow(1 - smooth(0, 0.36f, c.edge), 3.0f) +
                                0.6f * std::pow(1 - smooth(0, 0.32f, d.edge), 3.0f);
            t.color = pool * (0.82f + 0.1f * fbm(x / 30, y / 30, 2, seed + 4)) +
                      Rgb{0.42f, 0.42f, 0.36f} * std::min(light, 1.3f);
            t.height = 0.4f * fbm(x / 12, y / 12, 2, seed + 5);
            t.shine = 0.2f;
            return;
        }
        const float h = surface(x, y);
        const float gx = surface(x + 0.5f, y) - surface(x - 0.5f, y),
                    gy = surface(x, y + 0.5f) - surface(x, y - 0.5f);
        // Seen at a slant from below the picture: what leans away mirrors the bright sky low down.
        const float slope = 0.25f + 0.9f * gy;
        const float facing = clamp01(0.72f - slope * 0.85f) / std::sqrt(1 + gx * gx + gy * gy);
        const float fresnel = std::pow(1 - clamp01(facing), 3.0f);
        Rgb color = mix(deep * (0.85f + 0.6f * clamp01(h / length * 2 + 0.4f)), sky,
                        clamp01(0.12f + fresnel * 1.15f));
        const float glint = smooth(0.40f, 0.62f, -gy * 0.8f - gx * 0.5f);
        color = color + Rgb{0.5f, 0.5f, 0.48f} * (glint * (kind == 4 ? 0.2f : 0.75f));
        if (kind == 3) {
            const float foam = smooth(
                0.5f, 0.85f,
                h / (steep * length * 0.16f) - 0.25f + 0.8f * fbm(x / 6, y / 6, 4, seed + 6));
            color = mix(color, rgb(0xe6ecee), 0.8f * foam);
        }
        t.color = color;
        t.height = 0.1f * h;
        t.shine = 0.1f;
    });
    label.name = kNames[kind];
    label.tags = {"waves", "liquid", "wet"};
    if (kind == 0 || kind == 3) label.tags.insert(label.tags.end(), {"sea", "ocean"});
    if (kind == 2) label.tags.insert(label.tags.end(), {"pool", "caustics"});
    label.light.relief = 0.4f;
    label.light.occlusion = 0;
    label.light.ambient = 0.75f;
    label.light.highlight = 0.3f;
    label.light.grain = 0.006f;
}

}  // namespace weft::starter
