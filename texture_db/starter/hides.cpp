// Leather and scales.

#include <algorithm>

#include "texture_db/starter/families.h"

namespace weft::starter {
namespace {

constexpr std::uint32_t kHide[]{0x6b4226, 0x8f5a2e, 0x3c2a22, 0x2a2526, 0xa9703f,
                                0x7a2a24, 0x4d3523, 0xb98a5c, 0x1f1d1f, 0x5a4a3c,
                                0x3c4a3a, 0x27374d, 0xd0b48c, 0x88412b};

// Fine net of creases between pebbles of about `size` px; 0 in the crease, 1 on a pebble.
float pebbles(float x, float y, float size, float stretch, std::uint32_t seed, float& own) {
    const float wx = x + 0.35f * size * noise(x / size / 1.5f, y / size / 1.5f, seed + 11);
    const float wy = y + 0.35f * size * noise(x / size / 1.5f, y / size / 1.5f, seed + 12);
    const Cells c = cells(wx / (size * stretch), wy / size, 0.95f, seed);
    own = static_cast<float>(c.id & 1023u) / 1023.0f;
    return smooth(0.0f, 0.30f, c.edge);
}

}  // namespace

void leather(Dice& dice, Relief& relief, Label& label) {
    // 0 pebbled, 1 fine grain, 2 crocodile, 3 suede, 4 worn, 5 quilted, 6 stitched, 7 wrinkled
    const int kind = dice.whole(0, 7);
    static const char* kNames[]{
        "pebbled leather", "fine grain leather", "crocodile leather", "suede",
        "worn leather",    "quilted leather",    "stitched leather",  "wrinkled leather"};
    const Rgb base = dice.color(kHide);
    const std::uint32_t seed = dice.seed();
    const float size = kind == 1   ? dice.uniform(2.6f, 3.8f)
                       : kind == 2 ? dice.uniform(11, 17)
                                   : dice.uniform(3.6f, 7.5f);
    const float shine = kind == 3 ? 0 : dice.uniform(0.25f, 0.8f);
    const float stretch = kind == 2 ? dice.uniform(1.2f, 1.7f) : dice.uniform(0.85f, 1.3f);
    const float quilt = dice.uniform(30, 44), wear = kind == 4 ? 1.0f : dice.uniform(0, 0.25f);
    const float lay = dice.uniform(0, 6.28f), seam = dice.uniform(28, 66);
    const bool across = dice.chance(0.5f);
    const Rgb worn = mix(base, rgb(0xc9a67c), 0.55f),
              thread = mix(base, rgb(0xe8d9b5), dice.chance(0.6f) ? 0.8f : 0.1f);
    relief.each([&](float x, float y, Texel& t) {
        const float broad = fbm(x / 46, y / 46, 3, seed + 1);
        if (kind == 3) {
            // Nap: short fibres brushed different ways in patches.
            const float turn = lay + 1.4f * fbm(x / 40, y / 40, 2, seed + 2);
            const float along = x * std::cos(turn) + y * std::sin(turn),
                        over = -x * std::sin(turn) + y * std::cos(turn);
            const float nap = noise(along / 2.6f, over / 0.8f, seed + 3) +
                              0.6f * noise(along / 1.6f, over / 0.6f, seed + 4);
            const float brushed = smooth(-0.15f, 0.15f, fbm(x / 30 + 9, y / 30, 2, seed + 5));
            t.color = base * (0.92f + 0.20f * brushed + 0.10f * nap + 0.12f * broad);
            t.height = 0.55f * nap + 0.9f * broad;
            return;
        }
        float own = 0;
        float pebble = pebbles(x, y, size, stretch, seed, own);
        float height = pebble * (kind == 2 ? 1.9f : 0.26f * size) * (0.75f + 0.5f * own);
        float fine = 0;
        if (kind != 1) {
            float other = 0;
            fine = pebbles(x, y, kind == 2 ? 3.0f : size * 0.42f, 1, seed + 20, other);
            height += 0.30f * fine;
        }
        const float crease = ridged(x / 26, y / 26, 3, seed + 6);
        float folds = 0;
        if (kind == 7 || kind == 4) {
            const float lines =
                ridged(x / 34 + 0.3f * fbm(x / 20, y / 20, 2, seed + 7), y / 15, 3, seed + 8);
            folds = smooth(0.55f, 0.95f, lines);
            height -= (kind == 7 ? 2.3f : 1.2f) * folds;
        }
        height += 1.1f * broad;
        float stitch = 0;
        if (kind == 5) {
            // Cushions between crossing seams.
            const float a = fraction((x + y) / quilt), b = fraction((x - y) / quilt);
            const float da = std::min(a, 1 - a), db = std::min(b, 1 - b);
            const float d = std::min(da, db);
            height += 6.5f * std::sqrt(std::min(da, 0.5f) * std::min(db, 0.5f)) * 2;
            const bool first = da < db;
            const float run = first ? (x - y) : (x + y);
            if (d < 0.026f && fraction(run / 5.2f) > 0.3f) stitch = 1;
        } else if (kind == 6) {
            const float at = across ? y : x, run = across ? x : y;
            const float d = fraction(at / seam) * seam - seam * 0.5f;
            const float edge = std::abs(d);
            height += 1.6f * smooth(0, 2.0f, edge) + 1.0f * std::exp(-(edge - 5) * (edge - 5) / 14);
            if (std::abs(edge - 4.2f) < 0.95f && fraction(run / 6.0f) > 0.25f) stitch = 1;
        }
        const float rub = clamp01(
            wear * (1.5f * smooth(-0.15f, 0.5f, broad + 0.5f * fbm(x / 11, y / 11, 3, seed + 9))));
        Rgb color = base * (0.86f + 0.14f * own + 0.12f * broad);
        color = mix(color * 0.62f, color, 0.35f + 0.65f * pebble);
        color = mix(color, worn * (0.9f + 0.2f * fine), rub * (0.35f + 0.65f * pebble));
        color = mix(color, base * 0.45f, 0.6f * folds);
        if (kind == 4) color = color * (1 - 0.18f * smooth(0.75f, 1, crease));
        t.color = color;
        t.height = height;
        t.shine = shine * (0.4f + 0.6f * pebble) * (1 - 0.5f * rub);
        if (stitch > 0) {
            t.color = thread;
            t.height = height + 0.7f;
            t.shine = 0.05f;
        }
    });
    label.name = kNames[kind];
    label.tags = {"hide", "skin", "upholstery"};
    if (kind == 2) label.tags.insert(label.tags.end(), {"reptile", "alligator"});
    if (kind == 5 || kind == 6) label.tags.push_back("stitching");
    if (kind == 4) label.tags.insert(label.tags.end(), {"old", "aged"});
    label.light.relief = kind == 1 ? 0.95f : 0.8f;
    label.light.elevation_deg = dice.uniform(36, 52);
    label.light.gloss = dice.uniform(10, 26);
    label.light.highlight = 0.42f;
    label.light.ambient = 0.3f;
}

void scales(Dice& dice, Relief& relief, Label& label) {
    // 0 fish, 1 snake, 2 lizard, 3 dragon
    const int kind = dice.whole(0, 3);
    static const char* kNames[]{"fish scales", "snake skin", "lizard skin", "dragon scales"};
    constexpr std::uint32_t kFish[]{0x8b9aa3, 0xa68a52, 0x5d7d86, 0xc0b6a0, 0x6f8f6a, 0xb8643a};
    constexpr std::uint32_t kReptile[]{0x6b6a3b, 0x4c5a34, 0x7d6a4a, 0x93844f,
                                       0x3f4a3f, 0x5b4331, 0x8d4a2a, 0x2f5547};
    const Rgb base = kind == 0 ? dice.color(kFish) : dice.color(kReptile),
              mark = dice.color(kReptile) * 0.6f;
    const std::uint32_t seed = dice.seed();
    const float w = kind == 2 ? dice.uniform(5, 8) : dice.uniform(9, 16),
                h = w * (kind == 1 ? dice.uniform(0.9f, 1.25f) : 0.55f);
    const float shine = dice.uniform(0.3f, 0.8f);
    relief.each([&](float px, float py, Texel& t) {
        const float x = px + 0.8f * fbm(px / 30, py / 30, 2, seed),
                    y = py + 0.8f * fbm(px / 30, py / 30, 2, seed + 1);
        float height = 0, own = 0, rim = 0, ridge = 0;
        int ci = 0, cj = 0;
        if (kind == 2) {
            const Cells c = cells(x / w, y / w, 0.55f, seed);
            height = 0.4f * w * smooth(0, 0.35f, c.edge);
            rim = 1 - smooth(0.02f, 0.14f, c.edge);
            own = static_cast<float>(c.id & 255u) / 255.0f;
            ci = c.ix;
            cj = c.iy;
        } else {
            // Rows overlap downwards: the lowest row whose scale covers the place lies on top.
            const int row = floor_int(y / h);
            for (int j = row + 1; j >= row - 2; --j) {
                const float shift = (j & 1) ? 0.5f : 0.0f;
                const int i = floor_int(x / w + shift);
                const float u = (x / w + shift - static_cast<float>(i) - 0.5f) * 2;
                const float v = (y - static_cast<float>(j) * h) / h;
                // Rounded below (fish), pointed (dragon), lozenge (snake).
                const float u2 = std::abs(u);
                const float outline = kind == 3 ? 1.75f - 1.15f * u2
                                      : kind == 1
                                          ? 1.5f - 1.0f * u2
                                          : 0.75f + 0.95f * std::sqrt(std::max(0.0f, 1 - u2 * u2));
                if (v > outline || v < -0.9f) continue;
                if (j == row + 1 && v < 0) {
                    if (kind != 1 || -v > 0.5f - 0.5f * u2) continue;
                }
                const float to_edge = outline - v;
                height = 0.10f * w * (1 + v) + 0.18f * w * (1 - u * u) * (kind == 1 ? 1.3f : 0.8f);
                rim = 1 - smooth(0.05f, 0.3f, to_edge);
                ridge = (kind == 3 || kind == 1) ? std::exp(-u * u * 40) : 0;
                own = hash01(seed, i, j, 1);
                ci = i;
                cj = j;
                break;
            }
        }
        const float pattern =
            fbm(static_cast<float>(ci) / 4.0f, static_cast<float>(cj) / 4.0f, 2, seed + 5);
        Rgb color = mix(base, mark, kind == 0 ? 0.0f : smooth(0.05f, 0.3f, pattern));
        color = color * (0.85f + 0.3f * own) * (1 - 0.45f * rim);
        if (kind == 0) color = mix(color, shifted(color, 0.12f * (own - 0.5f), 1.3f, 1.1f), 0.6f);
        t.color = color * (1 + 0.08f * noise(px / 1.5f, py / 3, seed + 6));
        t.height = height + 0.5f * ridge - 0.9f * rim;
        t.shine = shine;
    });
    label.name = kNames[kind];
    label.tags = {"scaly", "reptile", "animal"};
    label.light.gloss = 18;
    label.light.highlight = 0.45f;
    label.light.relief = 0.9f;
}

}  // namespace weft::starter
