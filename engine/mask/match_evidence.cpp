#include "engine/mask/match_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mask/tuning.h"

namespace weft {
namespace {

constexpr int kRadius = 2;  // 5×5 patches
constexpr int kPatchValues = 3 * (2 * kRadius + 1) * (2 * kRadius + 1);

int patch_difference(const std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b,
                     std::ptrdiff_t b_stride) {
    int sum = 0;
    for (int v = -kRadius; v <= kRadius; ++v) {
        const std::uint8_t* p = a + v * a_stride - 3 * kRadius;
        const std::uint8_t* q = b + v * b_stride - 3 * kRadius;
        for (int i = 0; i < 3 * (2 * kRadius + 1); ++i) sum += std::abs(p[i] - q[i]);
    }
    return sum;
}

struct BestMatches {
    int inside = std::numeric_limits<int>::max();
    int outside = std::numeric_limits<int>::max();
};

// The best patches of both sides around one guess of where the pixel was.
void search_around(const MatchInput& in, int x, int y, Vec2 motion, BestMatches& best) {
    const int w = in.prev_frame.width(), h = in.prev_frame.height();
    const int cx = in.origin.x + x + static_cast<int>(std::lround(motion.x));
    const int cy = in.origin.y + y + static_cast<int>(std::lround(motion.y));
    const std::uint8_t* here = in.frame.pixel(x, y);
    for (int v = std::max(kRadius, cy - 1); v <= std::min(h - 1 - kRadius, cy + 1); ++v) {
        for (int u = std::max(kRadius, cx - 1); u <= std::min(w - 1 - kRadius, cx + 1); ++u) {
            const int d = patch_difference(here, in.frame.stride(), in.prev_frame.pixel(u, v),
                                           in.prev_frame.stride());
            int& side = in.prev_phi.row(v)[u] > 0 ? best.inside : best.outside;
            side = std::min(side, d);
        }
    }
}

}  // namespace

ImageF1 match_evidence(const MatchInput& in, float band_px) {
    ImageF1 odds(in.frame.size());
    const int w = in.frame.width(), h = in.frame.height();
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = std::max(y0, kRadius); y < std::min(y1, h - kRadius); ++y) {
            for (int x = kRadius; x < w - kRadius; ++x) {
                if (std::abs(in.expected_phi.row(y)[x]) >= band_px) continue;
                const float* a = in.inside_motion.pixel(x, y);
                const float* b = in.outside_motion.pixel(x, y);
                const float* c = in.flow.pixel(in.origin.x + x, in.origin.y + y);
                BestMatches best;
                search_around(in, x, y, Vec2(a[0], a[1]), best);
                search_around(in, x, y, Vec2(b[0], b[1]), best);
                search_around(in, x, y, Vec2(c[0], c[1]), best);
                constexpr int kNone = std::numeric_limits<int>::max();
                if (best.inside == kNone || best.outside == kNone) continue;
                const float e = T(21);
                const float f = static_cast<float>(best.inside) / kPatchValues + e;
                const float g = static_cast<float>(best.outside) / kPatchValues + e;
                odds.row(y)[x] = std::log(g / f);
            }
        }
    });
    return odds;
}

}  // namespace weft
