#pragma once
// The paper's second strategy, candidate-level: a thread block takes a few neighbouring candidates,
// reads the tiles of the canvas and of the sample that they share once, into shared memory, and
// needs no other block.

#include "gpu/kernels/search_args.h"

namespace weft::kernels {

struct SearchCandidateLevel {
    using Args = SearchArgs;
    static constexpr int kThreads = 128;
    static constexpr int kCandidates = 4;  ///< Side by side.
    static constexpr int kTileW = 32, kTileH = 8;
    static constexpr int kSampleW = kTileW + kCandidates - 1;
    struct Shared {
        u32 target[kTileH][kTileW];
        u32 sample[kTileH][kSampleW];
        u64 ssd[kThreads], weight[kThreads];
        u32 some[2];  ///< Of tiles in turn, so that clearing one cannot meet the last read.
    };
    struct Sums {
        u64 ssd[kCandidates], weight[kCandidates];
    };

    static int blocks(const Args& a) { return ceil_div(a.count_x, kCandidates) * a.count_y; }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared& s, const Args& a) {
        auto sums = block.template local<Sums>();
        const int groups = ceil_div(a.count_x, kCandidates);
        const int first = block.index() % groups * kCandidates;
        const int tx = a.lo_x + first, ty = a.lo_y + block.index() / groups;
        block.each([&](int t) { sums[t] = Sums{}; });
        int turn = 0;
        for (int y0 = 0; y0 < a.block_h; y0 += kTileH) {
            for (int x0 = 0; x0 < a.block_w; x0 += kTileW) {
                turn = 1 - turn;
                load(block, s, a, x0, y0, tx, ty, s.some[turn]);
                if (s.some[turn]) add(block, s, a, x0, y0, tx, ty, sums);
            }
        }
        for (int c = 0; c < kCandidates; ++c) {
            block.each([&](int t) {
                s.ssd[t] = sums[t].ssd[c];
                s.weight[t] = sums[t].weight[c];
            });
            for (int half = kThreads / 2; half > 0; half /= 2) {
                block.each([&](int t) {
                    if (t >= half) return;
                    s.ssd[t] += s.ssd[t + half];
                    s.weight[t] += s.weight[t + half];
                });
            }
            block.each([&](int t) {
                if (t != 0 || first + c >= a.count_x) return;
                Cost& cost = a.costs[(ty - a.lo_y) * a.count_x + first + c];
                cost.ssd += s.ssd[0] * a.weight;
                cost.weight += s.weight[0] * a.weight;
            });
        }
    }

  private:
    template <class Block>
    WEFT_HD static void load(Block& block, Shared& s, const Args& a, int x0, int y0, int tx, int ty,
                             u32& some) {
        block.each([&](int t) {
            if (t == 0) some = 0;
        });
        block.each([&](int t) {
            for (int i = t; i < kTileH * kTileW; i += kThreads) {
                const int x = i % kTileW, y = i / kTileW;
                const u32 word = block_pixel(a, x0 + x, y0 + y);
                s.target[y][x] = word;
                if (word) some = 1;  // Whoever writes it writes the same.
            }
            for (int i = t; i < kTileH * kSampleW; i += kThreads) {
                // Candidate c sees sample column x + kCandidates − 1 − c beside target column x.
                const int x = i % kSampleW, y = i / kSampleW;
                const int sx = x0 - tx - (kCandidates - 1) + x, sy = y0 - ty + y;
                s.sample[y][x] = in_window(a, sx, sy) ? window_pixel(a, sx, sy) : 0;
            }
        });
    }

    template <class Block, class Local>
    WEFT_HD static void add(Block& block, const Shared& s, const Args& a, int x0, int y0, int tx,
                            int ty, Local& sums) {
        block.each([&](int t) {
            for (int i = t; i < kTileH * kTileW; i += kThreads) {
                const int x = i % kTileW, y = i / kTileW;
                const u32 word = s.target[y][x];
                if (!word) continue;
                for (int c = 0; c < kCandidates; ++c) {
                    if (!in_window(a, x0 + x - tx - c, y0 + y - ty)) continue;
                    sums[t].ssd[c] += squared_distance(word, s.sample[y][x + kCandidates - 1 - c]);
                    sums[t].weight[c] += 1;
                }
            }
        });
    }
};

}  // namespace weft::kernels
