#include "engine/motion/photometric_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/motion/cubic_lookup.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

// Local means reach this far, px at a width of 854.
constexpr float kLocal_px = 4;
// Pixels nearer to the outline are mixed with the background.
constexpr float kEdge_px = 3;

// Where a picture is looked up: the first of sixteen pixels, and the fractions.
struct LookupCell {
    const float* first;
    float fx, fy;
};

std::optional<LookupCell> cell_at(const RegistrationPicture& picture, Vec2 p) {
    const float gx = p.x - 0.5f - static_cast<float>(picture.area.x0);
    const float gy = p.y - 0.5f - static_cast<float>(picture.area.y0);
    if (!(gx >= 1 && gy >= 1 && gx < static_cast<float>(picture.area.width() - 2) &&
          gy < static_cast<float>(picture.area.height() - 2))) {
        return std::nullopt;
    }
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    if (*picture.inside.pixel(x, y) == 0 || *picture.inside.pixel(x + 1, y + 1) == 0)
        return std::nullopt;
    return LookupCell{picture.value.pixel(x - 1, y - 1), gx - static_cast<float>(x),
                      gy - static_cast<float>(y)};
}

}  // namespace

int local_window(int width) {
    const double sigma = kLocal_px * static_cast<double>(width) / 854.0;
    return 2 * static_cast<int>(std::lround(sigma)) + 1;
}

RegistrationPicture registration_picture(ViewU8x1 luma, ViewU8x1 visible) {
    RegistrationPicture out;
    const cv::Mat all = as_mat(visible) >= 128;
    cv::Rect box = cv::boundingRect(all);
    if (box.empty()) return out;
    const cv::Mat inside = all(box);
    out.area = {box.x, box.y, box.x + box.width, box.y + box.height};

    // Local mean and deviation by normalised convolution, from inside the region only.
    cv::Mat value, share, mean, square;
    as_mat(luma)(box).convertTo(value, CV_32F);
    inside.convertTo(share, CV_32F, 1.0 / 255);
    cv::GaussianBlur(value, value, {0, 0}, 0.6);
    const auto local = [&](const cv::Mat& m, cv::Mat& smooth) {
        const int r = local_window(luma.width());
        // Two box filters replace the Gaussian.
        cv::boxFilter(m, smooth, CV_32F, {r, r}, {-1, -1}, true, cv::BORDER_REPLICATE);
        cv::boxFilter(smooth, smooth, CV_32F, {r, r}, {-1, -1}, true, cv::BORDER_REPLICATE);
    };
    cv::Mat covered;
    local(share, covered);
    covered += 1e-4f;
    local(value.mul(share), mean);
    cv::divide(mean, covered, mean);
    value -= mean;
    local(value.mul(value).mul(share), square);
    cv::divide(square, covered, square);
    // Nine levels² keep a blank place from showing only its noise.
    square += 9.0f;
    cv::sqrt(square, square);
    cv::divide(value, square, value);

    cv::Mat framed, distance;
    cv::copyMakeBorder(all, framed, 1, 1, 1, 1, cv::BORDER_REPLICATE);
    cv::distanceTransform(framed(cv::Rect(box.x, box.y, box.width + 2, box.height + 2)).clone(),
                          distance, cv::DIST_L2, 3);
    distance = distance(cv::Rect(1, 1, box.width, box.height));
    // A thin region keeps what it has.
    float edge = kEdge_px * std::max(1.0f, static_cast<float>(luma.width()) / 854.0f);
    while (edge > 1 && cv::countNonZero(distance > edge) * 2 < cv::countNonZero(inside))
        edge /= 2;
    out.value = ImageF1(box.width, box.height);
    out.inside = ImageF1(box.width, box.height);
    for (int y = 0; y < box.height; ++y) {
        for (int x = 0; x < box.width; ++x) {
            out.value.at(x, y) = value.at<float>(y, x);
            out.inside.at(x, y) = distance.at<float>(y, x) > edge ? 1.0f : 0.0f;
        }
    }
    return out;
}

RegistrationSamples registration_samples(const RegistrationPicture& picture, int most,
                                         int thinned) {
    constexpr std::int64_t kEnough = 4000;
    std::int64_t count = 0;
    for (int y = 0; y < picture.inside.height(); ++y) {
        const float* row = picture.inside.row(y);
        count += std::count(row, row + picture.inside.width(), 1.0f);
    }
    int stride = 1;
    while (count / (static_cast<std::int64_t>(stride) * stride) > most)
        ++stride;
    RegistrationSamples samples;
    const auto of_thinned = static_cast<std::int64_t>(stride) * thinned;
    if (count / (of_thinned * of_thinned) >= kEnough) {
        stride *= thinned;
        samples.weight = static_cast<double>(thinned) * thinned;
    }
    for (int y = 0; y < picture.inside.height(); y += stride) {
        // Rows are shifted against each other, so that no column is missed altogether.
        for (int x = (y / stride * 2) % stride; x < picture.inside.width(); x += stride) {
            if (picture.inside.at(x, y) == 0) continue;
            samples.p.emplace_back(static_cast<float>(picture.area.x0 + x) + 0.5f,
                                   static_cast<float>(picture.area.y0 + y) + 0.5f);
            samples.value.push_back(picture.value.at(x, y));
        }
    }
    return samples;
}

std::vector<Vec2> places_under(const LatticeField& anchor_from_cur,
                               const RegistrationSamples& samples) {
    std::vector<Vec2> places = anchor_from_cur.at(samples.p);
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] += samples.p[k];
    return places;
}

std::vector<RegistrationResidual> residuals_at(const RegistrationPicture& anchor,
                                               const RegistrationSamples& samples,
                                               const std::vector<Vec2>& places,
                                               const InterpolationNoise& noise) {
    constexpr std::size_t kChunk = 4096;
    std::vector<std::vector<RegistrationResidual>> parts((places.size() + kChunk - 1) / kChunk);
    parallel_for(parts.size(), [&](std::size_t part) {
        const std::size_t end = std::min(places.size(), (part + 1) * kChunk);
        std::vector<RegistrationResidual>& out = parts[part];
        out.reserve(kChunk);
        for (std::size_t k = part * kChunk; k < end; ++k) {
            const auto cell = cell_at(anchor, places[k]);
            if (!cell) continue;
            const F4 wy = weights_at(cell->fy), dy = slopes_at(cell->fy);
            const float* row = cell->first;
            F4 column{}, slope{};
            for (int j = 0; j < 4; ++j, row += anchor.value.stride()) {
                const F4 v = load(row);
                column += wy[j] * v;
                slope += dy[j] * v;
            }
            const F4 wx = weights_at(cell->fx);
            const Vec2 fraction(cell->fx, cell->fy);
            out.push_back({samples.p[k],
                           dot(wx, column) - samples.value[k],
                           {dot(slopes_at(cell->fx), column), dot(wx, slope)},
                           noise.slope(fraction),
                           noise.roughness(fraction),
                           1 + noise.variance(fraction)});
        }
    });
    std::vector<RegistrationResidual> all;
    all.reserve(places.size());
    for (const auto& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

std::optional<float> look_up(const RegistrationPicture& picture, Vec2 p) {
    const auto cell = cell_at(picture, p);
    if (!cell) return std::nullopt;
    const F4 wy = weights_at(cell->fy);
    const float* row = cell->first;
    F4 column{};
    for (int j = 0; j < 4; ++j, row += picture.value.stride())
        column += wy[j] * load(row);
    return dot(weights_at(cell->fx), column);
}

double robust_deviation(std::vector<float> sizes) {
    if (sizes.empty()) return 0;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return 1.4826 * static_cast<double>(*middle);
}

double robust_spread(const std::vector<RegistrationResidual>& residuals) {
    std::vector<float> sizes;
    sizes.reserve(residuals.size());
    for (const RegistrationResidual& t : residuals)
        sizes.push_back(std::abs(t.r));
    return std::max(0.03, robust_deviation(std::move(sizes)));
}

RegistrationFit registration_fit(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                                 const LatticeField& anchor_from_cur,
                                 const RegistrationOptions& options) {
    // Saturating: a pixel that shows something else counts as one that shows nothing.
    constexpr double kMost = 1.0;
    double sum = 0;
    std::size_t seen = 0, agreeing = 0;
    const RegistrationSamples samples = registration_samples(cur, options.samples / 2);
    const std::vector<Vec2> places = places_under(anchor_from_cur, samples);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto there = look_up(anchor, places[k]);
        if (!there) continue;
        const double r = std::abs(static_cast<double>(*there) - samples.value[k]);
        ++seen;
        agreeing += r < kMost;
        sum += std::min(r, kMost);
    }
    if (seen == 0) return {1, 0};
    return {sum / static_cast<double>(seen),
            static_cast<double>(agreeing) / static_cast<double>(samples.size())};
}

namespace {

// Sums of one cell for the correlations under some maps.
template <std::size_t N>
struct CellSums {
    std::array<double, N> product{}, there{};
    double here = 0;
    int count = 0;

    void add(float value, const std::array<float, N>& found) {
        for (std::size_t k = 0; k < N; ++k) {
            product[k] += static_cast<double>(value) * found[k];
            there[k] += static_cast<double>(found[k]) * found[k];
        }
        here += static_cast<double>(value) * value;
        ++count;
    }
    [[nodiscard]] double correlation(std::size_t k) const {
        constexpr double kNothing = 1e-9;
        return product[k] / std::sqrt(there[k] * here + kNothing);
    }
};

template <std::size_t N>
std::optional<std::array<float, N>> look_up_all(const RegistrationPicture& picture,
                                                const std::array<std::vector<Vec2>, N>& places,
                                                std::size_t i) {
    std::array<float, N> found{};
    for (std::size_t k = 0; k < N; ++k) {
        const auto value = look_up(picture, places[k][i]);
        if (!value) return std::nullopt;
        found[k] = *value;
    }
    return found;
}

// The correlations of the two pictures in cells of 24 px (of 640), by cell under every map; of
// cells that hold enough. At most `most` samples.
template <std::size_t N>
std::vector<std::array<double, N>> correlations(const RegistrationPicture& anchor,
                                                const RegistrationPicture& cur,
                                                const std::array<const LatticeField*, N>& maps,
                                                int most) {
    constexpr int kFewest = 30;
    const float unit = std::max(1.0f, static_cast<float>(maps[0]->full_size().width) / 640);
    const float cell_px = 24 * unit;
    const auto cell_of = [&](float from) { return static_cast<std::size_t>(from / cell_px); };
    const std::size_t across = cell_of(static_cast<float>(cur.area.width())) + 1;
    const std::size_t down = cell_of(static_cast<float>(cur.area.height())) + 1;
    std::vector<CellSums<N>> cells(across * down);
    const RegistrationSamples samples = registration_samples(cur, most);
    std::array<std::vector<Vec2>, N> places;
    for (std::size_t k = 0; k < N; ++k)
        places[k] = places_under(*maps[k], samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto found = look_up_all(anchor, places, i);
        if (!found) continue;
        const std::size_t column = cell_of(samples.p[i].x - static_cast<float>(cur.area.x0));
        const std::size_t row = cell_of(samples.p[i].y - static_cast<float>(cur.area.y0));
        cells[row * across + column].add(samples.value[i], *found);
    }
    std::vector<std::array<double, N>> out;
    for (const CellSums<N>& cell : cells) {
        if (cell.count < kFewest) continue;
        std::array<double, N>& of_cell = out.emplace_back();
        for (std::size_t k = 0; k < N; ++k)
            of_cell[k] = cell.correlation(k);
    }
    return out;
}

}  // namespace

double registration_agreement(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                              const LatticeField& anchor_from_cur) {
    constexpr int kSamples = 24000;
    const auto cells = correlations<1>(anchor, cur, {&anchor_from_cur}, kSamples);
    double sum = 0;
    for (const auto& cell : cells)
        sum += cell[0];
    return cells.empty() ? 0 : sum / static_cast<double>(cells.size());
}

RegistrationLead registration_lead(const RegistrationPicture& anchor,
                                   const RegistrationPicture& cur, const LatticeField& a,
                                   const LatticeField& b, double left_out) {
    constexpr int kSamples = 40000;
    constexpr std::size_t kFewest = 3;
    constexpr double kLeast = 1e-4;  // standard error: two maps may be the same
    const auto cells = correlations<2>(anchor, cur, {&a, &b}, kSamples);
    std::vector<double> leads;
    leads.reserve(cells.size());
    for (const auto& cell : cells)
        leads.push_back(cell[0] - cell[1]);
    if (left_out > 0) {
        const std::size_t kept =
            leads.size() - static_cast<std::size_t>(left_out * static_cast<double>(leads.size()));
        std::nth_element(leads.begin(), leads.begin() + static_cast<std::ptrdiff_t>(kept),
                         leads.end());
        leads.resize(kept);
    }
    if (leads.size() < kFewest) return {};
    const double n = static_cast<double>(leads.size());
    double sum = 0, squares = 0;
    for (const double lead : leads) {
        sum += lead;
        squares += lead * lead;
    }
    const double mean = sum / n, variance = std::max(0.0, squares / n - mean * mean);
    return {mean, mean / std::max(kLeast, std::sqrt(variance / (n - 1)))};
}

}  // namespace weft
