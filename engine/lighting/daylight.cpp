#include "engine/lighting/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/fast_math.h"

namespace weft {
namespace {

constexpr int kReducedWidth = 320;          // pixels, about: finer structure is paint or noise
constexpr float kFloor = 0.02f;             // of the median luma, added before the logarithm
constexpr int kBlock = 10, kBlockStep = 5;  // reduced pixels
constexpr float kVaries = 0.12f;            // ln luma: deviation of a block that has a say
constexpr float kExplained = 0.8f;          // share of its colours' energy that goes with its luma
constexpr float kAstray = 0.3f;             // of the slope: the most across daylight's direction
constexpr float kLeastSlope = 0.05f, kMostSlope = 0.5f;
constexpr int kBins = 45;                     // between them
constexpr int kAgree = 7;                     // bins to each side of the slope that agree with it
constexpr float kFew = 0.03f, kMany = 0.07f;  // share of all variation that must agree

struct LogColours {
    ImageF1 luma, along, across;
};

// Block means in logarithms. Pixels that are not finite count as black.
LogColours reduced_logs(ViewF3 linear) {
    const int factor = std::max(1, (linear.width() + kReducedWidth / 2) / kReducedWidth);
    const Size size{linear.width() / factor, linear.height() / factor};
    LogColours out{ImageF1(size), ImageF1(size), ImageF1(size)};
    ImageF3 mean(size);
    std::vector<float> lumas;
    const auto luma_of = [](const float* p) {
        return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
    };
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            float* m = mean.pixel(x, y);
            for (int v = y * factor; v < (y + 1) * factor; ++v) {
                for (int u = x * factor; u < (x + 1) * factor; ++u) {
                    const float* p = linear.pixel(u, v);
                    for (int c = 0; c < 3; ++c)
                        m[c] += std::isfinite(p[c]) ? std::max(p[c], 0.0f) : 0.0f;
                }
            }
            for (int c = 0; c < 3; ++c)
                m[c] /= static_cast<float>(factor * factor);
            lumas.push_back(luma_of(m));
        }
    }
    const float floor = std::max(1e-6f, kFloor * median_of(lumas, 0.0f));
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float* m = mean.pixel(x, y);
            const float green = fast_log(m[1] + floor);
            const float red = fast_log(m[0] + floor) - green;
            const float blue = fast_log(m[2] + floor) - green;
            out.luma.row(y)[x] = fast_log(luma_of(m) + floor);
            out.along.row(y)[x] = kDaylightRed * red + kDaylightBlue * blue;
            out.across.row(y)[x] = -kDaylightBlue * red + kDaylightRed * blue;
        }
    }
    return out;
}

struct Vote {
    float slope = 0;
    float weight = 0;  // deviation of its luma; 0: has no say
    bool agrees = false;
};

Vote vote_of(const LogColours& logs, int x0, int y0) {
    double l = 0, a = 0, c = 0, ll = 0, aa = 0, la = 0, lc = 0;
    for (int y = y0; y < y0 + kBlock; ++y) {
        for (int x = x0; x < x0 + kBlock; ++x) {
            const double luma = logs.luma.row(y)[x], along = logs.along.row(y)[x];
            const double across = logs.across.row(y)[x];
            l += luma, a += along, c += across;
            ll += luma * luma, aa += along * along, la += luma * along, lc += luma * across;
        }
    }
    constexpr double kArea = kBlock * kBlock;
    const double variance = ll / kArea - l * l / (kArea * kArea);
    if (variance < kVaries * kVaries) return {};
    const double with = la / kArea - l * a / (kArea * kArea);
    const double spread = aa / kArea - a * a / (kArea * kArea);
    const double astray = lc / kArea - l * c / (kArea * kArea);
    Vote vote{static_cast<float>(with / variance), static_cast<float>(std::sqrt(variance))};
    vote.agrees = vote.slope > kLeastSlope && vote.slope < kMostSlope &&
                  with * with > kExplained * variance * spread && std::abs(astray) < kAstray * with;
    return vote;
}

}  // namespace

Daylight find_daylight(ViewF3 linear) {
    const LogColours logs = reduced_logs(linear);
    std::array<double, kBins> bins{}, slopes{};
    double all = 0;
    for (int y = 0; y + kBlock <= logs.luma.height(); y += kBlockStep) {
        for (int x = 0; x + kBlock <= logs.luma.width(); x += kBlockStep) {
            const Vote vote = vote_of(logs, x, y);
            all += vote.weight;
            if (!vote.agrees) continue;
            const float at = (vote.slope - kLeastSlope) / (kMostSlope - kLeastSlope);
            const auto bin = static_cast<std::size_t>(std::min(kBins - 1.0f, at * kBins));
            bins[bin] += vote.weight, slopes[bin] += vote.weight * vote.slope;
        }
    }
    double most = 0, slope = 0;
    for (int k = 0; k < kBins; ++k) {
        double votes = 0, sum = 0;
        for (int j = std::max(0, k - kAgree); j <= std::min(kBins - 1, k + kAgree); ++j)
            votes += bins[static_cast<std::size_t>(j)], sum += slopes[static_cast<std::size_t>(j)];
        if (votes > most) most = votes, slope = sum / votes;
    }
    if (!(most > 0)) return {};
    const float confidence = smooth_step(static_cast<float>(most / all), kFew, kMany);
    if (confidence == 0) return {};
    return {static_cast<float>(slope), confidence};
}

}  // namespace weft
