#include "engine/temporal/stretch_limit.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/core/smooth_step.h"

namespace weft {
namespace {

constexpr float kLimit = 3.0f;  // times
constexpr float kPull = 0.33f;  // per frame, at twice the limit

Vec2 landing(const LatticeField& field, int i, int j) {
    return field.node_position(i, j) + field.node(i, j);
}

// The larger of the stretch and the squeeze at an inner node: singular values of the Jacobian.
float stretch_at(const LatticeField& field, int i, int j) {
    const float step = 2.0f * static_cast<float>(field.spacing());
    const Vec2 x = (landing(field, i + 1, j) - landing(field, i - 1, j)) / step;
    const Vec2 y = (landing(field, i, j + 1) - landing(field, i, j - 1)) / step;
    const float sum = x.x * x.x + x.y * x.y + y.x * y.x + y.y * y.y;
    const float det = x.x * y.y - x.y * y.x;
    const float root = std::sqrt(std::max(0.0f, sum * sum - 4 * det * det));
    const float largest = std::sqrt(0.5f * (sum + root));
    const float smallest = det <= 0 ? 0.0f : std::sqrt(std::max(0.0f, 0.5f * (sum - root)));
    return std::max(largest, 1.0f / std::max(smallest, 1e-3f));
}

bool inside(const LatticeField& field, ViewU8x1 visible, int i, int j) {
    const Vec2 p = field.node_position(i, j);
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    return rect_of(visible.size()).contains(x, y) && visible.at(x, y) >= 128;
}

// q ≈ a p + b over complex numbers: rotation, scale and translation by least squares.
struct Similarity {
    std::complex<double> a{1, 0}, b{0, 0};
    [[nodiscard]] Vec2 operator()(Vec2 p) const {
        const std::complex<double> q = a * std::complex<double>(p.x, p.y) + b;
        return {static_cast<float>(q.real()), static_cast<float>(q.imag())};
    }
};

Similarity fit(const LatticeField& field, const ImageF1& weight) {
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
    out.a = scale > 1e-6 ? out.a * (std::clamp(scale, 2.0 / 3.0, 1.5) / scale)
                         : std::complex<double>(1, 0);
    out.b = (q_sum - out.a * p_sum) / n;
    return out;
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

}  // namespace

std::optional<LatticeField> relaxed_stretch(const LatticeField& field, ViewU8x1 visible) {
    constexpr float kMuch = 0.2f;    // of the surface
    constexpr float kEnough = 0.7f;  // of the limit, so that it is not reached again at once
    const Size size = field.nodes().size();
    ImageF1 excess(size), weight(size);
    int seen = 0, past = 0;
    for (int j = 1; j + 1 < size.height; ++j) {
        for (int i = 1; i + 1 < size.width; ++i) {
            if (!inside(field, visible, i, j)) continue;
            const bool over = stretch_at(field, i, j) > kLimit;
            excess.at(i, j) = over ? 1.0f : 0.0f;
            weight.at(i, j) = over ? 0.02f : 1.0f;
            ++seen;
            past += over ? 1 : 0;
        }
    }
    if (seen == 0 || static_cast<float>(past) < kMuch * static_cast<float>(seen)) return {};
    const Similarity target = fit(field, weight);
    for (int reach = 4; reach <= 64; reach *= 2) {
        const ImageF1 pull = reach < 64 ? spread(excess, reach) : ImageF1(size, 1.0f);
        LatticeField out = field;
        for (int j = 0; j < size.height; ++j) {
            for (int i = 0; i < size.width; ++i) {
                const Vec2 p = field.node_position(i, j);
                out.set_node(i, j,
                             field.node(i, j) + pull.at(i, j) * (target(p) - landing(field, i, j)));
            }
        }
        float most = 0;
        for (int j = 1; j + 1 < size.height; ++j) {
            for (int i = 1; i + 1 < size.width; ++i) {
                if (inside(out, visible, i, j)) most = std::max(most, stretch_at(out, i, j));
            }
        }
        if (most <= kEnough * kLimit || reach == 64) return out;
    }
    return {};
}

LatticeField similar_motion(const LatticeField& field, ViewU8x1 visible) {
    ImageF1 weight(field.nodes().size());
    for (int j = 0; j < weight.height(); ++j) {
        for (int i = 0; i < weight.width(); ++i)
            weight.at(i, j) = inside(field, visible, i, j) ? 1.0f : 0.0f;
    }
    const Similarity target = fit(field, weight);
    LatticeField out(field.full_size(), field.spacing());
    for (int j = 0; j < weight.height(); ++j) {
        for (int i = 0; i < weight.width(); ++i) {
            const Vec2 p = out.node_position(i, j);
            out.set_node(i, j, target(p) - p);
        }
    }
    return out;
}

bool limit_stretch(LatticeField& field, ViewU8x1 visible) {
    const Size size = field.nodes().size();
    ImageF1 excess(size), weight(size);
    bool any = false;
    for (int j = 1; j + 1 < size.height; ++j) {
        for (int i = 1; i + 1 < size.width; ++i) {
            if (!inside(field, visible, i, j)) continue;
            const float stretch = stretch_at(field, i, j);
            excess.at(i, j) = std::clamp(std::log2(stretch / kLimit), 0.0f, 1.0f);
            weight.at(i, j) = excess.at(i, j) > 0 ? 0.02f : 1.0f;
            any |= excess.at(i, j) > 0;
        }
    }
    if (!any) return false;
    const Similarity target = fit(field, weight);
    for (int j = 1; j + 1 < size.height; ++j) {
        for (int i = 1; i + 1 < size.width; ++i) {
            // The mean over the neighbours, because a pull on a single node would tear the field.
            float pull = 0;
            for (int k = 0; k < 9; ++k)
                pull += excess.at(i + k % 3 - 1, j + k / 3 - 1) / 9.0f;
            if (pull <= 0) continue;
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j,
                           field.node(i, j) + kPull * pull * (target(p) - landing(field, i, j)));
        }
    }
    return true;
}

}  // namespace weft
