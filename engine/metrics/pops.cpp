#include "engine/metrics/pops.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/parallel.h"
#include "engine/metrics/drift.h"
#include "engine/metrics/local_mean.h"
#include "engine/metrics/region.h"
#include "engine/metrics/tde.h"

namespace weft {
namespace {

constexpr std::int64_t kFewestPixels = 400;
constexpr double kFlattest = 0.25;  // of the pixels
constexpr double kLower = 0.75;     // of the responses there
// Times the root of their number: neighbours overlap, so two of them count as one.
constexpr double kGrainError = 1.2;
constexpr double kLeastGrain = 0.5;  // levels; fainter grain is not seen
constexpr int kPlaceStep_px = 24;    // between the patches whose motion is measured
constexpr std::int64_t kFewestPatches = 6;
constexpr int kAround = 3;                              // frames
constexpr double kQuarter = 0.25, kOfNormal = 0.31864;  // of |x|, x of deviation 1
constexpr double kLeastDeviation = 0.002;

// Where the pixels of `visible` come to lie.
Matte landed(const FlowField& motion, ViewU8x1 visible) {
    Matte out(visible.size());
    for (int y = 0; y < visible.height(); ++y) {
        for (int x = 0; x < visible.width(); ++x) {
            if (visible.row(y)[x] == 0) continue;
            const int u = x + static_cast<int>(std::floor(motion.d.at(x, y, 0) + 0.5f));
            const int v = y + static_cast<int>(std::floor(motion.d.at(x, y, 1) + 0.5f));
            if (u >= 0 && v >= 0 && u < out.width() && v < out.height()) out.at(u, v) = 255;
        }
    }
    // Surfaces that come nearer leave pixels out.
    Matte closed = out;
    for (int y = 1; y + 1 < out.height(); ++y) {
        for (int x = 1; x + 1 < out.width(); ++x) {
            if (out.at(x, y) == 0 && ((out.at(x - 1, y) != 0 && out.at(x + 1, y) != 0) ||
                                      (out.at(x, y - 1) != 0 && out.at(x, y + 1) != 0)))
                closed.at(x, y) = 255;
        }
    }
    return closed;
}

bool around_inside(ViewU8x1 region, int x, int y) {
    return region.row(y)[x] != 0 && region.row(y)[x - 1] != 0 && region.row(y)[x + 1] != 0 &&
           region.row(y - 1)[x] != 0 && region.row(y + 1)[x] != 0;
}

RowSum sum_rows(const std::vector<RowSum>& rows) {
    RowSum all;
    for (const RowSum& r : rows)
        all.add(r);
    return all;
}

// Sums f(x, y) over the pixels whose four neighbours are inside, where it is finite.
template <class Value>
RowSum over(ViewU8x1 region, Value&& value) {
    std::vector<RowSum> rows(static_cast<std::size_t>(region.height()));
    parallel_rows(region.height() - 2, 16, [&](int y0, int y1) {
        for (int y = y0 + 1; y < y1 + 1; ++y) {
            for (int x = 1; x + 1 < region.width(); ++x) {
                if (!around_inside(region, x, y)) continue;
                const double v = value(x, y);
                if (std::isfinite(v)) rows[static_cast<std::size_t>(y)].add(v);
            }
        }
    });
    return sum_rows(rows);
}

double squared_gradient(const ImageF1& plane, int x, int y) {
    const double gx = 0.5 * static_cast<double>(plane.at(x + 1, y) - plane.at(x - 1, y));
    const double gy = 0.5 * static_cast<double>(plane.at(x, y + 1) - plane.at(x, y - 1));
    return gx * gx + gy * gy;
}

// The middle of a list, which is reordered; the list is not empty.
double middle_of(std::vector<double>& list) {
    const auto at = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
    std::nth_element(list.begin(), at, list.end());
    return *at;
}

// What is measured of one picture over a part of it.
struct Look {
    std::optional<double> sharpness, light, grain;  // logarithms
    double grain_error = 0;
};

struct Grain {
    double log = 0, error = 0;
};

std::optional<Grain> grain_of(ViewF1 luma, ViewU8x1 region) {
    // Flat by the slopes of means over 3 × 3 pixels, in which most noise is gone.
    struct Place {
        double slope, response;
    };
    std::vector<Place> places;
    const auto mean = [&](int x, int y) {
        double sum = 0;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                sum += static_cast<double>(luma.row(y + j)[x + i]);
        return sum / 9;
    };
    for (int y = 3; y + 3 < luma.height(); y += 2) {
        for (int x = 3 + y % 4 / 2; x + 3 < luma.width(); x += 2) {
            if (!around_inside(region, x, y) || region.row(y - 3)[x] == 0 ||
                region.row(y + 3)[x] == 0 || region.row(y)[x - 3] == 0 || region.row(y)[x + 3] == 0)
                continue;
            const auto at = [&](int i, int j) {
                return static_cast<double>(luma.row(y + j)[x + i]);
            };
            const double filter = at(-1, -1) + at(1, -1) + at(-1, 1) + at(1, 1) -
                                  2 * (at(0, -1) + at(0, 1) + at(-1, 0) + at(1, 0)) + 4 * at(0, 0);
            const double slope = std::abs(mean(x + 2, y) - mean(x - 2, y)) +
                                 std::abs(mean(x, y + 2) - mean(x, y - 2));
            if (std::isfinite(filter) && std::isfinite(slope))
                places.push_back({slope, std::abs(filter)});
        }
    }
    if (static_cast<std::int64_t>(places.size()) < kFewestPixels) return std::nullopt;
    const auto flat = places.begin() +
                      static_cast<std::ptrdiff_t>(kFlattest * static_cast<double>(places.size()));
    std::nth_element(places.begin(), flat, places.end(),
                     [](const Place& a, const Place& b) { return a.slope < b.slope; });
    std::sort(places.begin(), flat,
              [](const Place& a, const Place& b) { return a.response < b.response; });
    // The mean of the lower three quarters: the median of pictures of 8 bit is that of a few codes.
    const auto counted =
        static_cast<std::size_t>(kLower * static_cast<double>(flat - places.begin()));
    double sum = 0;
    for (std::size_t k = 0; k < counted; ++k)
        sum += places[k].response;
    constexpr double kOfFilter = 6 * 0.5149;  // its deviation, and that mean of |x|
    const double mean_of_lower = sum / static_cast<double>(counted);
    return Grain{std::log(mean_of_lower / kOfFilter + kLeastGrain),
                 kGrainError / std::sqrt(static_cast<double>(counted))};
}

Look look_at(ViewF1 luma, ViewU8x1 region) {
    Look out;
    const Matte known = inside_and_finite(region, luma);
    const ImageF1 pattern = divided_by_local_mean(luma, known);
    const RowSum energy =
        over(known, [&](int x, int y) { return squared_gradient(pattern, x, y); });
    const RowSum light =
        over(known, [&](int x, int y) { return static_cast<double>(luma.row(y)[x]); });
    if (energy.count >= kFewestPixels && energy.mean() > 0)
        out.sharpness = 0.5 * std::log(energy.mean());
    if (light.count >= kFewestPixels && light.mean() > 0) out.light = std::log(light.mean() + 1);
    if (const auto grain = grain_of(luma, known))
        out.grain = grain->log, out.grain_error = grain->error;
    return out;
}

// What of the result's step lies beyond the plate's: its distance from what is between no step and
// the plate's.
std::optional<PopSteps::Step> step_of(const std::optional<double>& result_from,
                                      const std::optional<double>& result_to,
                                      const std::optional<double>& source_from,
                                      const std::optional<double>& source_to, bool forward) {
    if (!result_from || !result_to) return std::nullopt;
    const double sign = forward ? 1 : -1;
    const double own = sign * (*result_to - *result_from);
    const double plate = source_from && source_to ? sign * (*source_to - *source_from) : 0;
    return PopSteps::Step{own - std::clamp(own, std::min(0.0, plate), std::max(0.0, plate)), own,
                          plate};
}

std::optional<double> slide(ViewF1 from, ViewF1 to, const FlowField& motion, ViewU8x1 visible) {
    const ResidualMotion left = residual_motion(from, moved(to, motion), visible, kPlaceStep_px);
    if (left.patches < kFewestPatches) return std::nullopt;
    return left.mean_px;
}

// Of a value of each step, from the median of those around it.
template <class Value>
std::vector<std::optional<double>> departures_of(const std::vector<PopSteps>& steps, PopKind kind,
                                                 Value&& value) {
    std::vector<std::optional<double>> out(steps.size());
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (!steps[k].of(kind)) continue;
        std::vector<double> around;
        for (const PopSteps& s : steps) {
            if (std::abs(s.frame - steps[k].frame) <= kAround && s.of(kind))
                around.push_back(value(*s.of(kind)));
        }
        out[k] = value(*steps[k].of(kind)) - middle_of(around);
    }
    return out;
}

// Of a normal distribution with the same lower quarter of lengths.
double deviation_of(const std::vector<std::optional<double>>& departures) {
    std::vector<double> lengths;
    for (const auto& d : departures)
        if (d) lengths.push_back(std::abs(*d));
    if (lengths.empty()) return 0;
    const auto at = lengths.begin() +
                    static_cast<std::ptrdiff_t>(kQuarter * static_cast<double>(lengths.size()));
    std::nth_element(lengths.begin(), at, lengths.end());
    return std::max(kLeastDeviation, *at / kOfNormal);
}

// Of the meter; 0 without steps.
double deviation_of(const std::vector<PopSteps>& steps, PopKind kind) {
    using Step = PopSteps::Step;
    std::vector<double> errors;
    for (const PopSteps& s : steps)
        if (s.of(kind)) errors.push_back(s.of(kind)->error);
    if (errors.empty()) return 0;
    const double of_steps = std::min(
        deviation_of(departures_of(steps, kind, [](const Step& s) { return s.own; })),
        deviation_of(departures_of(steps, kind, [](const Step& s) { return s.own - s.plate; })));
    return std::max(of_steps, middle_of(errors));
}

double counts_from(PopKind kind, double deviation) {
    return std::max(kind == PopKind::kPlace ? kLeastPlacePop_px : kLeastPop,
                    kPopDeviations * deviation);
}

}  // namespace

const char* name_of(PopKind kind) {
    switch (kind) {
        case PopKind::kSharpness:
            return "sharpness";
        case PopKind::kLight:
            return "light";
        case PopKind::kGrain:
            return "grain";
        case PopKind::kPlace:
            return "place";
    }
    return "";
}

PopSteps pop_steps(const PopPair& pair) {
    PopSteps out;
    out.frame = pair.frame;
    const Matte there = landed(*pair.to_from_from, pair.visible);
    const Look result_from = look_at(pair.result_from, pair.visible);
    const Look result_to = look_at(pair.result_to, there);
    const Look source_from = look_at(pair.source_from, pair.visible);
    const Look source_to = look_at(pair.source_to, there);
    const auto set = [&](PopKind kind, std::optional<double> Look::*member) {
        out.step[static_cast<std::size_t>(kind)] =
            step_of(result_from.*member, result_to.*member, source_from.*member, source_to.*member,
                    pair.forward);
    };
    set(PopKind::kSharpness, &Look::sharpness);
    set(PopKind::kLight, &Look::light);
    set(PopKind::kGrain, &Look::grain);
    if (auto& grain = out.step[static_cast<std::size_t>(PopKind::kGrain)])
        grain->error = std::sqrt(result_from.grain_error * result_from.grain_error +
                                 result_to.grain_error * result_to.grain_error);
    const auto result = slide(pair.result_from, pair.result_to, *pair.to_from_from, pair.visible);
    const auto plate = slide(pair.source_from, pair.source_to, *pair.to_from_from, pair.visible);
    if (result)
        out.step[static_cast<std::size_t>(PopKind::kPlace)] = PopSteps::Step{
            std::max(0.0, *result - plate.value_or(0.0)), *result, plate.value_or(0.0)};
    return out;
}

std::vector<std::optional<double>> departures(const std::vector<PopSteps>& steps, PopKind kind) {
    return departures_of(steps, kind, [](const PopSteps::Step& s) { return s.beyond; });
}

std::vector<std::optional<PopHeight>> pop_heights(const std::vector<PopSteps>& steps) {
    std::vector<std::optional<PopHeight>> out(steps.size());
    for (std::size_t k = 0; k < kPopKinds; ++k) {
        const auto kind = static_cast<PopKind>(k);
        const std::vector<std::optional<double>> all = departures(steps, kind);
        const double least = counts_from(kind, deviation_of(steps, kind));
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!all[i]) continue;
            const double height = std::abs(*all[i]) / least;
            if (!out[i] || height > out[i]->height) out[i] = PopHeight{height, kind, *all[i]};
        }
    }
    return out;
}

Pops find_pops(const std::vector<PopSteps>& steps) {
    Pops out;
    for (std::size_t k = 0; k < kPopKinds; ++k) {
        const auto kind = static_cast<PopKind>(k);
        const std::vector<std::optional<double>> all = departures(steps, kind);
        PopsOfKind& pops = out.kinds[k];
        pops.deviation = deviation_of(steps, kind);
        const double least = counts_from(kind, pops.deviation);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!all[i]) continue;
            const double length = std::abs(*all[i]);
            if (length > pops.largest) pops.largest = length, pops.frame = steps[i].frame;
            if (length >= least) pops.frames.push_back(steps[i].frame);
        }
    }
    return out;
}

std::vector<int> Pops::frames() const {
    std::set<int> all;
    for (const PopsOfKind& kind : kinds)
        all.insert(kind.frames.begin(), kind.frames.end());
    return {all.begin(), all.end()};
}

}  // namespace weft
