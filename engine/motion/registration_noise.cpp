// noise_between(): the noise of two pictures that are registered.
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "engine/motion/photometric_samples.h"

namespace weft {
namespace {

// Differences of two pictures under a map, each with that of the next pixel along x.
struct Neighbours {
    struct Pair {
        float here, next;
    };
    std::vector<Pair> pairs;
    std::vector<Vec2> fractions;  // of a pixel, where the anchor was looked up
};

Neighbours neighbours_under(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                            const LatticeField& anchor_from_cur) {
    constexpr int kPairs = 6000;
    Neighbours out;
    const RegistrationSamples samples = registration_samples(cur, kPairs);
    const std::vector<Vec2> places = places_under(anchor_from_cur, samples);
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const Vec2 next = samples.p[k] + Vec2(1, 0);
        const int x = static_cast<int>(next.x) - cur.area.x0;
        const int y = static_cast<int>(next.y) - cur.area.y0;
        if (x >= cur.inside.width() || cur.inside.at(x, y) == 0) continue;
        const auto here = look_up(anchor, places[k]);
        const auto there = look_up(anchor, next + anchor_from_cur.at(next));
        if (!here || !there) continue;
        out.pairs.push_back({*here - samples.value[k], *there - cur.value.at(x, y)});
        out.fractions.push_back(glm::fract(places[k] - 0.5f));
    }
    return out;
}

// Of neighbouring differences; of those that show the same, since what does not is no noise.
double correlation_of(const std::vector<Neighbours::Pair>& pairs) {
    constexpr double kOutside = 3;  // robust deviations
    std::vector<float> sizes;
    sizes.reserve(pairs.size());
    for (const auto& pair : pairs)
        sizes.push_back(std::abs(pair.here));
    const double most = kOutside * robust_deviation(std::move(sizes));
    double square = 0, product = 0;
    for (const auto& pair : pairs) {
        const double a = pair.here, b = pair.next;
        if (std::abs(a) > most || std::abs(b) > most) continue;
        square += 0.5 * (a * a + b * b);
        product += a * b;
    }
    return square > 0 ? product / square : 1;
}

// How far the differences of two such pictures correlate from pixel to pixel.
double expected_correlation(const InterpolationNoise& noise, const std::vector<Vec2>& fractions) {
    double square = 0, product = 0;
    for (const Vec2 f : fractions) {
        square += 1 + static_cast<double>(noise.variance(f));
        product += static_cast<double>(noise.of_neighbours() + noise.with_next(f));
    }
    return product / square;
}

}  // namespace

InterpolationNoise noise_between(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                                 const LatticeField& anchor_from_cur) {
    constexpr std::size_t kFewest = 200;
    constexpr int kHalvings = 7;
    const Neighbours seen = neighbours_under(anchor, cur, anchor_from_cur);
    if (seen.pairs.size() < kFewest) return {};
    const double correlation = correlation_of(seen.pairs);
    const auto window = static_cast<float>(local_window(anchor_from_cur.full_size().width));
    const float local_mean = (window * window - 1) / 6;  // of two boxes
    float low = 0, high = 1;
    for (int k = 0; k < kHalvings; ++k) {
        const float middle = 0.5f * (low + high);
        const InterpolationNoise noise(middle, local_mean);
        (expected_correlation(noise, seen.fractions) < correlation ? low : high) = middle;
    }
    return {0.5f * (low + high), local_mean};
}

}  // namespace weft
