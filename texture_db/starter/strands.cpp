// Fur, grass, straw and foliage: surfaces of strokes.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {

void fur(Dice& dice, Relief& relief, Label& label) {
    // 0 plain, 1 spotted, 2 striped, 3 tipped, 4 curly, 5 mottled
    const int kind = dice.whole(0, 5);
    static const char* kNames[]{"fur",        "spotted fur",  "striped fur",
                                "tipped fur", "curly fleece", "mottled fur"};
    constexpr std::uint32_t kCoat[]{0x8a6038, 0x4a3424, 0xc9a878, 0xe6ddcd, 0x2b2725,
                                    0x9c9690, 0xb5713a, 0x6b6259, 0xd8c3a0, 0x7a4a2a};
    constexpr std::uint32_t kMark[]{0x2a1d16, 0x3b2819, 0x1c1a1b, 0x4d331f, 0xf0ebe2};
    const Rgb base = kind == 4 ? mix(dice.color(kCoat), rgb(0xece4d4), 0.5f) : dice.color(kCoat);
    const Rgb mark = dice.color(kMark),
              tip = kind == 3 ? mix(base, rgb(0xf2ece0), 0.8f) : mix(base, rgb(0xffffff), 0.18f);
    const std::uint32_t seed = dice.seed();
    const float lay = dice.uniform(0, 6.28f), swirl = dice.uniform(0.2f, 0.9f);
    const float length = kind == 4 ? dice.uniform(7, 11) : dice.uniform(11, 26),
                width = dice.uniform(0.85f, 1.35f);
    const float clump = dice.uniform(5, 12), mess = dice.uniform(0.15f, 0.45f),
                spot = dice.uniform(13, 24);
    relief.each([&](float, float, Texel& t) {
        t.color = base * 0.22f;
        t.height = -3;
    });
    const auto marked = [&](float x, float y) {
        if (kind == 1) {
            const Cells c = cells(x / spot, y / spot, 0.7f, seed + 3);
            const float ring = c.first + 0.12f * noise(x / 5, y / 5, seed + 4);
            return smooth(0.36f, 0.28f, ring) *
                   (hash01(seed, c.ix, c.iy, 5) < 0.5f ? 1.0f : smooth(0.10f, 0.2f, ring));
        }
        if (kind == 2) {
            const float d = -x * std::sin(lay) * 0.3f + x * std::cos(lay) + y * std::sin(lay);
            return smooth(
                -0.05f, 0.25f,
                std::sin((d / spot + 0.9f * fbm(x / 30, y / 30, 2, seed + 5)) * 6.2831853f));
        }
        if (kind == 5) return smooth(-0.05f, 0.3f, fbm(x / 26, y / 26, 3, seed + 6));
        return 0.0f;
    };
    // Undercoat first, then the guard hairs.
    for (int layer = 0; layer < 2; ++layer) {
        const float spacing = layer == 0 ? 1.9f : 2.3f;
        const std::uint32_t s0 = seed + static_cast<std::uint32_t>(layer) * 100u;
        scatter(relief, spacing, length + 4, [&](int i, int j) {
            Strand s;
            s.x = (static_cast<float>(i) + hash01(s0, i, j, 1)) * spacing;
            s.y = (static_cast<float>(j) + hash01(s0, i, j, 2)) * spacing;
            const Cells c = cells(s.x / clump, s.y / clump, 0.9f, seed + 1);
            const float toward = (static_cast<float>(c.id & 255u) / 255.0f - 0.5f) * 2 * mess;
            s.angle = lay + swirl * fbm(s.x / 50, s.y / 50, 2, seed + 2) + toward +
                      mess * (hash01(s0, i, j, 3) - 0.5f);
            s.bend = kind == 4 ? 5.5f * (static_cast<float>(c.id >> 8 & 1u) - 0.5f) * 2 *
                                     (0.7f + 0.5f * hash01(s0, i, j, 4))
                               : 1.3f * (hash01(s0, i, j, 4) - 0.5f) + toward;
            s.length = length * (layer == 0 ? 0.55f : 0.7f + 0.6f * hash01(s0, i, j, 5));
            s.width = width * (layer == 0 ? 1.2f : 0.8f + 0.4f * hash01(s0, i, j, 6));
            const float own = 0.72f + 0.56f * hash01(s0, i, j, 7);
            const float m = marked(s.x + std::cos(s.angle) * s.length * 0.5f,
                                   s.y + std::sin(s.angle) * s.length * 0.5f);
            const Rgb body = mix(base, mark, m);
            s.root = body * (layer == 0 ? 0.35f : 0.5f);
            s.tip = mix(tip, mark * 1.1f, m) * own;
            if (layer == 0) s.tip = s.tip * 0.7f;
            s.lift = 1.5f + 2.0f * hash01(s0, i, j, 8);
            s.base = layer == 0 ? -2.0f : -0.8f;
            s.taper = 0.85f;
            draw(relief, s);
        });
    }
    label.name = kNames[kind];
    label.tags = {"hair", "animal", "coat", "soft"};
    if (kind == 1) label.tags.insert(label.tags.end(), {"leopard", "spots"});
    if (kind == 2) label.tags.insert(label.tags.end(), {"tiger", "striped"});
    if (kind == 4) label.tags.insert(label.tags.end(), {"sheepskin", "wool"});
    label.light.relief = 0.75f;
    label.light.occlusion = 0.55f;
    label.light.ambient = 0.45f;
    label.light.highlight = 0;
}

void grass(Dice& dice, Relief& relief, Label& label) {
    // 0 lawn, 1 meadow, 2 dry, 3 mown short, 4 with flowers
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"lawn", "meadow grass", "dry grass", "mown grass", "flower meadow"};
    constexpr std::uint32_t kGreen[]{0x4f7a2b, 0x5d8a35, 0x3f6a2d, 0x6d8f3a, 0x476f38, 0x7a943f};
    constexpr std::uint32_t kDry[]{0xb09a55, 0xa08a4a, 0xc0aa68, 0x8f8a48};
    constexpr std::uint32_t kFlower[]{0xf4f1ea, 0xe9c93a, 0xb06ac0, 0xd84a4a, 0x6a86d8};
    const Rgb green = dice.color(kGreen), dry = dice.color(kDry), flower = dice.color(kFlower);
    const std::uint32_t seed = dice.seed();
    const float share = kind == 2 ? dice.uniform(0.7f, 0.95f) : dice.uniform(0.04f, 0.2f);
    const float length = kind == 1 || kind == 2 ? dice.uniform(15, 26)
                         : kind == 3            ? dice.uniform(4.5f, 7)
                                                : dice.uniform(8, 14);
    const float width = dice.uniform(1.1f, 2.0f) * (kind == 3 ? 0.8f : 1),
                wind = dice.uniform(-0.5f, 0.5f);
    relief.each([&](float x, float y, Texel& t) {
        t.color = mix(rgb(0x2a2415), green * 0.28f, 0.6f) * (1 + 0.2f * fbm(x / 5, y / 5, 2, seed));
        t.height = -3;
    });
    for (int layer = 0; layer < 3; ++layer) {
        const float spacing = kind == 3 ? 2.2f : 2.8f;
        const std::uint32_t s0 = seed + 10u + static_cast<std::uint32_t>(layer) * 97u;
        const float bright = 0.55f + 0.24f * static_cast<float>(layer);
        scatter(relief, spacing, length + 3, [&](int i, int j) {
            Strand s;
            s.x = (static_cast<float>(i) + hash01(s0, i, j, 1)) * spacing;
            s.y = (static_cast<float>(j) + hash01(s0, i, j, 2)) * spacing;
            const float thick = fbm(s.x / 24, s.y / 24, 2, seed + 1);
            if (layer == 2 && hash01(s0, i, j, 9) < 0.35f - thick) return;
            s.angle = -1.57f + wind + 2.3f * (hash01(s0, i, j, 3) - 0.5f) +
                      0.8f * fbm(s.x / 30, s.y / 30, 2, seed + 2);
            if (kind == 3 || kind == 0) s.angle += 2.2f * (hash01(s0, i, j, 10) - 0.5f);
            s.bend = 1.8f * (hash01(s0, i, j, 4) - 0.5f);
            s.length = length * (0.6f + 0.6f * hash01(s0, i, j, 5));
            s.width = width * (0.7f + 0.6f * hash01(s0, i, j, 6));
            const float own = (0.75f + 0.5f * hash01(s0, i, j, 7)) * bright;
            Rgb c = hash01(s0, i, j, 8) < share
                        ? dry
                        : shifted(green, 0.03f * (hash01(s0, i, j, 11) - 0.5f), 1, 1);
            c = c * (1 + 0.25f * thick);
            s.root = c * (0.45f * own);
            s.tip = mix(c, rgb(0xe6e6a0), 0.12f) * (1.25f * own);
            s.lift = 2 + 1.5f * static_cast<float>(layer);
            s.base = static_cast<float>(layer) - 2;
            s.taper = 0.9f;
            draw(relief, s);
        });
    }
    if (kind == 4) {
        scatter(relief, 12, 4, [&](int i, int j) {
            if (hash01(seed, i, j, 40) > 0.55f) return;
            const float x = (static_cast<float>(i) + hash01(seed, i, j, 41)) * 12,
                        y = (static_cast<float>(j) + hash01(seed, i, j, 42)) * 12;
            const float turn = 6.28f * hash01(seed, i, j, 43),
                        size = 2.2f + 1.5f * hash01(seed, i, j, 44);
            for (int petal = 0; petal < 6; ++petal) {
                Strand s;
                s.x = x;
                s.y = y;
                s.angle = turn + static_cast<float>(petal) * 1.047f;
                s.length = size;
                s.width = size * 0.75f;
                s.taper = 0.3f;
                s.root = flower * 0.85f;
                s.tip = flower;
                s.base = 6;
                draw(relief, s);
            }
            Strand heart;
            heart.x = x - 0.4f;
            heart.y = y;
            heart.length = 0.9f;
            heart.width = size * 0.6f;
            heart.root = heart.tip = rgb(0xd8a520);
            heart.base = 7;
            draw(relief, heart);
        });
    }
    label.name = kNames[kind];
    label.tags = {"lawn", "blades", "plant", "ground"};
    if (kind == 4) label.tags.push_back("flowers");
    label.light.relief = 0.5f;
    label.light.ambient = 0.5f;
    label.light.occlusion = 0.5f;
    label.light.highlight = 0;
}

void straw(Dice& dice, Relief& relief, Label& label) {
    // 0 thatch, 1 hay, 2 wicker, 3 reed mat, 4 rush weave
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"thatch", "hay", "wicker", "reed mat", "rush weave"};
    constexpr std::uint32_t kStraw[]{0xc9a65a, 0xb8924c, 0xd8bd7a, 0xa5884f, 0x9c7a45, 0xc2a878};
    const Rgb base = dice.color(kStraw);
    const std::uint32_t seed = dice.seed();
    const float lay = kind == 0 ? 1.57f + dice.uniform(-0.15f, 0.15f) : dice.uniform(0, 3.14f);
    const float mess = kind == 1 ? 3.1f : dice.uniform(0.12f, 0.3f),
                width = dice.uniform(1.4f, 2.4f);
    if (kind == 2 || kind == 4) {
        // Canes in and out of stakes.
        const float stake = dice.uniform(11, 18),
                    cane = kind == 4 ? dice.uniform(6, 9) : dice.uniform(3.6f, 5.4f);
        const int strands_in = kind == 4 ? 1 : dice.whole(1, 2);
        relief.each([&](float px, float py, Texel& t) {
            const float x = px + 0.6f * noise(px / 30, py / 30, seed),
                        y = py + 0.6f * noise(px / 20, py / 20, seed + 1);
            const int j = floor_int(y / cane);
            const float v = (fraction(y / cane) - 0.5f) * 2;
            const float phase =
                3.1415926f * (x / stake + static_cast<float>(j / strands_in +
                                                             (j < 0 && strands_in == 2 ? 1 : 0)));
            const float over = std::cos(phase);
            const float thick = 0.93f - 0.2f * hash01(seed, j, 0);
            const float a = v / thick;
            const float s =
                (fraction(x / stake) - 0.5f) * 2;  // the stake stands at the middle of a cell
            const float stake_h = std::abs(s) < 0.24f ? 1.5f * std::sqrt(1 - s * s / 0.058f) : -9;
            const float cane_h =
                std::abs(a) < 1 ? cane * 0.42f * std::sqrt(1 - a * a) + 1.9f * over : -9;
            const bool top = cane_h > stake_h;
            const float h = std::max(cane_h, stake_h);
            if (h < -8) {
                t.color = base * 0.15f;
                t.height = -3;
                return;
            }
            const float fibre = top ? noise(x / 9, v * 3 + static_cast<float>(j) * 7, seed + 2)
                                    : noise(s * 6, y / 9, seed + 3);
            const float own = hash01(seed, top ? j : floor_int(x / stake), top ? 1 : 2);
            t.color = base * ((top ? 0.82f : 0.62f) + 0.3f * own + 0.16f * fibre);
            t.height = h + 0.25f * fibre;
            t.shine = 0.25f;
        });
    } else {
        relief.each([&](float, float, Texel& t) {
            t.color = base * 0.2f;
            t.height = -3;
        });
        for (int layer = 0; layer < 3; ++layer) {
            const float spacing = kind == 3 ? 3.0f : 3.4f;
            const std::uint32_t s0 = seed + static_cast<std::uint32_t>(layer) * 55u;
            scatter(relief, spacing, 45, [&](int i, int j) {
                if (kind == 3 && (j & 7) != 0) return;
                Strand s;
                s.x = (static_cast<float>(i) + hash01(s0, i, j, 1)) * spacing;
                s.y = (static_cast<float>(j) + hash01(s0, i, j, 2)) * spacing;
                s.angle = (kind == 3 ? 1.57f : lay) + mess * (hash01(s0, i, j, 3) - 0.5f);
                s.bend = 0.5f * mess * (hash01(s0, i, j, 4) - 0.5f) * (kind == 1 ? 0.4f : 1);
                s.length =
                    kind == 1 ? 16 + 26 * hash01(s0, i, j, 5) : 18 + 18 * hash01(s0, i, j, 5);
                s.width = width * (0.6f + 0.6f * hash01(s0, i, j, 6));
                const float own =
                    0.5f + 0.17f * static_cast<float>(layer) + 0.45f * hash01(s0, i, j, 7);
                const Rgb c = shifted(base, 0.02f * (hash01(s0, i, j, 8) - 0.5f),
                                      0.8f + 0.4f * hash01(s0, i, j, 9), own);
                s.root = c * 0.8f;
                s.tip = c * 1.1f;
                s.taper = 0.25f;
                s.base = static_cast<float>(layer) * 1.3f - 2;
                s.lift = 0.8f;
                draw(relief, s);
            });
        }
        if (kind == 3) {
            // Threads that hold the reeds.
            const float period = 30;
            const Rgb thread = base * 0.45f;
            relief.each([&](float x, float y, Texel& t) {
                const float d =
                    std::abs(fraction(y / period + 0.02f * std::sin(x)) - 0.5f) * period;
                if (d < 1.1f) {
                    t.color = thread;
                    t.height += 1.2f * std::sqrt(1 - d * d / 1.21f);
                }
            });
        }
    }
    label.name = kNames[kind];
    label.tags = {"dry", "fibre", "plant"};
    if (kind == 0) label.tags.insert(label.tags.end(), {"thatched", "roof"});
    if (kind == 2 || kind == 4) label.tags.insert(label.tags.end(), {"basket", "woven", "rattan"});
    label.light.relief = 0.7f;
    label.light.occlusion = 0.7f;
    label.light.highlight = 0.2f;
}

void foliage(Dice& dice, Relief& relief, Label& label) {
    // 0 hedge, 1 ivy, 2 fallen leaves, 3 fern, 4 moss, 5 clover
    const int kind = dice.whole(0, 5);
    static const char* kNames[]{"hedge leaves", "ivy", "fallen leaves", "fern", "moss", "clover"};
    constexpr std::uint32_t kGreen[]{0x3f6a2a, 0x557d33, 0x2f5529, 0x6a8a3a, 0x466b45};
    constexpr std::uint32_t kAutumn[]{0x96602f, 0x84452a, 0xa8824a, 0x6b4a2f,
                                      0x8f7145, 0x75603a, 0x9c6a3a, 0x5c4632};
    const bool autumn = kind == 2;
    const std::uint32_t seed = dice.seed();
    const Rgb green = dice.color(kGreen);
    const float size = kind == 4   ? dice.uniform(1.8f, 2.6f)
                       : kind == 5 ? dice.uniform(4.5f, 6.5f)
                                   : dice.uniform(7, 13);
    const float narrow = kind == 3 ? 0.3f : dice.uniform(0.45f, 0.7f),
                fresh = dice.uniform(0.75f, 1.25f);
    const auto warm = static_cast<std::uint32_t>(dice.whole(0, 7));
    relief.each([&](float x, float y, Texel& t) {
        t.color =
            (autumn ? rgb(0x3a2a1a) : green * 0.25f) * (1 + 0.25f * fbm(x / 6, y / 6, 3, seed));
        t.height = kind == 4 ? 3 * fbm(x / 14, y / 14, 2, seed + 1) - 2 : -4;
    });
    const auto leaf = [&](float x, float y, float angle, float length, Rgb color, float base) {
        // Outline by two strokes side by side, then the midrib.
        const float width = length * narrow;
        for (int half = -1; half <= 1; half += 2) {
            for (int k = 0; k < 5; ++k) {
                const float f = (static_cast<float>(k) + 0.5f) / 5;
                Strand s;
                s.x = x + std::cos(angle) * length * 0.1f;
                s.y = y + std::sin(angle) * length * 0.1f;
                const float open = static_cast<float>(half) * narrow * 1.5f * f;
                s.angle = angle + open;
                s.bend = -2.1f * open;
                s.length = length * (1.0f - 0.12f * f);
                s.width = std::max(0.9f, width * 0.3f);
                s.taper = 0.75f;
                s.root = color * (half < 0 ? 0.82f : 1.0f);
                s.tip = color * (half < 0 ? 0.95f : 1.12f);
                s.base = base + (1 - f) * 0.5f;
                s.lift = 0.8f;
                draw(relief, s);
            }
        }
        if (length > 5) {
            Strand rib;
            rib.x = x;
            rib.y = y;
            rib.angle = angle;
            rib.length = length * 0.95f;
            rib.width = 0.55f;
            rib.root = mix(color, rgb(0xe0e0b0), 0.4f);
            rib.tip = color;
            rib.base = base + 0.7f;
            draw(relief, rib);
        }
    };
    for (int layer = 0; layer < 3; ++layer) {
        const float spacing = kind == 4 ? 2.1f : size * 0.62f;
        const std::uint32_t s0 = seed + static_cast<std::uint32_t>(layer) * 71u;
        scatter(relief, spacing, size + 3, [&](int i, int j) {
            const float x = (static_cast<float>(i) + hash01(s0, i, j, 1)) * spacing,
                        y = (static_cast<float>(j) + hash01(s0, i, j, 2)) * spacing;
            const float hump = fbm(x / 14, y / 14, 2, seed + 1);
            const float own = 0.42f + 0.17f * static_cast<float>(layer) +
                              0.38f * hash01(s0, i, j, 3) + (kind == 4 ? 0.5f * hump : 0.0f);
            Rgb color = shifted(green, 0.04f * (hash01(s0, i, j, 4) - 0.5f), 0.75f, own);
            if (autumn)
                color = shifted(rgb(kAutumn[(hash(s0, i, j, 5) % 5u + warm) % 8u]),
                                0.02f * (hash01(s0, i, j, 4) - 0.5f), fresh, 0.35f + 0.62f * own);
            const float angle = 6.28f * hash01(s0, i, j, 6);
            const float base = (kind == 4 ? 3 * hump : 0) + static_cast<float>(layer) * 1.6f - 3;
            const float length = size * (0.75f + 0.5f * hash01(s0, i, j, 7));
            if (kind == 5) {
                for (int k = 0; k < 3; ++k)
                    leaf(x, y, angle + 2.094f * static_cast<float>(k), length * 0.8f, color, base);
            } else if (kind == 3) {
                if (hash01(s0, i, j, 8) > 0.35f) return;
                for (int k = -5; k <= 5; ++k) {
                    const float along = (static_cast<float>(k) + 5) * size * 0.16f;
                    const float fx = x + std::cos(angle) * along, fy = y + std::sin(angle) * along;
                    const float len = length * 0.55f * (1 - static_cast<float>(k + 5) / 12);
                    leaf(fx, fy, angle + 1.2f, len, color, base);
                    leaf(fx, fy, angle - 1.2f, len, color, base);
                }
            } else {
                leaf(x, y, angle, length, color, base);
            }
        });
    }
    label.name = kNames[kind];
    label.tags = {"leaves", "plant", "vegetation"};
    if (autumn) label.tags.push_back("autumn");
    if (kind == 4) label.tags.push_back("mossy");
    label.light.relief = 0.6f;
    label.light.ambient = 0.45f;
    label.light.occlusion = 0.6f;
    label.light.highlight = 0;
}

}  // namespace weft::starter
