#include "texture_db/starter/units.h"

namespace weft::starter {

StarterUnit brick_unit(int kind, float w, float h) {
    switch (kind) {
        case 1:
            return {2, {Vec2(1.5f * w, 0), Vec2(0.75f * w, h)}};
        case 2:
            return {2, {Vec2(w, 0), Vec2(0, 2 * h)}};
        case 3:
            return {2, {Vec2(w, 0), Vec2(0, h)}};
        case 4:
            return {2, {Vec2(2 * h, 2 * h), Vec2(2 * h, -2 * h)}};
        case 5:
            return {2, {Vec2(h, h), Vec2(2 * h, -2 * h)}};
        default:
            return {2, {Vec2(w, 0), Vec2(0.5f * w, h)}};
    }
}

StarterUnit tile_unit(int kind, float size, bool checkered) {
    const float diagonal = 0.7071f * size;
    switch (kind) {
        case 1:
            return {2, {Vec2(size, size), Vec2(size, -size)}};
        case 2:
            return {2, {Vec2(0.866f * size, 0), Vec2(0.433f * size, 0.75f * size)}};
        case 4:
            return {2, {Vec2(1.5f * size, 0), Vec2(0.75f * size, 0.62f * size)}};
        case 6:
            if (checkered) return {2, {Vec2(2 * diagonal, 0), Vec2(0, 2 * diagonal)}};
            return {2, {Vec2(diagonal, diagonal), Vec2(diagonal, -diagonal)}};
        default:
            return {2, {Vec2(size, 0), Vec2(0, size)}};
    }
}

StarterUnit wallpaper_unit(int kind, float w, float h) {
    if (kind == 1) return {1, {Vec2(0.5f * w, 0), Vec2(0, 0)}};
    if (kind == 3) return {2, {Vec2(2 * w, 0), Vec2(0, h)}};
    return {2, {Vec2(w, 0.5f * h), Vec2(0, h)}};
}

StarterUnit roof_unit(int kind, float w, float h) {
    if (kind == 1) return {2, {Vec2(w, 0), Vec2(0.5f * w, h)}};
    if (kind == 2) return {2, {Vec2(w, 0), Vec2(0.5f * w, 0.62f * h)}};
    if (kind == 3) return {2, {Vec2(w, 0), Vec2(0, h)}};
    return {};  // rows that are shifted by chance
}

StarterUnit knit_unit(int stitches, int rows, float w, float h) {
    return {2, {Vec2(static_cast<float>(stitches) * w, 0), Vec2(0, static_cast<float>(rows) * h)}};
}

StarterUnit cloth_unit(float step, float turn, bool both_ways) {
    const float s = step / (1 + turn * turn);
    if (both_ways) return {2, {Vec2(s, turn * s), Vec2(-turn * s, s)}};
    return {1, {Vec2(s, turn * s), Vec2(0, 0)}};
}

}  // namespace weft::starter
