#pragma once
// Selects the best cost and all that are nearly as good. One block, because a placement has only a
// few hundred to a few thousand costs.

#include "gpu/kernels/search_args.h"

namespace weft::kernels {

struct SearchResult {
    u64 ssd, weight;
    u32 best;
};

struct SelectArgs {
    const Cost* costs;
    const u8* allowed;  ///< Null: all are; else not all 0.
    u32 count;
    u32 numerator, denominator;
    SearchResult* result;
    u8* good;  ///< One byte for each candidate.
};

struct SearchSelect {
    using Args = SelectArgs;
    static constexpr int kThreads = 512;
    static constexpr u32 kNone = 0xffffffffu;
    struct Shared {
        Cost cost[kThreads];
        u32 index[kThreads];
    };

    static int blocks(const Args&) { return 1; }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared& s, const Args& a) {
        block.each([&](int t) {
            s.index[t] = kNone;
            for (u32 i = static_cast<u32>(t); i < a.count; i += kThreads) {
                if (a.allowed && !a.allowed[i]) continue;
                take_better(s, t, a.costs[i], i);
            }
        });
        for (int half = kThreads / 2; half > 0; half /= 2) {
            block.each([&](int t) {
                if (t < half && s.index[t + half] != kNone)
                    take_better(s, t, s.cost[t + half], s.index[t + half]);
            });
        }
        block.each([&](int t) {
            const Cost best = s.cost[0];
            if (t == 0) *a.result = {best.ssd, best.weight, s.index[0]};
            for (u32 i = static_cast<u32>(t); i < a.count; i += kThreads) {
                const bool takes_part = !a.allowed || a.allowed[i];
                a.good[i] = takes_part && at_most(a.costs[i], best, a.numerator, a.denominator);
            }
        });
    }

  private:
    using Wide = unsigned __int128;

    /// As fractions: a ≤ b · numerator / denominator, exactly.
    WEFT_HD static bool at_most(const Cost& a, const Cost& b, u32 numerator, u32 denominator) {
        const u64 wa = larger(a.weight, u64{1}), wb = larger(b.weight, u64{1});
        return static_cast<Wide>(a.ssd) * wb * denominator <=
               static_cast<Wide>(b.ssd) * wa * numerator;
    }

    // On a tie the lower index wins, whatever the order of arrival.
    WEFT_HD static void take_better(Shared& s, int t, const Cost& cost, u32 index) {
        const bool no_worse = s.index[t] == kNone || at_most(cost, s.cost[t], 1, 1);
        if (!no_worse) return;
        const bool equal = s.index[t] != kNone && at_most(s.cost[t], cost, 1, 1);
        if (equal && s.index[t] < index) return;
        s.cost[t] = cost;
        s.index[t] = index;
    }
};

}  // namespace weft::kernels
