#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
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

// The filters that need the pixel to the left keep it in a register. All bytes of a pixel are
// computed at once: in a word whose bytes must not carry into each other, or in a vector.
template <std::size_t kPixel>
using PixelWord = std::conditional_t<(kPixel > 4), std::uint64_t, std::uint32_t>;

template <class Part>
Part load_part(const unsigned char* from) {
    Part part;
    std::memcpy(&part, from, sizeof part);
    return part;
}

template <class Part>
void store_part(unsigned char* to, Part part) {
    std::memcpy(to, &part, sizeof part);
}

// Three and six bytes in two parts: a copy of so many goes through memory, which takes longer than
// all the rest.
template <std::size_t kPixel>
PixelWord<kPixel> load(const unsigned char* from) {
    using Word = PixelWord<kPixel>;
    if constexpr (kPixel == 3 || kPixel == 6) {
        using Low = std::conditional_t<kPixel == 3, std::uint16_t, std::uint32_t>;
        using High = std::conditional_t<kPixel == 3, std::uint8_t, std::uint16_t>;
        const Word high = load_part<High>(from + sizeof(Low));
        return load_part<Low>(from) | high << (8 * sizeof(Low));
    } else if constexpr (kPixel == 1) {
        return *from;
    } else if constexpr (kPixel == 2) {
        return load_part<std::uint16_t>(from);
    } else {
        return load_part<Word>(from);
    }
}

template <std::size_t kPixel>
void store(unsigned char* to, PixelWord<kPixel> word) {
    if constexpr (kPixel == 3 || kPixel == 6) {
        using Low = std::conditional_t<kPixel == 3, std::uint16_t, std::uint32_t>;
        using High = std::conditional_t<kPixel == 3, std::uint8_t, std::uint16_t>;
        store_part(to, static_cast<Low>(word));
        store_part(to + sizeof(Low), static_cast<High>(word >> (8 * sizeof(Low))));
    } else if constexpr (kPixel == 1) {
        *to = static_cast<unsigned char>(word);
    } else if constexpr (kPixel == 2) {
        store_part(to, static_cast<std::uint16_t>(word));
    } else {
        store_part(to, word);
    }
}

template <class Word>
Word add_bytes(Word a, Word b) {
    constexpr Word kLow = static_cast<Word>(0x7f7f7f7f7f7f7f7fu);
    return ((a & kLow) + (b & kLow)) ^ ((a ^ b) & ~kLow);
}

template <class Word>
Word halfway_bytes(Word a, Word b) {
    constexpr Word kNot_lowest = static_cast<Word>(0xfefefefefefefefeu);
    return (a & b) + (((a ^ b) & kNot_lowest) >> 1);
}

template <std::size_t kPixel>
void add_left(unsigned char* row, std::size_t bytes) {
    PixelWord<kPixel> left = 0;
    for (std::size_t x = 0; x + kPixel <= bytes; x += kPixel) {
        left = add_bytes(left, load<kPixel>(row + x));
        store<kPixel>(row + x, left);
    }
}

template <std::size_t kPixel>
void add_average(unsigned char* row, const unsigned char* above, std::size_t bytes) {
    PixelWord<kPixel> left = 0;
    for (std::size_t x = 0; x + kPixel <= bytes; x += kPixel) {
        left = add_bytes(halfway_bytes(left, load<kPixel>(above + x)), load<kPixel>(row + x));
        store<kPixel>(row + x, left);
    }
}

using Bytes8 = std::uint8_t __attribute__((vector_size(8)));
using Shorts8 = std::int16_t __attribute__((vector_size(16)));

template <std::size_t kPixel>
Shorts8 load_wide(const unsigned char* from) {
    return __builtin_convertvector(std::bit_cast<Bytes8>(std::uint64_t{load<kPixel>(from)}),
                                   Shorts8);
}

Shorts8 magnitude(Shorts8 v) {
    return v > -v ? v : -v;
}

// Of three neighbours the one nearest to left + above − corner.
Shorts8 paeth(Shorts8 left, Shorts8 above, Shorts8 corner) {
    const Shorts8 to_left = magnitude(above - corner), to_above = magnitude(left - corner);
    const Shorts8 to_corner = magnitude(left + above - corner - corner);
    const Shorts8 second = to_above <= to_corner ? above : corner;
    return ((to_left <= to_above) & (to_left <= to_corner)) ? left : second;
}

template <std::size_t kPixel>
void add_paeth(unsigned char* row, const unsigned char* above, std::size_t bytes) {
    Shorts8 left{}, corner{};
    for (std::size_t x = 0; x + kPixel <= bytes; x += kPixel) {
        const Shorts8 up = load_wide<kPixel>(above + x);
        left = (load_wide<kPixel>(row + x) + paeth(left, up, corner)) & 0xff;
        corner = up;
        const auto pixel = std::bit_cast<std::uint64_t>(__builtin_convertvector(left, Bytes8));
        store<kPixel>(row + x, static_cast<PixelWord<kPixel>>(pixel));
    }
}

template <std::size_t kPixel>
bool unfilter_row(unsigned char filter, unsigned char* __restrict row,
                  const unsigned char* __restrict above, std::size_t bytes) {
    switch (filter) {
        case kNone:
            return true;
        case kSub:
            add_left<kPixel>(row, bytes);
            return true;
        case kUp:
            for (std::size_t i = 0; i < bytes; ++i)
                row[i] = static_cast<unsigned char>(row[i] + above[i]);
            return true;
        case kAverage:
            add_average<kPixel>(row, above, bytes);
            return true;
        case kPaeth:
            add_paeth<kPixel>(row, above, bytes);
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
