#include "engine/form/plane_from_lines.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/form/eigen_types.h"
#include "engine/form/exact_math.h"
#include "engine/form/plane_starts.h"
#include "engine/form/rigid_bundle.h"
#include "engine/form/unit_vector.h"

namespace weft {
namespace {

constexpr double kHand_px = 1;  // how exactly a line is drawn, at the picture's long side kSide
constexpr double kSide = 960;
constexpr double kLeastPlaneNearness = 0.02;
constexpr double kDerivativeStep = 1e-6;  // of the numeric derivatives
constexpr int kPlaneSteps = 40;
constexpr double kSkew = 0.26;  // deviation of an angle that was drawn as a right one, radians

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

// Slopes, tangent, the direction of `along`: in view space, unit, not yet in the plane; and by how
// much the angle to `across` is off a right one, radians.
struct Guess {
    double slope_x = 0, slope_y = 0, tangent = 1;
    glm::dvec3 direction{1, 0, 0};
    double skew = 0;
};

class Lines {
  public:
    Lines(const std::vector<PictureLine>& along, const std::vector<PictureLine>& across,
          Size picture, std::optional<double> tangent, bool skewed)
        : along_(along), across_(across), skewed_(skewed) {
        flat_.middle =
            0.5f * Vec2(static_cast<float>(picture.width), static_cast<float>(picture.height));
        flat_.long_side = std::max(picture.width, picture.height);
        sigma_ = kHand_px * flat_.long_side / kSide;
        if (tangent) prior_.tangent = *tangent, prior_.tangent_deviation = kGivenTangentDeviation;
        glm::dvec2 sum{0};
        const auto each = [&](auto&& visit) {
            for (const auto* group : {&along_, &across_})
                for (const PictureLine& line : *group)
                    visit(line.from), visit(line.to);
        };
        each([&](glm::dvec2 p) { sum += p; });
        centre_ = sum / (2.0 * static_cast<double>(along.size() + across.size()));
        each([&](glm::dvec2 p) {
            const glm::dvec2 d = p - centre_;
            radius_ = std::max(radius_, std::sqrt(d.x * d.x + d.y * d.y));
        });
    }

    [[nodiscard]] std::vector<Guess> starts() const {
        std::vector<double> tangents(kStartTangents.begin(), kStartTangents.end());
        if (prior_.tangent_deviation == kGivenTangentDeviation) tangents = {prior_.tangent};
        std::vector<Guess> out;
        for (const double tangent : tangents)
            for (const glm::dvec2& slope : start_slopes())
                out.push_back(start(tangent, slope));
        return out;
    }

    // Squares of all errors in units of their deviation.
    [[nodiscard]] double cost(const Guess& g) const {
        const Eigen::VectorXd r = errors(g);
        return r.size() == 0 ? std::numeric_limits<double>::infinity() : r.squaredNorm();
    }

    // Normal equations; false where the guess is impossible.
    bool linearise(const Guess& g, Matrix5& matrix, Vector5& right) const {
        const Eigen::VectorXd at = errors(g);
        if (at.size() == 0) return false;
        Eigen::Matrix<double, Eigen::Dynamic, 5> slopes(at.size(), 5);
        for (int k = 0; k < 5; ++k) {
            const Eigen::VectorXd moved = errors(stepped(g, kDerivativeStep * Vector5::Unit(k)));
            if (moved.size() == 0) return false;
            slopes.col(k) = (moved - at) / kDerivativeStep;
        }
        matrix = slopes.transpose() * slopes;
        right = -slopes.transpose() * at;
        return true;
    }

    [[nodiscard]] Guess stepped(const Guess& g, const Vector5& step) const {
        Guess out{g.slope_x + step[0], g.slope_y + step[1], std::max(0.02, g.tangent + step[2]),
                  g.direction, g.skew};
        const glm::dvec3 n = unit(normal(out));
        const glm::dvec3 flat = unit(out.direction - n * glm::dot(n, out.direction));
        out.direction = unit(flat + step[3] * glm::cross(n, flat));
        out.skew = skewed_ ? g.skew + step[4] : 0;
        return out;
    }

    [[nodiscard]] RigidSurface surface(const Guess& g) const {
        RigidSurface out = flat_;
        out.tangent = g.tangent;
        out.centre = Vec2(centre_);
        out.radius = radius_;
        out.slope_x = g.slope_x;
        out.slope_y = g.slope_y;
        return out;
    }

    // n with n · P = 1 on the plane, whose depth at the centre is 1.
    [[nodiscard]] glm::dvec3 normal(const Guess& g) const {
        const double by = flat_.long_side / (g.tangent * radius_);
        const glm::dvec2 off = (glm::dvec2(flat_.middle) - centre_) / radius_;
        return {g.slope_x * by, g.slope_y * by, 1 + g.slope_x * off.x + g.slope_y * off.y};
    }

    [[nodiscard]] double cosine(const Guess& g) const { return std::abs(unit(normal(g)).z); }

  private:
    [[nodiscard]] glm::dvec3 ray(glm::dvec2 place, double tangent) const {
        const glm::dvec2 d = (place - glm::dvec2(flat_.middle)) * tangent / flat_.long_side;
        return {d.x, d.y, 1};
    }
    [[nodiscard]] double nearness(const Guess& g, glm::dvec2 place) const {
        const glm::dvec2 y = (place - centre_) / radius_;
        return 1 + g.slope_x * y.x + g.slope_y * y.y;
    }
    [[nodiscard]] Guess start(double tangent, glm::dvec2 slope) const {
        Guess out{slope.x, slope.y, tangent, {1, 0, 0}};
        const PictureLine& line = along_.front();
        const glm::dvec3 step = ray(line.to, tangent) / std::max(0.1, nearness(out, line.to)) -
                                ray(line.from, tangent) / std::max(0.1, nearness(out, line.from));
        out.direction = unit(step);
        return out;
    }

    // How far a line's ends are off the line through its middle and the vanishing point of a
    // direction, px.
    [[nodiscard]] double off(const PictureLine& line, const glm::dvec3& direction,
                             double tangent) const {
        const glm::dvec2 mid = 0.5 * (line.from + line.to), half = 0.5 * (line.to - line.from);
        // The picture of a step along the direction from the middle: finite also for a vanishing
        // point at infinity.
        const glm::dvec3 at = ray(mid, tangent);
        const glm::dvec2 to(direction.x - at.x * direction.z, direction.y - at.y * direction.z);
        const double length = std::sqrt(to.x * to.x + to.y * to.y);
        if (!(length > 1e-9)) return std::sqrt(half.x * half.x + half.y * half.y);
        return (half.x * to.y - half.y * to.x) / length;
    }

    [[nodiscard]] Eigen::VectorXd errors(const Guess& g) const {
        for (const auto* group : {&along_, &across_})
            for (const PictureLine& line : *group)
                for (const glm::dvec2& end : {line.from, line.to})
                    if (nearness(g, end) < kLeastPlaneNearness) return {};
        const glm::dvec3 n = unit(normal(g));
        const glm::dvec3 first = unit(g.direction - n * glm::dot(n, g.direction)),
                         across = glm::cross(n, first),
                         // of unit length as far as it matters: only its direction counts
            second = across + g.skew * first;
        Eigen::VectorXd out(static_cast<Eigen::Index>(along_.size() + across_.size()) + 4);
        Eigen::Index k = 0;
        for (const PictureLine& line : along_)
            out[k++] = off(line, first, g.tangent) / sigma_;
        for (const PictureLine& line : across_)
            out[k++] = off(line, second, g.tangent) / sigma_;
        out[k++] = g.slope_x / prior_.slope;
        out[k++] = g.slope_y / prior_.slope;
        out[k++] = (g.tangent - prior_.tangent) / prior_.tangent_deviation;
        out[k++] = g.skew / kSkew;
        return out;
    }

    const std::vector<PictureLine>&along_, &across_;
    const bool skewed_;
    RigidSurface flat_;
    RigidPrior prior_;
    glm::dvec2 centre_{0};
    double radius_ = 1, sigma_ = 1;
};

Guess descended(const Lines& lines, Guess at) {
    double before = lines.cost(at), damping = 1e-3;
    for (int k = 0; k < kPlaneSteps && damping < 1e8; ++k) {
        Matrix5 matrix;
        Vector5 right;
        if (!lines.linearise(at, matrix, right)) return at;
        const Matrix5 damped =
            matrix + damping * Matrix5(matrix.diagonal().asDiagonal()) + 1e-9 * Matrix5::Identity();
        const Guess next = lines.stepped(at, damped.ldlt().solve(right));
        const double after = lines.cost(next);
        if (!(after < before)) {
            damping *= 10;
            continue;
        }
        const bool enough = before - after < 1e-9 * (1 + before);
        at = next;
        before = after;
        damping = std::max(1e-9, damping * 0.1);
        if (enough) break;
    }
    return at;
}

// The most likely guess from all starts.
Guess best_of(const Lines& lines) {
    Guess best;
    double least = std::numeric_limits<double>::infinity();
    for (const Guess& start : lines.starts()) {
        const Guess at = descended(lines, start);
        const double cost = lines.cost(at);
        if (cost < least * (1 - 1e-6)) best = at, least = cost;
    }
    return best;
}

PlaneFromLines plane_of(const Lines& lines, const Guess& best) {
    PlaneFromLines out{lines.surface(best), degrees_of_cosine(lines.cosine(best)), 0};
    Matrix5 matrix;
    Vector5 right;
    if (!lines.linearise(best, matrix, right)) return out;
    Vector5 slope;
    for (int k = 0; k < 5; ++k) {
        constexpr double kWide = 1e-4;
        const auto tilt = [&](double by) {
            return degrees_of_cosine(lines.cosine(lines.stepped(best, by * Vector5::Unit(k))));
        };
        slope[k] = (tilt(kWide) - tilt(-kWide)) / (2 * kWide);
    }
    const Vector5 solved = (matrix + 1e-9 * Matrix5::Identity()).ldlt().solve(slope);
    out.tilt_error_deg = std::sqrt(std::max(0.0, slope.dot(solved)));
    return out;
}

}  // namespace

PlaneFromLines plane_from_lines(const std::vector<PictureLine>& along,
                                const std::vector<PictureLine>& across, Size picture,
                                std::optional<double> tangent) {
    const Lines upright(along, across, picture, tangent, false);
    const Guess found = best_of(upright);
    if (found.tangent >= kLongestLens && found.tangent <= kWidestLens)
        return plane_of(upright, found);
    // No lens shows these lines at right angles.
    const Lines skewed(along, across, picture, tangent, true);
    return plane_of(skewed, best_of(skewed));
}

}  // namespace weft
