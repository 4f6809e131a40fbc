#include "engine/form/plane_corners.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/form/eigen_types.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

constexpr int kPlaces = 24;         // along the longer side of the box
constexpr double kFirst = 0.02;     // half side of the rectangle before it grows, by the box
constexpr double kSideStep = 0.02;  // by which a side moves
constexpr int kRounds = 200;
constexpr double kMostOff = 0.008;  // by the box, of the form of a pass that shows a plane

using Vector2 = Eigen::Vector2d;

// Of a matte, unsqueezed.
struct Places {
    Vec2 middle{0}, sides{0};  // of the box around it
    std::vector<Vec2> inside;
};

Places places_of(ViewU8x1 matte, PixelAspect aspect) {
    Places out;
    Recti box{};
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            if (matte.row(y)[x] >= 128) box = box.united({x, y, x + 1, y + 1});
    const int step = std::max(1, std::max(box.width(), box.height()) / kPlaces);
    for (int y = box.y0; y < box.y1; y += step)
        for (int x = box.x0; x < box.x1; x += step)
            if (matte.row(y)[x] >= 128)
                out.inside.push_back(aspect.unsqueezed(
                    Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)));
    out.middle = aspect.unsqueezed(
        0.5f * Vec2(static_cast<float>(box.x0 + box.x1), static_cast<float>(box.y0 + box.y1)));
    out.sides =
        aspect.unsqueezed(Vec2(static_cast<float>(box.width()), static_cast<float>(box.height())));
    return out;
}

// A rectangle on the plane laid flat.
struct Sides {
    double left, top, right, bottom;
};

class Growing {
  public:
    // `picture_from_flat`, both by the middle of the box and its longer side.
    Growing(const Eigen::Matrix3d& picture_from_flat, Vector2 reach)
        : picture_from_flat_(picture_from_flat), reach_(std::move(reach)) {}

    [[nodiscard]] bool fits(const Sides& s) const {
        double sign = 0;
        for (const Vector2& corner : corners(s)) {
            const Eigen::Vector3d p = picture_from_flat_ * corner.homogeneous();
            if (sign == 0) sign = p.z();
            if (!(p.z() * sign > 0)) return false;
            if (!(std::abs(p.x()) <= reach_.x() * std::abs(p.z()) &&
                  std::abs(p.y()) <= reach_.y() * std::abs(p.z())))
                return false;
        }
        return true;
    }
    [[nodiscard]] static std::vector<Vector2> corners(const Sides& s) {
        return {{s.left, s.top}, {s.right, s.top}, {s.right, s.bottom}, {s.left, s.bottom}};
    }
    // Moves one side after the other outwards, as long as all corners stay inside.
    [[nodiscard]] Sides grown(Sides s, double step) const {
        for (int round = 0; round < kRounds; ++round) {
            bool any = false;
            const auto move = [&](double Sides::*side, double by) {
                Sides next = s;
                next.*side += by;
                if (!fits(next)) return;
                s = next;
                any = true;
            };
            move(&Sides::left, -step);
            move(&Sides::right, step);
            move(&Sides::top, -step);
            move(&Sides::bottom, step);
            if (!any) break;
        }
        return s;
    }

  private:
    Eigen::Matrix3d picture_from_flat_;
    Vector2 reach_;
};

// How far places are off what the homography says, the median; px.
double off_plane_px(const glm::dmat3& map, const std::vector<PlacePair>& pairs) {
    std::vector<double> off;
    off.reserve(pairs.size());
    for (const PlacePair& pair : pairs)
        off.push_back(static_cast<double>(glm::distance(mapped(map, pair.from), pair.to)));
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::nth_element(off.begin(), middle, off.end());
    return *middle;
}

}  // namespace

std::optional<Quad<float>> plane_corners(const FormMap& form, ViewU8x1 matte) {
    const bool pass = form.finding.source == FormFinding::Source::kPass;
    if (form.finding.source == FormFinding::Source::kNone || (!form.finding.plane && !pass))
        return std::nullopt;
    const Places places = places_of(matte, form.aspect);
    if (places.inside.empty()) return std::nullopt;
    const auto wide = static_cast<double>(places.sides.x);
    const auto high = static_cast<double>(places.sides.y);
    const double side = std::max(wide, high);
    const Vec2 middle = places.middle;
    // A plane laid flat is a homography of its picture.
    std::vector<PlacePair> picture_of_flat;
    picture_of_flat.reserve(places.inside.size());
    for (const Vec2 p : places.inside)
        picture_of_flat.push_back({p + form.at(p), p});
    const auto fit = fit_homography(picture_of_flat);
    if (!fit || (pass && off_plane_px(*fit, picture_of_flat) > kMostOff * side))
        return std::nullopt;
    const Matrix3 map = in_units(*fit, middle, side);
    const Growing growing(map, Vector2(0.5 * wide / side, 0.5 * high / side));
    // From the place that the middle of the box shows.
    const Eigen::Vector3d at = map.inverse() * Eigen::Vector3d::UnitZ();
    if (!(std::abs(at.z()) > 1e-9)) return std::nullopt;
    const Vector2 centre = at.hnormalized();
    const Sides first{centre.x() - kFirst, centre.y() - kFirst, centre.x() + kFirst,
                      centre.y() + kFirst};
    if (!growing.fits(first)) return std::nullopt;
    Quad<float> out{};
    std::size_t k = 0;
    for (const Vector2& corner : Growing::corners(growing.grown(first, kSideStep))) {
        const Vector2 p = (map * corner.homogeneous()).hnormalized() * side;
        out[k++] = form.aspect.squeezed(middle +
                                        Vec2(static_cast<float>(p.x()), static_cast<float>(p.y())));
    }
    if (!is_convex(out)) return std::nullopt;
    return out;
}

}  // namespace weft
