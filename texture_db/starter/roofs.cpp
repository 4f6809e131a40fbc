// Roofs: rows of pieces that overlap.

#include <algorithm>

#include "texture_db/starter/families.h"
#include "texture_db/starter/units.h"

namespace weft::starter {

void roof(Dice& dice, Relief& relief, Label& label) {
    // 0 shingles, 1 slate, 2 beaver tail, 3 pantiles, 4 wooden shakes
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"roof shingles", "slate roof", "beaver tail tiles roof",
                                "pantile roof", "wooden shake roof"};
    constexpr std::uint32_t kClay[]{0xa04a30, 0xb5603f, 0x8a3f2c, 0xc07a50, 0x7d4a3a};
    constexpr std::uint32_t kSlate[]{0x555a62, 0x4a5058, 0x666a6e, 0x5d5563, 0x6b7373};
    constexpr std::uint32_t kShake[]{0x8a6a48, 0x7d7468, 0x9c7f5a, 0x6b5a48};
    constexpr std::uint32_t kFelt[]{0x4f4d4c, 0x6a5f58, 0x5a4038, 0x3f4a45};
    const Rgb base = kind == 1   ? dice.color(kSlate)
                     : kind == 4 ? dice.color(kShake)
                     : kind == 0 ? dice.color(kFelt)
                                 : dice.color(kClay);
    const std::uint32_t seed = dice.seed();
    const float w = kind == 3   ? dice.uniform(15, 22)
                    : kind == 0 ? dice.uniform(16, 26)
                                : dice.uniform(11, 17);
    const float h = kind == 3 ? w * 1.35f : kind == 0 ? w * 0.62f : w * dice.uniform(0.8f, 1.15f);
    const float vary = dice.uniform(0.15f, 0.5f),
                moss = dice.chance(0.35f) ? dice.uniform(0.4f, 0.9f) : 0;
    relief.each([&](float px, float py, Texel& t) {
        const float x = px + 0.4f * noise(px / 10, py / 10, seed),
                    y = py + 0.4f * noise(px / 10, py / 10, seed + 1);
        const float rough = fbm(px / 6, py / 6, 4, seed + 2),
                    grit = noise(px / 0.8f, py / 0.8f, seed + 3);
        float height = 0, shade = 1, own = 0.5f;
        if (kind == 3) {
            const int j = floor_int(y / h), i = floor_int(x / w);
            const float u = fraction(x / w), v = fraction(y / h);
            own = hash01(seed, i, j, 1);
            // An S across: a wide trough and a narrow crest.
            const float s = std::sin(6.2831853f * (u + 0.09f * std::sin(6.2831853f * u)));
            height = w * 0.22f * s + 2.6f * v + 0.5f * (own - 0.5f);
            shade = 0.5f + 0.5f * smooth(0, 0.16f, v);
        } else if (kind == 2) {
            // Rounded tails: of the rows that cover the place the upper one lies on top.
            const float step = h * 0.62f;
            const int row = floor_int(y / step);
            for (int j = row - 1; j <= row; ++j) {
                const float shift = 0.5f * static_cast<float>(j & 1);
                const int i = floor_int(x / w + shift);
                const float u = 2 * fraction(x / w + shift) - 1,
                            v = (y - static_cast<float>(j) * step) / step;
                const float outline = 0.75f + 0.95f * std::sqrt(std::max(0.0f, 1 - u * u));
                if (v > outline || v < 0) continue;
                own = hash01(seed, i, j, 1);
                height = 0.9f * (1 + v) + 0.4f * (own - 0.5f);
                shade = outline - v < 0.09f ? 1.1f : std::abs(u) > 0.93f ? 0.45f : 1;
                break;
            }
        } else {
            // The lower edge of every row casts its shadow on the next.
            bool found = false;
            for (int j = floor_int(y / h) + 1; j >= floor_int(y / h) - 1 && !found; --j) {
                const float shift = 0.5f * static_cast<float>(j & 1) +
                                    (kind == 4 || kind == 0 ? 0.35f * hash01(seed, j, 0, 5) : 0);
                const int i = floor_int(x / w + shift);
                const float u = fraction(x / w + shift);
                own = hash01(seed, i, j, 1);
                const float bottom = (static_cast<float>(j) + 0.5f) * h +
                                     (kind == 4 ? 3.5f : 0.9f) * (hash01(seed, i, j, 2) - 0.5f);
                const float top = bottom - 1.3f * h;
                if (y > bottom || y < top) continue;
                if (j == floor_int(y / h) + 1 && y < bottom - h * 1.12f) continue;
                const float below = bottom - y;
                const float side = std::min(u, 1 - u) * w;
                if (j == floor_int(y / h) + 1 && below > h * 1.05f) continue;
                height = 2.6f - 2.3f * clamp01(below / (1.3f * h));
                shade = side < 0.7f && below < h * 1.0f ? 0.35f : 1;
                if (below < 0.8f) shade *= 1.12f;
                found = true;
            }
            if (!found) shade = 0.3f;
        }
        Rgb color = shifted(base, 0.015f * (own - 0.5f), 1, 1 + vary * (own - 0.5f) * 1.5f);
        color = color * (1 + 0.12f * rough + (kind == 0 ? 0.28f : 0.08f) * grit) * shade;
        if (kind == 4) color = color * (1 + 0.22f * noise(px / 0.9f, py / 9, seed + 4));
        if (kind == 1) color = color * (1 + 0.1f * fbm(px / 9, py / 2.5f, 3, seed + 5));
        if (moss > 0)
            color = mix(color, rgb(0x6f7544) * (0.8f + 0.4f * clamp01(grit + 0.5f)),
                        moss * smooth(0.15f, 0.4f, fbm(px / 15, py / 15, 4, seed + 6)));
        t.color = color;
        t.height = height + 0.3f * rough +
                   (kind == 4 ? 0.5f * noise(px / 1.1f, py / 10, seed + 7) : 0.0f) + 0.2f * grit;
        t.shine = kind == 1 ? 0.25f : 0.06f;
    });
    label.name = kNames[kind];
    label.unit = roof_unit(kind, w, h);
    label.tags = {"roofing", "shingles", "building"};
    if (kind == 1) label.tags.push_back("slate");
    if (moss > 0) label.tags.push_back("mossy");
    label.light.azimuth_deg = dice.uniform(60, 130);
    label.light.relief = 0.9f;
    label.light.occlusion = 1.0f;
    label.light.highlight = 0.25f;
}

}  // namespace weft::starter
