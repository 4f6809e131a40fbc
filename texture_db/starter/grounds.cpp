// Plaster, concrete, asphalt, dirt, sand, gravel and snow.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {
namespace {

// A crack net: 1 in the crack.
float cracks(float x, float y, float size, float width, std::uint32_t seed) {
    const float wx = x + 0.16f * size * fbm(x / size * 3, y / size * 3, 3, seed + 31);
    const float wy = y + 0.16f * size * fbm(x / size * 3, y / size * 3, 3, seed + 32);
    const Cells c = cells(wx / size, wy / size, 1, seed + 33);
    return 1 - smooth(width * 0.3f, width, c.edge * size);
}

// Stones of one size strewn over a ground: draws the higher one.
void strew(float x, float y, float size, float share, std::uint32_t seed, Rgb base, float variety,
           Texel& t) {
    const Cells c = cells(x / size, y / size, 0.75f, seed);
    if (static_cast<float>(c.id >> 16 & 1023u) / 1023.0f > share) return;
    const float own = static_cast<float>(c.id & 255u) / 255.0f,
                tone = static_cast<float>(c.id >> 8 & 255u) / 255.0f;
    const float turn = tone * 6.28f, long_side = 0.40f + 0.1f * own,
                narrow = long_side * (0.65f + 0.35f * tone);
    const float a = (c.dx * std::cos(turn) + c.dy * std::sin(turn)) / long_side;
    const float b = (-c.dx * std::sin(turn) + c.dy * std::cos(turn)) / narrow;
    const float r = a * a + b * b + 0.25f * noise(x / size * 3, y / size * 3, seed + 1);
    if (r >= 1) return;
    const float h = size * 0.36f * std::sqrt(1 - std::max(r, 0.0f)) + 0.12f * size * own;
    if (h < t.height) return;
    t.height = h;
    t.color = shifted(base, 0.06f * (tone - 0.5f) * variety, 1, 1 + variety * 0.8f * (own - 0.5f)) *
              (1 + 0.15f * fbm(x / 2.5f, y / 2.5f, 3, seed + 2));
}

}  // namespace

void plaster(Dice& dice, Relief& relief, Label& label) {
    // 0 trowelled, 1 roughcast, 2 cracked, 3 stucco, 4 peeling, 5 adobe
    const int kind = dice.whole(0, 5);
    static const char* kNames[]{"trowelled plaster", "roughcast render",
                                "cracked plaster",   "stucco",
                                "peeling plaster",   "adobe"};
    constexpr std::uint32_t kWash[]{0xe6ded0, 0xd9c8a5, 0xe3d3b8, 0xc9b8a0, 0xd0d4d0,
                                    0xd8a882, 0xc4927a, 0xb8c4c0, 0xe9e4da, 0xd9b98a};
    const Rgb base =
        kind == 5 ? shifted(rgb(0xb98a5f), 0, dice.uniform(0.7f, 1.1f), dice.uniform(0.85f, 1.15f))
                  : dice.color(kWash);
    const Rgb under =
        shifted(rgb(0xa08a74), 0, dice.uniform(0.5f, 1.2f), dice.uniform(0.75f, 1.1f));
    const std::uint32_t seed = dice.seed();
    const float size = dice.uniform(2.4f, 4.5f), stain = dice.uniform(0, 0.14f),
                net = dice.uniform(26, 50);
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 40, y / 40, 4, seed),
                    grit = noise(x / 0.9f, y / 0.9f, seed + 1);
        float height = 0.2f * grit;
        Rgb color = base * (1 + 0.05f * broad + 0.03f * grit -
                            stain * smooth(0, 0.6f, fbm(x / 30, y / 70, 3, seed + 2)));
        if (kind == 0 || kind == 2 || kind == 4) {
            // Arcs of the trowel: stretched noise whose direction wanders.
            const float turn = 1.3f * fbm(x / 90, y / 90, 2, seed + 3);
            const float a = x * std::cos(turn) + y * std::sin(turn),
                        b = -x * std::sin(turn) + y * std::cos(turn);
            const float sweep = fbm(a / 30, b / 6, 4, seed + 4, 0.6f);
            const float lap = smooth(0.55f, 0.9f, ridged(a / 60, b / 20, 2, seed + 5));
            height += 0.38f * sweep + 0.45f * lap + 0.5f * fbm(x / 9, y / 9, 3, seed + 17);
            color = color * (1 + 0.03f * sweep);
        } else if (kind == 1) {
            const Cells c = cells(x / size, y / size, 1, seed + 6),
                        d = cells(x / size * 1.7f, y / size * 1.7f, 1, seed + 7);
            height += size * 0.42f * std::max(0.0f, 0.62f - c.first) * 1.6f +
                      size * 0.2f * std::max(0.0f, 0.6f - d.first);
        } else if (kind == 3) {
            // Flattened blobs on a lower coat.
            const float blob = fbm(x / (size * 2.6f), y / (size * 2.6f), 3, seed + 8);
            height += 1.7f * smooth(-0.05f, 0.16f, blob) + 0.25f * fbm(x / 2, y / 2, 2, seed + 9);
        } else {
            height += 1.8f * fbm(x / 14, y / 10, 4, seed + 10);
            // Chopped straw in the clay.
            const float chaff =
                smooth(0.55f, 0.7f,
                       noise(x / 5 + 3 * noise(x / 12, y / 12, seed + 11), y / 0.9f, seed + 12));
            color = mix(color * (1 + 0.16f * fbm(x / 9, y / 9, 3, seed + 13)), rgb(0xd9bd85),
                        0.6f * chaff);
        }
        if (kind == 2 || kind == 5) {
            const float c = cracks(x, y, net, 0.75f, seed);
            color = mix(color, base * 0.32f, 0.9f * c);
            height -= 2.2f * c;
        }
        if (kind == 4) {
            const float off = smooth(0.04f, 0.075f, fbm(x / 24, y / 24, 5, seed + 14));
            color = mix(color, under * (0.9f + 0.25f * fbm(x / 4, y / 4, 3, seed + 15)), off);
            height += 2.0f * (1 - off) + 0.6f * off * grit;
        }
        t.color = color;
        t.height = height;
    });
    label.name = kNames[kind];
    label.tags = {"render", "wall", "building"};
    if (kind == 2) label.tags.push_back("cracked");
    if (kind == 4) label.tags.insert(label.tags.end(), {"old", "peeling"});
    if (kind == 3) label.tags.push_back("stucco");
    label.light.elevation_deg = dice.uniform(24, 40);
    label.light.relief = 0.85f;
    label.light.highlight = 0;
    label.light.ambient = 0.45f;
}

void concrete(Dice& dice, Relief& relief, Label& label) {
    // 0 smooth, 1 board formed, 2 pitted, 3 cracked, 4 blocks, 5 exposed aggregate
    const int kind = dice.whole(0, 5);
    static const char* kNames[]{"smooth concrete", "board formed concrete",
                                "pitted concrete", "cracked concrete",
                                "concrete blocks", "exposed aggregate concrete"};
    constexpr std::uint32_t kGrey[]{0x9d9b96, 0x8a8883, 0xb0aca4, 0x77767a, 0xa39c8d, 0x8c9090};
    const Rgb base = dice.color(kGrey, 0.6f);
    const std::uint32_t seed = dice.seed();
    const float board = dice.uniform(14, 24),
                pits = kind == 2 ? dice.uniform(0.2f, 0.4f) : dice.uniform(0.0f, 0.035f),
                net = dice.uniform(40, 70);
    const float block = dice.uniform(26, 36);
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 34, y / 34, 5, seed, 0.6f),
                    fine = fbm(x / 3, y / 3, 3, seed + 1),
                    grit = noise(x / 0.8f, y / 0.8f, seed + 2);
        const float stain = smooth(0.1f, 0.5f, fbm(x / 18, y / 60, 4, seed + 3));
        Rgb color = base * (1 + 0.14f * broad + 0.06f * fine + 0.07f * grit - 0.12f * stain);
        float height = 0.35f * fine + 0.22f * grit + 0.8f * broad;
        // Blow holes of two sizes.
        for (const float size : {3.2f, 6.5f}) {
            const Cells c = cells(x / size, y / size, 0.9f, seed + 5);
            const float own = static_cast<float>(c.id & 255u) / 255.0f;
            if (static_cast<float>(c.id >> 8 & 1023u) / 1023.0f > pits * (size > 4 ? 0.6f : 1.0f))
                continue;
            const float hole = 1 - smooth(0.10f + 0.14f * own, 0.18f + 0.16f * own, c.first);
            color = mix(color, base * 0.45f, 0.7f * hole);
            height -= 1.6f * hole;
        }
        if (kind == 1) {
            const int j = floor_int(x / board);
            const float v = fraction(x / board) * board, own = hash01(seed, j, 0);
            const float line = 1 - smooth(0.2f, 1.0f, std::min(v, board - v));
            const float grain = fbm(x / 1.5f + 40 * own, y / 26, 3, seed + 6);
            color = color * (0.94f + 0.12f * own + 0.09f * grain);
            color = mix(color, base * 0.55f, 0.6f * line);
            height += 0.6f * grain + 0.9f * (own - 0.5f) + 1.4f * line;
        } else if (kind == 3) {
            const float c = cracks(x, y, net, 0.8f, seed);
            color = mix(color, base * 0.28f, c);
            height -= 2.4f * c;
        } else if (kind == 4) {
            const int j = floor_int(y / (block * 0.55f));
            const float v = fraction(y / (block * 0.55f)) * block * 0.55f,
                        shift = 0.5f * static_cast<float>(j & 1);
            const float u = fraction(x / block / 1.15f + shift) * block * 1.15f;
            const float d = std::min({u, block * 1.15f - u, v, block * 0.55f - v});
            const float own = hash01(seed, floor_int(x / block / 1.15f + shift), j);
            const float face = smooth(0.4f, 1.3f, d);
            color = mix(base * 0.62f, color * (0.9f + 0.2f * own) * (1 + 0.1f * grit), face);
            height += 1.6f * face + 0.5f * grit;
        } else if (kind == 5) {
            Texel stone_here;
            stone_here.height = -9;
            strew(x, y, 4.4f, 0.8f, seed + 7, shifted(base, 0.0f, 2.5f, 1.05f), 1.0f, stone_here);
            if (stone_here.height > -8) {
                color = stone_here.color;
                height += 0.7f * stone_here.height;
            }
        }
        t.color = color;
        t.height = height;
    });
    label.name = kNames[kind];
    label.tags = {"cement", "grey", "building"};
    if (kind == 3) label.tags.push_back("cracked");
    label.light.relief = 0.7f;
    label.light.elevation_deg = dice.uniform(34, 50);
    label.light.highlight = 0;
}

void asphalt(Dice& dice, Relief& relief, Label& label) {
    const int kind = dice.whole(0, 2);
    static const char* kNames[]{"asphalt", "cracked asphalt", "coarse asphalt"};
    constexpr std::uint32_t kGrey[]{0x4a4a4c, 0x3c3c3f, 0x5b5a5a, 0x66635f, 0x505357};
    const Rgb base = dice.color(kGrey, 0.6f);
    const std::uint32_t seed = dice.seed();
    const float size = kind == 2 ? dice.uniform(3.6f, 5.2f) : dice.uniform(2.0f, 3.0f),
                net = dice.uniform(24, 46), pale = dice.uniform(0.3f, 1.0f);
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 40, y / 40, 4, seed),
                    grit = noise(x / 0.7f, y / 0.7f, seed + 1);
        t.color = base * (0.72f + 0.12f * broad + 0.12f * grit);
        t.height = 0.3f * grit;
        Texel s;
        s.height = -9;
        strew(x, y, size, 0.9f, seed + 2, mix(base, rgb(0x9a968e), 0.35f * pale), 0.9f, s);
        strew(x + 40, y + 17, size * 0.6f, 0.9f, seed + 3, mix(base, rgb(0x8a8884), 0.25f * pale),
              0.9f, s);
        if (s.height > -8) {
            t.color = s.color * (0.9f + 0.15f * broad);
            t.height += 0.7f * s.height;
        }
        if (kind == 1) {
            const float c = cracks(x, y, net, 1.1f, seed);
            t.color = mix(t.color, base * 0.25f, 0.95f * c);
            t.height -= 2.5f * c;
        }
    });
    label.name = kNames[kind];
    label.tags = {"road", "street", "tarmac", "ground"};
    if (kind == 1) label.tags.push_back("cracked");
    label.light.relief = 0.8f;
    label.light.highlight = 0;
}

void dirt(Dice& dice, Relief& relief, Label& label) {
    // 0 loose soil, 1 dried mud, 2 stony, 3 forest floor
    const int kind = dice.whole(0, 3);
    static const char* kNames[]{"loose soil", "dried cracked mud", "stony dirt", "forest floor"};
    constexpr std::uint32_t kSoil[]{0x6b4f37, 0x8a6a48, 0x543d2b, 0x9c7f5a, 0x77583c, 0x4a3a2c};
    const Rgb base = dice.color(kSoil);
    const std::uint32_t seed = dice.seed();
    const float net = dice.uniform(18, 34), clods = dice.uniform(5, 8);
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 26, y / 26, 4, seed),
                    grit = noise(x / 0.8f, y / 0.8f, seed + 1),
                    fine = fbm(x / 3.5f, y / 3.5f, 4, seed + 2, 0.6f);
        t.color = base * (1 + 0.2f * broad + 0.2f * fine + 0.12f * grit);
        t.height = 1.2f * fine + 0.4f * grit;
        if (kind == 1) {
            const float wx = x + 2.5f * fbm(x / 14, y / 14, 3, seed + 3),
                        wy = y + 2.5f * fbm(x / 14, y / 14, 3, seed + 4);
            const Cells c = cells(wx / net, wy / net, 0.9f, seed + 5);
            const float d = c.edge * net, crack = 1 - smooth(0.4f, 1.7f, d);
            t.color =
                mix(shifted(base, 0, 0.8f,
                            1.15f + 0.2f * (static_cast<float>(c.id & 255u) / 255.0f - 0.5f)) *
                        (1 + 0.08f * fine + 0.06f * grit),
                    base * 0.2f, crack);
            t.height = 0.4f * fine + 1.4f * smooth(6, 1.5f, d) - 3.5f * crack;
            return;
        }
        Texel s;
        s.height = -9;
        strew(x, y, clods, 0.75f, seed + 6,
              kind == 2 ? shifted(base, 0, 0.5f, 1.35f) : base * 0.95f, 0.9f, s);
        strew(x + 33, y + 71, clods * 0.5f, 0.85f, seed + 7, base, 0.8f, s);
        strew(x + 11, y + 5, clods * 0.28f, 0.9f, seed + 8, base * 1.08f, 0.8f, s);
        if (s.height > -8) {
            const float soft = kind == 2 ? 1 : 0.75f;
            t.color = mix(t.color, s.color * (1 + 0.15f * fine), soft);
            t.height += s.height + (kind == 2 ? 0 : 0.9f * fine);
        }
    });
    if (kind == 3) {
        scatter(relief, 5, 16, [&](int i, int j) {
            Strand s;
            s.x = (static_cast<float>(i) + hash01(seed, i, j, 1)) * 5;
            s.y = (static_cast<float>(j) + hash01(seed, i, j, 2)) * 5;
            s.angle = 6.28f * hash01(seed, i, j, 3);
            s.bend = 1.2f * (hash01(seed, i, j, 4) - 0.5f);
            s.length = 5 + 11 * hash01(seed, i, j, 5);
            s.width = hash01(seed, i, j, 6) < 0.2f ? 2.6f : 0.9f;
            const Rgb c = shifted(rgb(0x8a6136), 0.03f * (hash01(seed, i, j, 7) - 0.5f), 1,
                                  0.6f + 0.7f * hash01(seed, i, j, 8));
            s.root = c * 0.7f;
            s.tip = c;
            s.base = 3;
            draw(relief, s);
        });
    }
    label.name = kNames[kind];
    label.tags = {"soil", "earth", "ground"};
    if (kind == 1) label.tags.insert(label.tags.end(), {"mud", "cracked"});
    label.light.relief = 0.75f;
    label.light.occlusion = 0.8f;
    label.light.highlight = 0;
}

void sand(Dice& dice, Relief& relief, Label& label) {
    // 0 fine, 1 rippled, 2 coarse, 3 trodden, 4 wet
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"fine sand", "rippled sand", "coarse sand", "trodden sand",
                                "wet sand"};
    constexpr std::uint32_t kSand[]{0xd6bd8d, 0xc9a870, 0xe3d0a8, 0xb8925f,
                                    0xdcc9a5, 0xcfae84, 0xbfae90};
    Rgb base = dice.color(kSand);
    if (kind == 4) base = shifted(base, 0, 1.1f, 0.66f);
    const std::uint32_t seed = dice.seed();
    const float period = dice.uniform(9, 19), turn = dice.uniform(0, 3.14f),
                grain = kind == 2 ? dice.uniform(1.5f, 2.3f) : dice.uniform(0.75f, 1.05f);
    const float tall = dice.uniform(0.09f, 0.17f) * period;
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 45, y / 45, 3, seed);
        const Cells g = cells(x / grain, y / grain, 1, seed + 1);
        const float own = static_cast<float>(g.id & 255u) / 255.0f,
                    tone = static_cast<float>(g.id >> 8 & 255u) / 255.0f;
        Rgb color = base * (0.90f + 0.2f * own + 0.05f * broad);
        if (tone < 0.06f) color = base * 0.45f;
        if (tone > 0.95f) color = mix(base, rgb(0xffffff), 0.5f);
        float height = grain * 0.35f * own * (1 - g.first) + 1.2f * broad +
                       0.5f * fbm(x / 7, y / 7, 2, seed + 2);
        if (kind == 1) {
            const float a = x * std::cos(turn) + y * std::sin(turn),
                        b = -x * std::sin(turn) + y * std::cos(turn);
            const float p = a / period + 1.0f * fbm(x / 38, y / 38, 2, seed + 3) +
                            0.15f * fbm(b / 14, a / 14, 2, seed + 4);
            const float f = fraction(p);
            // Gentle to windward, steep to lee.
            const float ripple = f < 0.68f ? smooth(0, 0.68f, f) : 1 - smooth(0.68f, 1, f);
            height += tall * ripple * 1.6f;
            color = color * (0.94f + 0.1f * ripple);
        } else if (kind == 3) {
            const Cells f = cells(x / 19, y / 19, 0.9f, seed + 5);
            height +=
                3.2f * smooth(0.1f, 0.5f, f.first) - 1.5f + 1.0f * fbm(x / 6, y / 6, 3, seed + 6);
        }
        t.color = color;
        t.height = height;
        t.shine = kind == 4 ? 0.35f : 0;
    });
    label.name = kNames[kind];
    label.tags = {"beach", "dune", "ground", "grains"};
    if (kind == 1) label.tags.push_back("rippled");
    if (kind == 4) label.tags.push_back("wet");
    label.light.elevation_deg = dice.uniform(26, 42);
    label.light.relief = 0.85f;
    label.light.highlight = 0.25f;
    label.light.gloss = 14;
    label.light.ambient = 0.42f;
}

void gravel(Dice& dice, Relief& relief, Label& label) {
    // 0 river pebbles, 1 crushed, 2 fine, 3 mixed
    const int kind = dice.whole(0, 3);
    static const char* kNames[]{"river pebbles", "crushed gravel", "fine gravel", "mixed gravel"};
    constexpr std::uint32_t kRock[]{0x9a948b, 0x7f7d7a, 0xb5a68f, 0x8f8378,
                                    0x6b6d70, 0xc4b8a3, 0xa0856c};
    const Rgb base = dice.color(kRock);
    const std::uint32_t seed = dice.seed();
    const float size = kind == 2 ? dice.uniform(3.2f, 4.6f) : dice.uniform(6.5f, 11),
                variety = dice.uniform(0.7f, 1.5f);
    relief.each([&](float x, float y, Texel& t) {
        const float grit = noise(x / 0.8f, y / 0.8f, seed + 1);
        t.color = base * (0.32f + 0.08f * grit);
        t.height = -0.6f * size * 0.3f;
        if (kind == 1) {
            // Broken stones: cells with facets.
            for (const float s : {size * 0.55f, size}) {
                const Cells c = cells(x / s, y / s, 0.95f, seed + 2);
                const float a = static_cast<float>(c.id & 63u) / 10.0f,
                            own = static_cast<float>(c.id >> 6 & 255u) / 255.0f;
                if (s == size && own < 0.25f) continue;
                const float face = smooth(0.02f, 0.12f, c.edge);
                const float h = s * (0.42f * face + 0.33f * own +
                                     0.45f * (c.dx * std::cos(a) + c.dy * std::sin(a)));
                if (h < t.height || face <= 0) continue;
                t.height = h;
                t.color =
                    shifted(base, 0.03f * (own - 0.5f), 1, 1 + 0.6f * variety * (own - 0.5f)) *
                    (1 + 0.14f * fbm(x / 3, y / 3, 3, seed + 3)) * (0.3f + 0.7f * face);
            }
        } else {
            strew(x + 51, y + 23, size * 0.5f, 0.95f, seed + 4, base, variety, t);
            strew(x + 5, y + 60, size * 0.7f, 0.9f, seed + 5, base, variety, t);
            strew(x, y, size, 0.92f, seed + 6, base, variety, t);
            if (kind == 3) strew(x + 80, y + 9, size * 1.7f, 0.5f, seed + 7, base, variety, t);
        }
        t.height += 0.15f * grit;
        t.color = t.color * (1 + 0.07f * grit);
        t.shine = kind == 0 ? 0.12f : 0;
    });
    label.name = kNames[kind];
    label.tags = {"pebbles", "stones", "ground"};
    label.light.relief = 0.8f;
    label.light.occlusion = 1.0f;
    label.light.highlight = 0.3f;
}

void snow(Dice& dice, Relief& relief, Label& label) {
    // 0 fresh, 1 crusted, 2 wind packed, 3 trodden, 4 icy
    const int kind = dice.whole(0, 4);
    static const char* kNames[]{"fresh snow", "crusted snow", "wind packed snow", "trodden snow",
                                "icy snow"};
    const std::uint32_t seed = dice.seed();
    const Rgb base = shifted(rgb(0xeceef1), 0, dice.uniform(0.4f, 1.2f), dice.uniform(0.9f, 0.99f));
    const float turn = dice.uniform(0, 3.14f), scale = dice.uniform(0.8f, 1.3f),
                sparkle = dice.uniform(0.2f, 0.7f);
    relief.each([&](float x, float y, Texel& t) {
        const float a = (x * std::cos(turn) + y * std::sin(turn)) / scale,
                    b = (-x * std::sin(turn) + y * std::cos(turn)) / scale;
        const float soft = fbm(a / 30, b / 30, 3, seed),
                    grain = noise(x / 0.9f, y / 0.9f, seed + 1),
                    lumps = fbm(a / 6, b / 6, 3, seed + 2);
        float height = 3.2f * soft + 0.42f * grain + 0.3f * noise(x / 1.9f, y / 1.9f, seed + 8);
        if (kind == 0) height += 0.9f * lumps;
        if (kind == 1) {
            const Cells c = cells(a / 9, b / 9, 1, seed + 3);
            height += 1.6f * std::floor(2.5f * (0.5f + 0.5f * fbm(a / 13, b / 13, 3, seed + 4))) +
                      0.8f * smooth(0, 0.3f, c.edge);
        }
        if (kind == 2) height += 3.2f * ridged(a / 12 + 0.5f * soft, b / 36, 3, seed + 5);
        if (kind == 3) {
            const Cells c = cells(a / 16, b / 16, 1, seed + 6);
            height += 3.8f * smooth(0.08f, 0.5f, c.first) + 1.6f * lumps;
        }
        // Hollows are lit by the sky: bluer.
        const float blue = smooth(0.25f, -0.4f, soft);
        t.color = mix(base, Rgb{base.r * 0.93f, base.g * 0.965f, base.b * 1.0f}, blue) *
                  (0.96f + 0.05f * grain);
        t.height = height;
        const bool glint =
            hash01(seed, floor_int(x * 1.2f), floor_int(y * 1.2f), 7) > 1 - 0.012f * sparkle * 3;
        t.shine = kind == 4 ? 0.5f : 0;
        if (glint) t.color = {1, 1, 1}, t.height += 0.6f;
        if (kind == 4) t.color = mix(t.color, rgb(0xb9d3e3), 0.55f * smooth(-0.1f, 0.4f, lumps));
    });
    label.name = kNames[kind];
    label.tags = {"winter", "white", "cold"};
    label.light.elevation_deg = dice.uniform(20, 34);
    label.light.ambient = 0.62f;
    label.light.relief = 0.55f;
    label.light.occlusion = 0.25f;
    label.light.highlight = 0.4f;
}

}  // namespace weft::starter
