#include "engine/mask/match_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mask/patch_difference.h"

namespace weft {
namespace {

constexpr float kNoiseLevels =
    3;  // mean difference of an unchanged patch one frame later, 8-bit levels
constexpr float kMatchWeight = 2;

struct BestMatches {
    int inside = std::numeric_limits<int>::max();
    int outside = std::numeric_limits<int>::max();
};

bool beside(Vec2i a, Vec2i b) {
    return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1;
}

// The best patches of both sides around one guess of where the pixel was. What lies around one of
// the `earlier` guesses was compared already.
void search_around(const MatchInput& in, Vec2i at, Vec2i guess,
                   std::initializer_list<Vec2i> earlier, BestMatches& best) {
    const int w = in.prev_frame.width(), h = in.prev_frame.height();
    const std::uint8_t* here = in.frame.pixel(at.x, at.y);
    const int u0 = std::max(kPatchRadius, guess.x - 1),
              u1 = std::min(w - 1 - kPatchRadius, guess.x + 1);
    for (int v = std::max(kPatchRadius, guess.y - 1);
         v <= std::min(h - 1 - kPatchRadius, guess.y + 1); ++v) {
        for (int u = u0; u <= u1; ++u) {
            if (std::any_of(earlier.begin(), earlier.end(), [&](Vec2i before) {
                    return beside(before, {u, v});
                }))
                continue;
            int& side = in.prev_phi.row(v)[u] > 0 ? best.inside : best.outside;
            side =
                std::min(side, patch_difference(here, in.frame.stride(), in.prev_frame.pixel(u, v),
                                                in.prev_frame.stride(), side));
        }
    }
}

// Three guesses: the surface's motion, its surroundings', and the measured one.
BestMatches best_matches(const MatchInput& in, int x, int y) {
    const Vec2i here = in.origin + Vec2i(x, y);
    const auto guess = [&](const float* d) {
        return here +
               Vec2i(static_cast<int>(std::lround(d[0])), static_cast<int>(std::lround(d[1])));
    };
    const Vec2i a = guess(in.inside_motion.pixel(x, y));
    const Vec2i b = guess(in.outside_motion.pixel(x, y));
    const Vec2i c = guess(in.flow.pixel(here.x, here.y));
    BestMatches best;
    search_around(in, Vec2i(x, y), a, {}, best);
    if (b != a) search_around(in, Vec2i(x, y), b, {a}, best);
    if (c != a && c != b) search_around(in, Vec2i(x, y), c, {a, b}, best);
    return best;
}

}  // namespace

ImageF1 match_evidence(const MatchInput& in, float band_px) {
    ImageF1 odds(in.frame.size());
    const int w = in.frame.width(), h = in.frame.height();
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = std::max(y0, kPatchRadius); y < std::min(y1, h - kPatchRadius); ++y) {
            for (int x = kPatchRadius; x < w - kPatchRadius; ++x) {
                if (std::abs(in.expected_phi.row(y)[x]) >= band_px) continue;
                const BestMatches best = best_matches(in, x, y);
                constexpr int kNone = std::numeric_limits<int>::max();
                if (best.inside == kNone || best.outside == kNone) continue;
                const float f = static_cast<float>(best.inside) / kPatchValues + kNoiseLevels;
                const float g = static_cast<float>(best.outside) / kPatchValues + kNoiseLevels;
                odds.row(y)[x] = kMatchWeight * std::log(g / f);
            }
        }
    });
    return odds;
}

}  // namespace weft
