#include "engine/composite/focus_course.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace weft {
namespace {

// Errors of a reading as shares of its blur: what is left of it however many edges a frame has, and
// the one that is aimed at by taking more frames.
constexpr double kLeastError = 0.03, kWantedError = 0.03;
constexpr double kLeastError_px = 0.02;
// Half the width of the window, frames, and how many readings it holds at least, each counted by
// how near it is: as many as two steps of the grid to either side.
constexpr double kNarrowest = kFocusStep, kWidest = kFocusReach + 1.0, kFewestReadings = 2.1;
constexpr int kCourseHalvings = 24, kPasses = 20;
constexpr double kOfMedian = 1.4826;  // deviation of a normal distribution, by its median length
constexpr double kOutlier = 3;        // deviations, at which a reading counts a quarter
constexpr double kDiffer = 2.5;       // deviations, of two readings
constexpr float kSharp_px = 0.6f;     // of both, below which a difference is not seen
// Of the slope of the line, in squared frames: with readings on one side only it stays flat.
constexpr double kRidge = 2;

double error_of(const FocusReading& r) {
    const double share = kLeastError * static_cast<double>(r.blur_px);
    const double error = static_cast<double>(r.error_px);
    return std::sqrt(error * error + share * share + kLeastError_px * kLeastError_px);
}

struct Point {
    double away = 0;  // frames
    double blur = 0, error = 1, certainty = 0;
    double weight = 0;
    const FocusReading* reading = nullptr;
    // What it tells. Of soft and sharp ones the same share of the blur is an error.
    [[nodiscard]] double information() const { return certainty * (blur / error) * (blur / error); }
};

// The biweight.
double nearness_of(double away, double half_width) {
    const double u = away / half_width;
    return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0.0;
}

// A line through a value of the points; its value at the frame itself.
class Line {
  public:
    explicit Line(const std::vector<Point>& points) : points_(points) {
        for (const Point& p : points) {
            w_ += p.weight;
            wt_ += p.weight * p.away;
            wtt_ += p.weight * p.away * p.away;
        }
        wtt_ += kRidge * w_;
    }
    template <class Value>
    [[nodiscard]] std::pair<double, double> fit(Value&& value) const {
        double v = 0, vt = 0;
        for (const Point& p : points_) {
            v += p.weight * value(p);
            vt += p.weight * value(p) * p.away;
        }
        const double det = w_ * wtt_ - wt_ * wt_;
        return {(wtt_ * v - wt_ * vt) / det, (w_ * vt - wt_ * v) / det};
    }
    template <class Value>
    [[nodiscard]] float at(Value&& value) const {
        return static_cast<float>(fit(value).first);
    }
    // What a point's value counts for in at().
    [[nodiscard]] double share(const Point& p) const {
        return p.weight * (wtt_ - wt_ * p.away) / (w_ * wtt_ - wt_ * wt_);
    }

  private:
    const std::vector<Point>& points_;
    double w_ = 0, wt_ = 0, wtt_ = 0;
};

// The median of their blurs, each counted by its certainty.
double typical_blur(std::vector<Point> points) {
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.blur < b.blur; });
    double all = 0, below = 0;
    for (const Point& p : points)
        all += p.information();
    for (const Point& p : points) {
        below += p.information();
        if (2 * below >= all) return p.blur;
    }
    return points.back().blur;
}

// How far the window has to reach for the error that is wanted.
double window_for(const std::vector<Point>& points) {
    const auto enough = [&](double half_width) {
        double information = 0, count = 0;
        for (const Point& p : points) {
            const double nearness = nearness_of(p.away, half_width);
            information += nearness * p.information();
            count += nearness;
        }
        return count >= kFewestReadings && information * kWantedError * kWantedError >= 1;
    };
    double low = kNarrowest, high = kWidest;
    for (int i = 0; i < kCourseHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (enough(middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

// Gives the points their weights: from a flat line through the median on, so that a reading that
// stands alone does not draw the line to itself.
void weigh(std::vector<Point>& points) {
    const double half_width = window_for(points);
    const double typical = typical_blur(points);
    const auto set = [&](double level, double slope) {
        // What no line explains of the others is no outlier: a pull begins and ends.
        std::vector<double> residues;
        for (const Point& p : points)
            if (std::abs(p.away) < half_width)
                residues.push_back(std::abs(p.blur - level - slope * p.away));
        std::nth_element(residues.begin(), residues.begin() + std::ssize(residues) / 2,
                         residues.end());
        const double common = kOfMedian * residues[residues.size() / 2];
        for (Point& p : points) {
            const double off = std::abs(p.blur - level - slope * p.away) /
                               std::sqrt(p.error * p.error + common * common);
            const double among = 1 / (1 + off * off / (kOutlier * kOutlier));
            p.weight = nearness_of(p.away, half_width) * p.information() * among * among;
        }
    };
    set(typical, 0);
    for (int pass = 0; pass < kPasses; ++pass) {
        const auto [level, slope] = Line(points).fit([](const Point& p) { return p.blur; });
        set(level, slope);
    }
}

BlurSlope slope_by(const Line& line) {
    BlurSlope out;
    const auto at = [&](float BlurSlope::*member) {
        return line.at(
            [&](const Point& p) { return static_cast<double>(p.reading->slope.*member); });
    };
    out.agreement = std::clamp(at(&BlurSlope::agreement), 0.0f, 1.0f);
    if (!(out.agreement > 0)) return {};
    // The planes of those that have one.
    const auto of_agreeing = [&](float BlurSlope::*member) {
        const float sum = line.at([&](const Point& p) {
            return static_cast<double>(p.reading->slope.agreement * (p.reading->slope.*member));
        });
        return sum / out.agreement;
    };
    out.constant = of_agreeing(&BlurSlope::constant);
    out.by_x = of_agreeing(&BlurSlope::by_x);
    out.by_y = of_agreeing(&BlurSlope::by_y);
    out.least_px = std::clamp(of_agreeing(&BlurSlope::least_px), kSharpestEdge_px, kSoftestEdge_px);
    out.most_px = std::clamp(of_agreeing(&BlurSlope::most_px), out.least_px, kSoftestEdge_px);
    return out;
}

std::vector<Point> points_around(int frame, const std::vector<TimedReading>& readings, bool lens) {
    std::vector<Point> out;
    for (const TimedReading& t : readings) {
        const FocusReading& r = t.reading;
        const bool tells = lens ? r.has_lens : r.blur_px > 0 && r.confidence > 0;
        if (!tells || std::abs(t.frame - frame) > kFocusReach) continue;
        Point p;
        p.away = t.frame - frame;
        p.reading = &r;
        // A lens that was fitted to the whole plate needs no evidence from the region.
        p.blur = lens ? static_cast<double>(r.lens.blur_px(r.lens.middle))
                      : static_cast<double>(r.blur_px);
        p.error = lens ? std::max(kLeastError * p.blur, kLeastError_px) : error_of(r);
        p.certainty = lens ? 1.0 : static_cast<double>(r.confidence);
        out.push_back(p);
    }
    return out;
}

}  // namespace

bool differ(const FocusReading& a, const FocusReading& b) {
    if (a.has_lens && b.has_lens) {
        const float from = a.lens.blur_px(a.lens.middle), to = b.lens.blur_px(a.lens.middle);
        if (std::abs(from - to) > 3 * static_cast<float>(kLeastError) * std::max(from, to))
            return true;
    }
    const bool both = a.blur_px > 0 && b.blur_px > 0 && a.confidence > 0 && b.confidence > 0;
    if (!both || std::max(a.blur_px, b.blur_px) < kSharp_px) return false;
    const double of_a = error_of(a), of_b = error_of(b);
    const double error = std::sqrt(of_a * of_a + of_b * of_b);
    return static_cast<double>(std::abs(a.blur_px - b.blur_px)) > kDiffer * error;
}

float FocusState::lens_blur_px(float nearness) const {
    float variance = 0;
    for (const Lens& lens : lenses) {
        const float blur = lens.model.blur_px(nearness);
        variance += lens.weight * blur * blur;
    }
    return std::clamp(std::sqrt(std::max(0.0f, variance)), kSharpestEdge_px, kSoftestEdge_px);
}

FocusState focus_at(int frame, const std::vector<TimedReading>& readings) {
    FocusState out;
    std::vector<Point> points = points_around(frame, readings, false);
    if (!points.empty()) {
        weigh(points);
        const Line line(points);
        out.blur_px = std::clamp(line.at([](const Point& p) { return p.blur; }), kSharpestEdge_px,
                                 kSoftestEdge_px);
        out.confidence =
            std::clamp(line.at([](const Point& p) { return p.certainty; }), 0.0f, 1.0f);
        out.slope = slope_by(line);
    }
    std::vector<Point> lenses = points_around(frame, readings, true);
    if (lenses.empty()) return out;
    weigh(lenses);
    const Line line(lenses);
    for (const Point& p : lenses) {
        const double share = line.share(p);
        if (share != 0) out.lenses.push_back({static_cast<float>(share), p.reading->lens});
    }
    return out;
}

}  // namespace weft
