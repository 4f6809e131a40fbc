#include "ui/form/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/quad.h"
#include "ui/canvas/angles.h"

namespace weft::ui {
namespace {

constexpr int kRoundSteps = 48;

Vec2 vec(glm::dvec2 p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y)};
}
glm::dvec2 exact(Vec2 p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
}
void put(FormGuide& guide, std::size_t first, glm::dvec2 at) {
    guide.numbers[first] = at.x;
    guide.numbers[first + 1] = at.y;
}
double length_of(glm::dvec2 v) {
    return std::hypot(v.x, v.y);
}
// At right angles to the axis of a cylinder or cone, of length 1.
glm::dvec2 across(const FormGuide& guide) {
    const glm::dvec2 axis = guide.place(2) - guide.place(0);
    const double l = std::max(length_of(axis), 1e-6);
    return {-axis.y / l, axis.x / l};
}

// A matte by unsqueezed places.
struct SeenMatte {
    const ViewU8x1& pixels;
    PixelAspect aspect;
};

bool inside(const SeenMatte& seen, glm::dvec2 unsqueezed) {
    const ViewU8x1& matte = seen.pixels;
    const glm::dvec2 p = seen.aspect.squeezed(unsqueezed);
    return p.x >= 0 && p.y >= 0 && p.x < matte.width() && p.y < matte.height() &&
           matte.at(static_cast<int>(p.x), static_cast<int>(p.y)) >= 128;
}

// How far the matte reaches from `at` to the nearer side; 0 outside of it.
double half_width(const SeenMatte& matte, glm::dvec2 at, glm::dvec2 way) {
    double out = 0;
    while (inside(matte, at + out * way) && inside(matte, at - out * way))
        out += 1;
    return out;
}

FormGuide round_guide(FormGuideKind kind, glm::dvec2 a, glm::dvec2 b, const SeenMatte& matte) {
    FormGuide out{kind, {a.x, a.y, b.x, b.y, 0, 0}};
    // A little inside of the ends, where the outline still runs along the axis.
    constexpr double kIn = 0.1;
    const double usual = 0.25 * length_of(b - a);
    for (std::size_t k = 0; k < 2; ++k) {
        const double t = k == 0 ? kIn : 1 - kIn;
        const double found = half_width(matte, (1 - t) * a + t * b, across(out));
        out.numbers[4 + k] = found > 0 ? found : usual;
    }
    if (kind == FormGuideKind::kCylinder) return out;
    // To the ends themselves, along straight sides.
    const double slope = (out.numbers[5] - out.numbers[4]) / (1 - 2 * kIn);
    out.numbers[4] = std::max(0.0, out.numbers[4] - kIn * slope);
    out.numbers[5] = std::max(0.0, out.numbers[5] + kIn * slope);
    return out;
}

// An ellipse with half axes u and v.
std::vector<Vec2> ellipse(glm::dvec2 centre, glm::dvec2 u, glm::dvec2 v) {
    std::vector<Vec2> out;
    for (int k = 0; k <= kRoundSteps; ++k) {
        const double angle = 360 * kDegree * k / kRoundSteps;
        out.push_back(vec(centre + std::cos(angle) * u + std::sin(angle) * v));
    }
    return out;
}

std::vector<std::vector<Vec2>> plane_lines(const FormGuide& guide) {
    const Quad<double> corners{guide.place(0), guide.place(2), guide.place(4), guide.place(6)};
    std::vector<std::vector<Vec2>> out;
    if (!is_convex(corners)) {
        std::vector<Vec2> edge;
        for (std::size_t k = 0; k <= 4; ++k)
            edge.push_back(vec(corners[k % 4]));
        return {edge};
    }
    const glm::dmat3 plate_from_square = square_to_quad(corners);
    const auto on = [&](double u, double v) {
        const glm::dvec3 p = plate_from_square * glm::dvec3(u, v, 1);
        return vec({p.x / p.z, p.y / p.z});
    };
    constexpr int kCells = 6;
    for (int k = 0; k <= kCells; ++k) {
        const double t = static_cast<double>(k) / kCells;
        out.push_back({on(t, 0), on(t, 1)});
        out.push_back({on(0, t), on(1, t)});
    }
    return out;
}

std::vector<std::vector<Vec2>> round_lines(const FormGuide& guide) {
    const glm::dvec2 a = guide.place(0), b = guide.place(2), n = across(guide);
    const glm::dvec2 along{n.y, -n.x};
    const double ra = guide.numbers[4], rb = guide.numbers[5];
    // Ends of a shape without a tilt are drawn as if seen a little from above.
    const double tilt = guide.numbers.size() > 6 ? std::abs(guide.numbers[6]) : 15;
    const double flat = std::sin(tilt * kDegree);
    return {{vec(a + ra * n), vec(b + rb * n)},
            {vec(a - ra * n), vec(b - rb * n)},
            {vec(a), vec(b)},
            ellipse(a, ra * n, flat * ra * along),
            ellipse(b, rb * n, flat * rb * along)};
}

}  // namespace

std::optional<FormGuide> guide_of_drag(FormGuideKind kind, Vec2 from, Vec2 to,
                                       const ViewU8x1& matte, PixelAspect aspect) {
    const glm::dvec2 a = aspect.unsqueezed(exact(from)), b = aspect.unsqueezed(exact(to));
    FormGuide out{kind, {a.x, a.y, b.x, b.y}};
    switch (kind) {
        case FormGuideKind::kPlane: {
            const double x0 = std::min(a.x, b.x), x1 = std::max(a.x, b.x);
            const double y0 = std::min(a.y, b.y), y1 = std::max(a.y, b.y);
            out.numbers = {x0, y0, x1, y0, x1, y1, x0, y1};
            break;
        }
        case FormGuideKind::kCylinder:
        case FormGuideKind::kCone:
            out = round_guide(kind, a, b, {matte, aspect});
            break;
        case FormGuideKind::kBall:
            out.numbers = {a.x, a.y, length_of(b - a)};
            break;
        case FormGuideKind::kParallel:
        case FormGuideKind::kLevel:
        case FormGuideKind::kCut:
            break;
    }
    out = squeezed(std::move(out), aspect);
    if (!check_form_guide(out)) return std::nullopt;
    return out;
}

std::vector<GuideHandle> handles_of(const FormGuide& squeezed, PixelAspect aspect) {
    const FormGuide guide = unsqueezed(squeezed, aspect);
    std::vector<GuideHandle> out;
    switch (guide.kind) {
        case FormGuideKind::kPlane: {
            glm::dvec2 middle{0};
            for (std::size_t k = 0; k < 4; ++k) {
                out.push_back({"corner " + std::to_string(k + 1), vec(guide.place(2 * k))});
                middle += 0.25 * guide.place(2 * k);
            }
            out.push_back({"middle", vec(middle)});
            break;
        }
        case FormGuideKind::kCylinder:
        case FormGuideKind::kCone: {
            const glm::dvec2 a = guide.place(0), b = guide.place(2), n = across(guide);
            out = {{"start", vec(a)},
                   {"end", vec(b)},
                   {"start width", vec(a + guide.numbers[4] * n), false},
                   {"end width", vec(b + guide.numbers[5] * n), false},
                   {"middle", vec(0.5 * (a + b))}};
            break;
        }
        case FormGuideKind::kBall:
            out = {{"middle", vec(guide.place(0))},
                   {"radius", vec(guide.place(0) + glm::dvec2(guide.numbers[2], 0)), false}};
            break;
        case FormGuideKind::kParallel:
        case FormGuideKind::kLevel:
        case FormGuideKind::kCut:
            for (std::size_t k = 0; k < guide.numbers.size(); k += 4) {
                const std::string line = std::to_string(k / 4 + 1);
                out.push_back({"start " + line, vec(guide.place(k))});
                out.push_back({"end " + line, vec(guide.place(k + 2))});
            }
            break;
    }
    for (GuideHandle& one : out)
        one.at = aspect.squeezed(one.at);
    return out;
}

FormGuide with_handle_at(const FormGuide& drawn, std::size_t handle, Vec2 to, PixelAspect aspect) {
    const FormGuide guide = unsqueezed(drawn, aspect);
    FormGuide out = guide;
    const glm::dvec2 at = aspect.unsqueezed(exact(to));
    const bool round = guide.kind == FormGuideKind::kCylinder || guide.kind == FormGuideKind::kCone;
    if (handles_of(guide)[handle].name == "middle") {
        const glm::dvec2 by = at - exact(handles_of(guide)[handle].at);
        const std::size_t places = guide.kind == FormGuideKind::kBall ? 1 : round ? 2 : 4;
        for (std::size_t k = 0; k < places; ++k)
            put(out, 2 * k, guide.place(2 * k) + by);
    } else if (guide.kind == FormGuideKind::kBall) {
        out.numbers[2] = length_of(at - guide.place(0));
    } else if (round && handle >= 2) {
        const glm::dvec2 from = at - guide.place(2 * (handle - 2)), n = across(guide);
        out.numbers[2 + handle] = std::abs(from.x * n.x + from.y * n.y);
    } else {
        put(out, 2 * handle, at);
    }
    return squeezed(std::move(out), aspect);
}

namespace {

std::vector<std::vector<Vec2>> unsqueezed_lines(const FormGuide& guide) {
    switch (guide.kind) {
        case FormGuideKind::kPlane:
            return plane_lines(guide);
        case FormGuideKind::kCylinder:
        case FormGuideKind::kCone:
            return round_lines(guide);
        case FormGuideKind::kBall: {
            const glm::dvec2 c = guide.place(0);
            const double r = guide.numbers[2];
            constexpr double kFlat = 0.3;
            return {ellipse(c, {r, 0}, {0, r}), ellipse(c, {r, 0}, {0, kFlat * r}),
                    ellipse(c, {kFlat * r, 0}, {0, r})};
        }
        case FormGuideKind::kParallel:
        case FormGuideKind::kLevel:
        case FormGuideKind::kCut:
            break;
    }
    std::vector<std::vector<Vec2>> out;
    for (std::size_t k = 0; k < guide.numbers.size(); k += 4)
        out.push_back({vec(guide.place(k)), vec(guide.place(k + 2))});
    return out;
}

}  // namespace

std::vector<std::vector<Vec2>> lines_of(const FormGuide& guide, PixelAspect aspect) {
    auto out = unsqueezed_lines(unsqueezed(guide, aspect));
    for (auto& line : out)
        for (Vec2& place : line)
            place = aspect.squeezed(place);
    return out;
}

void add_parallel(const FormGuide& stroke, std::vector<FormGuide>& strokes, PixelAspect aspect) {
    const auto direction = [&](const FormGuide& line) {
        return aspect.unsqueezed(line.place(2) - line.place(0));
    };
    const glm::dvec2 way = direction(stroke);
    FormGuide* last = nullptr;
    int groups = 0;
    for (FormGuide& group : strokes) {
        if (group.kind != FormGuideKind::kParallel) continue;
        ++groups;
        last = &group;
        const glm::dvec2 other = direction(group);
        const double dot = std::abs(way.x * other.x + way.y * other.y);
        if (dot >= std::sqrt(0.5) * length_of(way) * length_of(other)) break;
        last = groups == 2 ? &group : nullptr;
    }
    if (!last) {
        strokes.push_back(stroke);
    } else if (last->numbers.size() < kMostParallelNumbers) {
        last->numbers.insert(last->numbers.end(), stroke.numbers.begin(), stroke.numbers.end());
    }
}

void remove_line(std::size_t index, std::size_t line, std::vector<FormGuide>& strokes) {
    std::vector<double>& numbers = strokes[index].numbers;
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(4 * line);
    numbers.erase(first, first + 4);
    if (numbers.empty()) strokes.erase(strokes.begin() + static_cast<std::ptrdiff_t>(index));
}

std::vector<Edit> edits_of_form(const Region& region, const std::vector<FormGuide>& shape,
                                const std::vector<FormGuide>& strokes) {
    const RegionRef ref{region.id, {}};
    const FormParams& form = region.form;
    const bool drawn =
        !shape.empty() || std::any_of(strokes.begin(), strokes.end(), [](const FormGuide& stroke) {
            return stroke.kind == FormGuideKind::kParallel;
        });
    const bool pass_first = !form.position.empty() || !form.normal.empty();
    const bool reads =
        form.source == FormSource::kShape || (form.source == FormSource::kAuto && !pass_first);
    std::vector<Edit> out;
    if (shape != form.shape) out.emplace_back(SetRegionParameter{ref, "form.shape", shape});
    if (strokes != form.strokes) out.emplace_back(SetRegionParameter{ref, "form.strokes", strokes});
    if (drawn && !reads)
        out.emplace_back(SetRegionParameter{ref, "form.source", std::string("shape")});
    if (!drawn && form.source == FormSource::kShape)
        out.emplace_back(SetRegionParameter{ref, "form.source", std::string("auto")});
    return out;
}

}  // namespace weft::ui
