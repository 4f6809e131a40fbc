// Woven fabric and knit, yarn by yarn.

#include <algorithm>
#include <array>
#include <string>

#include "texture_db/starter/families.h"
#include "texture_db/starter/units.h"

namespace weft::starter {
namespace {

constexpr std::uint32_t kCloth[]{0xb9a37f, 0xd8cdb6, 0x7b2d2b, 0x29406b, 0x3f5a3c, 0x8d8f94,
                                 0x2b2c31, 0xc8842f, 0x5e3c5e, 0xe3dccd, 0x6d7f93, 0x9c5b3b,
                                 0x4a6f73, 0xb45a5f, 0x8a7a3f, 0xd3b3a5};
constexpr std::uint32_t kWool[]{0xd9cfbb, 0x8f8a84, 0x5b2a33, 0x2f4a63, 0x58694a,
                                0xc2542f, 0xd6a03a, 0x3a3a40, 0xe7e2d8, 0x7d5a41,
                                0x93a6b8, 0xb98a9a, 0x3f6b66, 0x9b3434};

enum class Weave { kPlain, kTwill, kTwill31, kSatin, kBasket, kHerringbone };

// Whether the warp lies on top at this crossing.
bool warp_on_top(Weave weave, int i, int j) {
    const auto mod = [](int a, int n) { return ((a % n) + n) % n; };
    switch (weave) {
        case Weave::kPlain:
            return mod(i + j, 2) == 0;
        case Weave::kTwill:
            return mod(i + j, 4) < 2;
        case Weave::kTwill31:
            return mod(i + j, 4) < 1;
        case Weave::kSatin:
            return mod(i * 3 + j, 5) == 0;
        case Weave::kBasket:
            return mod(floor_int(static_cast<float>(i) / 2) + floor_int(static_cast<float>(j) / 2),
                       2) == 0;
        case Weave::kHerringbone:
            return mod((mod(i, 16) < 8 ? i : -i - 1) + j, 4) < 2;
    }
    return false;
}

struct Yarn {
    float height = -10;
    float across = 0, along = 0;
    int number = 0;
};

// Stripes of a tartan: widths in yarns and colours, mirrored.
struct Sett {
    std::vector<std::pair<int, Rgb>> stripes;
    [[nodiscard]] int half() const {
        int yarns = 0;
        for (const auto& [width, color] : stripes)
            yarns += width;
        return yarns;
    }
    [[nodiscard]] Rgb color(int yarn) const {
        const int period = half();
        int at = ((yarn % (2 * period)) + 2 * period) % (2 * period);
        if (at >= period) at = 2 * period - 1 - at;
        for (const auto& [width, color] : stripes) {
            if (at < width) return color;
            at -= width;
        }
        return stripes.back().second;
    }
};

StarterUnit knit_unit_of(int kind, int rib, int stripe, int motif, float w, float h) {
    constexpr std::array<int, 4> kMotifs{4, 2, 8, 6};
    switch (kind) {
        case 1:
            return knit_unit(2 * rib, 1, w, h);
        case 3:
            return knit_unit(1, 2, w, h);
        case 4:  // eight rows a band; slanting stripes meet theirs again after three
            return knit_unit(kMotifs[static_cast<std::size_t>(motif)], motif == 3 ? 24 : 8, w, h);
        case 5:
            return knit_unit(1, 2 * stripe, w, h);
        case 7:
            return knit_unit(6, 1, w, h);
        default:
            return knit_unit(1, 1, w, h);
    }
}

}  // namespace

void weave(Dice& dice, Relief& relief, Label& label) {
    // 0 linen, 1 burlap, 2 denim, 3 tartan, 4 gingham, 5 twill, 6 herringbone, 7 basket, 8 satin,
    // 9 stripes
    const int kind = dice.whole(0, 9);
    static const char* kNames[]{
        "linen",        "burlap", "denim",        "tartan", "gingham", "twill", "herringbone tweed",
        "basket weave", "satin",  "striped cloth"};
    Weave weave = Weave::kPlain;
    float width = dice.uniform(3.0f, 5.5f), gap = dice.uniform(0.0f, 0.12f), crimp = 0.9f;
    float uneven = dice.uniform(0.08f, 0.2f), fibres = dice.uniform(0.1f, 0.2f);
    Rgb warp = dice.color(kCloth), weft = warp;
    const std::uint32_t seed = dice.seed();
    Sett sett, other;
    switch (kind) {
        case 0:
            warp = weft = mix(dice.color(kCloth), rgb(0xd9ccb4), dice.uniform(0, 0.8f));
            gap = dice.uniform(0.1f, 0.3f);
            uneven = 0.3f;
            break;
        case 1:
            width = dice.uniform(5.5f, 9.0f);
            gap = dice.uniform(0.28f, 0.5f);
            uneven = dice.uniform(0.3f, 0.45f);
            fibres = 0.3f;
            warp = weft = shifted(rgb(0xb08c58), dice.uniform(-0.02f, 0.02f),
                                  dice.uniform(0.6f, 1.1f), dice.uniform(0.75f, 1.2f));
            break;
        case 2:
            weave = Weave::kTwill31;
            width = dice.uniform(2.6f, 4.4f);
            weft = shifted(rgb(0x2f4468), dice.uniform(-0.02f, 0.02f), dice.uniform(0.7f, 1.2f),
                           dice.uniform(0.6f, 1.7f));
            warp = mix(rgb(0xd6d7d8), weft, dice.uniform(0.0f, 0.35f));
            break;
        case 3:
        case 4:
        case 9: {
            width = dice.uniform(2.4f, 3.6f);
            weave = kind == 3 ? Weave::kTwill : Weave::kPlain;
            if (kind == 4) {
                const int n = dice.whole(4, 8);
                sett.stripes = {{n, rgb(0xf1eee6)}, {n, dice.color(kCloth)}};
            } else {
                sett.stripes = {{dice.whole(4, 9), warp},
                                {dice.whole(1, 3), dice.color(kCloth)},
                                {dice.whole(3, 6), dice.color(kCloth)},
                                {1, dice.color(kCloth)}};
            }
            other = sett;
            if (kind == 9) other.stripes = {{1, sett.stripes[0].second}};
            break;
        }
        case 5:
            weave = Weave::kTwill;
            weft = mix(warp, dice.color(kCloth), dice.uniform(0.1f, 0.6f));
            break;
        case 6:
            weave = Weave::kHerringbone;
            width = dice.uniform(2.8f, 4.2f);
            weft = mix(dice.color(kCloth), rgb(0xd5cdbf), 0.4f);
            break;
        case 7:
            weave = Weave::kBasket;
            weft = mix(warp, dice.color(kCloth), dice.uniform(0, 0.3f));
            width = dice.uniform(3.4f, 6.0f);
            break;
        default:
            weave = Weave::kSatin;
            width = dice.uniform(1.8f, 2.6f);
            crimp = 0.35f;
            uneven = 0.05f;
            fibres = 0.08f;
            break;
    }
    const float twist = dice.uniform(0.6f, 1.4f),
                turn = dice.chance(0.3f) ? dice.uniform(-0.12f, 0.12f) : 0;
    const float wave = width * dice.uniform(0.05f, 0.16f),
                folds = dice.chance(0.3f) ? dice.uniform(1, 3) : 0;
    const bool colored = !sett.stripes.empty();
    relief.each([&](float px, float py, Texel& t) {
        const float x0 = px + turn * py, y0 = py - turn * px;
        const float x = x0 + wave * fbm(px / 22, py / 22, 2, seed) +
                        uneven * 1.6f * noise(px / 60, py / 7, seed + 1);
        const float y = y0 + wave * fbm(px / 22, py / 22, 2, seed + 2) +
                        uneven * 1.6f * noise(px / 7, py / 60, seed + 3);
        const int i = floor_int(x / width), j = floor_int(y / width);
        const float u = 2 * (x / width - static_cast<float>(i)) - 1,
                    v = 2 * (y / width - static_cast<float>(j)) - 1;
        // How high a yarn runs between this crossing and its neighbours: a smooth wave.
        const auto level = [&](bool is_warp) {
            const float s = is_warp ? v : u;
            const int di = is_warp ? 0 : (s < 0 ? -1 : 1), dj = is_warp ? (s < 0 ? -1 : 1) : 0;
            const float here = warp_on_top(weave, i, j) == is_warp ? 1.0f : -1.0f;
            const float next = warp_on_top(weave, i + di, j + dj) == is_warp ? 1.0f : -1.0f;
            return here + (next - here) * smooth(0, 1, std::abs(s)) * 0.5f;
        };
        Yarn best;
        bool best_warp = false;
        for (const bool is_warp : {true, false}) {
            const int number = is_warp ? i : j;
            const float thick =
                1 - gap - uneven * hash01(seed, number, is_warp ? 1 : 2) -
                0.5f * uneven *
                    (1 + noise((is_warp ? y : x) / 9, static_cast<float>(number) * 3.7f, seed + 4));
            const float a = (is_warp ? u : v) / std::max(thick, 0.2f);
            if (std::abs(a) >= 1) continue;
            const float h =
                0.5f * width * (std::sqrt(1 - a * a) * 0.8f + crimp * 0.55f * level(is_warp));
            if (h > best.height) {
                best = {h, a, is_warp ? y : x, number};
                best_warp = is_warp;
            }
        }
        if (best.height < -9) {
            t.color = (colored ? sett.color(i) : mix(warp, weft, 0.5f)) * 0.35f;
            t.height = -0.8f * width;
            return;
        }
        Rgb color = best_warp ? warp : weft;
        if (colored) color = best_warp ? sett.color(best.number) : other.color(best.number);
        // Plies twisted round the yarn, fibres along them, and every yarn a little different.
        const float ply = std::sin((best.along * twist / width + best.across * 0.7f) * 6.2831853f);
        const float hair = noise(best.along * 1.6f + best.across * 3,
                                 best.across * 4 + static_cast<float>(best.number) * 5, seed + 6);
        const float own = hash01(seed, best.number, best_warp ? 5 : 6) - 0.5f;
        t.color = color * (1 + 0.07f * ply + fibres * hair + 0.16f * own);
        t.height = best.height + 0.05f * width * ply + fibres * hair +
                   folds * fbm(px / 55, py / 55, 2, seed + 8);
        t.shine = kind == 8 ? 0.5f : 0.05f;
    });
    label.name = kNames[kind];
    if (colored)
        label.unit = cloth_unit(2 * static_cast<float>(sett.half()) * width, turn, kind != 9);
    label.tags = {"woven", "cloth", "textile"};
    if (kind == 3 || kind == 4) label.tags.insert(label.tags.end(), {"checked", "plaid"});
    if (kind == 9) label.tags.push_back("striped");
    if (kind == 1) label.tags.insert(label.tags.end(), {"sackcloth", "jute", "coarse"});
    if (kind == 2) label.tags.insert(label.tags.end(), {"jeans", "cotton"});
    label.light.relief = dice.uniform(0.5f, 0.8f);
    label.light.elevation_deg = dice.uniform(42, 58);
    label.light.gloss = 12;
    label.light.highlight = kind == 8 ? 0.35f : 0.2f;
}

void knit(Dice& dice, Relief& relief, Label& label) {
    // 0 stockinette, 1 rib, 2 purl, 3 garter, 4 fair isle, 5 stripes, 6 marled, 7 cable
    const int kind = dice.whole(0, 7);
    static const char* kNames[]{"stockinette knit", "rib knit",     "purl knit",   "garter knit",
                                "fair isle knit",   "striped knit", "marled knit", "cable knit"};
    const float w = dice.uniform(9.5f, 16), h = w * dice.uniform(0.68f, 0.85f);
    const Rgb main = dice.color(kWool), second = kind >= 4 && kind <= 6 ? dice.color(kWool) : main;
    const Rgb third = dice.color(kWool);
    const std::uint32_t seed = dice.seed();
    const int rib = dice.whole(1, 3), stripe = dice.whole(2, 4), motif = dice.whole(0, 3);
    const float fuzz = dice.uniform(0.08f, 0.28f), fat = dice.uniform(0.30f, 0.37f);
    const float cable = dice.uniform(3.5f, 5) * h;
    const auto mod = [](int a, int n) { return ((a % n) + n) % n; };
    const auto stitch_color = [&](int i, int j) {
        if (kind == 5) return mod(j, 2 * stripe) < stripe ? main : second;
        if (kind == 6) return hash01(seed, i, j, 9) < 0.5f ? main : second;
        if (kind == 4) {
            const int band = mod(j, 8);
            if (band == 0 || band == 7) return third;
            if (motif == 0) return mod(i + j, 4) == 0 || mod(i - j, 4) == 0 ? second : main;
            if (motif == 1) return mod(i, 2) == mod(j, 2) ? second : main;
            if (motif == 2) return std::abs(mod(i, 8) - 4) + std::abs(band - 4) < 3 ? second : main;
            return mod(i + (band < 4 ? j : -j), 6) < 2 ? second : main;
        }
        return main;
    };
    const auto purled = [&](int i, int j) {
        if (kind == 2) return true;
        if (kind == 1) return mod(i, 2 * rib) >= rib;
        if (kind == 3) return mod(j, 2) == 0;
        if (kind == 7) return mod(i, 6) >= 4;
        return false;
    };
    relief.each([&](float px, float py, Texel& t) {
        float x = px + 0.9f * fbm(px / 26, py / 26, 2, seed),
              y = py + 0.9f * fbm(px / 26, py / 26, 2, seed + 1);
        float lift = 0;
        if (kind == 7) {
            // Four columns cross over each other like a rope.
            const float band = fraction(x / (6 * w)) * 6;
            if (band < 4) {
                const float phase = y / cable * 6.2831853f;
                const float side = (band - 2) / 2;
                x += w * 0.95f * std::sin(phase) * (1 - side * side);
                lift = 0.32f * w * (1 - side * side) * (0.6f + 0.4f * std::cos(phase) * side);
            }
        }
        const int ci = floor_int(x / w), cj = floor_int(y / h);
        float best = -9, best_a = 0, best_b = 0;
        Rgb color = main;
        for (int j = cj - 1; j <= cj + 1; ++j) {
            for (int i = ci - 1; i <= ci + 1; ++i) {
                const float sx =
                    (static_cast<float>(i) + 0.5f) * w + 0.5f * (hash01(seed, i, j, 1) - 0.5f);
                const float sy =
                    (static_cast<float>(j) + 0.5f) * h + 0.5f * (hash01(seed, i, j, 2) - 0.5f);
                const bool purl = purled(i, j);
                for (const float side : {-1.0f, 1.0f}) {
                    // A leg of the V; of a purl stitch one sees the arch instead.
                    const float lean = purl ? 1.25f : 0.46f;
                    const float dx = x - sx - side * w * (purl ? 0.24f : 0.235f);
                    const float dy = y - sy - (purl ? -side * 0.0f : 0);
                    const float ux = side * std::sin(lean),
                                uy = purl ? std::cos(lean) : -std::cos(lean);
                    const float along = dx * ux + dy * uy, across = -dx * uy + dy * ux;
                    const float a = across / (w * fat), b = along / (purl ? w * 0.42f : h * 0.82f);
                    const float r = a * a + b * b * b * b;
                    if (r >= 1) continue;
                    const float z = (purl ? 0.34f : 0.38f) * w * std::sqrt(1 - r) -
                                    (purl ? 0.02f : 0.10f) * w * b +
                                    (kind == 1 && purl ? -0.22f * w : 0) +
                                    (kind == 7 && purl ? -0.15f * w : 0);
                    if (z > best) {
                        best = z;
                        best_a = a * side;
                        best_b = along;
                        color = stitch_color(i, j);
                    }
                }
            }
        }
        if (best < -8) {
            t.color = main * 0.28f;
            t.height = -0.12f * w;
            return;
        }
        const float ply = std::sin(best_b * 1.5f + best_a * 2.6f);
        const float hair = noise(best_b * 1.3f + px * 0.3f, best_a * 5 + py * 0.3f, seed + 3);
        t.color =
            color * (1 + 0.06f * ply + fuzz * hair + 0.05f * fbm(px / 3, py / 3, 2, seed + 4));
        t.height = best + lift + 0.22f * ply + 0.8f * fuzz * hair;
    });
    // Loose fibres over the yarn.
    scatter(relief, 3.2f, 6, [&](int i, int j) {
        if (hash01(seed, i, j, 20) > fuzz * 1.8f) return;
        Strand s;
        s.x = (static_cast<float>(i) + hash01(seed, i, j, 21)) * 3.2f;
        s.y = (static_cast<float>(j) + hash01(seed, i, j, 22)) * 3.2f;
        s.angle = 6.28f * hash01(seed, i, j, 23);
        s.bend = 3 * hash01(seed, i, j, 24) - 1.5f;
        s.length = 3 + 4 * hash01(seed, i, j, 25);
        s.width = 0.42f;
        s.root = s.tip = mix(main, rgb(0xffffff), 0.25f);
        s.base = 0.38f * w;
        draw(relief, s);
    });
    label.name = kNames[kind];
    label.unit = knit_unit_of(kind, rib, stripe, motif, w, h);
    if (kind == 7) label.unit.steps[1] = Vec2(0, cable);
    label.tags = {"knitted", "wool", "sweater", "textile"};
    if (kind == 5) label.tags.push_back("striped");
    if (kind == 4) label.tags.push_back("patterned");
    label.light.relief = dice.uniform(0.55f, 0.8f);
    label.light.elevation_deg = dice.uniform(45, 60);
    label.light.occlusion = 0.75f;
    label.light.highlight = 0;
}

}  // namespace weft::starter
