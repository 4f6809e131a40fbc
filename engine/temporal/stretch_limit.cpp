#include "engine/temporal/stretch_limit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/smooth_step.h"

namespace weft {
namespace {

constexpr float kPull = 0.7f;  // of the way back, per frame

Vec2 landing(const LatticeField& field, int i, int j) {
    return field.node_position(i, j) + field.node(i, j);
}

// The Jacobian at an inner node as turn(after) · diag(largest, smallest) · turn(before). `smallest`
// is below 0 where the field folds over.
struct LocalShape {
    float largest, smallest, before, after;
};

LocalShape shape_at(const LatticeField& field, int i, int j) {
    const float step = 2.0f * static_cast<float>(field.spacing());
    const Vec2 x = (landing(field, i + 1, j) - landing(field, i - 1, j)) / step;
    const Vec2 y = (landing(field, i, j + 1) - landing(field, i, j - 1)) / step;
    const Vec2 even(0.5f * (x.x + y.y), 0.5f * (x.y - y.x));
    const Vec2 odd(0.5f * (x.x - y.y), 0.5f * (x.y + y.x));
    const float turn = std::atan2(even.y, even.x), mirror = std::atan2(odd.y, odd.x);
    const float a = std::hypot(even.x, even.y), b = std::hypot(odd.x, odd.y);
    return {a + b, a - b, 0.5f * (turn - mirror), 0.5f * (turn + mirror)};
}

// Also where the field is flat or folds over.
float width_of(const LocalShape& shape) {
    return std::max(shape.smallest, 1e-4f * shape.largest);
}
float scale_of(const LocalShape& shape) {
    return std::sqrt(shape.largest * width_of(shape));
}
float drawn_out(const LocalShape& shape) {
    return shape.largest / width_of(shape);
}

// In units of the limits: above 1 it is past one of them.
float stretch_of(const LocalShape& shape, const StretchLimits& limits, float whole) {
    const float scale = scale_of(shape) / whole;
    return std::max(drawn_out(shape) / limits.drawn_out,
                    std::max(scale, 1 / scale) / limits.scaled);
}

bool inside(const LatticeField& field, ViewU8x1 visible, int i, int j) {
    const Vec2 p = field.node_position(i, j);
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    return rect_of(visible.size()).contains(x, y) && visible.at(x, y) >= 128;
}

// How much larger or smaller all of the surface is on the reference frame: of both singular values
// the one nearer to 1 if they lie on one side of it, else 1; the median of what is seen, as far as
// `range` allows. What comes near the camera takes its texture with it.
float whole_scale(const LatticeField& field, ViewU8x1 visible, ScaleRange range) {
    std::vector<float> scales;
    for (int j = 1; j + 1 < field.nodes().height(); ++j) {
        for (int i = 1; i + 1 < field.nodes().width(); ++i) {
            if (!inside(field, visible, i, j)) continue;
            const LocalShape shape = shape_at(field, i, j);
            if (shape.smallest > 0)
                scales.push_back(std::max(shape.smallest, std::min(1.0f, shape.largest)));
        }
    }
    return std::clamp(median_of(scales, 1.0f), range.least, range.most);
}

// q ≈ a p + b over complex numbers: rotation, scale and translation by least squares.
struct Similarity {
    std::complex<double> a{1, 0}, b{0, 0};
    [[nodiscard]] Vec2 operator()(Vec2 p) const {
        const std::complex<double> q = a * std::complex<double>(p.x, p.y) + b;
        return {static_cast<float>(q.real()), static_cast<float>(q.imag())};
    }
};

Similarity fit(const LatticeField& field, const ImageF1& weight, ScaleRange range) {
    double n = 0, norm = 0;
    std::complex<double> p_sum, q_sum, cross;
    for (int j = 0; j < weight.height(); ++j) {
        for (int i = 0; i < weight.width(); ++i) {
            const double w = weight.at(i, j);
            if (w <= 0) continue;
            const Vec2 at = field.node_position(i, j), to = landing(field, i, j);
            const std::complex<double> p(at.x, at.y), q(to.x, to.y);
            n += w;
            p_sum += w * p;
            q_sum += w * q;
            cross += w * std::conj(p) * q;
            norm += w * std::norm(p);
        }
    }
    Similarity out;
    if (n <= 0) return out;
    const double spread = norm - std::norm(p_sum) / n;
    if (spread > 1e-6) out.a = (cross - std::conj(p_sum) * q_sum / n) / spread;
    const double scale = std::abs(out.a);
    const double held = std::clamp<double>(scale, range.least, range.most);
    out.a = scale > 1e-6 ? out.a * (held / scale) : std::complex<double>(held, 0);
    out.b = (q_sum - out.a * p_sum) / n;
    return out;
}

constexpr ScaleRange kAnyScale{2.0f / 3, 1.5f};  // of one that nobody has asked for

// 1 at nodes that are seen.
ImageF1 seen_nodes(const LatticeField& field, ViewU8x1 visible) {
    ImageF1 out(field.nodes().size());
    for (int j = 0; j < out.height(); ++j) {
        for (int i = 0; i < out.width(); ++i)
            out.at(i, j) = inside(field, visible, i, j) ? 1.0f : 0.0f;
    }
    return out;
}

// That of what is seen.
Similarity similarity_of(const LatticeField& field, ViewU8x1 visible) {
    return fit(field, seen_nodes(field, visible), kAnyScale);
}

// 1 within `reach` nodes of the marks, falling smoothly to 0 at twice that distance.
ImageF1 spread(const ImageF1& marks, int reach) {
    ImageF1 out(marks.size());
    for (int j = 0; j < marks.height(); ++j) {
        for (int i = 0; i < marks.width(); ++i) {
            float nearest = 1e9f;
            for (int v = std::max(0, j - 2 * reach);
                 v <= std::min(marks.height() - 1, j + 2 * reach); ++v) {
                for (int u = std::max(0, i - 2 * reach);
                     u <= std::min(marks.width() - 1, i + 2 * reach); ++u) {
                    if (marks.at(u, v) > 0)
                        nearest = std::min(nearest, std::hypot(static_cast<float>(u - i),
                                                               static_cast<float>(v - j)));
                }
            }
            out.at(i, j) = 1 - smooth_step(nearest / static_cast<float>(reach), 1.0f, 2.0f);
        }
    }
    return out;
}

// 0 at what is seen and what a few frames may bring into view, rising to 1 farther off.
ImageF1 out_of_sight(const LatticeField& field, ViewU8x1 visible) {
    constexpr int kMargin = 3;  // nodes
    ImageF1 out = spread(seen_nodes(field, visible), kMargin);
    for (int j = 0; j < out.height(); ++j) {
        for (int i = 0; i < out.width(); ++i)
            out.at(i, j) = 1 - out.at(i, j);
    }
    return out;
}

// The field's slopes at an inner node, well within the limits where they are past one.
struct Slopes {
    Vec2 along_x, along_y;
};

Slopes limited_slopes(const LocalShape& shape, const StretchLimits& limits, float whole) {
    float scale = scale_of(shape) / whole;
    if (std::max(scale, 1 / scale) > limits.scaled)
        scale = scale > 1 ? limits.scaled_after : 1 / limits.scaled_after;
    const float is = drawn_out(shape);
    const float half = std::sqrt(is > limits.drawn_out ? limits.drawn_out_after : is);
    const float large = whole * scale * half, small = whole * scale / half;
    const Vec2 before(std::cos(shape.before), std::sin(shape.before));
    const Vec2 after(std::cos(shape.after), std::sin(shape.after));
    const auto turned = [&](Vec2 v) {
        const Vec2 u(large * (before.x * v.x - before.y * v.y),
                     small * (before.y * v.x + before.x * v.y));
        return Vec2(after.x * u.x - after.y * u.y, after.y * u.x + after.x * u.y);
    };
    return {turned({1, 0}), turned({0, 1})};
}

// Where the nodes with `free` > 0 come to lie if every step between neighbours is as `slopes` say
// and all other nodes stay (least squares, by successive over-relaxation; after Sorkine & Alexa
// 2007).
ImageF2 laid_by(const Image<Slopes, 1>& slopes, const ImageF1& free, const LatticeField& field) {
    constexpr int kSweeps = 120;
    constexpr float kStay = 5e-4f;  // beside one neighbour
    constexpr float kOver = 1.9f;
    const Size size = free.size();
    const float half_step = 0.5f * static_cast<float>(field.spacing());
    ImageF2 out(size);
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i) {
            const Vec2 to = landing(field, i, j);
            out.at(i, j, 0) = to.x;
            out.at(i, j, 1) = to.y;
        }
    }
    const auto relax = [&](int i, int j) {
        const Slopes& here = slopes.at(i, j);
        Vec2 sum = kStay * landing(field, i, j);
        float weight = kStay;
        const auto add = [&](int u, int v) {
            if (u < 0 || v < 0 || u >= size.width || v >= size.height) return;
            const Slopes& there = slopes.at(u, v);
            const Vec2 way = u != i ? static_cast<float>(i - u) * (here.along_x + there.along_x)
                                    : static_cast<float>(j - v) * (here.along_y + there.along_y);
            sum += Vec2(out.at(u, v, 0), out.at(u, v, 1)) + half_step * way;
            weight += 1;
        };
        add(i - 1, j);
        add(i + 1, j);
        add(i, j - 1);
        add(i, j + 1);
        out.at(i, j, 0) += kOver * (sum.x / weight - out.at(i, j, 0));
        out.at(i, j, 1) += kOver * (sum.y / weight - out.at(i, j, 1));
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (int j = 0; j < size.height; ++j) {
            for (int i = 0; i < size.width; ++i) {
                if (free.at(i, j) > 0) relax(i, j);
            }
        }
    }
    return out;
}

}  // namespace

StretchLimits StretchLimits::towards(const StretchLimits& tight, float share) const {
    const auto mixed = [&](float here, float there) { return here + share * (there - here); };
    return {mixed(drawn_out, tight.drawn_out),
            mixed(scaled, tight.scaled),
            mixed(drawn_out_after, tight.drawn_out_after),
            mixed(scaled_after, tight.scaled_after),
            {mixed(whole.least, tight.whole.least), mixed(whole.most, tight.whole.most)}};
}

std::optional<LatticeField> relaxed_stretch(const LatticeField& field, ViewU8x1 visible,
                                            const StretchLimits& limits) {
    constexpr float kMuch = 0.2f;    // of the surface
    constexpr float kEnough = 0.7f;  // of the limit, so that it is not reached again at once
    const Size size = field.nodes().size();
    ImageF1 excess(size), weight(size);
    const float whole = whole_scale(field, visible, limits.whole);
    int seen = 0, past = 0;
    for (int j = 1; j + 1 < size.height; ++j) {
        for (int i = 1; i + 1 < size.width; ++i) {
            if (!inside(field, visible, i, j)) continue;
            const bool over = stretch_of(shape_at(field, i, j), limits, whole) > 1;
            excess.at(i, j) = over ? 1.0f : 0.0f;
            weight.at(i, j) = over ? 0.02f : 1.0f;
            ++seen;
            past += over ? 1 : 0;
        }
    }
    if (seen == 0 || static_cast<float>(past) < kMuch * static_cast<float>(seen)) return {};
    const Similarity target =
        fit(field, weight, {whole / limits.scaled_after, whole * limits.scaled_after});
    const ImageF1 hidden = out_of_sight(field, visible);
    for (int reach = 4; reach <= 64; reach *= 2) {
        const ImageF1 pull = reach < 64 ? spread(excess, reach) : ImageF1(size, 1.0f);
        LatticeField out = field;
        for (int j = 0; j < size.height; ++j) {
            for (int i = 0; i < size.width; ++i) {
                const Vec2 p = field.node_position(i, j);
                const float pulled = std::max(pull.at(i, j), hidden.at(i, j));
                out.set_node(i, j, field.node(i, j) + pulled * (target(p) - landing(field, i, j)));
            }
        }
        float most = 0;
        for (int j = 1; j + 1 < size.height; ++j) {
            for (int i = 1; i + 1 < size.width; ++i) {
                if (inside(out, visible, i, j))
                    most = std::max(most, stretch_of(shape_at(out, i, j), limits, whole));
            }
        }
        if (most <= kEnough || reach == 64) return out;
    }
    return {};
}

LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible) {
    const Similarity target = similarity_of(field, visible);
    LatticeField out(field.full_size(), field.spacing());
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j);
            out.set_node(i, j, target(p) - p);
        }
    }
    return out;
}

LatticeField tame_out_of_sight(const LatticeField& field, ViewU8x1 visible) {
    const StretchLimits limits;
    const float whole = whole_scale(field, visible, kAnyScale);
    const ImageF1 hidden = out_of_sight(field, visible);
    float most = 0;
    for (int j = 1; j + 1 < hidden.height(); ++j) {
        for (int i = 1; i + 1 < hidden.width(); ++i) {
            if (hidden.at(i, j) > 0)
                most = std::max(most, stretch_of(shape_at(field, i, j), limits, whole));
        }
    }
    if (most <= 1) return field;
    const Similarity target = similarity_of(field, visible);
    LatticeField out = field;
    for (int j = 0; j < hidden.height(); ++j) {
        for (int i = 0; i < hidden.width(); ++i) {
            const Vec2 to = target(field.node_position(i, j));
            out.set_node(i, j, field.node(i, j) + hidden.at(i, j) * (to - landing(field, i, j)));
        }
    }
    return out;
}

bool limit_stretch(LatticeField& field, ViewU8x1 visible, const StretchLimits& limits) {
    constexpr int kReach = 2;  // nodes
    const Size size = field.nodes().size();
    const float whole = whole_scale(field, visible, limits.whole);
    ImageF1 past(size);
    bool any = false;
    for (int j = 1; j + 1 < size.height; ++j) {
        for (int i = 1; i + 1 < size.width; ++i) {
            if (!inside(field, visible, i, j)) continue;
            if (stretch_of(shape_at(field, i, j), limits, whole) <= 1) continue;
            past.at(i, j) = 1;
            any = true;
        }
    }
    if (!any) return false;
    // What is not seen goes along.
    ImageF1 free = spread(past, kReach);
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i) {
            if (!inside(field, visible, i, j)) free.at(i, j) = 1;
        }
    }
    Image<Slopes, 1> slopes(size);
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i) {
            const int u = std::clamp(i, 1, size.width - 2), v = std::clamp(j, 1, size.height - 2);
            slopes.at(i, j) = limited_slopes(shape_at(field, u, v), limits, whole);
        }
    }
    const ImageF2 target = laid_by(slopes, free, field);
    for (int j = 0; j < size.height; ++j) {
        for (int i = 0; i < size.width; ++i) {
            const float pull = kPull * free.at(i, j);
            if (pull <= 0) continue;
            const Vec2 to(target.at(i, j, 0), target.at(i, j, 1));
            field.set_node(i, j, field.node(i, j) + pull * (to - landing(field, i, j)));
        }
    }
    return true;
}

}  // namespace weft
