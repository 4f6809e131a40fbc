#include "engine/form/drawn_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/form/plane_from_lines.h"
#include "engine/form/rigid_bundle.h"
#include "engine/form/unit_vector.h"

namespace weft {
namespace {

using Vector = glm::dvec3;

constexpr double kLeastCosine = 0.05;    // of the view; more grazing does not tell
constexpr double kLeastNearness = 0.04;  // of a plane towards its horizon, against its middle
constexpr double kMostPointing = 0.985;  // cosine of a cylinder's axis against the view

// Long double: see docs/decisions/0002-determinism.md.
double sine_of_degrees(double deg) {
    return static_cast<double>(
        std::sin(static_cast<long double>(deg) * std::numbers::pi_v<long double> / 180));
}
double fov_of(double tangent, Size picture) {
    const long double half = 0.5L * static_cast<long double>(tangent) * picture.width /
                             std::max(picture.width, picture.height);
    return static_cast<double>(2 * std::atan(half) * 180 / std::numbers::pi_v<long double>);
}

std::optional<double> tangent_of(const DrawnCamera& camera) {
    if (!camera.fov_deg) return std::nullopt;
    return std::max(camera.picture.width, camera.picture.height) /
           camera_with(*camera.fov_deg, camera.picture).focal_px;
}

// The smaller of two solutions of a t² − 2 b t + c = 0 that lies in front of the camera.
std::optional<double> nearer(double a, double b, double c, const auto& holds) {
    if (std::abs(a) < 1e-15 * (std::abs(b) + 1e-300)) {
        const double t = 0.5 * c / b;
        return t > 0 && holds(t) ? std::optional(t) : std::nullopt;
    }
    const double under = b * b - a * c;
    if (!(under >= 0)) return std::nullopt;
    const double q = b + std::copysign(std::sqrt(under), b);
    std::array<double, 2> solutions{q / a, q != 0 ? c / q : -1.0};
    if (solutions[0] > solutions[1]) std::swap(solutions[0], solutions[1]);
    for (const double t : solutions)
        if (t > 0 && holds(t)) return t;
    return std::nullopt;
}

// Depth along a ray, and the surface's normal there.
struct Hit {
    double depth = 0;
    Vector normal{0};
};

std::optional<Hit> hit(const DrawnPlane& plane, const Vector& ray) {
    const double nearness = glm::dot(plane.normal, ray);
    if (!(nearness >= kLeastNearness)) return std::nullopt;
    return Hit{1 / nearness, plane.normal};
}

std::optional<Hit> hit(const DrawnBall& ball, const Vector& ray) {
    const auto t = nearer(glm::dot(ray, ray), glm::dot(ray, ball.centre),
                          glm::dot(ball.centre, ball.centre) - ball.radius * ball.radius,
                          [](double) { return true; });
    if (!t) return std::nullopt;
    return Hit{*t, *t * ray - ball.centre};
}

std::optional<Hit> hit(const DrawnCylinder& c, const Vector& ray) {
    const auto beside = [&](const Vector& v) { return v - c.axis * glm::dot(v, c.axis); };
    const Vector r = beside(ray), o = beside(c.origin);
    const auto t = nearer(glm::dot(r, r), glm::dot(r, o), glm::dot(o, o) - c.radius * c.radius,
                          [](double) { return true; });
    if (!t) return std::nullopt;
    return Hit{*t, *t * r - o};
}

std::optional<Hit> hit(const DrawnCone& c, const Vector& ray) {
    // ((P − V) · d)² = cos² |P − V|², on the side into which the axis runs.
    const double r = glm::dot(ray, c.axis), v = glm::dot(c.apex, c.axis), k = c.squared_cosine;
    const auto along = [&](double t) { return t * r - v; };
    const auto t =
        nearer(r * r - k * glm::dot(ray, ray), r * v - k * glm::dot(ray, c.apex),
               v * v - k * glm::dot(c.apex, c.apex), [&](double at) { return along(at) > 0; });
    if (!t) return std::nullopt;
    const Vector from_apex = *t * ray - c.apex;
    return Hit{*t, k * from_apex - c.axis * along(*t)};
}

// The two planes through the camera in which the outlines of a round thing lie, by normals that
// point inwards, and the directions of the middles of its ends.
struct Outlines {
    Vector left, right, at_a, at_b;
};

Outlines outlines_of(const FormGuide& shape, const ViewCamera& camera) {
    const glm::dvec2 a = shape.place(0), b = shape.place(2), d = b - a;
    const glm::dvec2 across = glm::dvec2(-d.y, d.x) / std::sqrt(d.x * d.x + d.y * d.y);
    const auto ray = [&](glm::dvec2 p) -> Vector {
        return unit({(p.x - camera.centre.x) / camera.focal_px,
                     (p.y - camera.centre.y) / camera.focal_px, 1.0});
    };
    const double ra = shape.numbers[4], rb = shape.numbers[5];
    const Vector la = ray(a - ra * across), lb = ray(b - rb * across), ha = ray(a + ra * across),
                 hb = ray(b + rb * across);
    Outlines out{unit(glm::cross(la, lb)), unit(glm::cross(ha, hb)), unit(la + ha), unit(lb + hb)};
    const Vector middle = unit(out.at_a + out.at_b);
    if (glm::dot(out.left, middle) < 0) out.left = -out.left;
    if (glm::dot(out.right, middle) < 0) out.right = -out.right;
    return out;
}

// On the plane halfway between the outlines, where a direction meets it nearest.
Vector between_outlines(const Outlines& o, const Vector& direction) {
    const Vector across = unit(o.left - o.right);
    return unit(direction - across * glm::dot(direction, across));
}

Expected<DrawnCylinder> cylinder_from_outlines(const Outlines& o) {
    const Vector axis = unit(glm::cross(o.left, o.right));
    const Vector a = between_outlines(o, o.at_a);
    if (std::abs(glm::dot(axis, unit(o.at_a + o.at_b))) > kMostPointing) {
        return fail(ErrorCode::kUsage,
                    "The cylinder's radii differ so much that it would point at the camera.",
                    "Make them more alike, or draw a cone");
    }
    return DrawnCylinder{a, axis, glm::dot(o.left, a)};
}

// The ends of a tilted axis: A at a distance of 1 from the camera.
struct Axis {
    Vector a{0}, b{0};
};

Expected<Axis> tilted_axis(const Outlines& o, double tilt_deg) {
    const Vector a = between_outlines(o, o.at_a), b = between_outlines(o, o.at_b);
    // Of the triangle camera, A, B: (B − A) · middle = |B − A| sin tilt.
    const Vector middle = unit(a + b);
    const double sine = sine_of_degrees(tilt_deg);
    // With B = s b: (s m − m)² … where both have the same cosine m to the middle.
    const double m = glm::dot(a, middle), c = glm::dot(a, b);
    // m² (s − 1)² = sine² (s² − 2 c s + 1)
    const double square = m * m - sine * sine, linear = m * m - c * sine * sine;
    const double under = linear * linear - square * square;
    if (!(under >= 0) || !(square > 0)) {
        return fail(ErrorCode::kUsage, "An axis as long as this cannot be tilted as much.",
                    "Tilt it less");
    }
    const double root = std::sqrt(under);
    const double s = (linear + (tilt_deg >= 0 ? root : -root)) / square;
    return Axis{a, s * b};
}

Expected<DrawnSurface> round_surface(const FormGuide& shape, DrawnSurface out) {
    const Outlines o = outlines_of(shape, out.camera);
    const bool tilted = shape.numbers.size() > 6;
    if (shape.kind == FormGuideKind::kCylinder && !tilted) {
        WEFT_TRY(cylinder, cylinder_from_outlines(o));
        out.body = cylinder;
        return out;
    }
    WEFT_TRY(axis, tilted_axis(o, tilted ? shape.numbers[6] : 0.0));
    const Vector along = axis.b - axis.a;
    const double long_ = glm::length(along);
    // Radii of the balls around A and B that touch the outlines.
    const double a = glm::dot(o.left, axis.a), b = glm::dot(o.left, axis.b);
    const double sine = (b - a) / long_;
    constexpr double kNoCone = 1e-3;
    if (shape.kind == FormGuideKind::kCylinder || std::abs(sine) < kNoCone) {
        out.body = DrawnCylinder{axis.a, along / long_, 0.5 * (a + b)};
        return out;
    }
    constexpr double kMostSine = 0.98;
    if (std::abs(sine) > kMostSine) {
        return fail(ErrorCode::kUsage,
                    "The cone is wider than it is long, so that its side is not seen.",
                    "Draw its axis longer, or tilt it less");
    }
    const Vector apex = axis.a - along * (a / (b - a));
    out.body = DrawnCone{apex, (sine > 0 ? 1.0 : -1.0) * along / long_, 1 - sine * sine};
    return out;
}

DrawnSurface ball_surface(const FormGuide& shape, DrawnSurface out) {
    const glm::dvec2 c = shape.place(0);
    const double r = shape.numbers[2];
    const auto ray = [&](double x, double y) -> Vector {
        return unit({(x - out.camera.centre.x) / out.camera.focal_px,
                     (y - out.camera.centre.y) / out.camera.focal_px, 1.0});
    };
    const Vector left = ray(c.x - r, c.y), right = ray(c.x + r, c.y), up = ray(c.x, c.y - r),
                 down = ray(c.x, c.y + r);
    const Vector middle = unit(left + right + up + down);
    // Sine of half the angle between the edges, in the mean of both ways.
    const auto sine = [](const Vector& p, const Vector& q) { return 0.5 * glm::length(p - q); };
    out.body = DrawnBall{middle, 0.5 * (sine(left, right) + sine(up, down))};
    return out;
}

DrawnSurface plane_surface(const PlaneFromLines& found, Size picture) {
    const RigidSurface& s = found.surface;
    DrawnSurface out;
    out.camera = {s.long_side / s.tangent, s.middle};
    // n · ray is the nearness, whose slopes by pixel are the same at every depth.
    const double by = out.camera.focal_px / s.radius;
    out.body = DrawnPlane{{s.slope_x * by, s.slope_y * by, s.nearness(s.middle)}};
    out.fov_deg = fov_of(s.tangent, picture);
    out.tilt_deg = found.tilt_deg;
    out.tilt_error_deg = found.tilt_error_deg;
    return out;
}

DrawnSurface in_front_of(const DrawnCamera& camera) {
    const double tangent = tangent_of(camera).value_or(RigidPrior().tangent);
    DrawnSurface out;
    out.fov_deg = camera.fov_deg.value_or(fov_of(tangent, camera.picture));
    const double side = std::max(camera.picture.width, camera.picture.height);
    out.camera = {side / tangent, 0.5f * Vec2(static_cast<float>(camera.picture.width),
                                              static_cast<float>(camera.picture.height))};
    return out;
}

bool cross_each_other(const PictureLine& p, const PictureLine& q) {
    const auto side = [](const PictureLine& line, const glm::dvec2& at) {
        const glm::dvec2 d = line.to - line.from, e = at - line.from;
        return d.x * e.y - d.y * e.x;
    };
    return side(p, q.from) * side(p, q.to) < 0 && side(q, p.from) * side(q, p.to) < 0;
}

}  // namespace

std::optional<Metric> DrawnSurface::metric(Vec2 pixel) const {
    const Vector ray = camera.ray(pixel);
    const auto at = std::visit([&](const auto& b) { return hit(b, ray); }, body);
    if (!at) return std::nullopt;
    const double straight = glm::dot(at->normal, ray);
    const double cosine = std::abs(straight) / (glm::length(at->normal) * glm::length(ray));
    if (!(cosine >= kLeastCosine)) return std::nullopt;
    // A step of the ray moves its place along the ray, back onto the surface.
    const auto step = [&](const Vector& d) -> Vector {
        return at->depth * (d - ray * (glm::dot(at->normal, d) / straight));
    };
    const double by = 1 / camera.focal_px;
    const Vector x = step({by, 0, 0}), y = step({0, by, 0});
    return Metric{glm::dot(x, x), glm::dot(x, y), glm::dot(y, y)};
}

Expected<DrawnSurface> drawn_surface(const FormGuide& shape, const DrawnCamera& camera) {
    switch (shape.kind) {
        case FormGuideKind::kPlane: {
            const glm::dvec2 a = shape.place(0), b = shape.place(2), c = shape.place(4),
                             d = shape.place(6);
            return plane_surface(plane_from_lines({{a, b}, {d, c}}, {{b, c}, {a, d}},
                                                  camera.picture, tangent_of(camera)),
                                 camera.picture);
        }
        case FormGuideKind::kBall:
            return ball_surface(shape, in_front_of(camera));
        default:
            return round_surface(shape, in_front_of(camera));
    }
}

Expected<DrawnSurface> drawn_plane(const std::vector<FormGuide>& strokes,
                                   const DrawnCamera& camera) {
    std::vector<std::vector<PictureLine>> groups;
    for (const FormGuide& stroke : strokes) {
        if (stroke.kind != FormGuideKind::kParallel) continue;
        auto& lines = groups.emplace_back();
        for (std::size_t k = 0; k < stroke.numbers.size(); k += 4) {
            const PictureLine line{stroke.place(k), stroke.place(k + 2)};
            for (const PictureLine& other : lines)
                if (cross_each_other(line, other))
                    return fail(ErrorCode::kUsage,
                                "Parallel strokes of one group cross each other.",
                                "Draw them along lines that are parallel on the surface");
            lines.push_back(line);
        }
    }
    if (groups.size() > 2)
        return fail(ErrorCode::kUsage, "There are more than two groups of parallel strokes",
                    "a plane has two, at right angles to each other");
    groups.resize(2);
    if (groups[0].size() + groups[1].size() < 2)
        return fail(
            ErrorCode::kUsage, "One parallel stroke does not show a plane.",
            "Draw a second line that is parallel to it on the surface, or at right angles to it");
    return plane_surface(plane_from_lines(groups[0], groups[1], camera.picture, tangent_of(camera)),
                         camera.picture);
}

}  // namespace weft
