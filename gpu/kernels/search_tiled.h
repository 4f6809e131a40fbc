#pragma once
// Register-tiled candidates, the strategy that `cuda` uses. A sum of squared differences over the
// compared pixels is Σa² − 2Σab + Σb². Σab is one dp4a for a pixel and a candidate; a thread
// takes five neighbouring candidates, so that a pixel of the sample that it has read serves five
// times from a register. Σa² and Σb² come from sums along rows: two look-ups for each run of filled
// pixels. A block takes a small tile of the target and up to 640 candidates; what it finds is added
// to the costs atomically, in integers.

#include "gpu/kernels/search_args.h"

namespace weft::kernels {

struct SearchTiled {
    using Args = SearchArgs;
    static constexpr int kThreads = 128;
    static constexpr int kTileW = 32, kTileH = 4;
    /// Candidates of a thread, side by side. Odd, so that threads side by side read different
    /// banks of shared memory.
    static constexpr int kGroup = 5;
    static constexpr int kMostRows = 32;  ///< Of candidates in a block.
    // The largest of (rows + kTileH − 1) · (kTileW + kGroup · groups) over the shapes of
    // shape_of().
    static constexpr int kSampleWords = 4 * (kTileW + kGroup * kThreads) + 64;
    static_assert(kTileW * kTileH == kThreads, "a thread loads one pixel of the target");
    static_assert(kTileW == 32, "a row of the target is one word of bits");

    struct Shared {
        u32 target[kTileH][kTileW];  ///< 0 where a pixel is not compared.
        u8 takes_part[kTileH][kTileW];
        u32 bits[kTileH];                 ///< The same, a bit for each.
        u32 squares[kTileH][kTileW + 1];  ///< Sums of a² before each pixel.
        u32 sample[kSampleWords];
        u32 some;
    };

    /// How a launch deals out the candidates: a block takes `rows` rows of `groups` groups.
    struct Shape {
        int groups, rows;
        int tiles_x, tiles_y, parts_x, parts_y;
    };
    WEFT_HD static Shape shape_of(const Args& a) {
        Shape s;
        const int all_groups = ceil_div(a.count_x, kGroup);
        s.groups = smaller(all_groups, kThreads);
        s.rows = smaller(smaller(kThreads / s.groups, kMostRows), a.count_y);
        s.tiles_x = ceil_div(a.block_w, kTileW);
        s.tiles_y = ceil_div(a.block_h, kTileH);
        s.parts_x = ceil_div(all_groups, s.groups);
        s.parts_y = ceil_div(a.count_y, s.rows);
        return s;
    }
    static int blocks(const Args& a) {
        const Shape s = shape_of(a);
        return s.tiles_x * s.tiles_y * s.parts_x * s.parts_y;
    }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared& s, const Args& a) {
        const Shape shape = shape_of(a);
        const int tile = block.index() % (shape.tiles_x * shape.tiles_y);
        const int part = block.index() / (shape.tiles_x * shape.tiles_y);
        Place p;
        p.x0 = tile % shape.tiles_x * kTileW;
        p.y0 = tile / shape.tiles_x * kTileH;
        p.first_x = part % shape.parts_x * shape.groups * kGroup;
        p.first_y = part / shape.parts_x * shape.rows;
        p.pitch = kTileW + kGroup * shape.groups;
        p.left = p.x0 - (a.lo_x + p.first_x + kGroup * shape.groups - 1);
        p.top = p.y0 - (a.lo_y + p.first_y + shape.rows - 1);

        block.each([&](int t) {
            if (t == 0) s.some = 0;
        });
        block.each([&](int t) {
            const int x = t % kTileW, y = t / kTileW;
            const u32 word = block_pixel(a, p.x0 + x, p.y0 + y);
            s.target[y][x] = word & kColour;
            s.takes_part[y][x] = word != 0;
            if (word) s.some = 1;  // Whoever writes it writes the same.
        });
        if (!s.some) return;
        block.each([&](int t) {
            load_sample(s, a, shape, p, t);
            if (t % kTileW == 0) sum_row(s, t / kTileW);
        });
        block.each([&](int t) {
            const int row = t / shape.groups, group = t % shape.groups;
            if (row >= shape.rows || p.first_y + row >= a.count_y) return;
            compare(s, a, shape, p, row, group);
        });
    }

  private:
    // Where a block's tile lies in the target, and where its part of the sample begins.
    struct Place {
        int x0, y0, first_x, first_y, pitch, left, top;
    };

    WEFT_HD static void load_sample(Shared& s, const Args& a, const Shape& shape, const Place& p,
                                    int t) {
        const int words = (shape.rows + kTileH - 1) * p.pitch;
        for (int i = t; i < words; i += kThreads) {
            const int x = p.left + i % p.pitch, y = p.top + i / p.pitch;
            s.sample[i] = in_window(a, x, y) ? window_pixel(a, x, y) : 0;
        }
    }

    WEFT_HD static void sum_row(Shared& s, int y) {
        u32 sum = 0, bits = 0;
        for (int x = 0; x < kTileW; ++x) {
            s.squares[y][x] = sum;
            sum = dot_bytes(s.target[y][x], s.target[y][x], sum);
            bits |= u32{s.takes_part[y][x]} << x;
        }
        s.squares[y][kTileW] = sum;
        s.bits[y] = bits;
    }

    WEFT_HD static void compare(const Shared& s, const Args& a, const Shape& shape, const Place& p,
                                int row, int group) {
        u32 dot[kGroup] = {}, squares[kGroup] = {}, count[kGroup] = {};
        const int first = p.first_x + kGroup * group;
        for (int y = 0; y < kTileH; ++y) {
            const int sample_y = p.y0 + y - (a.lo_y + p.first_y + row);
            if (s.bits[y] == 0 || sample_y < 0 || sample_y >= a.window_h) continue;
            // Candidate c of this thread sees column x + kGroup − 1 − c of `line` beside column x.
            const u32* line = s.sample + (y + shape.rows - 1 - row) * p.pitch +
                              kGroup * (shape.groups - 1 - group);
            u32 seen[kTileW + kGroup - 1];
            WEFT_UNROLL
            for (int x = 0; x < kTileW + kGroup - 1; ++x)
                seen[x] = line[x];
            WEFT_UNROLL
            for (int x = 0; x < kTileW; ++x) {
                const u32 word = s.target[y][x];
                WEFT_UNROLL
                for (int c = 0; c < kGroup; ++c)
                    dot[c] = dot_bytes(word, seen[x + kGroup - 1 - c], dot[c]);
            }
            add_squares(s, a, p, y, sample_y, first, squares, count);
        }
        WEFT_UNROLL
        for (int c = 0; c < kGroup; ++c) {
            if (first + c >= a.count_x || count[c] == 0) continue;
            Cost& cost = a.costs[(p.first_y + row) * a.count_x + first + c];
            atomic_add(&cost.ssd, u64{squares[c] - 2 * dot[c]} * a.weight);
            atomic_add(&cost.weight, u64{count[c]} * a.weight);
        }
    }

    // Σa² + Σb² over the runs of one row, each clipped to what the window reaches.
    WEFT_HD static void add_squares(const Shared& s, const Args& a, const Place& p, int y,
                                    int sample_y, int first, u32* squares, u32* count) {
        const u32* before =
            a.squares + static_cast<u64>(sample_y) * static_cast<u64>(a.squares_pitch);
        for (u32 left = s.bits[y]; left != 0;) {
            const int begin = lowest_bit(left);
            const u32 after = ~(left >> begin);
            const int end = after == 0 ? kTileW : begin + lowest_bit(after);
            left = end >= kTileW ? 0 : left >> end << end;
            WEFT_UNROLL
            for (int c = 0; c < kGroup; ++c) {
                const int shift = p.x0 - (a.lo_x + first + c);  // target column → sample column
                const int x0 = larger(begin, -shift), x1 = smaller(end, a.window_w - shift);
                if (x1 <= x0) continue;
                squares[c] +=
                    s.squares[y][x1] - s.squares[y][x0] + before[x1 + shift] - before[x0 + shift];
                count[c] += static_cast<u32>(x1 - x0);
            }
        }
    }
};

}  // namespace weft::kernels
