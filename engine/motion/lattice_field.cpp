#include "engine/motion/lattice_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

// Catmull–Rom weights of the nodes −1, 0, 1, 2 at the fraction f in [0, 1).
std::array<float, 4> catmull_rom(float f) {
    const float f2 = f * f, f3 = f2 * f;
    return {0.5f * (-f3 + 2 * f2 - f), 0.5f * (3 * f3 - 5 * f2 + 2), 0.5f * (-3 * f3 + 4 * f2 + f),
            0.5f * (f3 - f2)};
}

struct Tap {
    int first;  // node index of weight[0]
    std::array<float, 4> weight;
};

// The nodes around a frame coordinate among `count` nodes. The coordinate must lie inside the inner
// ones.
Tap tap_at(float coordinate, int spacing, int count) {
    const float g = coordinate / static_cast<float>(spacing) + LatticeField::kMargin;
    const int cell = std::clamp(static_cast<int>(std::floor(g)), 1, count - 3);
    return {cell - 1, catmull_rom(g - static_cast<float>(cell))};
}

Vec2 interpolate(const ImageF2& nodes, const Tap& tx, const Tap& ty) {
    Vec2 sum(0);
    for (int r = 0; r < 4; ++r) {
        const float* n = nodes.pixel(tx.first, ty.first + r);
        Vec2 line(0);
        for (int c = 0; c < 4; ++c) {
            line += tx.weight[static_cast<std::size_t>(c)] * Vec2(n[2 * c], n[2 * c + 1]);
        }
        sum += ty.weight[static_cast<std::size_t>(r)] * line;
    }
    return sum;
}

constexpr float kSettledPx = 0.01f;

// p -> linear * p + offset.
struct AffineMap {
    glm::mat2 linear{1};
    Vec2 offset{0};
};

// The affine part of the whole field, by least squares over its nodes.
AffineMap mean_affine(const LatticeField& field) {
    const ImageF2& nodes = field.nodes();
    const Vec2 middle = 0.5f * (field.node_position(0, 0) +
                                field.node_position(nodes.width() - 1, nodes.height() - 1));
    // The nodes lie symmetrically about their middle, so the sums over x, y and 1 are independent.
    Vec2 mean(0), along_x(0), along_y(0);
    float xx = 0, yy = 0;
    for (int j = 0; j < nodes.height(); ++j) {
        for (int i = 0; i < nodes.width(); ++i) {
            const Vec2 p = field.node_position(i, j) - middle, d = field.node(i, j);
            mean += d;
            along_x += p.x * d;
            along_y += p.y * d;
            xx += p.x * p.x;
            yy += p.y * p.y;
        }
    }
    mean /= static_cast<float>(nodes.width() * nodes.height());
    AffineMap out;
    out.linear = glm::mat2(1) + glm::mat2(along_x / xx, along_y / yy);
    out.offset = middle + mean - out.linear * middle;
    return out;
}

// Solves p + field(p) = `target` by Newton's method, starting from the solution for `whole`.
// Returns the nearest of all places that were tried and of `start`, because a field that folds over
// has no root everywhere. `start` is left out where it has run away, to infinity or NaN.
Vec2 newton_root(const LatticeField& field, Vec2 target, Vec2 start, const AffineMap& whole) {
    const auto residual = [&](Vec2 p) { return target - (p + field.at(p)); };
    constexpr float kFlat = 1e-3f;
    Vec2 best = target;
    float least = glm::length(residual(target));
    if (const float miss = glm::length(residual(start)); miss < least) {
        best = start;
        least = miss;
    }
    Vec2 p = std::abs(glm::determinant(whole.linear)) > kFlat
                 ? glm::inverse(whole.linear) * (target - whole.offset)
                 : best;
    const float h = 0.25f * static_cast<float>(field.spacing());
    const float longest = 8.0f * static_cast<float>(field.spacing());
    for (int k = 0; k < 16; ++k) {
        const Vec2 r = residual(p);
        const float miss = glm::length(r);
        // Also true for NaN.
        if (!(miss < 1e6f)) break;
        if (miss < least) {
            least = miss;
            best = p;
        }
        if (miss < 0.1f * kSettledPx) break;
        const glm::mat2 slope((r - residual(p + Vec2(h, 0))) / h,
                              (r - residual(p + Vec2(0, h))) / h);
        if (std::abs(glm::determinant(slope)) < kFlat) break;
        const Vec2 step = glm::inverse(slope) * r;
        p += step * std::min(1.0f, longest / std::max(glm::length(step), 1e-6f));
    }
    return best;
}

int node_count(int extent, int spacing) {
    return (extent + spacing - 1) / spacing + 1 + 2 * LatticeField::kMargin;
}

}  // namespace

LatticeField::LatticeField(Size full, int spacing)
    : full_(full),
      spacing_(spacing),
      nodes_(node_count(full.width, spacing), node_count(full.height, spacing)) {
    assert(spacing >= 1);
}

Vec2 LatticeField::at(Vec2 p) const {
    // Inside the inner nodes all four taps exist. Outside, the field continues with its gradient at
    // the nearest inner place.
    const float step = static_cast<float>(spacing_);
    const Vec2 low(-step), high = node_position(nodes_.width() - 2, nodes_.height() - 2);
    const Vec2 q(std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y));
    const Tap tx = tap_at(q.x, spacing_, nodes_.width());
    const Tap ty = tap_at(q.y, spacing_, nodes_.height());
    Vec2 d = interpolate(nodes_, tx, ty);
    if (p.x != q.x) {
        const float inward = p.x < q.x ? q.x + step : q.x - step;
        const Vec2 slope = (interpolate(nodes_, tap_at(inward, spacing_, nodes_.width()), ty) - d) /
                           (inward - q.x);
        d += slope * (p.x - q.x);
    }
    if (p.y != q.y) {
        const float inward = p.y < q.y ? q.y + step : q.y - step;
        const Vec2 slope = (interpolate(nodes_, tx, tap_at(inward, spacing_, nodes_.height())) -
                            interpolate(nodes_, tx, ty)) /
                           (inward - q.y);
        d += slope * (p.y - q.y);
    }
    return d;
}

std::vector<Vec2> LatticeField::at(const std::vector<Vec2>& positions) const {
    constexpr std::size_t kChunk = 4096;
    std::vector<Vec2> out(positions.size());
    parallel_for((positions.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t end = std::min(positions.size(), (chunk + 1) * kChunk);
        std::vector<float> line(static_cast<std::size_t>(nodes_.stride()));
        for (std::size_t k = chunk * kChunk; k < end;) {
            const float y = positions[k].y;
            std::size_t row_end = k;
            while (row_end < end && positions[row_end].y == y)
                ++row_end;
            const Tap ty = tap_at(y, spacing_, nodes_.height());
            const auto [left, right] =
                std::minmax_element(positions.begin() + static_cast<std::ptrdiff_t>(k),
                                    positions.begin() + static_cast<std::ptrdiff_t>(row_end),
                                    [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
            const int first = tap_at(left->x, spacing_, nodes_.width()).first;
            const int last = tap_at(right->x, spacing_, nodes_.width()).first + 3;
            for (int n = 2 * first; n < 2 * (last + 1); ++n) {
                float sum = 0;
                for (int r = 0; r < 4; ++r)
                    sum += ty.weight[static_cast<std::size_t>(r)] * nodes_.row(ty.first + r)[n];
                line[static_cast<std::size_t>(n)] = sum;
            }
            for (; k < row_end; ++k) {
                const Tap tx = tap_at(positions[k].x, spacing_, nodes_.width());
                const float* n = line.data() + static_cast<std::ptrdiff_t>(2) * tx.first;
                const auto& w = tx.weight;
                out[k] = {w[0] * n[0] + w[1] * n[2] + w[2] * n[4] + w[3] * n[6],
                          w[0] * n[1] + w[1] * n[3] + w[2] * n[5] + w[3] * n[7]};
            }
        }
    });
    return out;
}

ImageF2 LatticeField::dense(const Recti& area) const {
    assert(area.intersected(rect_of(full_)) == area);
    ImageF2 out(area.width(), area.height());
    std::vector<Tap> columns;
    columns.reserve(static_cast<std::size_t>(area.width()));
    for (int x = area.x0; x < area.x1; ++x) {
        columns.push_back(tap_at(static_cast<float>(x) + 0.5f, spacing_, nodes_.width()));
    }
    parallel_rows(area.height(), 32, [&](int y0, int y1) {
        std::vector<float> line(static_cast<std::size_t>(nodes_.stride()));
        for (int y = y0; y < y1; ++y) {
            const Tap ty =
                tap_at(static_cast<float>(area.y0 + y) + 0.5f, spacing_, nodes_.height());
            for (std::size_t k = 0; k < line.size(); ++k) {
                float sum = 0;
                for (int r = 0; r < 4; ++r) {
                    sum += ty.weight[static_cast<std::size_t>(r)] * nodes_.row(ty.first + r)[k];
                }
                line[k] = sum;
            }
            float* o = out.row(y);
            for (const Tap& tx : columns) {
                const float* n = line.data() + 2 * tx.first;
                const auto& w = tx.weight;
                *o++ = w[0] * n[0] + w[1] * n[2] + w[2] * n[4] + w[3] * n[6];
                *o++ = w[0] * n[1] + w[1] * n[3] + w[2] * n[5] + w[3] * n[7];
            }
        }
    });
    return out;
}

LatticeField LatticeField::resampled(int spacing) const {
    LatticeField out(full_, spacing);
    for (int j = 0; j < out.nodes_.height(); ++j) {
        for (int i = 0; i < out.nodes_.width(); ++i) {
            out.set_node(i, j, at(out.node_position(i, j)));
        }
    }
    return out;
}

LatticeField compose(const LatticeField& inner, const LatticeField& outer) {
    assert(inner.full_size() == outer.full_size());
    LatticeField out = inner;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 d = inner.node(i, j);
            out.set_node(i, j, d + outer.at(inner.node_position(i, j) + d));
        }
    }
    return out;
}

LatticeField inverse(const LatticeField& field) {
    LatticeField out(field.full_size(), field.spacing());
    std::optional<AffineMap> whole;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 target = out.node_position(i, j);
            Vec2 p = target - field.at(target);
            for (int k = 0; k < 12; ++k)
                p += 0.8f * (target - (p + field.at(p)));
            // A rotation by more than 60 degrees is not a contraction.
            if (!(glm::length(target - (p + field.at(p))) < kSettledPx)) {
                if (!whole) whole = mean_affine(field);
                p = newton_root(field, target, p, *whole);
            }
            out.set_node(i, j, p - target);
        }
    }
    return out;
}

LatticeField unsqueezed(const LatticeField& squeezed, PixelAspect aspect) {
    if (aspect.square()) return squeezed;
    LatticeField out(aspect.unsqueezed(squeezed.full_size()), squeezed.spacing());
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 from = aspect.squeezed(out.node_position(i, j));
            out.set_node(i, j, aspect.unsqueezed(squeezed.at(from)));
        }
    }
    return out;
}

LatticeField mix(const LatticeField& a, const LatticeField& b, float weight) {
    assert(a.full_size() == b.full_size() && a.spacing() == b.spacing());
    LatticeField out = a;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            out.set_node(i, j, a.node(i, j) + weight * (b.node(i, j) - a.node(i, j)));
        }
    }
    return out;
}

}  // namespace weft
