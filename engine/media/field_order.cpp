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
// Of the frames that tell: more are two moments. Telecine has two of five, cuts and dissolves make
// single ones. Without a flag more is needed.
constexpr double kLeastFlagged = 0.2, kLeastUnflagged = 0.5;
// Lines above and below a pixel that reach to the next edge: three of each field.
constexpr int kReach = 3;
constexpr int kOfEdge = 4;    // beside an edge, what is below a quarter of it is the parts' own
constexpr int kLineStep = 6;  // codes from line to line: more than coding leaves in flat parts

// 255 where a picture's column shows one part, or two and the edge between them: what it shows
// there may be one moment or two. Combed lines have steps at each line, repeated ones at every
// second.
Matte calm_pixels(const Matte& luma) {
    Matte out(luma.width(), luma.height());
    const auto width = static_cast<std::size_t>(luma.width());
    std::vector<int> largest(width), second(width);
    for (int y = 0; y < luma.height(); ++y) {
        std::fill(largest.begin(), largest.end(), 0);
        std::fill(second.begin(), second.end(), 0);
        const int end = std::min(y + kReach, luma.height() - 1);
        for (int k = std::max(0, y - kReach); k < end; ++k) {
            const std::uint8_t *line = luma.row(k), *next = luma.row(k + 1);
            for (std::size_t x = 0; x < width; ++x) {
                const int step = std::abs(line[x] - next[x]);
                second[x] = std::max(second[x], std::min(step, largest[x]));
                largest[x] = std::max(largest[x], step);
            }
        }
        for (std::size_t x = 0; x < width; ++x) {
            const bool one_edge = second[x] <= std::max(kLineStep, largest[x] / kOfEdge);
            out.row(y)[x] = one_edge ? 255 : 0;
        }
    }
    return out;
}

// Half codes between the lines of one parity and what lies between the lines of the other one.
struct Sums {
    std::int64_t within = 0;       ///< Lower lines and upper ones of one frame.
    std::int64_t upper_later = 0;  ///< Lower lines of the frame before, upper ones of this frame.
    std::int64_t lower_later = 0;
};

Sums& operator+=(Sums& sum, const Sums& more) {
    sum.within += more.within;
    sum.upper_later += more.upper_later;
    sum.lower_later += more.lower_later;
    return sum;
}

FieldVote vote_of(const Sums& sums, double pixels) {
    const double within = 0.5 * static_cast<double>(sums.within) / pixels;
    const double upper_later = 0.5 * static_cast<double>(sums.upper_later) / pixels - within;
    const double lower_later = 0.5 * static_cast<double>(sums.lower_later) / pixels - within;
    const double motion = std::abs(upper_later) + std::abs(lower_later);
    const double chance = within / std::sqrt(pixels);  // what it makes of so many pixels
    if (motion <= std::max(kLeastMotion, kOverChance * chance)) return FieldVote::kNone;
    const double asymmetry = std::abs(upper_later - lower_later) / motion;
    if (asymmetry < kOneMoment) return FieldVote::kProgressive;
    if (asymmetry <= kTwoMoments) return FieldVote::kNone;
    return upper_later > lower_later ? FieldVote::kUpperFirst : FieldVote::kLowerFirst;
}

}  // namespace

void FieldMeter::Votes::add(FieldVote vote) {
    progressive += vote == FieldVote::kProgressive;
    upper_first += vote == FieldVote::kUpperFirst;
    lower_first += vote == FieldVote::kLowerFirst;
}

void FieldMeter::add(Matte luma) {
    Frame frame{std::move(luma), {}};
    if (frame.luma.height() >= 8) frame.calm = calm_pixels(frame.luma);
    if (before_.luma.size() == frame.luma.size() && frame.luma.height() >= 8) count(frame);
    before_ = std::move(frame);
}

void FieldMeter::count(const Frame& now) {
    Sums all, parted;
    const int width = now.luma.width();
    double pixels = 0;
    for (int y = 3; y + 1 < now.luma.height(); y += 2) {
        const std::uint8_t *line = now.luma.row(y), *line_before = before_.luma.row(y);
        const std::uint8_t *above = now.luma.row(y - 1), *above_before = before_.luma.row(y - 1);
        const std::uint8_t *below = now.luma.row(y + 1), *below_before = before_.luma.row(y + 1);
        const std::uint8_t *calm = now.calm.row(y), *calm_before = before_.calm.row(y);
        for (int x = 0; x < width; ++x) {
            const int upper = above[x] + below[x], upper_before = above_before[x] + below_before[x];
            const Sums here{std::abs(2 * line[x] - upper), std::abs(2 * line_before[x] - upper),
                            std::abs(2 * line[x] - upper_before)};
            all += here;
            if (calm[x] == 0 || calm_before[x] == 0) parted += here;
        }
        pixels += width;
    }
    const FieldVote vote = vote_of(all, pixels);
    all_.add(vote);
    if (vote == FieldVote::kProgressive || vote == vote_of(parted, pixels)) parted_.add(vote);
}

Fields FieldMeter::fields(bool flagged) const {
    const Votes& votes = flagged ? all_ : parted_;
    // Fields have one order; chance has none.
    const int interlaced = std::max(votes.upper_first, votes.lower_first);
    const int told = votes.progressive + interlaced;
    if (told == 0) return Fields::kUnknown;
    return interlaced >= kFewest && interlaced > (flagged ? kLeastFlagged : kLeastUnflagged) * told
               ? Fields::kInterlaced
               : Fields::kProgressive;
}

}  // namespace weft
