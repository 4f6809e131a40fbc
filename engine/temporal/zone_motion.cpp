#include "engine/temporal/zone_motion.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "engine/motion/plane_fit.h"
#include "engine/temporal/zone_solve.h"

namespace weft {
namespace {

// Over how many nodes a moving piece passes into what holds it.
constexpr double kPassage_nodes = 1;

Vec2 lands(const LatticeField& field, Vec2 p) {
    return p + field.at(p);
}

// The plane that a field moves by inside of a zone.
glm::dmat3 plane_inside(const ZoneSolve& solve, const LatticeField& field) {
    std::vector<PlacePair> pairs;
    solve.each_inside([&](Vec2 p) { pairs.push_back({p, lands(field, p)}); });
    return fit_plane(pairs);
}

LatticeField towards_plane(const ZoneSolve& solve, const glm::dmat3& plane, double reach) {
    return solve.towards([&](Vec2 p) { return mapped(plane, p) - p; }, reach);
}

// How the places `on_ref` move on another frame: by a plane, and what departs from it, on the
// lattice of the reference frame: x = plane(r + departure(r)).
struct Movement {
    glm::dmat3 ref_from_other;
    LatticeField departure;
};
Movement movement(const LatticeField& ref_from_other, const std::vector<Vec2>& on_ref) {
    const LatticeField other_from_ref = inverse(ref_from_other);
    std::vector<PlacePair> pairs;
    pairs.reserve(on_ref.size());
    Vec2 low = on_ref.front(), high = low;
    for (const Vec2 r : on_ref) {
        pairs.push_back({r, lands(other_from_ref, r)});
        low = glm::min(low, r);
        high = glm::max(high, r);
    }
    Movement out{glm::inverse(fit_plane(pairs)),
                 LatticeField(ref_from_other.full_size(), ref_from_other.spacing())};
    LatticeField& field = out.departure;
    const float beyond = 3 * static_cast<float>(field.spacing());
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 r = field.node_position(i, j);
            const bool near = r.x > low.x - beyond && r.y > low.y - beyond &&
                              r.x < high.x + beyond && r.y < high.y + beyond;
            if (near)
                field.set_node(i, j, mapped(out.ref_from_other, lands(other_from_ref, r)) - r);
        }
    }
    return out;
}

}  // namespace

LatticeField without_picture(const LatticeField& ref_from_cur, const MotionZone& zone) {
    const ZoneSolve solve(ref_from_cur, zone);
    if (solve.empty()) return ref_from_cur;
    if (!solve.is_held())
        return towards_plane(solve, plane_inside(solve, ref_from_cur), kPassage_nodes);
    constexpr int kAround = 8;
    std::vector<PlacePair> pairs;
    solve.each_around(kAround, [&](Vec2 p) { pairs.push_back({p, lands(ref_from_cur, p)}); });
    return towards_plane(solve, fit_plane(pairs), 0);
}

LatticeField stiffened(const LatticeField& ref_from_cur, const MotionZone& zone) {
    const ZoneSolve solve(ref_from_cur, zone);
    if (solve.empty()) return ref_from_cur;
    return towards_plane(solve, plane_inside(solve, ref_from_cur), kPassage_nodes);
}

LatticeField calmed(const LatticeField& ref_from_cur, const MotionZone& zone,
                    const std::vector<OtherFrame>& others) {
    const ZoneSolve solve(ref_from_cur, zone);
    std::vector<Vec2> on_ref;
    solve.each_inside([&](Vec2 p) { on_ref.push_back(lands(ref_from_cur, p)); });
    if (on_ref.empty()) return ref_from_cur;
    // A line through the departures over time, at this frame: where the clip ends on one side, a
    // mean would lag behind.
    const auto weight = [](int distance) {
        const double t = distance / (0.5 * kCalm_frames);
        return std::exp(-0.5 * t * t);
    };
    double s0 = 1, s1 = 0, s2 = 0;
    for (const OtherFrame& other : others) {
        const double w = weight(other.distance);
        s0 += w;
        s1 += w * other.distance;
        s2 += w * other.distance * other.distance;
    }
    const double determinant = s0 * s2 - s1 * s1;
    const auto share = [&](int distance) {
        if (!(determinant > 0)) return weight(distance) / s0;
        return weight(distance) * (s2 - s1 * distance) / determinant;
    };
    LatticeField mean(ref_from_cur.full_size(), ref_from_cur.spacing());
    const auto add = [&](const LatticeField& departure, int distance) {
        const float w = static_cast<float>(share(distance));
        for (int j = 0; j < mean.nodes().height(); ++j)
            for (int i = 0; i < mean.nodes().width(); ++i)
                mean.set_node(i, j, mean.node(i, j) + w * departure.node(i, j));
    };
    const Movement here = movement(ref_from_cur, on_ref);
    add(here.departure, 0);
    for (const OtherFrame& other : others)
        add(movement(other.ref_from_cur, on_ref).departure, other.distance);

    const auto calm = [&](Vec2 p) {
        const Vec2 target = mapped(here.ref_from_other, p);
        Vec2 r = target;
        for (int round = 0; round < 4; ++round)
            r = target - mean.at(r);
        return r - p;
    };
    return solve.towards(calm, kPassage_nodes);
}

LatticeField with_surroundings(const LatticeField& ref_from_cur, const MotionZone& zone,
                               const LatticeField& around, ViewU8x1 seen) {
    const ZoneSolve solve(ref_from_cur, zone);
    std::vector<PlacePair> pairs;
    ZoneSolve(around, {seen, seen, 1}).each_inside([&](Vec2 p) {
        pairs.push_back({p, lands(around, p)});
    });
    if (solve.empty() || pairs.empty()) return ref_from_cur;
    return towards_plane(solve, fit_plane(pairs), kPassage_nodes);
}

}  // namespace weft
