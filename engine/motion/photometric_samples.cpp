#include "engine/motion/photometric_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace weft {
namespace {

cv::Mat as_mat(ViewU8x1 v) {
    return {v.height(), v.width(), CV_8UC1, const_cast<std::uint8_t*>(v.data()),
            static_cast<std::size_t>(v.stride())};
}

// Local means reach this far, px at a width of 854.
constexpr float kLocal_px = 4;
// Pixels nearer to the outline are mixed with the background.
constexpr float kEdge_px = 3;

// Catmull–Rom weights of four neighbours at fraction t, and their derivatives.
void weights_at(float t, std::array<float, 4>& w, std::array<float, 4>& d) {
    const float t2 = t * t, t3 = t2 * t;
    w = {-0.5f * t + t2 - 0.5f * t3, 1 - 2.5f * t2 + 1.5f * t3, 0.5f * t + 2 * t2 - 1.5f * t3,
         -0.5f * t2 + 0.5f * t3};
    d = {-0.5f + 2 * t - 1.5f * t2, -5 * t + 4.5f * t2, 0.5f + 4 * t - 4.5f * t2, -t + 1.5f * t2};
}

}  // namespace

RegistrationPicture registration_picture(ViewU8x1 luma, ViewU8x1 visible) {
    RegistrationPicture out;
    const cv::Mat all = as_mat(visible) >= 128;
    cv::Rect box = cv::boundingRect(all);
    if (box.empty()) return out;
    const cv::Mat inside = all(box);
    out.area = {box.x, box.y, box.x + box.width, box.y + box.height};

    // Local mean and deviation by normalised convolution, from inside the region only.
    const double sigma = kLocal_px * static_cast<double>(luma.width()) / 854.0;
    cv::Mat value, share, mean, square;
    as_mat(luma)(box).convertTo(value, CV_32F);
    inside.convertTo(share, CV_32F, 1.0 / 255);
    cv::GaussianBlur(value, value, {0, 0}, 0.6);
    const auto local = [&](const cv::Mat& m, cv::Mat& smooth) {
        const int r = 2 * static_cast<int>(std::lround(sigma)) + 1;
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

std::vector<RegistrationSample> registration_samples(const RegistrationPicture& picture, int most) {
    std::int64_t count = 0;
    for (int y = 0; y < picture.inside.height(); ++y) {
        const float* row = picture.inside.row(y);
        count += std::count(row, row + picture.inside.width(), 1.0f);
    }
    int stride = 1;
    while (count / (static_cast<std::int64_t>(stride) * stride) > most)
        ++stride;
    std::vector<RegistrationSample> samples;
    for (int y = 0; y < picture.inside.height(); y += stride) {
        // Rows are shifted against each other, so that no column is missed altogether.
        for (int x = (y / stride * 2) % stride; x < picture.inside.width(); x += stride) {
            if (picture.inside.at(x, y) == 0) continue;
            samples.push_back({{static_cast<float>(picture.area.x0 + x) + 0.5f,
                                static_cast<float>(picture.area.y0 + y) + 0.5f},
                               picture.value.at(x, y)});
        }
    }
    return samples;
}

std::optional<RegistrationLookup> look_up(const RegistrationPicture& picture, Vec2 p) {
    const float gx = p.x - 0.5f - static_cast<float>(picture.area.x0);
    const float gy = p.y - 0.5f - static_cast<float>(picture.area.y0);
    if (!(gx >= 1 && gy >= 1 && gx < static_cast<float>(picture.area.width() - 2) &&
          gy < static_cast<float>(picture.area.height() - 2))) {
        return std::nullopt;
    }
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    if (picture.inside.at(x, y) == 0 || picture.inside.at(x + 1, y + 1) == 0) return std::nullopt;
    std::array<float, 4> wx{}, dx{}, wy{}, dy{};
    weights_at(gx - static_cast<float>(x), wx, dx);
    weights_at(gy - static_cast<float>(y), wy, dy);
    RegistrationLookup out{0, {0, 0}};
    for (int j = 0; j < 4; ++j) {
        const float* row = picture.value.pixel(x - 1, y - 1 + j);
        const auto k = static_cast<std::size_t>(j);
        const float v = wx[0] * row[0] + wx[1] * row[1] + wx[2] * row[2] + wx[3] * row[3];
        const float g = dx[0] * row[0] + dx[1] * row[1] + dx[2] * row[2] + dx[3] * row[3];
        out.value += wy[k] * v;
        out.gradient.x += wy[k] * g;
        out.gradient.y += dy[k] * v;
    }
    return out;
}

double robust_spread(std::vector<float>& sizes) {
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return std::max(0.03, 1.4826 * static_cast<double>(*middle));
}

RegistrationFit registration_fit(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                                 const LatticeField& anchor_from_cur,
                                 const RegistrationOptions& options) {
    // Saturating: a pixel that shows something else counts as one that shows nothing.
    constexpr double kMost = 1.0;
    RegistrationFit fit;
    double sum = 0;
    std::size_t seen = 0, agreeing = 0;
    const auto samples = registration_samples(cur, options.samples / 2);
    for (const RegistrationSample& s : samples) {
        const auto there = look_up(anchor, s.p + anchor_from_cur.at(s.p));
        if (!there) continue;
        const double r = std::abs(static_cast<double>(there->value) - s.value);
        ++seen;
        agreeing += r < kMost;
        sum += std::min(r, kMost);
    }
    if (seen == 0) return {1, 0};
    return {sum / static_cast<double>(seen),
            static_cast<double>(agreeing) / static_cast<double>(samples.size())};
}

namespace {

// Sums of one cell for the correlation under a map and under its four shifts.
struct CellSums {
    std::array<double, 5> product{}, there{}, here{};
    int count = 0;

    [[nodiscard]] double correlation(std::size_t k) const {
        constexpr double kNothing = 1e-9;
        return product[k] / std::sqrt(there[k] * here[k] + kNothing);
    }
    [[nodiscard]] double evidence() const {
        return correlation(0) -
               (correlation(1) + correlation(2) + correlation(3) + correlation(4)) / 4;
    }
};

}  // namespace

double registration_evidence(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                             const LatticeField& anchor_from_cur) {
    constexpr int kSamples = 40000, kFewest = 40;
    const float unit = std::max(1.0f, static_cast<float>(anchor_from_cur.full_size().width) / 640);
    const float shift = 4 * unit, cell_px = 32 * unit;
    const std::array<Vec2, 5> shifts{Vec2(0), Vec2(shift, 0), Vec2(-shift, 0), Vec2(0, shift),
                                     Vec2(0, -shift)};
    const auto cell_of = [&](float from) { return static_cast<std::size_t>(from / cell_px); };
    const std::size_t across = cell_of(static_cast<float>(cur.area.width())) + 1;
    const std::size_t down = cell_of(static_cast<float>(cur.area.height())) + 1;
    std::vector<CellSums> cells(across * down);
    for (const RegistrationSample& s : registration_samples(cur, kSamples)) {
        const std::size_t column = cell_of(s.p.x - static_cast<float>(cur.area.x0));
        const std::size_t row = cell_of(s.p.y - static_cast<float>(cur.area.y0));
        CellSums& cell = cells[row * across + column];
        const Vec2 place = s.p + anchor_from_cur.at(s.p);
        ++cell.count;
        for (std::size_t k = 0; k < shifts.size(); ++k) {
            const auto there = look_up(anchor, place + shifts[k]);
            if (!there) continue;
            cell.product[k] += static_cast<double>(s.value) * there->value;
            cell.there[k] += static_cast<double>(there->value) * there->value;
            cell.here[k] += static_cast<double>(s.value) * s.value;
        }
    }
    std::vector<double> found;
    for (const CellSums& cell : cells)
        if (cell.count >= kFewest) found.push_back(cell.evidence());
    if (found.empty()) return 0;
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), middle, found.end());
    return *middle;
}

}  // namespace weft
