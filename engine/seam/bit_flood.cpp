#include "engine/seam/bit_flood.h"

namespace weft {
namespace {

// The bits of r and all bits that unbroken `step` bits lead to from them, twice as far in each
// round (Kogge & Stone 1973). `carry`: the carry bit from the word before.
std::uint64_t run_up(std::uint64_t r, std::uint64_t step, std::uint64_t carry) {
    r |= carry;
    for (int shift = 1; shift < 64; shift *= 2) {
        r |= (r & step) << shift;
        step &= step >> shift;
    }
    return r;
}

std::uint64_t run_down(std::uint64_t r, std::uint64_t step) {
    for (int shift = 1; shift < 64; shift *= 2) {
        r |= (r & step) >> shift;
        step &= step << shift;
    }
    return r;
}

// Fills along one row, both ways.
void fill_row(const std::uint64_t* right, const std::uint64_t* left, std::uint64_t* r,
              std::size_t words) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < words; ++i) {
        r[i] = run_up(r[i], right[i], carry);
        carry = (r[i] & right[i]) >> 63;
    }
    carry = 0;
    for (std::size_t i = words; i-- > 0;) {
        r[i] = run_down(r[i] | carry << 63, left[i]);
        carry = r[i] & left[i] & 1;
    }
}

}  // namespace

void flood(const FloodSteps& steps, BitRows& reached) {
    const std::size_t words = reached.words();
    const int h = steps.size.height;
    std::vector<std::uint64_t> before(words);
    // Fills row y, with what comes in from `from`. Returns true if the row changed.
    const auto visit = [&](int y, const std::uint64_t* from, const std::uint64_t* step) {
        std::uint64_t* r = reached.row(y);
        std::uint64_t gained = 0;
        for (std::size_t i = 0; i < words; ++i) {
            before[i] = r[i];
            if (from) r[i] |= from[i] & step[i];
            gained |= r[i] ^ before[i];
        }
        if (from && gained == 0) return false;
        fill_row(steps.right.row(y), steps.left.row(y), r, words);
        for (std::size_t i = 0; i < words; ++i)
            gained |= r[i] ^ before[i];
        return gained != 0;
    };
    for (int y = 0; y < h; ++y)
        (void)visit(y, nullptr, nullptr);
    for (bool changed = true; changed;) {
        changed = false;
        for (int y = 1; y < h; ++y)
            changed |= visit(y, reached.row(y - 1), steps.down.row(y - 1));
        for (int y = h - 2; y >= 0; --y)
            changed |= visit(y, reached.row(y + 1), steps.up.row(y + 1));
    }
}

}  // namespace weft
