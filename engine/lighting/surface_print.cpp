#include "engine/lighting/surface_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/fast_math.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/masked_statistics.h"
#include "engine/lighting/surface_sample.h"

namespace weft {
namespace {

constexpr std::size_t kPaints = 6;
// Tiles (small pixels): a sixth of the side of a square of the surface's area, but no smaller.
constexpr float kTilesAcross = 6;
constexpr int kLeastTile = 24;
constexpr float kFullTile = 0.85f;  // share of a tile that shows the surface
// Of the tile: structure that a tile sees, and shade, at first and when the paints are known.
constexpr float kStructure = 0.29f, kFirstShadeSigma = 0.5f, kShadeSigma = 0.2f;

// A tile shows a print if, among places of one lightness, chromaticity deviates by so much (ln)
// and by so large a share of its deviation altogether, and if lightness itself does. Measured: a
// checked shirt 0.4, 0.88 and 1.0; red hair 0.35, 0.6 and 0.4; knits and fur below 0.15.
constexpr float kColours = 0.25f, kOfItsOwn = 0.75f, kLightness = 0.5f;
constexpr int kSteps = 8;  // of lightness
// Tiles, half overlapping, that there must be, and the share of them that must show it.
constexpr float kFewTiles = 12, kManyTiles = 24;
constexpr float kSomeShow = 0.35f, kMostShow = 0.6f;

constexpr float kColourUnit = 1.5f;  // ln chromaticity counts more than ln luma
constexpr int kSeedRounds = 8, kShadeRounds = 8;
constexpr float kFarthest = 0.995f;  // quantile: what is still farther is no paint
// Deviations: of places that are certainly of a paint, and of those that may be of several.
constexpr float kCertain = 0.15f, kMixture = 0.25f;
constexpr float kLeastCertain = 0.02f;  // weight of all others
constexpr float kEdgeOfPaint = 0.2f;    // ln luma
constexpr float kEdgeWeight = 0.1f;
constexpr std::size_t kMostSamples = 20000;  // places that the paints are found from

using Feature = std::array<float, 3>;

Feature scaled(float luma, float red_green, float blue_green) {
    return {luma, kColourUnit * red_green, kColourUnit * blue_green};
}

float distance2(const Feature& a, const Feature& b) {
    float sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

bool is_sure(const SurfaceSample& s, int x, int y) {
    return s.weight.row(y)[x] > 0.5f;
}

int tile_side(const SurfaceSample& sample) {
    double area = 0;
    for (std::size_t i = 0; i < sample.weight.size_bytes() / sizeof(float); ++i)
        area += sample.weight.data()[i] > 0 ? 1 : 0;
    return std::max(kLeastTile, static_cast<int>(std::sqrt(area) / kTilesAcross));
}

double variance(const std::vector<Feature>& places, std::size_t from, std::size_t to,
                std::size_t k) {
    double sum = 0, sum2 = 0;
    for (std::size_t i = from; i < to; ++i)
        sum += places[i][k], sum2 += static_cast<double>(places[i][k]) * places[i][k];
    const double n = static_cast<double>(to - from), mean = sum / n;
    return std::max(0.0, sum2 / n - mean * mean);
}

// Sorts them by lightness, where what costs nothing does not tell already.
bool shows_print(std::vector<Feature>& places) {
    const std::size_t n = places.size();
    const double all = std::sqrt(variance(places, 0, n, 1) + variance(places, 0, n, 2));
    if (all <= kColours || std::sqrt(variance(places, 0, n, 0)) <= kLightness) return false;
    std::sort(places.begin(), places.end());
    double within = 0;
    for (std::size_t step = 0; step < kSteps; ++step) {
        const std::size_t from = n * step / kSteps, to = n * (step + 1) / kSteps;
        within += (variance(places, from, to, 1) + variance(places, from, to, 2)) / kSteps;
    }
    return std::sqrt(within) > kColours && std::sqrt(within) > kOfItsOwn * all;
}

// The share of the tiles that show a print, as a confidence.
float confidence_of_print(const SurfaceSample& s, int tile) {
    const int radius = std::max(1, static_cast<int>(kStructure * static_cast<float>(tile)));
    ImageF1 weight_mean = s.weight;
    box_blur(weight_mean, radius);
    const ImageF1 luma = high_pass(s.luma, s.weight, weight_mean, radius);
    const ImageF1 red_green = high_pass(s.red_green, s.weight, weight_mean, radius);
    const ImageF1 blue_green = high_pass(s.blue_green, s.weight, weight_mean, radius);
    int tiles = 0, shown = 0;
    std::vector<Feature> places;
    for (int top = 0; top + tile <= s.box.height(); top += tile / 2) {
        for (int left = 0; left + tile <= s.box.width(); left += tile / 2) {
            places.clear();
            for (int y = top; y < top + tile; ++y) {
                for (int x = left; x < left + tile; ++x) {
                    if (!is_sure(s, x, y)) continue;
                    places.push_back({luma.row(y)[x], red_green.row(y)[x], blue_green.row(y)[x]});
                }
            }
            if (static_cast<float>(places.size()) < kFullTile * static_cast<float>(tile * tile))
                continue;
            ++tiles;
            shown += shows_print(places) ? 1 : 0;
        }
    }
    const float share = static_cast<float>(shown) / static_cast<float>(std::max(1, tiles));
    return smooth_step(static_cast<float>(tiles), kFewTiles, kManyTiles) *
           smooth_step(share, kSomeShow, kMostShow);
}

std::vector<Feature> sure_places(const SurfaceSample& s) {
    std::vector<Feature> out;
    for (int y = 0; y < s.box.height(); ++y) {
        for (int x = 0; x < s.box.width(); ++x) {
            if (is_sure(s, x, y))
                out.push_back(
                    scaled(s.luma.row(y)[x], s.red_green.row(y)[x], s.blue_green.row(y)[x]));
        }
    }
    if (out.size() <= kMostSamples) return out;
    std::vector<Feature> fewer(kMostSamples);
    for (std::size_t i = 0; i < kMostSamples; ++i)
        fewer[i] = out[i * out.size() / kMostSamples];
    return fewer;
}

std::size_t nearest(const std::vector<Feature>& paints, const Feature& at) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < paints.size(); ++k)
        if (distance2(paints[k], at) < distance2(paints[best], at)) best = k;
    return best;
}

// Each paint becomes the median of its places: edges, where paints mix, do not move it.
std::vector<Feature> recentred(const std::vector<Feature>& places,
                               const std::vector<Feature>& paints) {
    std::vector<std::array<std::vector<float>, 3>> of(paints.size());
    for (const Feature& place : places) {
        auto& values = of[nearest(paints, place)];
        for (std::size_t k = 0; k < place.size(); ++k)
            values[k].push_back(place[k]);
    }
    std::vector<Feature> out = paints;
    for (std::size_t p = 0; p < paints.size(); ++p) {
        for (std::size_t k = 0; k < out[p].size(); ++k)
            out[p][k] = median_of(of[p][k], out[p][k]);
    }
    return out;
}

// k-means; the first paint is the middle of all, each further one what is farthest from those
// before (Gonzalez 1985).
std::vector<Feature> first_paints(const std::vector<Feature>& places) {
    std::vector<Feature> paints = recentred(places, {Feature{}});
    std::vector<std::pair<float, std::size_t>> far(places.size());
    while (paints.size() < kPaints) {
        for (std::size_t i = 0; i < places.size(); ++i)
            far[i] = {distance2(places[i], paints[nearest(paints, places[i])]), i};
        const auto at = far.begin() +
                        static_cast<std::ptrdiff_t>(kFarthest * static_cast<float>(far.size() - 1));
        std::nth_element(far.begin(), at, far.end());
        paints.push_back(places[at->second]);
        for (int round = 0; round < kSeedRounds; ++round)
            paints = recentred(places, paints);
    }
    return paints;
}

// Where each place's paint is told, and how surely.
struct Painted {
    ImageF1 luma, sure;
};

Painted painted_by(const SurfaceSample& s, const std::vector<Feature>& paints,
                   const ImageF1& shade) {
    Painted out{ImageF1(s.box.size()), ImageF1(s.box.size())};
    parallel_rows(s.box.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < s.box.width(); ++x) {
                const float weight = s.weight.row(y)[x];
                if (!(weight > 0)) continue;
                const Feature at = scaled(s.luma.row(y)[x] - shade.row(y)[x], s.red_green.row(y)[x],
                                          s.blue_green.row(y)[x]);
                const float least = distance2(paints[nearest(paints, at)], at);
                // At an edge two paints mix.
                float sum = 0, total = 0;
                for (const Feature& paint : paints) {
                    const float share =
                        fast_exp((least - distance2(paint, at)) / (2 * kMixture * kMixture));
                    sum += share * paint[0], total += share;
                }
                out.luma.row(y)[x] = sum / total;
                out.sure.row(y)[x] =
                    weight * (kLeastCertain + fast_exp(-least / (2 * kCertain * kCertain)));
            }
        }
    });
    return out;
}

// Smooth ln shade under the paints.
ImageF1 shade_over(const SurfaceSample& s, const Painted& painted, float sigma) {
    ImageF1 rest = s.luma;
    for (std::size_t i = 0; i < rest.size_bytes() / sizeof(float); ++i)
        rest.data()[i] = painted.sure.data()[i] * (rest.data()[i] - painted.luma.data()[i]);
    return blurred(rest, painted.sure, sigma).value;
}

float median_where_seen(const SurfaceSample& s, const ImageF1& plane) {
    std::vector<float> values;
    for (std::size_t i = 0; i < plane.size_bytes() / sizeof(float); ++i)
        if (s.weight.data()[i] > 0) values.push_back(plane.data()[i]);
    return median_of(values, 0.0f);
}

// The paints' own level and the shade's are one: `shade` gets the median `level`.
ImageF1 levelled(ImageF1 shade, const SurfaceSample& s, float level) {
    const float by = level - median_where_seen(s, shade);
    for (std::size_t i = 0; i < shade.size_bytes() / sizeof(float); ++i)
        shade.data()[i] += by;
    return shade;
}

// Over a tile the paints average out.
ImageF1 first_shade(const SurfaceSample& s, float tile_px, float level) {
    const ImageF1 wide =
        blurred(weighted(s.luma, s.weight), s.weight, kFirstShadeSigma * tile_px).value;
    return levelled(wide, s, level);
}

std::vector<Feature> unshaded_places(const SurfaceSample& s, const ImageF1& shade) {
    SurfaceSample lit = s;
    for (std::size_t i = 0; i < shade.size_bytes() / sizeof(float); ++i)
        lit.luma.data()[i] -= shade.data()[i];
    return sure_places(lit);
}

// Where the paint beside is another one, both are in the pixel.
void lower_at_edges(ImageF1& weight, const ImageF1& paint) {
    const ImageF1 whole = weight;
    parallel_rows(paint.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < paint.width(); ++x) {
                float least = paint.row(y)[x], most = least;
                for (int v = std::max(0, y - 1); v < std::min(paint.height(), y + 2); ++v) {
                    for (int u = std::max(0, x - 1); u < std::min(paint.width(), x + 2); ++u) {
                        if (!(whole.row(v)[u] > 0)) continue;
                        least = std::min(least, paint.row(v)[u]);
                        most = std::max(most, paint.row(v)[u]);
                    }
                }
                if (most - least > kEdgeOfPaint) weight.row(y)[x] *= kEdgeWeight;
            }
        }
    });
}

std::vector<Feature> features_of(const SurfacePrint& print) {
    std::vector<Feature> out;
    for (const PrintPaint& p : print.paints)
        out.push_back(scaled(p.luma, p.red_green, p.blue_green));
    return out;
}

}  // namespace

SurfacePrint find_print(const SurfaceSample& sample) {
    const int tile = tile_side(sample);
    SurfacePrint print;
    print.confidence = confidence_of_print(sample, tile);
    if (!(print.confidence > 0)) return print;
    print.tile_px = static_cast<float>(tile);
    print.median_luma = median_where_seen(sample, sample.luma);
    ImageF1 shade = first_shade(sample, print.tile_px, 0);
    std::vector<Feature> places = unshaded_places(sample, shade);
    std::vector<Feature> paints = first_paints(places);
    for (int round = 0; round < kShadeRounds; ++round) {
        shade = levelled(
            shade_over(sample, painted_by(sample, paints, shade), kShadeSigma * print.tile_px),
            sample, 0);
        places = unshaded_places(sample, shade);
        paints = recentred(places, paints);
    }
    double sum = 0;
    for (const Feature& place : places)
        sum += paints[nearest(paints, place)][0];
    print.mean_luma = static_cast<float>(sum / static_cast<double>(places.size()));
    for (const Feature& p : paints)
        print.paints.push_back({p[0], p[1] / kColourUnit, p[2] / kColourUnit});
    return print;
}

PrintedPaint printed_paint(const SurfaceSample& sample, const SurfacePrint& print) {
    const std::vector<Feature> paints = features_of(print);
    ImageF1 shade = first_shade(sample, print.tile_px,
                                median_where_seen(sample, sample.luma) - print.median_luma);
    for (int round = 0; round < kShadeRounds; ++round)
        shade = shade_over(sample, painted_by(sample, paints, shade), kShadeSigma * print.tile_px);
    PrintedPaint out{painted_by(sample, paints, shade).luma, sample.weight};
    lower_at_edges(out.weight, out.luma);
    for (std::size_t i = 0; i < out.luma.size_bytes() / sizeof(float); ++i) {
        float& paint = out.luma.data()[i];
        paint = sample.weight.data()[i] > 0 ? paint - print.mean_luma : 0.0f;
    }
    return out;
}

}  // namespace weft
