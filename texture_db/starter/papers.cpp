// Paper and wallpaper.

#include <algorithm>

#include "texture_db/starter/families.h"
#include "texture_db/starter/units.h"

namespace weft::starter {

void paper(Dice& dice, Relief& relief, Label& label) {
    // 0 laid, 1 crumpled, 2 kraft, 3 corrugated board, 4 handmade, 5 old parchment, 6 ruled
    const int kind = dice.whole(0, 6);
    static const char* kNames[]{"laid paper",           "crumpled paper", "kraft paper",
                                "corrugated cardboard", "handmade paper", "old parchment",
                                "ruled paper"};
    constexpr std::uint32_t kSheet[]{0xf0ece2, 0xe6dcc6, 0xf2f0ea, 0xd9d3c8,
                                     0xe9e0e0, 0xd8e0e3, 0xe6d3a8};
    Rgb base = dice.color(kSheet, 0.6f);
    if (kind == 2 || kind == 3)
        base = shifted(rgb(0xb58f63), dice.uniform(-0.01f, 0.01f), dice.uniform(0.7f, 1.1f),
                       dice.uniform(0.85f, 1.15f));
    if (kind == 5)
        base = shifted(rgb(0xd9bd88), dice.uniform(-0.01f, 0.01f), dice.uniform(0.7f, 1.2f),
                       dice.uniform(0.8f, 1.1f));
    const std::uint32_t seed = dice.seed();
    const float pitch = dice.uniform(2.6f, 3.6f), chain = dice.uniform(22, 32),
                flute = dice.uniform(7, 11), crease = dice.uniform(16, 28),
                rule = dice.uniform(9, 14);
    relief.each([&](float x, float y, Texel& t) {
        const float mottle = fbm(x / 5, y / 5, 4, seed, 0.6f),
                    tooth = noise(x / 0.8f, y / 0.8f, seed + 1),
                    broad = fbm(x / 40, y / 40, 3, seed + 2);
        Rgb color = base * (1 + 0.025f * mottle + 0.02f * tooth + 0.03f * broad);
        float height = 0.16f * tooth + 0.3f * mottle;
        if (kind == 0) {
            const float line = std::sin(y / pitch * 6.2831853f),
                        wire = std::abs(fraction(x / chain) - 0.5f) * chain;
            height += 0.26f * line + 0.5f * smooth(1.2f, 0, wire);
            color = color * (1 + 0.028f * line - 0.05f * smooth(1.1f, 0, wire));
        } else if (kind == 1) {
            // Facets between creases: two nets of tilted planes.
            for (const float s : {crease, crease * 0.45f}) {
                const float wx = x + 0.2f * s * noise(x / s, y / s, seed + 3),
                            wy = y + 0.2f * s * noise(x / s, y / s, seed + 4);
                const Cells c = cells(wx / s, wy / s, 1, seed + 5);
                const float a = static_cast<float>(c.id & 63u) / 10.0f,
                            tilt = 0.25f + 0.5f * static_cast<float>(c.id >> 6 & 63u) / 63.0f;
                height += s * 0.5f * tilt * (c.dx * std::cos(a) + c.dy * std::sin(a)) +
                          0.05f * s * (1 - smooth(0, 0.07f, c.edge));
            }
        } else if (kind == 2) {
            color = color * (1 + 0.05f * noise(x / 14, y / 0.9f, seed + 6) + 0.05f * mottle);
        } else if (kind == 3) {
            const float wave = std::sin(x / flute * 6.2831853f);
            height += 1.5f * wave;
            color = color * (1 + 0.05f * noise(x / 0.8f, y / 16, seed + 7));
        } else if (kind == 4) {
            height += 0.9f * fbm(x / 7, y / 7, 4, seed + 8);
        } else if (kind == 5) {
            const float stain = smooth(0.0f, 0.5f, fbm(x / 20, y / 20, 5, seed + 9));
            color =
                mix(color * (1 + 0.1f * broad), base * Rgb{0.62f, 0.62f, 0.62f}.r, 0.5f * stain);
            const float spot = smooth(0.55f, 0.7f, noise(x / 3.5f, y / 3.5f, seed + 10));
            color = mix(color, base * 0.5f, 0.5f * spot);
            height += 0.9f * fbm(x / 18, y / 18, 3, seed + 11);
        } else {
            const float line = std::abs(fraction(y / rule) - 0.5f) * rule;
            color = mix(color, rgb(0x7d9ac9), 0.75f * smooth(0.7f, 0.35f, line));
            const float margin = std::abs(fraction(x / 110 + 0.35f) - 0.5f) * 110;
            color = mix(color, rgb(0xd0606a), 0.75f * smooth(0.7f, 0.35f, margin));
            height += 0.25f * fbm(x / 16, y / 16, 2, seed + 12);
        }
        t.color = color;
        t.height = height;
    });
    if (kind == 4 || kind == 2) {
        // Fibres and petals in the pulp.
        scatter(relief, kind == 4 ? 5.5f : 8, 16, [&](int i, int j) {
            Strand s;
            s.x = (static_cast<float>(i) + hash01(seed, i, j, 21)) * 5.5f;
            s.y = (static_cast<float>(j) + hash01(seed, i, j, 22)) * 5.5f;
            s.angle = 6.28f * hash01(seed, i, j, 23);
            s.bend = 3 * (hash01(seed, i, j, 24) - 0.5f);
            s.length = 3 + 9 * hash01(seed, i, j, 25);
            s.width = hash01(seed, i, j, 26) < 0.08f ? 2.2f : 0.55f;
            const float pick = hash01(seed, i, j, 27);
            s.root = s.tip = kind == 4 ? (pick < 0.5f   ? base * 0.75f
                                          : pick < 0.8f ? rgb(0x9c7f4a)
                                                        : rgb(0x7a8a4a))
                                       : base * (pick < 0.5f ? 0.82f : 1.1f);
            s.lift = 0;
            s.base = 0.5f;
            draw(relief, s);
        });
    }
    label.name = kNames[kind];
    label.tags = {"sheet", "fibre"};
    if (kind == 3) label.tags.insert(label.tags.end(), {"cardboard", "corrugated"});
    if (kind == 1) label.tags.push_back("creased");
    if (kind == 5) label.tags.insert(label.tags.end(), {"old", "parchment"});
    label.light.elevation_deg = kind == 1 ? dice.uniform(36, 50) : dice.uniform(24, 36);
    label.light.relief = kind == 1 ? 0.55f : 0.8f;
    label.light.ambient = 0.5f;
    label.light.highlight = 0;
    label.light.occlusion = 0.35f;
}

void wallpaper(Dice& dice, Relief& relief, Label& label) {
    // 0 damask, 1 stripes, 2 floral, 3 trellis, 4 polka
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"damask wallpaper", "striped wallpaper", "floral wallpaper",
                                "trellis wallpaper", "dotted wallpaper"};
    constexpr std::uint32_t kGround[]{0xd9cdb0, 0x8a3a3a, 0x46604f, 0x31455f, 0xcfd6d0,
                                      0xb5a48a, 0x6b4a5d, 0xe3dccb, 0xa8b5a0};
    const Rgb base = dice.color(kGround),
              figure = dice.chance(0.5f)
                           ? shifted(base, 0.01f, 1.1f, dice.chance(0.5f) ? 1.25f : 0.75f)
                           : dice.color(kGround),
              accent = dice.color(kGround);
    const std::uint32_t seed = dice.seed();
    const float w = dice.uniform(30, 46), h = w * dice.uniform(1.1f, 1.5f),
                gold = dice.chance(0.4f) ? 0.6f : 0.1f;
    const int petals_count = dice.whole(4, 6);
    relief.each([&](float x, float y, Texel& t) {
        const int column = floor_int(x / w);
        const float u = fraction(x / w) - 0.5f,
                    v = fraction(y / h + 0.5f * static_cast<float>(column & 1)) - 0.5f;
        const float s = std::abs(u);
        float ink = 0, second = 0;
        if (kind == 0) {
            // An ogee with a palmette inside, mirrored.
            const float ogee = std::abs(s - 0.36f * std::cos(v * 6.2831853f) * 0.5f - 0.26f);
            const float body = s / (0.24f * std::max(0.05f, std::cos(v * 4.4f)));
            const float lobes = 0.75f + 0.25f * std::cos(v * 56);
            ink = std::max(smooth(0.045f, 0.025f, ogee),
                           std::abs(v) < 0.34f ? smooth(lobes, lobes - 0.15f, body) : 0.0f);
            const float vein =
                std::abs(v) < 0.28f
                    ? smooth(0.02f, 0.01f, std::abs(s - 0.06f - 0.05f * std::sin(v * 24)))
                    : 0.0f;
            ink = clamp01(ink - vein);
        } else if (kind == 1) {
            const float f = fraction(x / (w * 0.5f));
            ink = f < 0.45f ? 1.0f : 0.0f;
            second = (f > 0.5f && f < 0.54f) || (f > 0.9f && f < 0.94f) ? 1.0f : 0.0f;
        } else if (kind == 2) {
            const float r = std::sqrt(u * u + v * v * 1.6f), a = std::atan2(v, u);
            const float flower =
                r *
                (1.3f - 0.45f * std::abs(std::cos(a * static_cast<float>(petals_count) * 0.5f)));
            ink = smooth(0.25f, 0.235f, flower);
            second = smooth(0.075f, 0.06f, r);
            const float stem = std::abs(u - 0.17f * std::sin(v * 6.2831853f + 1.2f));
            const float leaf = std::abs(std::abs(u) - 0.34f) / 0.09f + std::abs(v - 0.3f) / 0.14f;
            second = std::max(second, 0.8f * std::max(smooth(0.025f, 0.015f, stem) * (1 - ink),
                                                      smooth(1.0f, 0.85f, leaf)));
        } else if (kind == 3) {
            const float d = std::min(std::abs(fraction((x / w + y / h)) - 0.5f),
                                     std::abs(fraction((x / w - y / h)) - 0.5f));
            ink = smooth(0.075f, 0.06f, d);
            second = smooth(0.13f, 0.11f, std::sqrt(u * u + v * v)) * (1 - ink);
        } else {
            const float d = std::sqrt(u * u * w * w + v * v * h * h) / w;
            ink = smooth(0.17f, 0.155f, d);
        }
        const float tooth = noise(x / 0.8f, y / 0.8f, seed),
                    broad = fbm(x / 40, y / 40, 3, seed + 1),
                    thread = noise(x / 0.7f, y / 12, seed + 2);
        Rgb color = mix(mix(base, figure, ink), accent, second);
        t.color = color * (1 + 0.03f * tooth + 0.05f * broad + 0.02f * thread);
        t.height = 0.45f * std::max(ink, second) + 0.1f * tooth + 0.08f * thread;
        t.shine = gold * ink;
    });
    label.name = kNames[kind];
    label.unit = wallpaper_unit(kind, w, h);
    label.tags = {"wall", "interior", "pattern", "patterned"};
    if (kind == 1) label.tags.push_back("striped");
    if (kind == 2) label.tags.push_back("flowers");
    label.light.relief = 0.7f;
    label.light.gloss = 20;
    label.light.highlight = 0.2f;
}

}  // namespace weft::starter
