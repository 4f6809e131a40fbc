#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "engine/media/png_format.h"

namespace weft {
namespace {

enum Filter : unsigned char { kNone, kSub, kUp, kAverage, kPaeth };

// How far two bytes are apart modulo 256, which is how their difference is stored.
unsigned char distance(unsigned char a, unsigned char b) {
    return std::min(static_cast<unsigned char>(a - b), static_cast<unsigned char>(b - a));
}

// In blocks of a fixed length, which the compiler vectorises.
std::uint64_t sum_of_distances(const unsigned char* row, const unsigned char* other,
                               std::size_t bytes) {
    constexpr std::size_t kBlock = 64;
    std::uint64_t sum = 0;
    std::size_t i = 0;
    for (; i + kBlock <= bytes; i += kBlock) {
        std::uint16_t block = 0;  // at most 64 · 128
        for (std::size_t k = i; k < i + kBlock; ++k)
            block = static_cast<std::uint16_t>(block + distance(row[k], other[k]));
        sum += block;
    }
    for (; i < bytes; ++i)
        sum += distance(row[i], other[i]);
    return sum;
}

void subtract(const unsigned char* row, const unsigned char* other, std::size_t bytes,
              unsigned char* __restrict to) {
    for (std::size_t i = 0; i < bytes; ++i)
        to[i] = static_cast<unsigned char>(row[i] - other[i]);
}

// Of three neighbours the one nearest to left + above − corner.
int paeth(int left, int above, int corner) {
    const int to_left = std::abs(above - corner), to_above = std::abs(left - corner);
    const int to_corner = std::abs(left + above - 2 * corner);
    if (to_left <= to_above && to_left <= to_corner) return left;
    return to_above <= to_corner ? above : corner;
}

// The filters that need the pixel to the left, which stays in registers because its number of bytes
// is known here.
template <Filter kFilter, std::size_t kPixel>
void add_guesses(unsigned char* __restrict row, const unsigned char* __restrict above,
                 std::size_t bytes) {
    int left[kPixel] = {}, corner[kPixel] = {};
    for (std::size_t x = 0; x + kPixel <= bytes; x += kPixel) {
        for (std::size_t c = 0; c < kPixel; ++c) {
            int guess = left[c];
            if constexpr (kFilter == kAverage) guess = (left[c] + above[x + c]) / 2;
            if constexpr (kFilter == kPaeth) {
                guess = paeth(left[c], above[x + c], corner[c]);
                corner[c] = above[x + c];
            }
            left[c] = (row[x + c] + guess) & 0xff;
            row[x + c] = static_cast<unsigned char>(left[c]);
        }
    }
}

template <std::size_t kPixel>
bool unfilter_row(unsigned char filter, unsigned char* __restrict row,
                  const unsigned char* __restrict above, std::size_t bytes) {
    switch (filter) {
        case kNone:
            return true;
        case kSub:
            add_guesses<kSub, kPixel>(row, above, bytes);
            return true;
        case kUp:
            for (std::size_t i = 0; i < bytes; ++i)
                row[i] = static_cast<unsigned char>(row[i] + above[i]);
            return true;
        case kAverage:
            add_guesses<kAverage, kPixel>(row, above, bytes);
            return true;
        case kPaeth:
            add_guesses<kPaeth, kPixel>(row, above, bytes);
            return true;
        default:
            return false;
    }
}

using UnfilterRow = bool (*)(unsigned char, unsigned char*, const unsigned char*, std::size_t);

UnfilterRow unfilter_for(std::size_t pixel_bytes) {
    switch (pixel_bytes) {
        case 1:
            return unfilter_row<1>;
        case 2:
            return unfilter_row<2>;
        case 3:
            return unfilter_row<3>;
        case 4:
            return unfilter_row<4>;
        case 6:
            return unfilter_row<6>;
        case 8:
            return unfilter_row<8>;
        default:
            return nullptr;
    }
}

}  // namespace

void filter_png_row(const unsigned char* row, const unsigned char* above, std::size_t bytes,
                    std::size_t pixel_bytes, unsigned char* to) {
    const std::size_t rest = bytes - pixel_bytes;
    const bool up = above && sum_of_distances(row, above, bytes) <
                                 sum_of_distances(row + pixel_bytes, row, rest);
    to[0] = up ? kUp : kSub;
    if (up) {
        subtract(row, above, bytes, to + 1);
    } else {
        std::memcpy(to + 1, row, pixel_bytes);
        subtract(row + pixel_bytes, row, rest, to + 1 + pixel_bytes);
    }
}

bool unfilter_png(const PngShape& shape, unsigned char* filtered) {
    const std::size_t bytes = shape.row_bytes();
    const UnfilterRow unfilter = unfilter_for(shape.pixel_bytes());
    const std::vector<unsigned char> black(bytes);
    const unsigned char* above = black.data();
    for (int y = 0; y < shape.size.height; ++y) {
        unsigned char* const row = filtered + static_cast<std::size_t>(y) * (bytes + 1) + 1;
        if (!unfilter(row[-1], row, above, bytes)) return false;
        unsigned char* const place = filtered + static_cast<std::size_t>(y) * bytes;
        std::memmove(place, row, bytes);
        above = place;
    }
    return true;
}

}  // namespace weft
