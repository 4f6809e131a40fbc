#include "engine/form/pulled_back.h"

namespace weft {

std::optional<Metric> pulled_back(const Metric& g, const LatticeField& ref_from_cur, Vec2 at) {
    constexpr float kHalf = 2;   // px
    constexpr double kMost = 8;  // times, that a surface is larger on one frame
    const Vec2 x =
        (ref_from_cur.at(at + Vec2(kHalf, 0)) - ref_from_cur.at(at - Vec2(kHalf, 0))) / (2 * kHalf);
    const Vec2 y =
        (ref_from_cur.at(at + Vec2(0, kHalf)) - ref_from_cur.at(at - Vec2(0, kHalf))) / (2 * kHalf);
    const double a = 1.0 + x.x, b = y.x, c = x.y, d = 1.0 + y.y;
    const double determinant = a * d - b * c, norm = a * a + b * b + c * c + d * d;
    if (!(determinant > norm / (kMost * kMost)) || norm > 2 * kMost * kMost) return std::nullopt;
    const double inverse = 1 / (determinant * determinant);
    return Metric{inverse * (d * d * g.xx - 2 * c * d * g.xy + c * c * g.yy),
                  inverse * (-b * d * g.xx + (a * d + b * c) * g.xy - a * c * g.yy),
                  inverse * (b * b * g.xx - 2 * a * b * g.xy + a * a * g.yy)};
}

}  // namespace weft
