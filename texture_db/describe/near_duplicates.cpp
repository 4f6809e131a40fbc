#include "texture_db/describe/near_duplicates.h"

#include <algorithm>
#include <cmath>

#include "texture_db/describe/sample_codec.h"

namespace weft {
namespace {

constexpr float kSameShape = 0.965f;
constexpr float kSameColor = 7;

}  // namespace

NearDuplicates::Mark NearDuplicates::mark_of(ViewU8x3 picture) {
    const ImageU8x3 small = resized(picture, {16, 16});
    Mark mark;
    std::array<float, kCells> light{};
    for (std::size_t i = 0; i < kCells; ++i) {
        const std::uint8_t* p = small.data() + 3 * i;
        for (std::size_t c = 0; c < 3; ++c)
            mark.mean[c] += static_cast<float>(p[c]) / kCells;
        light[i] = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
    }
    float mean = 0, largest = 1;
    for (const float v : light)
        mean += v / kCells;
    for (const float v : light)
        largest = std::max(largest, std::abs(v - mean));
    double squares = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
        mark.shape[i] = static_cast<std::int8_t>(std::lround((light[i] - mean) * 127 / largest));
        squares += static_cast<double>(mark.shape[i]) * mark.shape[i];
    }
    mark.norm = static_cast<float>(std::sqrt(squares));
    return mark;
}

bool NearDuplicates::known(const Mark& mark) const {
    return std::any_of(marks_.begin(), marks_.end(), [&](const Mark& other) {
        for (std::size_t c = 0; c < 3; ++c) {
            if (std::abs(mark.mean[c] - other.mean[c]) > kSameColor) return false;
        }
        int dot = 0;
        for (std::size_t i = 0; i < kCells; ++i)
            dot += mark.shape[i] * other.shape[i];
        return static_cast<float>(dot) > kSameShape * mark.norm * other.norm;
    });
}

bool NearDuplicates::is_known(ViewU8x3 picture) const {
    return known(mark_of(picture));
}

bool NearDuplicates::add_if_new(ViewU8x3 picture) {
    const Mark mark = mark_of(picture);
    if (known(mark)) return false;
    marks_.push_back(mark);
    return true;
}

}  // namespace weft
