#include "engine/mask/pattern_return.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kAgrees = 0.65f;  // correlation
constexpr float kPattern_levels = 2.0f;
constexpr double kLead = 1.5;
constexpr float kMostWanted = 0.4f;  // of the places around

// The same at half the size; known and wanted where all of a block is.
PatternPair halved(const PatternPair& pair) {
    const auto half = [](const ImageF1& from) {
        ImageF1 to(from.width() / 2, from.height() / 2);
        for (int y = 0; y < to.height(); ++y) {
            for (int x = 0; x < to.width(); ++x)
                to.at(x, y) = 0.25f * (from.at(2 * x, 2 * y) + from.at(2 * x + 1, 2 * y) +
                                       from.at(2 * x, 2 * y + 1) + from.at(2 * x + 1, 2 * y + 1));
        }
        return to;
    };
    PatternPair out{half(pair.key), half(pair.now), half(pair.known), half(pair.wanted)};
    for (ImageF1* flags : {&out.known, &out.wanted}) {
        for (int y = 0; y < flags->height(); ++y)
            std::transform(flags->row(y), flags->row(y) + flags->width(), flags->row(y),
                           [](float share) { return share < 1 ? 0.0f : 1.0f; });
    }
    return out;
}

cv::Mat mat_of(const ImageF1& image) {
    // cv::Mat has no const view; nothing writes to it.
    return {image.height(), image.width(), CV_32F,
            const_cast<float*>(image.data())};  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

cv::Mat window_sum(const cv::Mat& of, int radius) {
    cv::Mat out;
    cv::boxFilter(of, out, CV_32F, {2 * radius + 1, 2 * radius + 1}, {-1, -1}, false,
                  cv::BORDER_CONSTANT);
    return out;
}

// What is known of both pictures less its mean in windows of (2 radius + 1)² pixels, so that a
// slope of light is no pattern.
struct Details {
    cv::Mat key, now, known, count;
};

Details details_of(const PatternPair& pair, int radius, int dx, int dy) {
    const int width = pair.key.width(), height = pair.key.height();
    cv::Mat now(height, width, CV_32F);
    for (int y = 0; y < height; ++y) {
        const float* row = pair.now.row(std::clamp(y + dy, 0, height - 1));
        for (int x = 0; x < width; ++x)
            now.at<float>(y, x) = row[std::clamp(x + dx, 0, width - 1)];
    }
    Details out;
    out.known = mat_of(pair.known);
    out.count = window_sum(out.known, radius);
    const auto detail = [&](const cv::Mat& picture) {
        cv::Mat mean;
        cv::divide(window_sum(picture.mul(out.known), radius), cv::max(out.count, 1.0), mean);
        return cv::Mat((picture - mean).mul(out.known));
    };
    out.key = detail(mat_of(pair.key));
    out.now = detail(now);
    return out;
}

// The correlation of both in windows of (2 radius + 1)² pixels, over what is known; 0 where less
// than half of a window is, or one of them is plain. `dx`, `dy`: key at p is compared to now there.
ImageF1 correlation(const PatternPair& pair, int radius, int dx, int dy) {
    const Details of = details_of(pair, radius, dx, dy);
    const cv::Mat sa = window_sum(of.key, radius), sb = window_sum(of.now, radius),
                  saa = window_sum(of.key.mul(of.key), radius),
                  sbb = window_sum(of.now.mul(of.now), radius),
                  sab = window_sum(of.key.mul(of.now), radius);
    const float least = 0.5f * static_cast<float>((2 * radius + 1) * (2 * radius + 1));
    ImageF1 out(pair.key.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float count = of.count.at<float>(y, x);
            if (count < least) continue;
            const float ma = sa.at<float>(y, x) / count, mb = sb.at<float>(y, x) / count;
            const float va = saa.at<float>(y, x) / count - ma * ma;
            const float vb = sbb.at<float>(y, x) / count - mb * mb;
            const float plain = kPattern_levels * kPattern_levels;
            if (va < plain || vb < plain) continue;
            out.at(x, y) = (sab.at<float>(y, x) / count - ma * mb) / std::sqrt(va * vb);
        }
    }
    return out;
}

// How many of the wanted places agree under a shift.
int agreeing(const PatternPair& pair, int radius, int dx, int dy) {
    const ImageF1 found = correlation(pair, radius, dx, dy);
    int count = 0;
    for (int y = 0; y < found.height(); ++y)
        for (int x = 0; x < found.width(); ++x)
            count += pair.wanted.at(x, y) > 0 && found.at(x, y) > kAgrees ? 1 : 0;
    return count;
}

struct Shift {
    int x = 0, y = 0, agree = 0;
    double lead = 0;  // how many times as much agrees as under any shift further than 2 px away
};

// The shift within `reach` of `about` under which most agrees; the smallest of several.
Shift best_shift(const PatternPair& pair, int radius, Shift about, int reach) {
    std::vector<Shift> all;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
            all.push_back({about.x + dx, about.y + dy});
    parallel_for(all.size(),
                 [&](std::size_t k) { all[k].agree = agreeing(pair, radius, all[k].x, all[k].y); });
    Shift best =
        *std::max_element(all.begin(), all.end(), [](const Shift& one, const Shift& other) {
            if (one.agree != other.agree) return one.agree < other.agree;
            return one.x * one.x + one.y * one.y > other.x * other.x + other.y * other.y;
        });
    int second = 1;
    for (const Shift& other : all)
        if (std::max(std::abs(other.x - best.x), std::abs(other.y - best.y)) > 2)
            second = std::max(second, other.agree);
    best.lead = static_cast<double>(best.agree) / second;
    return best;
}

// Sums over one piece of what is compared.
struct PieceSums {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    void add(double key, double now) {
        n += 1, a += key, b += now, aa += key * key, bb += now * now, ab += key * now;
    }
    [[nodiscard]] double correlation() const {
        const double va = aa - a * a / n, vb = bb - b * b / n;
        return va > 0 && vb > 0 ? (ab - a * b / n) / std::sqrt(va * vb) : 0.0;
    }
};

// Drops the pieces of `mask` that are smaller than `least`, or that are not one pattern with the
// keyframe: windows of a few pixels agree by chance now and then, a whole piece does not.
void keep_certain(Matte& mask, const PatternPair& pair, int radius, double least) {
    constexpr double kOnePattern = 0.8;
    const Details of = details_of(pair, radius, 0, 0);
    const cv::Mat view(mask.height(), mask.width(), CV_8U, mask.data());
    cv::Mat labels;
    const int count = cv::connectedComponents(view, labels, 8, CV_32S);
    std::vector<PieceSums> sums(static_cast<std::size_t>(count));
    const auto piece = [&](int x, int y) { return static_cast<std::size_t>(labels.at<int>(y, x)); };
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x) {
            sums[piece(x, y)].add(static_cast<double>(of.key.at<float>(y, x)),
                                  static_cast<double>(of.now.at<float>(y, x)));
        }
    }
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x) {
            const PieceSums& sum = sums[piece(x, y)];
            if (sum.n < least || sum.correlation() < kOnePattern) mask.at(x, y) = 0;
        }
    }
}

// The pixels around which most of what is wanted agrees.
Matte agreeing_places(const ImageF1& found, const ImageF1& wanted, int radius) {
    const Size size = found.size();
    ImageF1 agrees(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            agrees.at(x, y) = wanted.at(x, y) > 0 && found.at(x, y) > kAgrees ? 1.0f : 0.0f;
    const int around = 2 * radius;
    const cv::Mat share = window_sum(mat_of(agrees), around),
                  among = window_sum(mat_of(wanted), around);
    Matte out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (wanted.at(x, y) > 0 && share.at<float>(y, x) > kMostWanted * among.at<float>(y, x))
                out.at(x, y) = 255;
    return out;
}

// A place of a template in a picture.
struct Peak {
    double correlation = 0;
    Vec2i at{0, 0};
};

// The best place, and the best one further than `apart` pixels from it.
std::pair<Peak, double> best_peaks(const cv::Mat& scores, int apart) {
    std::pair<Peak, double> out{{-1, {0, 0}}, -1};
    const auto score = [&](int x, int y) {
        const float v = scores.at<float>(y, x);
        // Where a picture is plain the quotient is not finite, or beyond 1.
        return std::isfinite(v) && v <= 1.01f ? static_cast<double>(v) : -1.0;
    };
    for (int y = 0; y < scores.rows; ++y)
        for (int x = 0; x < scores.cols; ++x)
            if (score(x, y) > out.first.correlation) out.first = {score(x, y), {x, y}};
    for (int y = 0; y < scores.rows; ++y) {
        for (int x = 0; x < scores.cols; ++x) {
            const Vec2i d = Vec2i(x, y) - out.first.at;
            if (std::max(std::abs(d.x), std::abs(d.y)) > apart)
                out.second = std::max(out.second, score(x, y));
        }
    }
    return out;
}

// The part of `known` between two columns, as a box of places.
Recti bounds_of(const ImageF1& known, int x0, int x1) {
    Recti box;
    for (int y = 0; y < known.height(); ++y)
        for (int x = std::max(0, x0); x < std::min(known.width(), x1); ++x)
            if (known.at(x, y) > 0) box = box.united({x, y, x + 1, y + 1});
    return box;
}

bool has_pattern(const ImageF1& key, const ImageF1& known, const Recti& box) {
    constexpr double kFewest = 60;
    PieceSums sums;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            if (known.at(x, y) > 0)
                sums.add(static_cast<double>(key.at(x, y)), static_cast<double>(key.at(x, y)));
    const double mean = sums.a / std::max(1.0, sums.n);
    const double variance = sums.aa / std::max(1.0, sums.n) - mean * mean;
    return sums.n >= kFewest && variance > static_cast<double>(kPattern_levels * kPattern_levels);
}

}  // namespace

std::optional<Vec2i> find_anywhere(const ImageF1& key, const ImageF1& known,
                                   const ImageF1& picture) {
    constexpr double kLeast = 0.7, kAhead = 0.12;
    const Recti whole = bounds_of(known, 0, known.width());
    const int middle = (whole.x0 + whole.x1) / 2;
    std::optional<Vec2i> found;
    double best = kLeast;
    for (const Recti& box :
         {whole, bounds_of(known, whole.x0, middle), bounds_of(known, middle, whole.x1)}) {
        if (box.empty() || !has_pattern(key, known, box)) continue;
        const cv::Rect part(box.x0, box.y0, box.width(), box.height());
        cv::Mat scores;
        cv::matchTemplate(mat_of(picture), mat_of(key)(part).clone(), scores, cv::TM_CCOEFF_NORMED,
                          mat_of(known)(part).clone());
        const auto [peak, second] = best_peaks(scores, std::max(3, box.width() / 4));
        if (peak.correlation < best || peak.correlation < second + kAhead) continue;
        best = peak.correlation;
        found = peak.at - Vec2i(box.x0, box.y0);
    }
    return found;
}

std::optional<Vec2i> find_shift(PatternPair pair, int radius, int halvings, double least_px) {
    std::vector<PatternPair> levels{std::move(pair)};
    for (int k = 0; k < halvings; ++k)
        levels.push_back(halved(levels.back()));
    Shift shift;
    for (std::size_t level = levels.size(); level-- > 0;) {
        const bool first = level + 1 == levels.size();
        shift = best_shift(levels[level], std::max(2, radius >> level), {2 * shift.x, 2 * shift.y},
                           first ? 4 : 1);
        // Lines agree along themselves, and by chance anything does a little.
        if (first && shift.lead < kLead) return std::nullopt;
        if (std::ldexp(shift.agree, 2 * static_cast<int>(level)) < least_px) return std::nullopt;
    }
    return Vec2i(shift.x, shift.y);
}

Matte found_again(const PatternPair& pair, int radius, double least_px) {
    Matte out = agreeing_places(correlation(pair, radius, 0, 0), pair.wanted, radius);
    keep_certain(out, pair, radius, least_px);
    return out;
}

}  // namespace weft
