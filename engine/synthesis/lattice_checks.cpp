#include "engine/synthesis/lattice_checks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace weft {
namespace {

// Of the 345 patterns of the starter library with even numbers: stripes differ along themselves by
// 2 % at most, courses by 25 % at least.
constexpr double kLeastAlong = 0.93;
constexpr double kLeastShare = 0.5, kMostSpread = 0.33;
constexpr double kSlack_px = 0.6;
// Of joints within courses: narrower units are not looked for; the least lead over other moves
// along them, in correlation and in deviations; the least match.
constexpr int kNoUnit_px = 8;
constexpr double kJointLead = 0.06, kJointsSure = 4, kJointMatch = 0.35;
// How much better, and by how many standard errors, whole units must match.
constexpr double kLead = 0.03, kSure = 1.8;

struct Match {
    int i, j;
    double value;
};

std::vector<Match> matches_of(const SelfCorrelation& c, const std::array<glm::dvec2, 2>& s) {
    constexpr int kFar = 8;
    std::vector<Match> out;
    for (int j = -kFar; j <= kFar; ++j) {
        for (int i = -kFar; i <= kFar; ++i) {
            const Vec2i d = nearest(static_cast<double>(i) * s[0] + static_cast<double>(j) * s[1]);
            if (d.y < 0 || (d.y == 0 && d.x <= 0) || !c.covers(d)) continue;
            out.push_back({i, j, c.at(*best_near(c, d, 1))});
        }
    }
    return out;
}

// Translations i, j with (a·i + b·j) a multiple of `index`.
struct Part {
    int a, b, index;

    [[nodiscard]] bool holds(const Match& m) const { return (a * m.i + b * m.j) % index == 0; }
    [[nodiscard]] std::array<glm::dvec2, 2> of(const std::array<glm::dvec2, 2>& s) const {
        const double n = index;
        if (b == 0) return {n * s[0], s[1]};
        if (a == 0) return {s[0], n * s[1]};
        // i ≡ −b/a · j: (index, 0), and the i that goes with j = 1.
        int i = 0;
        while ((a * i + b) % index != 0)
            ++i;
        return {n * s[0], static_cast<double>(i) * s[0] + s[1]};
    }
};
constexpr std::array<Part, 7> kParts{
    {{1, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 2, 3}}};

struct Mean {
    int n = 0;
    double sum = 0, squares = 0;
    void add(double v) { ++n, sum += v, squares += v * v; }
    [[nodiscard]] double value() const { return sum / n; }
    /// Squared standard error.
    [[nodiscard]] double error2() const {
        return std::max(squares / n - value() * value(), 1e-4) / (n - 1);
    }
};

// By how much a part of the translations leads the rest; 0 where that is not sure.
double lead_of(const std::vector<Match>& matches, const Part& part) {
    Mean on, off;
    for (const Match& m : matches)
        (part.holds(m) ? on : off).add(m.value);
    if (on.n < 2 || off.n < 2) return 0;
    const double lead = on.value() - off.value();
    return lead > kLead && lead > kSure * std::sqrt(on.error2() + off.error2()) ? lead : 0;
}

// How units of `width` stand in the courses: how far each course is shifted on, and how many
// courses are alike.
struct Bond {
    double width = 0, shift = 0;
    int courses = 1;
};

struct Joints {
    Bond bond;
    double lead = 0;
    bool sure = false;
};

// By how much moves by whole units lead the other moves along the same courses.
template <class At>
Joints joints_of(const At& at, const Bond& bond, double step, Vec2i reach) {
    Mean on, off;
    for (int n = 0; n * step <= reach.y; n += bond.courses) {
        const int y = static_cast<int>(std::lround(n * step));
        const double first = std::fmod(n * bond.shift, bond.width);
        for (int x = -reach.x; x <= reach.x; ++x) {
            if (n == 0 && x < kNoUnit_px) continue;
            const double away = (x - first) / bond.width;
            const double miss = std::abs(away - std::round(away)) * bond.width;
            if (miss <= 0.5)
                on.add(at(x, y));
            else if (miss > std::min(3.0, 0.25 * bond.width))
                off.add(at(x, y));
        }
    }
    if (on.n < 4 || off.n < 4) return {};
    Joints out{bond, on.value() - off.value(), false};
    out.sure = out.lead > kJointLead && on.value() > kJointMatch &&
               out.lead > kJointsSure * std::sqrt(off.error2() * (off.n - 1) / on.n);
    return out;
}

}  // namespace

std::optional<std::array<glm::dvec2, 2>> joints_in_courses(const SelfCorrelation& c, double step_px,
                                                           bool along_x) {
    const Vec2i reach = along_x ? c.reach : Vec2i{c.reach.y, c.reach.x};
    const auto at = [&](int u, int v) {
        const Vec2i d = along_x ? Vec2i{u, v} : Vec2i{v, u};
        return c.at(*best_near(c, d, 1));
    };
    std::vector<Joints> found;
    const int widths = static_cast<int>(2 * (2 * reach.x - kNoUnit_px));
    for (int k = 0; k <= widths; ++k) {
        const double width = kNoUnit_px + 0.5 * k;
        for (const Bond bond : {Bond{width, 0, 1}, Bond{width, width / 2, 1}, Bond{width, 0, 2}}) {
            if (bond.shift == 0 && width > 0.9 * reach.x) continue;
            const Joints here = joints_of(at, bond, step_px, reach);
            if (here.sure) found.push_back(here);
        }
    }
    if (found.empty()) return std::nullopt;
    const double most = std::ranges::max(found, {}, &Joints::lead).lead;
    // Two and three units in a row repeat as well: the narrowest that leads as clearly.
    const auto best =
        std::ranges::find_if(found, [&](const Joints& j) { return j.lead > 0.85 * most; });
    Joints top = *best;
    for (const Joints& j : found)
        if (std::abs(j.bond.width - top.bond.width) < 2 && j.lead > top.lead) top = j;
    const glm::dvec2 along{top.bond.width, 0}, on{top.bond.shift, top.bond.courses * step_px};
    const auto turned = [&](glm::dvec2 v) { return along_x ? v : glm::dvec2{v.y, v.x}; };
    return reduced({turned(along), turned(on)});
}

bool is_free_along(const SelfCorrelation& c, double step_px, bool along_x) {
    const int along = (along_x ? c.reach.x : c.reach.y) * 3 / 4;
    double least = 1, most = -1;
    for (int u = -along; u <= along; ++u) {
        const Vec2i d = nearest(along_x ? glm::dvec2(u, step_px) : glm::dvec2(step_px, u));
        if (!c.covers(d)) continue;
        const double v = c.at(*best_near(c, d, 1));
        least = std::min(least, v), most = std::max(most, v);
    }
    return least >= kLeastAlong * most;
}

std::array<glm::dvec2, 2> whole_units(const SelfCorrelation& c, std::array<glm::dvec2, 2> steps) {
    for (int turns = 0; turns < 3; ++turns) {
        const std::vector<Match> matches = matches_of(c, steps);
        std::array<glm::dvec2, 2> coarser = steps;
        double lead = 0;
        for (const Part& part : kParts) {
            const double here = lead_of(matches, part);
            const std::array<glm::dvec2, 2> of = reduced(part.of(steps));
            if (here <= lead || !c.covers(nearest(of[0])) || !c.covers(nearest(of[1]))) continue;
            coarser = of, lead = here;
        }
        if (lead == 0) break;
        steps = coarser;
    }
    return steps;
}

bool is_even(const SelfCorrelation& c, const std::array<glm::dvec2, 2>& steps) {
    double least = 1;
    Mean all;
    for (const Match& m : matches_of(c, steps)) {
        all.add(m.value);
        if (std::abs(m.i) <= 2 && std::abs(m.j) <= 2) least = std::min(least, m.value);
    }
    if (all.n == 0 || !(all.value() > 0)) return false;
    const double variance = all.squares / all.n - all.value() * all.value();
    return least >= kLeastShare * all.value() &&
           variance <= kMostSpread * kMostSpread * all.value() * all.value();
}

bool is_symmetric(const std::array<glm::dvec2, 2>& steps) {
    const double a = glm::length(steps[0]), b = glm::length(steps[1]);
    const double along = std::abs(glm::dot(steps[0], steps[1])) / a;
    return along < kSlack_px || std::abs(along - 0.5 * a) < kSlack_px || b - a < kSlack_px;
}

}  // namespace weft
