// Wood and bark.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {

void wood(Dice& dice, Relief& relief, Label& label) {
    // 0 plain sawn, 1 planks, 2 weathered planks, 3 painted planks, 4 parquet, 5 end grain, 6
    // plywood
    const int kind = dice.whole(0, 6);
    static const char* kNames[]{"wood grain",      "wooden planks", "weathered planks",
                                "painted planks",  "parquet",       "end grain wood",
                                "fine wood veneer"};
    constexpr std::uint32_t kTimber[]{0xb07a45, 0x8a5a30, 0xc99a62, 0x5f3d24,
                                      0xd9b482, 0x7a3f24, 0xa8784f, 0x4a3222};
    constexpr std::uint32_t kPaint[]{0xe8e4da, 0x6f8fa3, 0x7d9a83, 0xa84a3c,
                                     0x4a5d6b, 0xd9c36b, 0x8fb0b5};
    Rgb base = dice.color(kTimber);
    const Rgb paint = dice.color(kPaint);
    const std::uint32_t seed = dice.seed();
    if (kind == 2) base = mix(base, rgb(0x8d8982), dice.uniform(0.5f, 0.9f));
    const bool upright = dice.chance(0.5f), boards = kind >= 1 && kind <= 4;
    const float board = kind == 4 ? dice.uniform(13, 20) : dice.uniform(20, 36);
    const float ring = dice.uniform(4.5f, 9), stretch = dice.uniform(9, 16),
                knots = dice.uniform(0.1f, 0.5f);
    const float length = kind == 4 ? board * 4 : dice.uniform(90, 200);
    const float cx = dice.uniform(-20, 116), cy = dice.uniform(-20, 116);
    relief.each([&](float px, float py, Texel& t) {
        if (kind == 5) {
            const float dx = px - cx, dy = py - cy;
            const float r = std::sqrt(dx * dx + dy * dy) + 2.5f * fbm(px / 24, py / 24, 3, seed);
            const float f = fraction(r / ring * 1.1f);
            const float angle = std::atan2(dy, dx);
            const float late = smooth(0.45f, 0.95f, f) * (1 - smooth(0.96f, 1.0f, f));
            const float crack =
                smooth(0.86f, 0.97f, ridged(angle * 4.5f, r / 90, 2, seed + 3)) * smooth(0, 50, r);
            t.color = mix(base * 1.1f, base * 0.62f, late) *
                      (1 + 0.12f * noise(px / 1.2f, py / 1.2f, seed + 1)) * (1 - 0.7f * crack);
            t.height = 0.4f * late - 2.4f * crack + 0.15f * noise(px, py, seed + 2);
            return;
        }
        float along = upright ? py : px, across = upright ? px : py;
        int number = 0, end = 0;
        float groove = 0, gap_d = 99;
        if (boards) {
            number = floor_int(across / board);
            const float v = fraction(across / board) * board;
            gap_d = std::min(v, board - v);
            const float offset = length * hash01(seed, number, 0, 1);
            end = floor_int((along + offset) / length);
            const float w = fraction((along + offset) / length) * length;
            gap_d = std::min(gap_d, std::min(w, length - w));
            groove = 1 - smooth(0.3f, kind == 4 ? 0.9f : 1.5f, gap_d);
        }
        const float own = boards ? hash01(seed, number, end, 2) : 0.5f;
        const float shift = boards ? 400 * hash01(seed, number, end, 3) : 0.0f;
        const float a = along + shift, c = across + shift * 0.37f;
        // Cathedral figure: rings cut at a slant, bent round the knots.
        float warp = 3.2f * fbm(a / (stretch * 7), c / 16, 3, seed + 4) * ring * 0.45f;
        const Cells k = cells(a / 95, c / 42, 0.9f, seed + 5);
        float knot = 0;
        if (hash01(seed, k.ix, k.iy, 6) < knots) {
            const float kx = k.dx * 95, ky = k.dy * 42, d2 = kx * kx * 0.35f + ky * ky;
            warp += 16 * std::exp(-d2 / 60) * (ky > 0 ? 1.0f : -1.0f) * std::exp(-std::abs(ky) / 9);
            knot = std::exp(-d2 / 9);
        }
        const float r = c + warp + 0.0022f * (a - 60) * (a - 60) * (kind == 6 ? 0.25f : 1);
        const float f = fraction(r / ring);
        const float late = smooth(0.35f, 0.92f, f) * (1 - smooth(0.95f, 1.0f, f));
        const float fibre = fbm(a / stretch / 1.6f, c / 0.7f, 2, seed + 7);
        const float pore = smooth(0.52f, 0.75f, noise(a / stretch, c / 0.45f, seed + 8));
        Rgb color = mix(base * 1.08f, base * 0.66f, late * (kind == 6 ? 0.55f : 0.85f));
        color = color * (1 + 0.13f * fibre) * (0.82f + 0.36f * own);
        color = mix(color, base * 0.45f, 0.5f * pore);
        color = mix(color, base * 0.3f, knot);
        float height = 0.35f * late + 0.22f * fibre - 0.35f * pore;
        if (kind == 2) {
            const float split = smooth(0.72f, 0.95f, ridged(a / 70, c / 4.5f, 2, seed + 9));
            color = mix(color, base * 0.28f, 0.8f * split);
            height = 1.1f * late + 0.5f * fibre - 1.8f * split;
        }
        if (kind == 3) {
            const float off = smooth(0.12f, 0.22f, fbm(a / 26, c / 9, 4, seed + 10) - 0.12f);
            color = mix(paint * (0.93f + 0.1f * own + 0.05f * fibre - 0.06f * late), color, off);
            height += 0.7f * (1 - off);
        }
        color = mix(color, base * 0.13f, groove);
        height -= 2.6f * groove;
        if (kind == 1 || kind == 2 || kind == 3) {
            // Nails near the ends of the boards.
            const float offset = length * hash01(seed, number, 0, 1),
                        w = fraction((along + offset) / length) * length;
            const float v = fraction(across / board);
            const float nx = std::min(w, length - w) - 5, ny = (std::min(v, 1 - v) - 0.22f) * board;
            const float d = nx * nx + ny * ny;
            if (d < 2.2f) {
                color = rgb(0x2f2a28);
                height -= 0.5f;
            } else if (d < 12 && kind == 2) {
                color = color * 0.75f;
            }
        }
        t.color = color;
        t.height = height;
        t.shine = kind == 4 || kind == 6 ? 0.35f : 0.08f;
    });
    label.name = kNames[kind];
    label.tags = {"timber", "grain", upright ? "vertical" : "horizontal"};
    if (boards) label.tags.insert(label.tags.end(), {"boards", "planks"});
    if (kind == 2) label.tags.insert(label.tags.end(), {"old", "grey"});
    if (kind == 3) label.tags.insert(label.tags.end(), {"paint", "peeling"});
    if (kind == 4) label.tags.push_back("floor");
    label.light.relief = kind == 2 ? 0.9f : 0.6f;
    label.light.gloss = 20;
    label.light.highlight = 0.22f;
}

void bark(Dice& dice, Relief& relief, Label& label) {
    // 0 furrowed oak, 1 pine plates, 2 birch, 3 smooth beech
    const int kind = dice.whole(0, 3);
    static const char* kNames[]{"oak bark", "pine bark", "birch bark", "beech bark"};
    constexpr std::uint32_t kColors[]{0x6b5846, 0x7d6a58, 0x584636, 0x8a7866, 0x6f6a60, 0x4e3f32};
    const Rgb base = kind == 1 ? shifted(rgb(0x8a5a3c), dice.uniform(-0.02f, 0.02f),
                                         dice.uniform(0.6f, 1.1f), dice.uniform(0.75f, 1.1f))
                               : dice.color(kColors);
    const std::uint32_t seed = dice.seed();
    const float w = dice.uniform(8, 15), tall = dice.uniform(2.6f, 4.5f),
                moss = dice.chance(0.35f) ? dice.uniform(0.3f, 0.8f) : 0;
    relief.each([&](float px, float py, Texel& t) {
        float x = px + 5 * fbm(px / 26, py / 48, 3, seed),
              y = py + 6 * fbm(px / 20, py / 30, 2, seed + 1);
        const float rough = fbm(px / 3.2f, py / 5, 4, seed + 2, 0.6f),
                    fine = noise(px / 0.9f, py / 1.6f, seed + 3);
        float height = 0, crack = 0, own = 0.5f;
        Rgb color = base;
        if (kind == 0 || kind == 1) {
            const float sy = kind == 0 ? w * tall : w * 2.1f;
            const Cells c = cells(x / w, y / sy, 0.9f, seed + 4);
            own = static_cast<float>(c.id & 255u) / 255.0f;
            crack = 1 - smooth(0.03f, kind == 0 ? 0.30f : 0.20f, c.edge + 0.09f * rough);
            height =
                4.2f * (1 - crack) +
                (kind == 1 ? 1.5f * std::floor(2 * own + 1.2f * fbm(px / 9, py / 9, 2, seed + 5))
                           : 0.0f);
            const float flake = noise(px / 1.4f, py / 7, seed + 17);
            height += 1.5f * rough + 0.3f * fine + 0.7f * flake;
            color = base * (0.8f + 0.3f * own + 0.28f * rough + 0.16f * flake);
            if (kind == 1) color = mix(color, rgb(0xa89a8a), 0.4f * smooth(0.1f, 0.5f, rough));
            color = mix(color, base * 0.24f, 0.85f * crack);
        } else if (kind == 2) {
            // White skin with dark dashes across, and black diamonds.
            const float dash = smooth(
                0.42f, 0.55f,
                noise(px / 13, py / 1.5f, seed + 6) - 0.25f * noise(px / 4, py / 20, seed + 7));
            const float scar = smooth(0.46f, 0.62f, fbm(px / 18, py / 11, 3, seed + 8));
            color = mix(rgb(0xe3ddd0), rgb(0xc9b9a3),
                        clamp01(0.5f + fbm(px / 24, py / 9, 3, seed + 9)));
            color = mix(color, rgb(0x3a302a), std::max(dash * 0.85f, scar));
            height = 0.5f * fbm(px / 30, py / 4, 3, seed + 10) - 0.8f * dash + 1.5f * scar * rough +
                     0.1f * fine;
        } else {
            color = mix(rgb(0x8f918a), base, 0.35f) *
                    (0.95f + 0.18f * fbm(px / 12, py / 12, 4, seed + 11));
            const float lichen = smooth(0.18f, 0.4f, fbm(px / 15, py / 13, 4, seed + 12));
            color = mix(color, rgb(0xb5b9a3), 0.65f * lichen);
            const float wrinkle = smooth(0.75f, 0.95f, ridged(px / 50, py / 9, 2, seed + 13));
            height = 0.8f * rough - 1.3f * wrinkle + 0.4f * lichen + 0.25f * fine;
            color = color * (1 - 0.35f * wrinkle);
        }
        if (moss > 0) {
            const float green = moss * smooth(0.1f, 0.4f, fbm(px / 20, py / 20, 4, seed + 16));
            color = mix(color, rgb(0x6b7a35) * (0.7f + 0.5f * clamp01(rough + 0.5f)), green);
        }
        t.color = color;
        t.height = height;
    });
    label.name = kNames[kind];
    label.tags = {"tree", "trunk", "plant"};
    if (moss > 0) label.tags.push_back("mossy");
    label.light.relief = kind == 0 || kind == 1 ? 0.75f : 0.9f;
    label.light.occlusion = 0.9f;
    label.light.highlight = 0;
}

}  // namespace weft::starter
