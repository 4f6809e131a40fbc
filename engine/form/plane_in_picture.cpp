#include "engine/form/plane_in_picture.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/form/eigen_types.h"
#include "engine/form/exact_math.h"
#include "engine/form/surface_distance.h"
#include "engine/form/unit_vector.h"

namespace weft {
namespace {

constexpr double kMostSceneLines = 60, kMostOwnLines = 40;  // that count for themselves
constexpr double kSceneEvidence = 6;                        // ln, next to no frame at all
constexpr double kNoScene = 0.1;                            // believed before, next to a scene
constexpr double kUnlikely = 1e-3;                          // of the belief
constexpr double kMattePlaces = 400;                        // of the matte
constexpr double kBeyond = 0.01;         // of the matte that may lie beyond the horizon
constexpr double kLeastNearness = 0.02;  // of that in the middle
constexpr double kLeastCosine = 0.05;
// What is believed of a surface before: it faces along an axis of the scene and its lines run along
// the others (of three), or it is turned about that axis, or it is another plane; or it is curved,
// or the sides of a box.
constexpr double kAligned = 0.6, kTurned = 0.2, kOther = 0.2, kCurved = 0.05, kBox = 0.01;
constexpr double kTurnError = std::numbers::pi / 180;  // of a plane turned about an axis, radians

// MattePlaces of a matte, and where they are from the picture's centre in long sides.
struct MattePlaces {
    std::vector<Vec2> pixels;
    std::vector<glm::dvec2> rays;
    RigidSurface flat;  // faces the camera
};

MattePlaces matte_places(ViewU8x1 matte) {
    MattePlaces out;
    double count = 0;
    for (int y = 0; y < matte.height(); ++y)
        count += static_cast<double>(std::count_if(matte.row(y), matte.row(y) + matte.width(),
                                                   [](auto v) { return v >= 128; }));
    const int step = std::max(1, static_cast<int>(std::sqrt(count / kMattePlaces)));
    glm::dvec2 sum(0);
    for (int y = step / 2; y < matte.height(); y += step) {
        for (int x = step / 2; x < matte.width(); x += step) {
            if (matte.row(y)[x] < 128) continue;
            out.pixels.emplace_back(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            sum += glm::dvec2(out.pixels.back());
        }
    }
    RigidSurface& flat = out.flat;
    flat.middle =
        0.5f * Vec2(static_cast<float>(matte.width()), static_cast<float>(matte.height()));
    flat.long_side = std::max(matte.width(), matte.height());
    if (out.pixels.empty()) return out;
    flat.centre = Vec2(sum / static_cast<double>(out.pixels.size()));
    for (const Vec2 p : out.pixels) {
        const Vec2 d = p - flat.centre;
        flat.radius = std::max(flat.radius, static_cast<double>(std::sqrt(d.x * d.x + d.y * d.y)));
        out.rays.push_back(glm::dvec2(p - flat.middle) / flat.long_side);
    }
    return out;
}

double nearness_at(const glm::dvec3& normal, double tangent, glm::dvec2 ray) {
    return tangent * (normal.x * ray.x + normal.y * ray.y) + normal.z;
}

glm::dvec2 centre_ray(const MattePlaces& places) {
    return glm::dvec2(places.flat.centre - places.flat.middle) / places.flat.long_side;
}

// Whether the matte shows one side of the plane only.
bool shows(const MattePlaces& places, const glm::dvec3& normal, double tangent) {
    const double middle = nearness_at(normal, tangent, centre_ray(places));
    if (!(std::abs(middle) > 1e-6)) return false;
    std::size_t beyond = 0;
    for (const glm::dvec2 ray : places.rays)
        beyond += nearness_at(normal, tangent, ray) / middle < kLeastNearness;
    return static_cast<double>(beyond) <= kBeyond * static_cast<double>(places.rays.size());
}

// The cosine at which the matte's middle is seen.
double cosine_of(const MattePlaces& places, const ManhattanFrame& frame) {
    const glm::dvec2 r = centre_ray(places);
    const glm::dvec3 ray(frame.tangent * r.x, frame.tangent * r.y, 1);
    return std::abs(glm::dot(frame.axes[2], unit(ray)));
}

RigidSurface surface_of(const MattePlaces& places, const ManhattanFrame& frame) {
    RigidSurface out = places.flat;
    const glm::dvec3 n = frame.axes[2];
    const double middle = nearness_at(n, frame.tangent, centre_ray(places));
    const double by = frame.tangent * out.radius / (out.long_side * middle);
    out.tangent = frame.tangent;
    out.slope_x = n.x * by;
    out.slope_y = n.y * by;
    return out;
}

// Where the picture shows a direction, at the matte's middle; the longer of a frame's two.
Vec2 along_in_picture(const MattePlaces& places, const ManhattanFrame& frame) {
    const glm::dvec2 ray = frame.tangent * centre_ray(places);
    const auto seen = [&](const glm::dvec3& axis) {
        return glm::dvec2(axis.x - ray.x * axis.z, axis.y - ray.y * axis.z);
    };
    const glm::dvec2 a = seen(frame.axes[0]), b = seen(frame.axes[1]);
    const glm::dvec2 longer = glm::dot(a, a) >= glm::dot(b, b) ? a : b;
    return Vec2(longer / std::sqrt(std::max(glm::dot(longer, longer), 1e-12)));
}

// A plane that may be it, with ln of how likely it is.
struct Candidate {
    ManhattanFrame frame;  // the third axis is its normal
    FrameMatrix covariance;
    double likely;
};

ManhattanFrame with_normal(const ManhattanFrame& frame, int axis) {
    return {{frame.axes[(axis + 1) % 3], frame.axes[(axis + 2) % 3], frame.axes[axis]},
            frame.tangent};
}

std::vector<Candidate> candidates_of(const ScenePerspective& scene, const ManhattanLines& lines,
                                     const MattePlaces& places) {
    std::vector<Candidate> out;
    const auto add = [&](const ManhattanFrame& frame, const FrameMatrix& covariance,
                         double before) {
        // Of what lies across the view, much is seen.
        const double seen = std::max(kLeastCosine, cosine_of(places, frame));
        out.push_back({frame, covariance, lines.log_likelihood(frame, 2) + before + ln(seen)});
    };
    for (const ScenePerspective::Way& way : scene.ways) {
        for (int axis = 0; axis < 3; ++axis) {
            const ManhattanFrame frame = with_normal(way.fit.frame, axis);
            if (!shows(places, frame.axes[2], frame.tangent)) continue;
            add(frame, way.fit.covariance, ln(way.share * kAligned / 3));
            const double narrow = kTurnError * std::sqrt(8 / std::numbers::pi);  // of a right angle
            add(turned_best(lines, frame), way.fit.covariance,
                ln(way.share * kTurned / 3 * narrow));
        }
    }
    const auto possible = [&](const glm::dvec3& normal, double tangent) {
        return shows(places, normal, tangent);
    };
    for (const ManhattanFit& fit : find_manhattan(lines, scene.lens, possible))
        add(fit.frame, fit.covariance, fit.before + ln(kOther));
    return out;
}

// ln of how likely it is that what looks like the likeliest plane is none.
double no_plane(const std::vector<Candidate>& candidates, const ManhattanLines& lines) {
    const Candidate& best = *std::max_element(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.likely < b.likely; });
    return std::max({ln(kCurved), lines.loose_likelihood(best.frame) + ln(kCurved),
                     lines.log_likelihood(best.frame, 3) + ln(kBox)});
}

void make_shares(std::vector<double>& logs) {
    const double most = *std::max_element(logs.begin(), logs.end());
    double all = 0;
    for (double& v : logs)
        v = exponential(v - most), all += v;
    for (double& v : logs)
        v /= all;
}

// The squares of the errors that a candidate's covariance makes: of ln stretch, degrees of tilt and
// tangent.
struct Squares {
    double stretch = 0, tilt = 0, tangent = 0;
};

Squares errors_of(const Candidate& at, const MattePlaces& places) {
    Matrix4 covariance;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            covariance(i, j) =
                at.covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    const Eigen::SelfAdjointEigenSolver<Matrix4> solver(covariance);
    const RigidSurface surface = surface_of(places, at.frame);
    const double tilt = tilt_of(surface);
    Squares out;
    for (int k = 0; k < 4; ++k) {
        const double deviation = std::sqrt(std::max(0.0, solver.eigenvalues()[k]));
        for (const double sign : {-1.0, 1.0}) {
            FrameStep step;
            for (int i = 0; i < 4; ++i)
                step[static_cast<std::size_t>(i)] = sign * deviation * solver.eigenvectors()(i, k);
            const ManhattanFrame frame = stepped(at.frame, step);
            const RigidSurface other = surface_of(places, frame);
            const double apart =
                std::min(kImpossibleStretch, log_stretch_between(surface, other, places.pixels));
            const double turned = tilt_of(other) - tilt, lens = frame.tangent - at.frame.tangent;
            out.stretch += 0.5 * apart * apart;
            out.tilt += 0.5 * turned * turned;
            out.tangent += 0.5 * lens * lens;
        }
    }
    return out;
}

}  // namespace

bool PictureFit::holds(double least_belief) const {
    constexpr double kMostError = 0.4;      // ln stretch
    constexpr double kLeastStretch = 0.02;  // ln; less is not seen
    constexpr double kLeastExplained = 0.35, kLeastEvidence = 3;
    return belief >= least_belief && error <= kMostError && log_stretch >= kLeastStretch &&
           explained >= kLeastExplained && evidence >= kLeastEvidence;
}

ScenePerspective scene_perspective(const std::vector<PictureLine>& lines, Size picture,
                                   const TangentBelief& lens) {
    ScenePerspective out;
    out.lens = lens;
    const ManhattanLines evidence(thinned(lines, picture), picture, 3, kMostSceneLines);
    const auto all = [](const glm::dvec3&, double) { return true; };
    const std::vector<ManhattanFit> fits = find_manhattan(evidence, lens, all);
    if (fits.empty() || fits.front().evidence() < kSceneEvidence) return out;
    std::vector<double> shares;
    shares.reserve(fits.size() + 1);
    for (const ManhattanFit& fit : fits)
        shares.push_back(evidence.log_likelihood(fit.frame, 3) + fit.before);
    // Directions that are only loosely alike are no scene; they are as free.
    const ManhattanFit& best = fits[static_cast<std::size_t>(
        std::max_element(shares.begin(), shares.end()) - shares.begin())];
    shares.push_back(evidence.loose_likelihood(best.frame) + best.before + ln(kNoScene));
    make_shares(shares);
    const double none = shares.back();
    double mean = none * lens.value,
           square = none * (lens.value * lens.value + lens.deviation * lens.deviation);
    for (std::size_t k = 0; k < fits.size(); ++k) {
        const double tangent = fits[k].frame.tangent;
        mean += shares[k] * tangent;
        square += shares[k] * (tangent * tangent + fits[k].covariance[3][3]);
        if (shares[k] >= kUnlikely) out.ways.push_back({fits[k], shares[k]});
    }
    // Scenes are not as square as the model has them.
    constexpr double kLeastError = 0.05;
    out.lens = {mean, std::min(lens.deviation, std::sqrt(std::max(0.0, square - mean * mean) +
                                                         kLeastError * kLeastError * mean * mean))};
    return out;
}

std::optional<PictureFit> plane_in_picture(const ScenePerspective& scene,
                                           const std::vector<PictureLine>& lines, ViewU8x1 matte) {
    const MattePlaces places = matte_places(matte);
    if (places.pixels.empty()) return std::nullopt;
    const Size picture = matte.size();
    const ManhattanLines evidence(thinned(lines, picture), picture, 2, kMostOwnLines);
    const std::vector<Candidate> candidates = candidates_of(scene, evidence, places);
    if (candidates.empty()) return std::nullopt;
    std::vector<double> shares;
    shares.reserve(candidates.size() + 1);
    for (const Candidate& candidate : candidates)
        shares.push_back(candidate.likely);
    shares.push_back(no_plane(candidates, evidence));
    make_shares(shares);
    const auto best = static_cast<std::size_t>(std::max_element(shares.begin(), shares.end() - 1) -
                                               shares.begin());
    const Candidate& chosen = candidates[best];
    PictureFit out;
    out.surface = surface_of(places, chosen.frame);
    out.along = along_in_picture(places, chosen.frame);
    out.tilt_deg = tilt_of(out.surface);
    out.fov_deg = fov_of_tangent(out.surface.tangent, picture);
    out.explained = evidence.explained(chosen.frame);
    out.evidence = evidence.log_likelihood(chosen.frame, 2);
    out.log_stretch = log_stretch_of(out.surface, places.pixels);
    Squares own = errors_of(chosen, places);
    double others = shares.back() * out.log_stretch * out.log_stretch;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (k == best || shares[k] < kUnlikely) continue;
        const RigidSurface other = surface_of(places, candidates[k].frame);
        const double apart =
            std::min(kImpossibleStretch, log_stretch_between(out.surface, other, places.pixels));
        const double turned = tilt_of(other) - out.tilt_deg,
                     lens = other.tangent - out.surface.tangent;
        others += shares[k] * apart * apart;
        own.tilt += shares[k] * turned * turned;
        own.tangent += shares[k] * lens * lens;
    }
    out.error = std::sqrt(own.stretch + others);
    out.tilt_error_deg = std::sqrt(own.tilt);
    const double off = std::sqrt(own.tangent);
    out.fov_error_deg = 0.5 * (fov_of_tangent(out.surface.tangent + off, picture) -
                               fov_of_tangent(std::max(0.0, out.surface.tangent - off), picture));
    out.belief =
        out.log_stretch > 0
            ? std::max(0.0, 1 - out.error * out.error / (out.log_stretch * out.log_stretch))
            : 0;
    return out;
}

}  // namespace weft
