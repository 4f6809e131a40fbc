#include "engine/temporal/correction.h"

#include <algorithm>
#include <complex>

namespace weft {
namespace {

using Point = std::complex<double>;

Point point_of(Vec2 v) {
    return {v.x, v.y};
}

// The place that the texture belonging at p is fetched from.
Point source_of(Point p, const std::vector<SurfacePin>& pins) {
    double total = 0;
    Point to_mean, from_mean;
    const auto weight = [&](const SurfacePin& pin) {
        return 1 / std::max(1e-6, std::norm(point_of(pin.to) - p));
    };
    for (const SurfacePin& pin : pins) {
        const double w = weight(pin);
        total += w;
        to_mean += w * point_of(pin.to);
        from_mean += w * point_of(pin.from);
    }
    to_mean /= total;
    from_mean /= total;
    Point turn;
    double spread = 0;
    for (const SurfacePin& pin : pins) {
        const double w = weight(pin);
        const Point a = point_of(pin.to) - to_mean, b = point_of(pin.from) - from_mean;
        turn += w * std::conj(a) * b;
        spread += w * std::norm(a);
    }
    // One pin, or several at one place, do not determine a rotation.
    turn = spread > 1e-9 * total ? turn / spread : Point(1, 0);
    return turn * (p - to_mean) + from_mean;
}

LatticeField bend_by(const std::vector<SurfacePin>& pins, Size size, int spacing) {
    LatticeField bend(size, spacing);
    for (int j = 0; j < bend.nodes().height(); ++j) {
        for (int i = 0; i < bend.nodes().width(); ++i) {
            const Vec2 p = bend.node_position(i, j);
            const Point q = source_of(point_of(p), pins);
            bend.set_node(i, j,
                          Vec2(static_cast<float>(q.real()), static_cast<float>(q.imag())) - p);
        }
    }
    return bend;
}

}  // namespace

LatticeField corrected(const LatticeField& ref_from_cur, const std::vector<SurfacePin>& pins) {
    if (pins.empty()) return ref_from_cur;
    return compose(bend_by(pins, ref_from_cur.full_size(), ref_from_cur.spacing()), ref_from_cur);
}

LatticeField recorrected(const LatticeField& ref_from_cur, const std::vector<SurfacePin>& before,
                         const std::vector<SurfacePin>& after) {
    if (before == after) return ref_from_cur;
    if (before.empty()) return corrected(ref_from_cur, after);
    const LatticeField bend = bend_by(before, ref_from_cur.full_size(), ref_from_cur.spacing());
    return corrected(compose(inverse(bend), ref_from_cur), after);
}

}  // namespace weft
