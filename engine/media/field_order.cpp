#include "engine/media/field_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

constexpr double kLeastMotion = 0.25;  // codes, mean over the picture: less is noise
constexpr double kOverChance = 5;
constexpr int kFewest = 2;  // frames of two moments
// Of the asymmetry of a frame, 0 to 1.
constexpr double kOneMoment = 0.3, kTwoMoments = 0.55;

// The mean difference between the lines of one parity in `a` and what lies between its lines of the
// other parity in `b`.
double difference(const Matte& a, const Matte& b, int parity) {
    std::int64_t sum = 0, count = 0;
    for (int y = 2 + parity; y + 1 < a.height(); y += 2) {
        const std::uint8_t *line = a.row(y), *above = b.row(y - 1), *below = b.row(y + 1);
        for (int x = 0; x < a.width(); ++x)
            sum += std::abs(2 * line[x] - above[x] - below[x]);
        count += a.width();
    }
    return count > 0 ? 0.5 * static_cast<double>(sum) / static_cast<double>(count) : 0.0;
}

}  // namespace

void FieldMeter::add(Matte luma) {
    if (before_.size() == luma.size() && luma.height() >= 8) {
        // Lower lines against the upper field: of this frame, and of the other one.
        const double within = difference(luma, luma, 1);
        const double upper_later = difference(before_, luma, 1) - within;
        const double lower_later = difference(luma, before_, 1) - within;
        const double motion = std::abs(upper_later) + std::abs(lower_later);
        // What chance makes of so many pixels.
        const double chance = within / std::sqrt(0.5 * luma.width() * luma.height());
        if (motion > std::max(kLeastMotion, kOverChance * chance)) {
            const double asymmetry = std::abs(upper_later - lower_later) / motion;
            progressive_ += asymmetry < kOneMoment;
            const bool two = asymmetry > kTwoMoments;
            upper_first_ += two && upper_later > lower_later;
            lower_first_ += two && lower_later > upper_later;
        }
    }
    before_ = std::move(luma);
}

Fields FieldMeter::fields(double least_share) const {
    // Fields have one order; chance has none.
    const int interlaced = std::max(upper_first_, lower_first_);
    const int told = progressive_ + interlaced;
    if (told == 0) return Fields::kUnknown;
    return interlaced >= kFewest && interlaced > least_share * told ? Fields::kInterlaced
                                                                    : Fields::kProgressive;
}

}  // namespace weft
