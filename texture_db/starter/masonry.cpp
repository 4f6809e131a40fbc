// Brick, tiles, stone walls and cobblestones: units laid side by side.

#include <algorithm>

#include "texture_db/starter/families.h"
#include "texture_db/starter/units.h"

namespace weft::starter {
namespace {

// Distance from the border of a rounded rectangle, positive inside, in the units of the sides.
float inside_rectangle(float u, float v, float w, float h, float round) {
    const float qx = std::abs(u - 0.5f) * w - w * 0.5f + round,
                qy = std::abs(v - 0.5f) * h - h * 0.5f + round;
    const float ox = std::max(qx, 0.0f), oy = std::max(qy, 0.0f);
    return round - std::sqrt(ox * ox + oy * oy) - std::min(std::max(qx, qy), 0.0f);
}

}  // namespace

void brick(Dice& dice, Relief& relief, Label& label) {
    // 0 running, 1 Flemish, 2 English, 3 stack, 4 basket, 5 herringbone, 6 painted running, 7 worn
    // running
    const int kind = dice.whole(0, 7);
    static const char* kNames[]{"running bond brick", "Flemish bond brick", "English bond brick",
                                "stacked brick",      "basket brick",       "herringbone brick",
                                "painted brick",      "worn brick"};
    constexpr std::uint32_t kClay[]{0x9c4a32, 0x8a3b2a, 0xb5603f, 0xa8553a, 0xc08a5a,
                                    0x7a3a2e, 0xd0a878, 0x6b4438, 0xb8745a};
    constexpr std::uint32_t kPaint[]{0xe9e5dc, 0xd9d3c3, 0x9fb0b5, 0x5f6b6f, 0xc9a37a};
    constexpr std::uint32_t kMortar[]{0xb8b0a3, 0x9a948a, 0xd0cabd, 0x7d7871, 0xc2b49a};
    const Rgb clay = dice.color(kClay), mortar = dice.color(kMortar), paint = dice.color(kPaint);
    const std::uint32_t seed = dice.seed();
    const float h = dice.uniform(8.5f, 14), w = h * dice.uniform(2.5f, 3.3f),
                joint = dice.uniform(1.0f, 2.0f);
    const float variety = dice.uniform(0.15f, 0.5f),
                wear = kind == 7 ? 1.0f : dice.uniform(0, 0.35f);
    const auto mod = [](int a, int n) { return ((a % n) + n) % n; };
    relief.each([&](float px, float py, Texel& t) {
        const float x = px + 0.5f * noise(px / 9, py / 9, seed),
                    y = py + 0.5f * noise(px / 9, py / 9, seed + 1);
        float u = 0, v = 0, bw = w, bh = h;
        int i = 0, j = floor_int(y / h);
        v = fraction(y / h);
        const bool header_row = kind == 2 && mod(j, 2) == 1;
        if (kind == 1) {
            // Stretchers and headers in turn, headers over the middle of stretchers.
            const float period = w * 1.5f, at = x / period + (mod(j, 2) == 0 ? 0 : 0.5f);
            const float f = fraction(at) * 1.5f;
            i = 2 * floor_int(at) + (f < 1 ? 0 : 1);
            bw = f < 1 ? w : w * 0.5f;
            u = f < 1 ? f : (f - 1) * 2;
        } else if (header_row) {
            bw = w * 0.5f;
            i = floor_int(x / bw + 0.5f);
            u = fraction(x / bw + 0.5f);
        } else if (kind == 4) {
            const float cell = 2 * h;
            const int ci = floor_int(x / cell), cj = floor_int(y / cell);
            const bool turned = mod(ci + cj, 2) == 1;
            bw = cell;
            u = turned ? fraction(y / cell) : fraction(x / cell);
            v = turned ? fraction(x / h) : fraction(y / h);
            i = ci * 7 + (turned ? floor_int(x / h) : 0);
            j = cj * 7 + (turned ? 3 : floor_int(y / h));
        } else if (kind == 5) {
            // Herringbone of 2:1 bricks on a grid of h: diagonals of alternately lying and standing
            // ones.
            const int gx = floor_int(x / h), gy = floor_int(y / h);
            const int k = mod(gx - gy, 4);
            const bool lying = k < 2;
            bw = 2 * h;
            const float fx = fraction(x / h), fy = fraction(y / h);
            u = lying ? (static_cast<float>(k) + fx) / 2 : (static_cast<float>(3 - k) + fy) / 2;
            v = lying ? fy : fx;
            i = lying ? gx - k : gx;
            j = lying ? gy : gy - (3 - k) + 1000;
        } else {
            const float shift = kind == 3 ? 0.0f : 0.5f * static_cast<float>(mod(j, 2));
            i = floor_int(x / w + shift);
            u = fraction(x / w + shift);
        }
        const float own = hash01(seed, i, j, 1), tone = hash01(seed, i, j, 2);
        const float rough = fbm(px / 5, py / 5, 4, seed + 2),
                    grit = noise(px / 0.9f, py / 0.9f, seed + 3);
        const float chip = wear * 1.8f * std::max(0.0f, fbm(px / 6, py / 6, 3, seed + 4));
        const float d = inside_rectangle(u, v, bw, bh, 1.4f) - joint * 0.5f + 0.35f * rough - chip;
        const float face = smooth(-0.2f, 0.8f, d);
        Rgb color = shifted(clay, 0.02f * (tone - 0.5f), 1 + 0.3f * (own - 0.5f),
                            1 + variety * (own - 0.5f));
        if (hash01(seed, i, j, 3) < 0.08f) color = color * 0.6f;
        color = color * (1 + 0.13f * rough + 0.10f * grit);
        if (kind == 6) {
            const float off = smooth(0.2f, 0.35f, fbm(px / 14, py / 14, 4, seed + 5));
            color = mix(paint * (0.94f + 0.06f * own + 0.05f * rough), color, off);
        }
        if (wear > 0.5f)
            color =
                mix(color, mortar, 0.45f * smooth(0.1f, 0.5f, fbm(px / 12, py / 12, 4, seed + 6)));
        const Rgb joint_color = kind == 6 ? mix(mortar, paint, 0.75f) : mortar;
        t.color = mix(joint_color * (0.92f + 0.16f * rough + 0.12f * grit), color, face);
        t.height = 2.0f * face + 0.35f * (own - 0.5f) + 0.35f * rough + 0.22f * grit;
    });
    label.name = kNames[kind];
    label.unit = brick_unit(kind, w, h);
    label.tags = {"brickwork", "wall", "masonry"};
    if (kind == 6) label.tags.push_back("paint");
    if (kind == 7) label.tags.insert(label.tags.end(), {"old", "weathered"});
    label.light.relief = 0.85f;
    label.light.highlight = 0;
}

void tiles(Dice& dice, Relief& relief, Label& label) {
    // 0 square, 1 checker, 2 hexagon, 3 mosaic, 4 subway, 5 patterned, 6 diagonal, 7 terracotta
    const int kind = dice.whole(0, 7);
    static const char* kNames[]{"square tiles",   "checkered tiles", "hexagon tiles",
                                "mosaic tiles",   "metro tiles",     "patterned tiles",
                                "diagonal tiles", "terracotta tiles"};
    constexpr std::uint32_t kGlaze[]{0xe9e7e0, 0xbfd0d4, 0x6f98a8, 0x2f5d6b, 0xc9c3b0,
                                     0x8a3a34, 0x3d4a44, 0xd9b96a, 0x9fb49a, 0x4a4f57};
    const Rgb base = kind == 7 ? shifted(rgb(0xb5663f), dice.uniform(-0.015f, 0.015f),
                                         dice.uniform(0.7f, 1.1f), dice.uniform(0.8f, 1.15f))
                               : dice.color(kGlaze);
    const Rgb second = dice.color(kGlaze), third = dice.color(kGlaze),
              grout = dice.chance(0.7f) ? rgb(0xb5b1a8) : rgb(0x55524d);
    const std::uint32_t seed = dice.seed();
    const float size = kind == 3   ? dice.uniform(7, 11)
                       : kind == 5 ? dice.uniform(28, 44)
                                   : dice.uniform(18, 36);
    const float joint = kind == 3 ? 1.1f : dice.uniform(1.0f, 2.2f),
                shine = kind == 7 ? 0.08f : dice.uniform(0.4f, 0.9f);
    const float vary = kind == 3 ? 0.5f : dice.uniform(0.04f, 0.22f);
    const int motif = dice.whole(0, 2);
    const auto mod = [](int a, int n) { return ((a % n) + n) % n; };
    relief.each([&](float px, float py, Texel& t) {
        float x = px, y = py;
        if (kind == 6) {
            x = (px + py) * 0.7071f;
            y = (py - px) * 0.7071f;
        }
        int i = 0, j = 0;
        float d = 0, u = 0.5f, v = 0.5f;
        if (kind == 2) {
            const float s = size * 0.5f, q = x / (1.732f * s), r = y / (1.5f * s);
            const int row = floor_int(r);
            float best = 1e9f, second_best = 1e9f;
            for (int b = row - 1; b <= row + 1; ++b) {
                for (int a = floor_int(q) - 1; a <= floor_int(q) + 2; ++a) {
                    const float hx =
                        (static_cast<float>(a) + 0.5f * static_cast<float>(mod(b, 2))) * 1.732f *
                            s -
                        x;
                    const float hy = (static_cast<float>(b) + 0.5f) * 1.5f * s - y;
                    const float dist = std::sqrt(hx * hx + hy * hy);
                    if (dist < best) {
                        second_best = best;
                        best = dist;
                        i = a;
                        j = b;
                    } else if (dist < second_best) {
                        second_best = dist;
                    }
                }
            }
            d = (second_best - best) * 0.5f - joint * 0.5f;
        } else {
            const float w = kind == 4 ? size * 1.5f : size, h = kind == 4 ? size * 0.62f : size;
            j = floor_int(y / h);
            const float shift = kind == 4 ? 0.5f * static_cast<float>(mod(j, 2)) : 0.0f;
            i = floor_int(x / w + shift);
            u = fraction(x / w + shift);
            v = fraction(y / h);
            d = inside_rectangle(u, v, w, h, kind == 3 ? 1.2f : 0.8f) - joint * 0.5f;
        }
        const float own = hash01(seed, i, j, 1);
        const float face = smooth(-0.25f, 0.35f, d), pillow = smooth(0, 2.2f, d);
        Rgb color = base;
        if (kind == 1 || (kind == 6 && motif == 0)) color = mod(i + j, 2) == 0 ? base : second;
        if (kind == 3) {
            const float pick = hash01(seed, i, j, 4);
            color = pick < 0.45f ? base : pick < 0.75f ? second : mix(base, second, 0.5f);
        }
        if (kind == 5) {
            const float cu = u - 0.5f, cv = v - 0.5f;
            const float r = std::sqrt(cu * cu + cv * cv),
                        corner = std::sqrt((0.5f - std::abs(cu)) * (0.5f - std::abs(cu)) +
                                           (0.5f - std::abs(cv)) * (0.5f - std::abs(cv)));
            const float petals =
                r * (1 + 0.35f * std::cos(std::atan2(cv, cu) * (motif == 0 ? 4 : 8)));
            if (corner < 0.24f)
                color = corner > 0.17f ? second : third;
            else if (petals < 0.2f)
                color = second;
            else if (motif == 2 && std::abs(std::abs(cu) + std::abs(cv) - 0.42f) < 0.035f)
                color = third;
        }
        const float flow = fbm(px / 10, py / 10, 3, seed + 2);
        color = color * (1 + vary * (own - 0.5f) * 2) * (1 + (kind == 7 ? 0.14f : 0.03f) * flow);
        if (kind == 7) color = color * (1 + 0.08f * noise(px, py, seed + 3));
        t.color = mix(grout * (0.9f + 0.14f * noise(px / 1.2f, py / 1.2f, seed + 4)), color, face);
        const float tilt = 0.05f * ((hash01(seed, i, j, 5) - 0.5f) * u * size +
                                    (hash01(seed, i, j, 6) - 0.5f) * v * size);
        t.height = face * (0.9f + 0.7f * pillow + tilt) + 0.12f * flow;
        t.shine = shine * face;
    });
    label.name = kNames[kind];
    label.unit = tile_unit(kind, size, motif == 0);
    label.tags = {"tile", "floor", "wall", "grout"};
    if (kind == 3) label.tags.push_back("mosaic");
    if (kind == 1) label.tags.push_back("checked");
    label.light.relief = 0.8f;
    label.light.gloss = 45;
    label.light.highlight = 0.5f;
    label.light.elevation_deg = dice.uniform(48, 66);
}

void stone(Dice& dice, Relief& relief, Label& label) {
    // 0 ashlar, 1 rubble wall, 2 rock face, 3 slate layers, 4 flagstones, 5 granite
    const int kind = dice.whole(0, 5);
    static const char* kNames[]{"ashlar stone wall", "rubble stone wall", "rock face",
                                "layered slate",     "flagstones",        "granite"};
    constexpr std::uint32_t kRock[]{0x8d8a83, 0xa39b8b, 0x77736d, 0xb5a88f,
                                    0x6a6f73, 0x9c8d78, 0x5d5a57, 0xc2b59b};
    const Rgb base = dice.color(kRock), mortar = shifted(dice.color(kRock), 0, 0.6f, 0.95f);
    const std::uint32_t seed = dice.seed();
    const float size = dice.uniform(17, 30),
                lichen = dice.chance(0.4f) ? dice.uniform(0.3f, 0.9f) : 0;
    const float course = dice.uniform(13, 22), tilt = dice.uniform(-0.35f, 0.35f),
                joint = dice.uniform(0.06f, 0.12f);
    relief.each([&](float px, float py, Texel& t) {
        const float x = px + 1.6f * fbm(px / 12, py / 12, 3, seed),
                    y = py + 1.6f * fbm(px / 12, py / 12, 3, seed + 1);
        const float rough = fbm(px / 7, py / 7, 5, seed + 2, 0.55f),
                    grit = noise(px / 0.8f, py / 0.8f, seed + 3);
        float face = 1, own = 0.5f, height = 0;
        Rgb color = base;
        if (kind == 0) {
            const int j = floor_int(y / course);
            // Blocks of uneven length: the borders of a course are a jittered grid.
            const float pitch = course * 1.9f, at = x / pitch + 0.5f * static_cast<float>(j & 1);
            int i = floor_int(at);
            const auto border = [&](int k) {
                return static_cast<float>(k) + 0.5f * (hash01(seed, k, j, 1) - 0.5f);
            };
            if (at < border(i))
                --i;
            else if (at >= border(i + 1))
                ++i;
            const float v = fraction(y / course) * course;
            const float d =
                std::min({(at - border(i)) * pitch, (border(i + 1) - at) * pitch, v, course - v});
            face = smooth(0.5f, 1.9f, d + 0.5f * rough);
            own = hash01(seed, i, j, 2);
            height = 2.4f * face * smooth(0, 4, d) + 1.3f * rough;
        } else if (kind == 1 || kind == 4) {
            const Cells c =
                cells(x / size, y / (size * (kind == 1 ? 0.62f : 0.95f)), 0.85f, seed + 4);
            own = static_cast<float>(c.id & 255u) / 255.0f;
            face = smooth(joint * 0.5f, joint * 1.3f, c.edge + 0.025f * rough);
            height = (kind == 1 ? 4.2f * smooth(0, 0.42f, c.edge) : 1.3f * face) +
                     (kind == 1 ? 1.2f : 0.55f) * rough;
        } else if (kind == 2) {
            const Cells c = cells(x / size / 1.1f, y / size / 1.1f, 1, seed + 4),
                        f = cells(x / 8, y / 8, 1, seed + 5);
            own = static_cast<float>(c.id & 255u) / 255.0f;
            const float a = static_cast<float>(c.id & 63u) / 10.0f;
            const float b = static_cast<float>(f.id & 63u) / 10.0f;
            height = 5 * (c.dx * std::cos(a) + c.dy * std::sin(a)) +
                     1.9f * (f.dx * std::cos(b) + f.dy * std::sin(b)) + 2.5f * rough -
                     2.2f * (1 - smooth(0, 0.06f, c.edge));
        } else if (kind == 3) {
            const float l = y + tilt * x + 3 * fbm(px / 30, py / 16, 3, seed + 6);
            const float step = fraction(l / 6 + 0.35f * noise(px / 17, l / 40, seed + 7));
            own = hash01(seed, floor_int(l / 6),
                         floor_int(x / 40 + 0.5f * hash01(seed, floor_int(l / 6), 0)), 1);
            height = 3.2f * step + 1.0f * rough + 1.4f * own;
            color = base * (0.7f + 0.3f * step);
        } else {
            // Feldspar, quartz and mica, grain by grain.
            const Cells c = cells(x / 2.6f, y / 2.6f, 1, seed + 8);
            own = static_cast<float>(c.id & 255u) / 255.0f;
            color = own < 0.18f  ? rgb(0x2a2a2c)
                    : own < 0.5f ? mix(base, rgb(0xffffff), 0.45f)
                    : own < 0.8f ? base
                                 : mix(base, rgb(0xb08272), 0.6f);
            height = 0.3f * own;
            own = 0.5f;
        }
        if (kind != 5) color = shifted(color, 0.012f * (own - 0.5f), 1, 1 + 0.45f * (own - 0.5f));
        color = color * (1 + (kind == 5 ? 0.05f : 0.2f) * rough + 0.1f * grit);
        if (lichen > 0 && kind != 5) {
            const float green = lichen * smooth(0.15f, 0.35f, fbm(px / 16, py / 16, 4, seed + 9));
            color = mix(color, rgb(0x7f8358) * (0.9f + 0.3f * grit), green * 0.8f);
        }
        if (kind == 0 || kind == 1 || kind == 4)
            color = mix(mortar * (0.68f + 0.14f * grit), color, face);
        t.color = color;
        t.height = height + 0.25f * grit;
        t.shine = kind == 5 ? 0.35f : 0;
    });
    label.name = kNames[kind];
    label.tags = {"rock", "mineral"};
    if (kind <= 1) label.tags.insert(label.tags.end(), {"masonry", "wall"});
    if (lichen > 0) label.tags.insert(label.tags.end(), {"lichen", "mossy"});
    label.light.relief = 0.75f;
    label.light.occlusion = 0.8f;
    label.light.highlight = 0.3f;
}

void cobblestone(Dice& dice, Relief& relief, Label& label) {
    // 0 round, 1 setts in rows, 2 fan, 3 pebble paving
    const int kind = dice.whole(0, 3);
    static const char* kNames[]{"round cobbles", "stone setts", "fan cobbles", "pebble paving"};
    constexpr std::uint32_t kRock[]{0x8a8781, 0x706d69, 0x9c9284, 0x5f6164, 0xa8957c, 0x7d7f86};
    constexpr std::uint32_t kJoint[]{0x4a443b, 0x5f574a, 0x3a3833, 0x6b6250};
    const Rgb base = dice.color(kRock), joint = dice.color(kJoint);
    const std::uint32_t seed = dice.seed();
    const float size = kind == 3 ? dice.uniform(7, 11) : dice.uniform(13, 22),
                jitter = dice.uniform(0.25f, 0.6f);
    const float wet = dice.chance(0.3f) ? 0.6f : 0.1f, moss = dice.chance(0.35f) ? 0.8f : 0,
                fan = dice.uniform(48, 70);
    relief.each([&](float px, float py, Texel& t) {
        const float x = px + 0.9f * fbm(px / 8, py / 8, 2, seed),
                    y = py + 0.9f * fbm(px / 8, py / 8, 2, seed + 1);
        float d = 0, own = 0, dome = 0;
        if (kind == 0 || kind == 3) {
            const Cells a = cells(x / size, y / size, jitter + 0.25f, seed + 2);
            own = static_cast<float>(a.id & 255u) / 255.0f;
            d = a.edge * size;
            dome = std::sqrt(std::max(0.0f, 1 - std::min(1.0f, a.first * a.first * 2.3f)));
        } else {
            float row_pos = y, run = x;
            if (kind == 2) {
                // Arcs over the corners of a staggered grid.
                const int j = floor_int(y / (fan * 0.5f));
                const float cx = (std::round(x / fan - 0.5f * static_cast<float>(j & 1)) +
                                  0.5f * static_cast<float>(j & 1)) *
                                 fan;
                const float cy = static_cast<float>(j + 1) * fan * 0.5f;
                const float dx = x - cx, dy = y - cy;
                row_pos = std::sqrt(dx * dx + dy * dy);
                run = std::atan2(dy, dx) *
                          std::max(10.0f,
                                   (std::floor(row_pos / (size * 0.75f)) + 0.5f) * size * 0.75f) +
                      500 * static_cast<float>(j);
            }
            const float h = size * 0.75f, w = size * (kind == 1 ? 1.1f : 0.85f);
            const int j = floor_int(row_pos / h);
            const float shift = 0.5f * static_cast<float>(j & 1) + 0.15f * hash01(seed, j, 0, 9);
            const int i = floor_int(run / w + shift);
            const float u = fraction(run / w + shift), v = fraction(row_pos / h);
            d = inside_rectangle(u, v, w, h, 3.2f) - 0.5f - 0.6f * hash01(seed, i, j, 3);
            own = hash01(seed, i, j, 1);
            dome = std::sqrt(std::max(
                0.0f, (1 - 3.6f * (u - 0.5f) * (u - 0.5f)) * (1 - 3.6f * (v - 0.5f) * (v - 0.5f))));
        }
        const float rough = fbm(px / 5, py / 5, 4, seed + 4),
                    grit = noise(px / 0.9f, py / 0.9f, seed + 5);
        const float face = smooth(0.5f, 1.9f, d + 0.4f * rough);
        Rgb color = shifted(base, 0.02f * (own - 0.5f), 1, 0.8f + 0.4f * own) *
                    (1 + 0.16f * rough + 0.1f * grit);
        Rgb between = joint * (0.85f + 0.3f * grit);
        if (moss > 0)
            between = mix(between, rgb(0x5f6b30) * (0.8f + 0.4f * clamp01(rough + 0.5f)),
                          moss * smooth(-0.2f, 0.3f, fbm(px / 20, py / 20, 2, seed + 6)));
        t.color = mix(between, color, face);
        t.height = face * (1.2f + 3.6f * dome + 0.8f * (own - 0.5f)) + 0.5f * rough + 0.25f * grit;
        t.shine = face * wet;
    });
    label.name = kNames[kind];
    label.tags = {"cobbles", "paving", "street", "stone"};
    if (moss > 0) label.tags.push_back("mossy");
    if (wet > 0.5f) label.tags.push_back("wet");
    label.light.relief = 0.85f;
    label.light.occlusion = 0.9f;
    label.light.highlight = 0.35f;
    label.light.gloss = 22;
}

}  // namespace weft::starter
