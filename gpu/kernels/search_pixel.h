#pragma once
// The paper's first strategy, pixel-level: the threads of the whole grid share out the pixels of
// one candidate, and candidates are taken one after the other.

#include "gpu/kernels/search_args.h"

namespace weft::kernels {

struct SearchPixelLevel {
    using Args = SearchArgs;
    static constexpr int kThreads = 256;
    struct Shared {
        u32 sum[kThreads], count[kThreads];
        u32 some;
    };
    struct Mine {
        int x, y;
        u32 word;
    };

    static int blocks(const Args& a) { return ceil_div(a.block_w * a.block_h, kThreads); }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared& s, const Args& a) {
        auto mine = block.template local<Mine>();
        const int first = block.index() * kThreads;
        block.each([&](int t) {
            if (t == 0) s.some = 0;
        });
        block.each([&](int t) {
            const int x = (first + t) % a.block_w, y = (first + t) / a.block_w;
            mine[t] = {x, y, block_pixel(a, x, y)};
            if (mine[t].word) s.some = 1;  // Whoever writes it writes the same.
        });
        if (!s.some) return;
        for (int c = 0; c < a.count_x * a.count_y; ++c) {
            const int tx = a.lo_x + c % a.count_x, ty = a.lo_y + c / a.count_x;
            block.each([&](int t) {
                const int x = mine[t].x - tx, y = mine[t].y - ty;
                const bool counts = mine[t].word != 0 && in_window(a, x, y);
                s.sum[t] = counts ? squared_distance(mine[t].word, window_pixel(a, x, y)) : 0;
                s.count[t] = counts;
            });
            for (int half = kThreads / 2; half > 0; half /= 2) {
                block.each([&](int t) {
                    if (t >= half) return;
                    s.sum[t] += s.sum[t + half];
                    s.count[t] += s.count[t + half];
                });
            }
            block.each([&](int t) {
                if (t != 0 || s.count[0] == 0) return;
                atomic_add(&a.costs[c].ssd, u64{s.sum[0]} * a.weight);
                atomic_add(&a.costs[c].weight, u64{s.count[0]} * a.weight);
            });
        }
    }
};

}  // namespace weft::kernels
