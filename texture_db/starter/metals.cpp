// Metal, rust and rubber.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {

void metal(Dice& dice, Relief& relief, Label& label) {
    // 0 brushed, 1 tread plate, 2 hammered, 3 corrugated, 4 perforated, 5 riveted, 6 scratched, 7
    // galvanised
    const int kind = dice.whole(0, 7);
    static const char* kNames[]{"brushed metal",    "tread plate",      "hammered metal",
                                "corrugated metal", "perforated metal", "riveted metal",
                                "scratched metal",  "galvanised steel"};
    constexpr std::uint32_t kMetal[]{0x9a9da1, 0x83878c, 0xb5b6b5, 0x6a6e74,
                                     0xb08d57, 0xa86a4a, 0x8d949c, 0xc4a35f};
    const Rgb base = kind == 7 ? rgb(0x9ba3a8) : dice.color(kMetal, 0.7f);
    const std::uint32_t seed = dice.seed();
    const bool upright = dice.chance(0.3f);
    const float size = dice.uniform(9, 16), dents = dice.uniform(0, 0.8f),
                sheen_at = dice.uniform(-0.5f, 0.5f);
    relief.each([&](float px, float py, Texel& t) {
        const float a = upright ? py : px, b = upright ? px : py;
        const float brush =
            noise(a / 34, b / 0.55f, seed) + 0.7f * noise(a / 12, b / 0.4f, seed + 1);
        const float broad = fbm(px / 40, py / 40, 3, seed + 2),
                    grime = smooth(0.05f, 0.5f, fbm(px / 18, py / 18, 4, seed + 3));
        float height = dents * 1.6f * fbm(px / 30, py / 30, 2, seed + 4), light = 1;
        Rgb color = base * (1 + 0.05f * broad - 0.12f * grime);
        // A metal's colour is what it mirrors: a soft band of light across it.
        const float sheen =
            std::exp(-std::pow((b / 96 - 0.5f + sheen_at * 0.6f + 0.08f * broad) * 2.6f, 2.0f));
        if (kind == 0) {
            light = 0.72f + 0.55f * sheen + 0.13f * brush;
            height += 0.10f * brush;
        } else if (kind == 1) {
            // Raised lozenges, lying and standing in turn.
            const float gx = px / size, gy = py / size;
            const int i = floor_int(gx), j = floor_int(gy);
            const float s = ((i + j) & 1) ? 0.7071f : -0.7071f;
            const float u = fraction(gx) - 0.5f, v = fraction(gy) - 0.5f;
            const float l = u * 0.7071f + v * s, w = -u * s + v * 0.7071f;
            const float d = (l * l) / 0.19f + (w * w) / 0.017f;
            const float bump = smooth(1.1f, 0.35f, d);
            height += 1.7f * bump;
            light = 0.8f + 0.12f * brush + 0.15f * bump;
            color = color * (1 - 0.2f * grime * (1 - bump));
        } else if (kind == 2) {
            const Cells c = cells(px / (size * 0.8f), py / (size * 0.8f), 0.85f, seed + 5);
            height += 3.2f * c.first * c.first;
            light = 0.9f + 0.05f * brush;
        } else if (kind == 3) {
            const float wave = std::sin(a / size * 6.2831853f);
            height += size * 0.16f * wave;
            light = 0.86f + 0.05f * brush + 0.1f * wave;
            color = color * (1 - 0.25f * smooth(0.35f, 0.7f, fbm(a / 7, b / 50, 3, seed + 6)));
        } else if (kind == 4) {
            const float s = size * 0.62f;
            const int j = floor_int(py / (s * 0.866f));
            const float u = (fraction(px / s + 0.5f * static_cast<float>(j & 1)) - 0.5f) * s,
                        v = (fraction(py / (s * 0.866f)) - 0.5f) * s * 0.866f;
            const float d = std::sqrt(u * u + v * v) - s * 0.3f;
            const float hole = smooth(0.35f, -0.35f, d);
            color = mix(color, rgb(0x0d0d0f), hole);
            light = 0.8f + 0.3f * sheen + 0.06f * brush;
            height -= 2.2f * hole;
        } else if (kind == 5) {
            const float plate = size * 3;
            const float u = fraction(px / plate) * plate, v = fraction(py / plate) * plate;
            const float seam = std::min({u, plate - u, v, plate - v});
            const int pi = floor_int(px / plate), pj = floor_int(py / plate);
            color = color * (0.88f + 0.24f * hash01(seed, pi, pj));
            height -= 1.6f * (1 - smooth(0.2f, 1.1f, seam));
            color = color * (0.45f + 0.55f * smooth(0.1f, 1.3f, seam));
            const float step = plate / 5;
            const float ru = (fraction(u / step) - 0.5f) * step,
                        rv = (fraction(v / step) - 0.5f) * step;
            const bool border = u < step || u > plate - step || v < step || v > plate - step;
            const float r = ru * ru + rv * rv;
            if (border && r < 5.3f) height += 1.5f * std::sqrt(1 - r / 5.3f);
            if (border && r >= 5.3f && r < 9) color = color * 0.72f;
            light = 0.85f + 0.07f * brush;
        } else if (kind == 6) {
            light = 0.78f + 0.35f * sheen + 0.05f * noise(px / 0.8f, py / 0.8f, seed + 7);
        } else {
            // Spangle: crystals that mirror different parts of the sky.
            const float wx = px + 2 * fbm(px / 6, py / 6, 3, seed + 8),
                        wy = py + 2 * fbm(px / 6, py / 6, 3, seed + 9);
            const Cells c = cells(wx / size / 1.1f, wy / size / 1.1f, 1, seed + 10);
            const float own = static_cast<float>(c.id & 255u) / 255.0f,
                        turn = static_cast<float>(c.id >> 8 & 255u) / 40.0f;
            const float lines = noise((px * std::cos(turn) + py * std::sin(turn)) / 1.3f,
                                      (py * std::cos(turn) - px * std::sin(turn)) / 14, seed + 11);
            light = 0.74f + 0.42f * own + 0.07f * lines;
        }
        t.color = color * light;
        t.height = height;
        t.shine = kind == 7 ? 0.2f : 0.8f;
    });
    if (kind == 6 || kind == 1 || kind == 5) {
        scatter(relief, 9, 40, [&](int i, int j) {
            if (hash01(seed, i, j, 20) > (kind == 6 ? 0.85f : 0.3f)) return;
            Strand s;
            s.x = (static_cast<float>(i) + hash01(seed, i, j, 21)) * 9;
            s.y = (static_cast<float>(j) + hash01(seed, i, j, 22)) * 9;
            s.angle =
                (hash01(seed, i, j, 28) < 0.75f ? 0.5f : 6.28f) * (hash01(seed, i, j, 23) - 0.5f) +
                (upright ? 1.57f : 0.0f);
            s.bend = 0.25f * (hash01(seed, i, j, 24) - 0.5f);
            s.length = 6 + 34 * hash01(seed, i, j, 25) * hash01(seed, i, j, 26);
            s.width = 0.5f;
            const Rgb c =
                hash01(seed, i, j, 27) < 0.6f ? mix(base, rgb(0xffffff), 0.55f) : base * 0.5f;
            s.root = s.tip = c;
            s.lift = 0;
            s.base = 0.0f;
            draw(relief, s);
        });
    }
    label.name = kNames[kind];
    label.tags = {"steel", "metallic", "industrial"};
    if (base.r > base.b * 1.4f) label.tags.insert(label.tags.end(), {"brass", "copper"});
    if (kind == 0) label.tags.push_back("brushed");
    label.light.gloss = kind == 2 ? 8 : 22;
    label.light.highlight = kind == 0 || kind == 6 ? 0.12f : 0.5f;
    label.light.relief = 0.9f;
    label.light.ambient = 0.45f;
}

void rust(Dice& dice, Relief& relief, Label& label) {
    // 0 all rust, 1 flaking paint, 2 patches on steel, 3 streaks, 4 pitted plate
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"rusted iron", "rust under flaking paint", "rust patches on steel",
                                "rust streaks", "pitted rusty plate"};
    constexpr std::uint32_t kPaint[]{0x5f7d8a, 0x8a9a8d, 0xb5aa8a, 0x4a5d4f,
                                     0xa8433a, 0xd0c9b8, 0x3f5575, 0xc9a23a};
    const Rgb paint = dice.color(kPaint), steel = rgb(0x85888a);
    const std::uint32_t seed = dice.seed();
    const float amount = kind == 0 || kind == 4 ? 1 : dice.uniform(0.35f, 0.65f),
                scale = dice.uniform(0.8f, 1.4f);
    const Rgb dark =
                  shifted(rgb(0x4a2a1c), dice.uniform(-0.01f, 0.01f), 1, dice.uniform(0.8f, 1.2f)),
              mid = shifted(rgb(0x8a4522), dice.uniform(-0.015f, 0.015f), 1,
                            dice.uniform(0.85f, 1.15f)),
              bright = shifted(rgb(0xc4702c), dice.uniform(-0.02f, 0.015f), 1, 1);
    relief.each([&](float px, float py, Texel& t) {
        const float x = px * scale, y = py * scale;
        const float n = fbm(x / 22, y / 22, 6, seed, 0.62f),
                    fine = fbm(x / 4, y / 4, 4, seed + 1, 0.65f),
                    grit = noise(px / 0.8f, py / 0.8f, seed + 2);
        const float tone = clamp01(0.5f + 0.9f * n + 0.45f * fine);
        Rgb rusty = tone < 0.5f ? mix(dark, mid, tone * 2) : mix(mid, bright, (tone - 0.5f) * 2);
        rusty = rusty * (1 + 0.2f * grit);
        float height = 1.6f * fine + 0.5f * grit;
        float cover = 1;
        Rgb under = steel;
        if (kind == 1) {
            const float v = fbm(x / 30, y / 30, 6, seed + 3, 0.6f) + 0.5f - amount;
            cover = smooth(0.03f, -0.02f, v);
            const float rim = smooth(0.12f, 0.0f, v) * (1 - cover);
            under = mix(paint * (1 + 0.05f * n + 0.03f * grit), mid, 0.45f * rim);
            height = cover * height + (1 - cover) * (2.6f + 0.9f * rim);
        } else if (kind == 2) {
            const float v = fbm(x / 26, y / 26, 6, seed + 4, 0.6f);
            cover = smooth(-0.15f, 0.25f, v + amount - 0.5f);
            under = steel * (0.9f + 0.1f * noise(px / 22, py / 0.5f, seed + 5));
            height *= cover;
        } else if (kind == 3) {
            const float drip =
                fbm(x / 5, y / 60, 4, seed + 6) + 0.35f * fbm(x / 16, y / 16, 3, seed + 7);
            cover = smooth(-0.1f, 0.5f, drip + amount - 0.5f);
            under = mix(paint, steel, 0.3f) * (1 + 0.04f * grit);
            height *= cover;
        } else if (kind == 4) {
            const Cells c = cells(x / 5, y / 5, 1, seed + 8);
            const float pit =
                (1 - smooth(0.12f, 0.4f, c.first)) * static_cast<float>(c.id & 255u) / 255.0f;
            rusty = mix(rusty, dark * 0.6f, pit);
            height -= 2.4f * pit;
        }
        t.color = mix(under, rusty, cover);
        t.height = height;
        t.shine = (1 - cover) * 0.35f;
    });
    label.name = kNames[kind];
    label.tags = {"rusty", "iron", "corroded", "old"};
    if (kind == 1) label.tags.insert(label.tags.end(), {"paint", "peeling"});
    label.light.relief = 0.75f;
    label.light.highlight = 0.3f;
}

void rubber(Dice& dice, Relief& relief, Label& label) {
    // 0 studded floor, 1 tyre tread, 2 ribbed mat, 3 granules, 4 hex mat
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"studded rubber", "tyre tread", "ribbed rubber mat",
                                "rubber granules", "hexagon rubber mat"};
    constexpr std::uint32_t kColors[]{0x26272a, 0x2d2c2b, 0x3a3c40, 0x303a33, 0x452a2a, 0x2a3345};
    const Rgb base = dice.color(kColors, 0.7f);
    const std::uint32_t seed = dice.seed();
    const float size = dice.uniform(12, 20), dust = dice.uniform(0, 0.35f),
                slant = dice.uniform(0.5f, 1.0f);
    const bool upright = dice.chance(0.5f);
    relief.each([&](float px, float py, Texel& t) {
        const float a = upright ? py : px, b = upright ? px : py;
        const float grit = noise(px / 0.9f, py / 0.9f, seed),
                    broad = fbm(px / 24, py / 24, 4, seed + 1);
        float top = 0;
        Rgb color = base;
        if (kind == 0) {
            const float u = (fraction(px / size) - 0.5f) * size,
                        v = (fraction(py / size) - 0.5f) * size;
            top = smooth(size * 0.33f, size * 0.29f, std::sqrt(u * u + v * v));
        } else if (kind == 1) {
            // Blocks between a zigzag and slanted grooves.
            const float zig = std::abs(fraction(b / size) - 0.5f) * size * slant;
            const float u = fraction((a + zig) / size * 0.9f), v = fraction(b / (size * 1.6f));
            const float du = std::min(u, 1 - u) * size, dv = std::min(v, 1 - v) * size * 1.6f;
            top = smooth(1.1f, 2.0f, std::min(du, dv));
            const float sipe = std::abs(fraction((a - zig) / 5) - 0.5f) * 5;
            top *= 0.75f + 0.25f * smooth(0.15f, 0.5f, sipe);
        } else if (kind == 2) {
            const float u = fraction(b / (size * 0.42f));
            top = smooth(0.12f, 0.26f, u) * smooth(0.88f, 0.74f, u);
        } else if (kind == 3) {
            const Cells c = cells(px / 4.2f, py / 4.2f, 1, seed + 2);
            top = smooth(0, 0.25f, c.edge);
            const float own = static_cast<float>(c.id & 255u) / 255.0f;
            color = own > 0.93f ? rgb(0x8a4a3a) : base * (0.7f + 0.7f * own);
        } else {
            const float s = size * 0.55f;
            const float gy = py / (s * 0.866f);
            const int j = floor_int(gy);
            float best = 9, next = 9;
            for (int jj = j - 1; jj <= j + 2; ++jj) {
                for (int ii = floor_int(px / s) - 1; ii <= floor_int(px / s) + 2; ++ii) {
                    const float dx = px / s - static_cast<float>(ii) -
                                     0.5f * static_cast<float>(jj & 1),
                                dy = (gy - static_cast<float>(jj)) * 0.866f;
                    const float d = std::sqrt(dx * dx + dy * dy);
                    if (d < best) {
                        next = best;
                        best = d;
                    } else {
                        next = std::min(next, d);
                    }
                }
            }
            top = smooth(0.10f, 0.22f, next - best);
        }
        const float pale = dust * smooth(-0.1f, 0.5f, broad + 0.3f * grit) *
                           (kind == 1 ? 1.0f : 0.6f + 0.4f * (1 - top));
        t.color = mix(color * (1 + 0.1f * broad + 0.1f * grit), rgb(0x8a8073), pale);
        t.height = (kind == 1 ? 3.4f : 2.0f) * top + 0.15f * grit;
        t.shine = 0.35f * (1 - pale);
    });
    label.name = kNames[kind];
    label.tags = {"black", "industrial", "floor"};
    if (kind == 1) label.tags.push_back("tyre");
    label.light.gloss = 9;
    label.light.highlight = 0.22f;
    label.light.relief = 0.9f;
}

}  // namespace weft::starter
