#include "engine/form/metric_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/form/exact_math.h"
#include "engine/motion/lattice_field.h"

namespace weft {
namespace {

constexpr int kSweeps = 400;           // of the relaxation, from the mean of what is known
constexpr double kMostAreaOff = 1e4;   // times, from the mean; a horizon is infinitely far
constexpr double kLeastFacing = 0.03;  // cosine; more grazing is not believed

struct Eigen2 {
    double larger = 1, smaller = 1, cosine = 1, sine = 0;  // of the larger one's direction
};

Eigen2 eigen_of(const Metric& m) {
    const double half = 0.5 * (m.xx + m.yy), difference = 0.5 * (m.xx - m.yy);
    const double root = std::sqrt(difference * difference + m.xy * m.xy);
    if (!(root > 0)) return {half, half, 1, 0};
    // Of half the angle whose cosine is difference / root and whose sine is xy / root.
    const double longer = std::sqrt(0.5 * (1 + std::abs(difference) / root));
    const double shorter = m.xy / (2 * root * longer);
    const bool along_x = difference >= 0;
    return {half + root, half - root, along_x ? longer : std::abs(shorter),
            along_x ? shorter : std::copysign(longer, m.xy)};
}

double power_of_e(double v) {
    return static_cast<double>(std::exp(static_cast<long double>(v)));
}

Metric composed(const Eigen2& e) {
    const double c = e.cosine, s = e.sine;
    return {e.larger * c * c + e.smaller * s * s, (e.larger - e.smaller) * c * s,
            e.larger * s * s + e.smaller * c * c};
}

Metric log_of(const Metric& m) {
    Eigen2 e = eigen_of(m);
    e.larger = ln(e.larger);
    e.smaller = ln(e.smaller);
    return composed(e);
}

Metric exp_of(const Metric& m) {
    Eigen2 e = eigen_of(m);
    e.larger = power_of_e(e.larger);
    e.smaller = power_of_e(e.smaller);
    return composed(e);
}

// Within what can be laid: no grazing view and no area beyond all others.
Metric bounded_metric(const Metric& m) {
    Eigen2 e = eigen_of(m);
    e.smaller = std::max(e.smaller, e.larger * kLeastFacing * kLeastFacing);
    const double area = std::sqrt(e.larger * e.smaller);
    const double scale = std::clamp(area, 1 / kMostAreaOff, kMostAreaOff) / area;
    e.larger *= scale;
    e.smaller *= scale;
    return composed(e);
}

Metric scaled(const Metric& m, double by) {
    return {by * m.xx, by * m.xy, by * m.yy};
}

}  // namespace

double facing(const Metric& metric) {
    const Eigen2 e = eigen_of(metric);
    return e.larger > 0 ? std::sqrt(std::max(0.0, e.smaller) / e.larger) : 0.0;
}

double log_area(const Metric& metric) {
    return 0.5 * ln(metric.determinant());
}

MetricField::MetricField(Size frame, int spacing)
    : MetricField(frame, {0, 0, frame.width, frame.height}, spacing) {}

MetricField::MetricField(Size frame, const Recti& domain, int spacing)
    : frame_(frame), domain_(domain), spacing_(spacing) {
    const LatticeField lattice(domain.size(), spacing);
    cells_ = {lattice.nodes().width() - 1, lattice.nodes().height() - 1};
    const auto count =
        static_cast<std::size_t>(cells_.width) * static_cast<std::size_t>(cells_.height);
    metrics_.resize(count);
    evidence_.resize(count);
}

bool MetricField::in_frame(int i, int j) const {
    const auto inside = [&](int cell, int origin, int side) {
        const int twice = 2 * origin + (2 * (cell - LatticeField::kMargin) + 1) * spacing_;
        return twice >= 0 && twice < 2 * side;
    };
    return inside(i, domain_.x0, frame_.width) && inside(j, domain_.y0, frame_.height);
}

Vec2 MetricField::centre_of(int i, int j) const {
    const auto centre = [this](int cell, int origin) {
        return static_cast<float>(origin) +
               (static_cast<float>(cell - LatticeField::kMargin) + 0.5f) *
                   static_cast<float>(spacing_);
    };
    return {centre(i, domain_.x0), centre(j, domain_.y0)};
}

std::optional<std::size_t> MetricField::cell_of(Vec2 place) const {
    const auto cell = [&](float p, int origin) {
        return static_cast<int>(
                   std::floor((p - static_cast<float>(origin)) / static_cast<float>(spacing_))) +
               LatticeField::kMargin;
    };
    if (!(std::abs(place.x) < 1e6f && std::abs(place.y) < 1e6f)) return std::nullopt;
    const int i = cell(place.x, domain_.x0), j = cell(place.y, domain_.y0);
    if (i < 0 || j < 0 || i >= cells_.width || j >= cells_.height) return std::nullopt;
    return index(i, j);
}

bool MetricField::has_evidence() const {
    return std::any_of(evidence_.begin(), evidence_.end(), [](double e) { return e > 0; });
}

std::optional<double> MetricField::log_area(Vec2 place) const {
    const auto k = cell_of(place);
    if (!k || !(evidence_[*k] > 0)) return std::nullopt;
    return weft::log_area(scaled(metrics_[*k], 1 / evidence_[*k]));
}

void MetricField::add(Vec2 place, const Metric& metric, double weight) {
    const auto k = cell_of(place);
    if (!k) return;
    Metric& m = metrics_[*k];
    m.xx += weight * metric.xx;
    m.xy += weight * metric.xy;
    m.yy += weight * metric.yy;
    evidence_[*k] += weight;
}

double MetricField::scale_to_unit_area() {
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < metrics_.size(); ++k) {
        if (!(evidence_[k] > 0)) continue;
        sum += evidence_[k] * weft::log_area(metrics_[k]);
        count += evidence_[k];
    }
    const double by = power_of_e(-sum / count);
    for (std::size_t k = 0; k < metrics_.size(); ++k)
        if (evidence_[k] > 0) metrics_[k] = bounded_metric(scaled(metrics_[k], by));
    return by;
}

void MetricField::continue_outwards(const std::vector<bool>& known) {
    std::vector<Metric> logs(metrics_.size());
    Metric mean;
    double count = 0;
    for (std::size_t k = 0; k < metrics_.size(); ++k) {
        if (!known[k]) continue;
        logs[k] = log_of(metrics_[k]);
        mean = {mean.xx + logs[k].xx, mean.xy + logs[k].xy, mean.yy + logs[k].yy};
        ++count;
    }
    mean = scaled(mean, 1 / count);
    for (std::size_t k = 0; k < metrics_.size(); ++k)
        if (!known[k]) logs[k] = mean;
    // Successive over-relaxation in a fixed order.
    constexpr double kOver = 1.9;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (int j = 0; j < cells_.height; ++j) {
            for (int i = 0; i < cells_.width; ++i) {
                const std::size_t k = index(i, j);
                if (known[k]) continue;
                Metric sum;
                double sides = 0;
                const auto take = [&](int x, int y) {
                    if (x < 0 || y < 0 || x >= cells_.width || y >= cells_.height) return;
                    const Metric& m = logs[index(x, y)];
                    sum = {sum.xx + m.xx, sum.xy + m.xy, sum.yy + m.yy};
                    ++sides;
                };
                take(i - 1, j), take(i + 1, j), take(i, j - 1), take(i, j + 1);
                Metric& m = logs[k];
                m.xx += kOver * (sum.xx / sides - m.xx);
                m.xy += kOver * (sum.xy / sides - m.xy);
                m.yy += kOver * (sum.yy / sides - m.yy);
            }
        }
    }
    for (std::size_t k = 0; k < metrics_.size(); ++k)
        if (!known[k]) metrics_[k] = bounded_metric(exp_of(logs[k]));
}

bool MetricField::finish(const Beyond& beyond) {
    bool any = false;
    for (std::size_t k = 0; k < metrics_.size(); ++k) {
        if (!(evidence_[k] > 0)) continue;
        metrics_[k] = scaled(metrics_[k], 1 / evidence_[k]);
        if (!(metrics_[k].determinant() > 0) || !std::isfinite(metrics_[k].determinant()))
            evidence_[k] = 0;
        any = any || evidence_[k] > 0;
    }
    if (!any) return false;
    const double by = scaled_by_ = scale_to_unit_area();
    std::vector<bool> known(metrics_.size());
    for (int j = 0; j < cells_.height; ++j) {
        for (int i = 0; i < cells_.width; ++i) {
            const std::size_t k = index(i, j);
            known[k] = evidence_[k] > 0;
            if (known[k] || !beyond) continue;
            const auto metric = beyond(centre_of(i, j));
            if (!metric || !(metric->determinant() > 0)) continue;
            metrics_[k] = bounded_metric(scaled(*metric, by));
            known[k] = true;
        }
    }
    continue_outwards(known);
    return true;
}

}  // namespace weft
