// Carpet, loop by loop and strand by strand.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {

void carpet(Dice& dice, Relief& relief, Label& label) {
    // 0 loop pile, 1 cut pile, 2 berber, 3 shag, 4 patterned pile
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"loop pile carpet", "cut pile carpet", "berber carpet", "shag rug",
                                "patterned rug"};
    constexpr std::uint32_t kColors[]{0x7d7468, 0xb3a78f, 0x6b2c2c, 0x35485f, 0x4c5a45,
                                      0x9a8f85, 0x544a46, 0xc9bda6, 0x8a4f2c};
    const Rgb main = dice.color(kColors), second = dice.color(kColors), third = dice.color(kColors);
    const std::uint32_t seed = dice.seed();
    const float loop = dice.uniform(3.2f, 5.2f), spacing = kind == 3 ? 2.2f : 1.7f;
    const float period = dice.uniform(26, 44), flecks = kind == 2 ? 0.3f : 0.05f;
    const auto color_at = [&](float x, float y, float dice01) {
        if (kind == 4) {
            const float u = fraction(x / period), v = fraction(y / period);
            const float d = std::abs(u - 0.5f) + std::abs(v - 0.5f);
            if (d < 0.16f) return third;
            if (d < 0.36f) return second;
            return d > 0.46f && d < 0.54f ? third : main;
        }
        return dice01 < flecks ? second : main;
    };
    relief.each([&](float px, float py, Texel& t) {
        t.color = main * 0.3f;
        t.height = -2;
        if (kind == 1 || kind == 3) return;
        const float x = px + 0.5f * fbm(px / 15, py / 15, 2, seed),
                    y = py + 0.5f * fbm(px / 15, py / 15, 2, seed + 1);
        const int row = floor_int(y / (loop * 0.82f));
        const float shift = 0.5f * static_cast<float>(row & 1) + 0.3f * hash01(seed, 0, row);
        const int column = floor_int(x / loop + shift);
        const float u = (fraction(x / loop + shift) - 0.5f) * 2,
                    v = (fraction(y / (loop * 0.82f)) - 0.5f) * 2;
        const float r2 = u * u * 0.8f + v * v * 0.8f + 0.25f * noise(px / 2, py / 2, seed + 2);
        if (r2 > 1) return;
        const float own = hash01(seed, column, row, 1);
        const float strands = std::sin((u * 1.2f + v * 2.2f) * 5 + own * 6);
        t.height = loop * 0.42f * std::sqrt(std::max(0.0f, 1 - r2)) + 0.16f * strands;
        const Rgb c =
            color_at(static_cast<float>(column) * loop, static_cast<float>(row) * loop * 0.82f,
                     hash01(seed, column, row, 2));
        t.color = c * (0.9f + 0.22f * own + 0.07f * strands);
    });
    if (kind == 1 || kind == 3) {
        scatter(relief, spacing, 12, [&](int i, int j) {
            Strand s;
            s.x = (static_cast<float>(i) + hash01(seed, i, j, 1)) * spacing;
            s.y = (static_cast<float>(j) + hash01(seed, i, j, 2)) * spacing;
            const float lay = 4 * fbm(s.x / 18, s.y / 18, 2, seed + 5);
            s.angle = lay + (kind == 3 ? 1.6f : 5) * (hash01(seed, i, j, 3) - 0.5f);
            s.bend = 1.6f * (hash01(seed, i, j, 4) - 0.5f);
            s.length =
                kind == 3 ? 8 + 8 * hash01(seed, i, j, 5) : 2.4f + 1.6f * hash01(seed, i, j, 5);
            s.width = kind == 3 ? 1.7f : 1.25f;
            s.taper = 0.3f;
            s.lift = kind == 3 ? 2.6f : 1.8f;
            const Rgb c = hash01(seed, i, j, 6) < 0.12f ? second : main;
            const float own = 0.8f + 0.4f * hash01(seed, i, j, 7);
            s.root = c * (0.5f * own);
            s.tip = c * (1.05f * own);
            draw(relief, s);
        });
    }
    label.name = kNames[kind];
    label.tags = {"rug", "pile", "floor", "textile"};
    label.light.relief = 0.6f;
    label.light.occlusion = 0.9f;
    label.light.highlight = 0;
}

}  // namespace weft::starter
