#include "engine/form/rigid_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/form/eigen_types.h"
#include "engine/form/exact_math.h"
#include "engine/form/plane_starts.h"
#include "engine/form/rigid_bundle.h"
#include "engine/form/still_camera.h"
#include "engine/form/surface_distance.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

constexpr std::size_t kLeastFrames = 2, kLeastPairs = 12;
constexpr double kNotRigid = 0.3;  // of the motion beyond a similarity that may be left
constexpr int kFirstSteps = 4, kMoreSteps = 30;
constexpr std::size_t kKept = 6;
constexpr double kSure = 0.12;   // deviation from which on one tangent is enough to start from
constexpr double kBulge = 0.15;  // of nearness, from which a curved surface is looked for
constexpr double kApart = 0.02;  // ln stretch between solutions that are two

using Matrix32 = Eigen::Matrix<double, 3, 2>;

Vector3 ray_towards(const RigidSurface& s, Vec2 place) {
    return {s.tangent * (static_cast<double>(place.x) - s.middle.x) / s.long_side,
            s.tangent * (static_cast<double>(place.y) - s.middle.y) / s.long_side, 1};
}

// The pose that a homography (in rays of a tangent of 1) shows of a plane (Malis & Vargas 2007): on
// the plane it is a rotation, and where it takes the centre gives the shift.
std::optional<RigidPose> pose_on(const RigidSurface& plane, const Matrix3& homography) {
    const double t = plane.tangent;
    const Matrix3 m =
        Vector3(t, t, 1).asDiagonal() * homography * Vector3(1 / t, 1 / t, 1).asDiagonal();
    const Vector3 centre = ray_towards(plane, plane.centre);
    const double by = plane.long_side / plane.radius;
    Matrix32 along;
    along.col(0) = t * Vector3::UnitX() - by * plane.slope_x * centre;
    along.col(1) = t * Vector3::UnitY() - by * plane.slope_y * centre;
    const auto frame_of = [](const Matrix32& axes) {
        Matrix3 out;
        out.col(0) = axes.col(0);
        out.col(1) = axes.col(1);
        out.col(2) = out.col(0).cross(out.col(1));
        return out;
    };
    // Axes of length 1 on the plane, and what becomes of them.
    Matrix32 axes;
    axes.col(0) = along.col(0).normalized();
    axes.col(1) = (along.col(1) - axes.col(0).dot(along.col(1)) * axes.col(0)).normalized();
    const double sign = (m * centre).z() < 0 ? -1 : 1;
    const Matrix32 moved = sign * m * axes;
    const Eigen::Matrix2d g = moved.transpose() * moved;
    const double area = std::sqrt(std::max(g.determinant(), 0.0));
    if (!(area > 1e-12)) return std::nullopt;
    // G^(−½) for 2 × 2 by G^½ = (G + √det) / √(tr + 2 √det).
    const Eigen::Matrix2d root =
        (g + area * Eigen::Matrix2d::Identity()) / std::sqrt(g.trace() + 2 * area);
    const Matrix3 rotation = frame_of(moved * root.inverse()) * frame_of(axes).transpose();
    return RigidPose{rotation, sign * m * centre / std::sqrt(area) - rotation * centre};
}

// All that is known before a shape is tried.
struct Problem {
    const std::vector<FrameMatches>* frames;
    std::vector<Matrix3> homographies;
    RigidSurface flat;
    RigidPrior prior;
    bool tangent_known;
    double least_sigma;
    std::vector<Vec2> places;

    [[nodiscard]] std::optional<RigidBundle> bundle_on(RigidSurface surface, double sigma) const {
        std::vector<RigidPose> poses;
        for (const Matrix3& h : homographies) {
            const auto pose = pose_on(surface, h);
            if (!pose) return std::nullopt;
            poses.push_back(*pose);
        }
        RigidBundle out(*frames, std::move(surface), std::move(poses), prior, sigma);
        if (!std::isfinite(out.cost())) return std::nullopt;
        return out;
    }
};

std::optional<Problem> problem_of(const std::vector<FrameMatches>& frames, Size picture,
                                  const TangentBelief& tangent) {
    if (frames.size() < kLeastFrames) return std::nullopt;
    Problem out{&frames, {}, {}, {}, tangent.deviation <= kSure, 0, {}};
    RigidSurface& flat = out.flat;
    flat.middle =
        0.5f * Vec2(static_cast<float>(picture.width), static_cast<float>(picture.height));
    flat.long_side = std::max(picture.width, picture.height);
    out.least_sigma = kTrackError * flat.long_side;
    out.prior.tangent = tangent.value;
    out.prior.tangent_deviation = tangent.deviation;
    flat.tangent = out.prior.tangent;
    double x = 0, y = 0, count = 0;
    for (const FrameMatches& m : frames) {
        if (m.reference.size() < kLeastPairs) return std::nullopt;
        for (const Vec2 p : m.reference)
            x += p.x, y += p.y, ++count;
    }
    flat.centre = Vec2(static_cast<float>(x / count), static_cast<float>(y / count));
    double squares = 0, most = 0;
    for (const FrameMatches& m : frames) {
        for (const Vec2 p : m.reference) {
            const Vec2 d = p - flat.centre;
            squares += static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y;
            most = std::max(
                {most, std::abs(static_cast<double>(d.x)), std::abs(static_cast<double>(d.y))});
        }
    }
    flat.radius = std::sqrt(squares / count);
    if (!(flat.radius > 4 * out.least_sigma)) return std::nullopt;
    flat.reach = most / flat.radius;
    for (const FrameMatches& m : frames) {
        std::vector<PlacePair> pairs;
        pairs.reserve(m.reference.size());
        for (std::size_t k = 0; k < m.reference.size(); ++k)
            pairs.push_back({m.reference[k], m.frame[k]});
        const auto h = fit_homography(pairs);
        if (!h) return std::nullopt;
        out.homographies.push_back(in_units(*h, flat.middle, flat.long_side));
    }
    out.places = frames.front().reference;
    return out;
}

// The solutions of `count` starts, in their order, without those that lead nowhere.
template <class From>
std::vector<RigidBundle> solutions_of(std::size_t count, const From& from) {
    std::vector<std::optional<RigidBundle>> found(count);
    parallel_for(count, [&](std::size_t k) { found[k] = from(k); });
    std::vector<RigidBundle> out;
    for (auto& bundle : found) {
        if (bundle) out.push_back(std::move(*bundle));
    }
    return out;
}

// Solutions with a plane, best first, no two alike.
std::vector<RigidBundle> planes(const Problem& problem, double sigma) {
    std::vector<RigidSurface> starts;
    std::vector<double> tangents(kStartTangents.begin(), kStartTangents.end());
    if (problem.tangent_known) tangents = {problem.prior.tangent};
    for (const double tangent : tangents) {
        for (const glm::dvec2& slope : start_slopes()) {
            RigidSurface& start = starts.emplace_back(problem.flat);
            start.tangent = tangent;
            start.slope_x = slope.x;
            start.slope_y = slope.y;
        }
    }
    std::vector<RigidBundle> all = solutions_of(starts.size(), [&](std::size_t k) {
        auto bundle = problem.bundle_on(starts[k], sigma);
        if (bundle) bundle->descend(kFirstSteps);
        return bundle;
    });
    const auto cheaper = [](const RigidBundle& a, const RigidBundle& b) {
        return a.cost() < b.cost();
    };
    std::stable_sort(all.begin(), all.end(), cheaper);
    std::vector<RigidBundle> out;
    for (RigidBundle& bundle : all) {
        if (out.size() == kKept) break;
        const auto alike = [&](const RigidBundle& other) {
            return log_stretch_between(other.surface(), bundle.surface(), problem.places) < kApart;
        };
        if (std::any_of(out.begin(), out.end(), alike)) continue;
        bundle.descend(kMoreSteps);
        if (!std::any_of(out.begin(), out.end(), alike)) out.push_back(std::move(bundle));
    }
    std::stable_sort(out.begin(), out.end(), cheaper);
    return out;
}

// Solutions with a curved surface, from the planes and from bulges either way on the best of them.
std::vector<RigidBundle> curved(const Problem& problem, const std::vector<RigidBundle>& from,
                                double sigma) {
    struct Start {
        const RigidBundle* plane;
        double bulge;
    };
    std::vector<Start> starts;
    starts.reserve(from.size() + 2);
    for (const RigidBundle& plane : from)
        starts.push_back({&plane, 0});
    for (const double bulge : {-kBulge, kBulge})
        starts.push_back({&from.front(), bulge});
    std::vector<RigidBundle> out = solutions_of(starts.size(), [&](std::size_t at) {
        const auto& [plane, bulge] = starts[at];
        RigidSurface start = plane->surface();
        start.relief.assign(RigidSurface::orders().size(), 0.0);
        for (std::size_t k = 0; k < start.relief.size(); ++k) {
            const Vec2i order = RigidSurface::orders()[k];
            if (std::max(order.x, order.y) == 2 && std::min(order.x, order.y) == 0)
                start.relief[k] = bulge;
        }
        std::optional<RigidBundle> bundle(std::in_place, *problem.frames, std::move(start),
                                          plane->poses(), problem.prior, sigma);
        bundle->descend(kMoreSteps);
        if (!std::isfinite(bundle->cost())) bundle.reset();
        return bundle;
    });
    std::stable_sort(out.begin(), out.end(), [](const RigidBundle& a, const RigidBundle& b) {
        return a.cost() < b.cost();
    });
    return out;
}

// Root mean square of the motion that no similarity explains, px.
double beyond_similarity_px(const Problem& problem) {
    double sum = 0, count = 0;
    for (const FrameMatches& m : *problem.frames) {
        // z → a z + b over complex numbers, by least squares.
        const auto n = static_cast<double>(m.reference.size());
        double px = 0, py = 0, qx = 0, qy = 0;
        for (std::size_t i = 0; i < m.reference.size(); ++i) {
            px += m.reference[i].x / n, py += m.reference[i].y / n;
            qx += m.frame[i].x / n, qy += m.frame[i].y / n;
        }
        double real = 0, imaginary = 0, squares = 0, after = 0;
        for (std::size_t i = 0; i < m.reference.size(); ++i) {
            const double x = m.reference[i].x - px, y = m.reference[i].y - py;
            const double u = m.frame[i].x - qx, v = m.frame[i].y - qy;
            real += x * u + y * v, imaginary += x * v - y * u;
            squares += x * x + y * y, after += u * u + v * v;
        }
        sum += std::max(0.0, after - (real * real + imaginary * imaginary) / squares), count += n;
    }
    return std::sqrt(sum / count);
}

double turn_of(const RigidSurface& surface, const std::vector<RigidPose>& poses) {
    const Vector3 at = ray_towards(surface, surface.centre) / surface.nearness(surface.centre);
    double cosine = 1;
    for (const RigidPose& pose : poses) {
        const Vector3 camera = -(pose.rotation.transpose() * pose.shift);
        cosine = std::min(cosine, (camera - at).normalized().dot((-at).normalized()));
    }
    return degrees_of_cosine(cosine);
}

// The error of a solution from its covariance, and from those that explain as much.
void find_errors(const Problem& problem, const std::vector<RigidBundle>& solutions, RigidFit& fit) {
    const RigidBundle& best = solutions.front();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(best.information());
    double squares = 0, tilt = 0;
    for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k) {
        const double deviation = 1 / std::sqrt(std::max(solver.eigenvalues()[k], 1e-6));
        for (const double sign : {-1.0, 1.0}) {
            const RigidSurface other = best.moved(sign * deviation * solver.eigenvectors().col(k));
            const double apart = std::min(kImpossibleStretch,
                                          log_stretch_between(fit.surface, other, problem.places));
            squares += 0.5 * apart * apart;
            const double turned = tilt_of(other) - fit.tilt_deg;
            tilt += 0.5 * turned * turned;
        }
    }
    const Eigen::Index last = solver.eigenvalues().size() - 1;
    double tangent = 0;
    for (Eigen::Index k = 0; k <= last; ++k) {
        const double part = solver.eigenvectors()(last, k);
        tangent += part * part / std::max(solver.eigenvalues()[k], 1e-6);
    }
    double all = 1, others = 0, other_tangents = 0;
    for (std::size_t k = 1; k < solutions.size(); ++k) {
        const auto likely = static_cast<double>(
            std::exp(-0.5L * static_cast<long double>(solutions[k].cost() - best.cost())));
        const double apart =
            std::min(kImpossibleStretch,
                     log_stretch_between(fit.surface, solutions[k].surface(), problem.places));
        all += likely;
        others += likely * apart * apart;
        const double lens = solutions[k].surface().tangent - fit.surface.tangent;
        other_tangents += likely * lens * lens;
    }
    fit.tangent_error = std::sqrt(tangent + other_tangents / all);
    fit.error = std::sqrt(squares + others / all);
    fit.tilt_error_deg = std::sqrt(tilt);
}

}  // namespace

double RigidFit::belief() const {
    if (!(log_stretch > 0)) return 0;
    return std::max(0.0, 1 - error * error / (log_stretch * log_stretch));
}

std::optional<RigidFit> fit_rigid_surface(const std::vector<FrameMatches>& frames, Size picture,
                                          std::optional<double> tangent) {
    return fit_rigid_surface(
        frames, picture,
        tangent ? TangentBelief{*tangent, kGivenTangentDeviation} : TangentBelief());
}

std::optional<RigidFit> fit_rigid_surface(const std::vector<FrameMatches>& frames, Size picture,
                                          const TangentBelief& tangent) {
    const auto problem = problem_of(frames, picture, tangent);
    if (!problem || !shows_parallax(frames, picture)) return std::nullopt;
    double sigma = problem->least_sigma;
    std::vector<RigidBundle> solutions = planes(*problem, sigma);
    if (solutions.empty()) return std::nullopt;
    RigidFit out;
    if (solutions.front().residual_px() > 2 * sigma) {
        std::vector<RigidBundle> bent = curved(*problem, solutions, sigma);
        if (bent.empty()) return std::nullopt;
        sigma = std::max(sigma, bent.front().residual_px());
        // Under the noise that the better one leaves: is a plane as likely?
        solutions = planes(*problem, sigma);
        bent = curved(*problem, solutions, sigma);
        if (bent.empty()) return std::nullopt;
        constexpr double kForRelief = 12;  // of the cost, that its freedom is worth
        if (bent.front().cost() + kForRelief < solutions.front().cost()) {
            solutions = std::move(bent);
            out.plane = false;
        }
    }
    const RigidBundle& best = solutions.front();
    out.surface = best.surface();
    out.residual_px = best.residual_px();
    if (out.residual_px > 2 * problem->least_sigma &&
        out.residual_px > kNotRigid * beyond_similarity_px(*problem))
        return std::nullopt;
    out.frames = static_cast<int>(frames.size());
    out.turn_deg = turn_of(out.surface, best.poses());
    out.tilt_deg = tilt_of(out.surface);
    out.log_stretch = log_stretch_of(out.surface, problem->places);
    out.believed = tangent;
    find_errors(*problem, solutions, out);
    out.fov_deg = fov_of_tangent(out.surface.tangent, picture);
    out.fov_error_deg =
        0.5 * (fov_of_tangent(out.surface.tangent + out.tangent_error, picture) -
               fov_of_tangent(std::max(0.0, out.surface.tangent - out.tangent_error), picture));
    return out;
}

}  // namespace weft
