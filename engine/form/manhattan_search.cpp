#include "engine/form/manhattan_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/form/eigen_types.h"
#include "engine/form/exact_math.h"
#include "engine/form/unit_vector.h"

namespace weft {
namespace {

constexpr int kNormals = 1500;        // over half a sphere: 3.7° from one to the next
constexpr double kCoarse = 0.035;     // radians: what lies between them
constexpr int kTurns = 90;            // over a right angle
constexpr std::size_t kVoters = 120;  // the longest lines
constexpr std::array kFirstTangents{0.45, 0.65, 0.9, 1.2, 1.6};
constexpr std::size_t kRefined = 24, kKept = 8;
constexpr double kNear = 0.98;                  // cosine between normals of one peak of the vote
constexpr std::array kBlurs{0.02, 0.008, 0.0};  // radians
constexpr int kFrameSteps = 8;                  // of each blur
constexpr double kSameTurn = 0.03, kSameTangent = 0.1;
constexpr double kRoll = 0.12, kUp = 0.6;  // sine of a camera's roll; of an axis that runs up
constexpr double kTiltedOnPurpose = 4;     // ln
// Where lines leave a turn open: radians.
constexpr double kOpenTurn = 1;

using Line = ManhattanLines::Line;

struct Turn {
    double cosine, sine;
};

const std::array<Turn, kTurns>& turns() {
    static const std::array<Turn, kTurns> all = [] {
        std::array<Turn, kTurns> out{};
        for (int k = 0; k < kTurns; ++k) {
            const long double angle =
                std::numbers::pi_v<long double> / 2 * static_cast<long double>(k) / kTurns;
            out[static_cast<std::size_t>(k)] = {static_cast<double>(std::cos(angle)),
                                                static_cast<double>(std::sin(angle))};
        }
        return out;
    }();
    return all;
}

// Normals over half a sphere, evenly (Fibonacci's lattice).
const std::vector<glm::dvec3>& normals() {
    static const std::vector<glm::dvec3> all = [] {
        std::vector<glm::dvec3> out;
        for (int k = 0; k < kNormals; ++k) {
            const long double z = (static_cast<long double>(k) + 0.5L) / kNormals,
                              radius = std::sqrt(1 - z * z),
                              angle = std::numbers::pi_v<long double> * (1 + std::sqrt(5.0L)) *
                                      (static_cast<long double>(k) + 0.5L);
            out.emplace_back(static_cast<double>(radius * std::cos(angle)),
                             static_cast<double>(radius * std::sin(angle)), static_cast<double>(z));
        }
        return out;
    }();
    return all;
}

ManhattanFrame frame_of(const glm::dvec3& normal, double tangent) {
    const glm::dvec3 other = std::abs(normal.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = unit(glm::cross(normal, other));
    return {{u, glm::cross(normal, u), normal}, tangent};
}

ManhattanFrame turned(const ManhattanFrame& frame, int turn) {
    const auto [c, s] = turns()[static_cast<std::size_t>(turn)];
    return {{c * frame.axes[0] + s * frame.axes[1], c * frame.axes[1] - s * frame.axes[0],
             frame.axes[2]},
            frame.tangent};
}

// On the plane across the third axis, which turn a line speaks for, and how exactly: in turns, of
// kTurns that go round. The line is n × (r × e) there, for its ray r and its direction e.
struct Vote {
    double turn, sigma;
};

Vote vote_of(const Line& line, const ManhattanFrame& frame) {
    const glm::dvec3 n = frame.axes[2];
    const glm::dvec3 r(frame.tangent * line.middle.x, frame.tangent * line.middle.y, 1),
        e(line.direction.x, line.direction.y, 0), across(-line.direction.y, line.direction.x, 0);
    const double depth = glm::dot(n, r);
    const glm::dvec3 d = r * glm::dot(n, e) - e * depth,
                     change = r * glm::dot(n, across) - across * depth;
    const double a = glm::dot(frame.axes[0], d), b = glm::dot(frame.axes[1], d);
    const double square = std::max(a * a + b * b, 1e-18);
    const double angle =
        static_cast<double>(std::atan2(static_cast<long double>(b), static_cast<long double>(a)));
    const double slope =
        (a * glm::dot(frame.axes[1], change) - b * glm::dot(frame.axes[0], change)) / square;
    constexpr double kByAngle = kTurns / (std::numbers::pi / 2);
    // Less than a turn's step is not told apart here.
    return {angle * kByAngle, std::max(0.5, std::abs(slope) * line.sigma * kByAngle)};
}

// The gain of every turn about the third axis. Lines along that axis, if it is one of them, gain
// there whatever the turn.
std::pair<int, double> best_turn(const ManhattanLines& lines, const ManhattanFrame& frame,
                                 std::size_t most_lines) {
    std::array<double, kTurns> votes{};
    double along_normal = 0;
    const std::size_t count = std::min(most_lines, lines.lines().size());
    for (std::size_t k = 0; k < count; ++k) {
        const Line& line = lines.lines()[k];
        double before = 0;
        if (lines.axes() == 3) {
            const double off = off_axis(line, frame.axes[2], frame.tangent) / line.sigma;
            before = std::max(0.0, line.most_gain - 0.5 * off * off);
            along_normal += line.weight * before;
        }
        const Vote vote = vote_of(line, frame);
        const double reach = vote.sigma * std::sqrt(2 * line.most_gain);
        const int from = static_cast<int>(std::ceil(vote.turn - std::min(reach, kTurns / 2.0))),
                  to = static_cast<int>(std::floor(vote.turn + std::min(reach, kTurns / 2.0 - 1)));
        for (int turn = from; turn <= to; ++turn) {
            const double off = (turn - vote.turn) / vote.sigma;
            const double gain = line.most_gain - 0.5 * off * off - before;
            if (gain > 0)
                votes[static_cast<std::size_t>((turn % kTurns + kTurns) % kTurns)] +=
                    line.weight * gain;
        }
    }
    const auto best = std::max_element(votes.begin(), votes.end());
    return {static_cast<int>(best - votes.begin()), *best + along_normal};
}

double lens_cost(double tangent, const TangentBelief& lens) {
    const double off = (tangent - lens.value) / lens.deviation;
    return 0.5 * off * off;
}

// Cameras are held upright, so one axis of what people build runs up the picture; where none does,
// the camera was tilted on purpose.
double upright_cost(const ManhattanFrame& frame) {
    double least = kTiltedOnPurpose;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 a = frame.axes[k];
        const double roll = a.x / kRoll;
        if (std::abs(a.y) > kUp) least = std::min(least, 0.5 * roll * roll);
    }
    return least;
}

struct Start {
    ManhattanFrame frame;
    double score;
};

std::vector<double> start_tangents(const TangentBelief& lens) {
    std::vector<double> out;
    for (const double tangent : kFirstTangents)
        if (std::abs(tangent - lens.value) < 2.5 * lens.deviation) out.push_back(tangent);
    out.push_back(lens.value);
    return out;
}

// The peaks of the vote.
std::vector<Start> starts_of(const ManhattanLines& lines, const TangentBelief& lens,
                             const NormalTest& possible) {
    const ManhattanLines coarse = lines.blurred(kCoarse);
    std::vector<Start> all;
    for (const double tangent : start_tangents(lens)) {
        for (const glm::dvec3& normal : normals()) {
            if (!possible(normal, tangent)) continue;
            const ManhattanFrame frame = frame_of(normal, tangent);
            const auto [turn, gain] = best_turn(coarse, frame, kVoters);
            const ManhattanFrame at = turned(frame, turn);
            all.push_back({at, gain - lens_cost(tangent, lens) - upright_cost(at)});
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Start& a, const Start& b) { return a.score > b.score; });
    std::vector<Start> out;
    for (const Start& start : all) {
        if (out.size() == kRefined) break;
        const bool near = std::any_of(out.begin(), out.end(), [&](const Start& taken) {
            return std::abs(glm::dot(taken.frame.axes[2], start.frame.axes[2])) > kNear &&
                   std::abs(taken.frame.tangent - start.frame.tangent) < 0.3;
        });
        if (!near) out.push_back(start);
    }
    return out;
}

// Normal equations with what was believed.
std::pair<Matrix4, Vector4> system_of(const ManhattanLines& lines, const ManhattanFrame& frame,
                                      const TangentBelief& lens) {
    FrameMatrix matrix{};
    FrameStep right{};
    lines.linearise(frame, matrix, right);
    Matrix4 m;
    Vector4 r;
    for (int i = 0; i < 4; ++i) {
        r[i] = right[static_cast<std::size_t>(i)];
        for (int j = 0; j < 4; ++j)
            m(i, j) = matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    const double sure = 1 / (lens.deviation * lens.deviation);
    m(3, 3) += sure;
    r[3] -= sure * (frame.tangent - lens.value);
    for (int k = 0; k < 3; ++k)
        m(k, k) += 1 / (kOpenTurn * kOpenTurn);
    return {m, r};
}

ManhattanFrame refined(const ManhattanLines& lines, ManhattanFrame frame,
                       const TangentBelief& lens) {
    for (const double blur : kBlurs) {
        const ManhattanLines at = blur > 0 ? lines.blurred(blur) : lines;
        const auto score = [&](const ManhattanFrame& f) {
            return at.gain(f) - lens_cost(f.tangent, lens);
        };
        double before = score(frame);
        for (int k = 0; k < kFrameSteps; ++k) {
            const auto [matrix, right] = system_of(at, frame, lens);
            Vector4 step = matrix.ldlt().solve(right);
            bool better = false;
            for (int halved = 0; halved < 4 && !better; ++halved, step *= 0.5) {
                const ManhattanFrame next = stepped(frame, {step[0], step[1], step[2], step[3]});
                const double after = score(next);
                if (!(after > before)) continue;
                better = after - before > 1e-6 * (1 + std::abs(before));
                frame = next;
                before = after;
                break;
            }
            if (!better) break;
        }
    }
    return frame;
}

// The turn between two frames, whichever way round their axes are named, radians.
double turn_between(const ManhattanFrame& a, const ManhattanFrame& b, int axes) {
    double least = 1;
    const auto off = [](const glm::dvec3& u, const glm::dvec3& v) {
        const glm::dvec3 c = glm::cross(u, v);
        return std::sqrt(glm::dot(c, c));
    };
    // Of 3 axes each may be the normal; of 2 only the third.
    for (int k = axes == 3 ? 0 : 2; k < 3; ++k) {
        const double normal = off(a.axes[2], b.axes[k]);
        const double other =
            std::min(off(a.axes[0], b.axes[(k + 1) % 3]), off(a.axes[0], b.axes[(k + 2) % 3]));
        least = std::min(least, std::max(normal, other));
    }
    return least;
}

ManhattanFit fit_of(const ManhattanLines& lines, const ManhattanFrame& frame,
                    const TangentBelief& lens) {
    ManhattanFit out{frame, lines.gain(frame), 0, {}};
    const Matrix4 covariance = system_of(lines, frame, lens).first.inverse();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            out.covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                covariance(i, j);
    // Of all turns, those that only name the axes otherwise are one: 24 of a cube, 8 of a plane.
    constexpr double kTau = 2 * std::numbers::pi;
    const double all_turns = 2 * kTau * kTau / (lines.axes() == 3 ? 24 : 8);
    const double volume = std::sqrt(std::max(covariance.determinant(), 1e-300)) * kTau * kTau;
    const double before = all_turns * lens.deviation * std::sqrt(kTau);
    out.before =
        ln(std::min(1.0, volume / before)) - lens_cost(frame.tangent, lens) - upright_cost(frame);
    return out;
}

}  // namespace

std::vector<ManhattanFit> find_manhattan(const ManhattanLines& lines, const TangentBelief& lens,
                                         const NormalTest& possible) {
    std::vector<ManhattanFit> out;
    if (lines.lines().empty()) return out;
    std::vector<ManhattanFit> found;
    for (const Start& start : starts_of(lines, lens, possible)) {
        const ManhattanFrame frame = refined(lines, start.frame, lens);
        if (possible(frame.axes[2], frame.tangent)) found.push_back(fit_of(lines, frame, lens));
    }
    std::stable_sort(found.begin(), found.end(), [](const ManhattanFit& a, const ManhattanFit& b) {
        return a.evidence() > b.evidence();
    });
    for (const ManhattanFit& fit : found) {
        if (out.size() == kKept) break;
        const bool known = std::any_of(out.begin(), out.end(), [&](const ManhattanFit& other) {
            return turn_between(fit.frame, other.frame, lines.axes()) < kSameTurn &&
                   std::abs(fit.frame.tangent - other.frame.tangent) < kSameTangent;
        });
        if (!known) out.push_back(fit);
    }
    return out;
}

ManhattanFrame turned_best(const ManhattanLines& lines, const ManhattanFrame& frame) {
    return turned(frame, best_turn(lines, frame, lines.lines().size()).first);
}

}  // namespace weft
