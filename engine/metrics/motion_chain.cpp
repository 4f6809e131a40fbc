#include "engine/metrics/motion_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr int kFixedPointSteps = 30;
constexpr float kInverseSettledPx = 0.05f;

Vec2 centre(int x, int y) {
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

Vec2 motion_at(const FlowField& f, int x, int y) {
    return {f.d.at(x, y, 0), f.d.at(x, y, 1)};
}

// The pixel that holds p, or false when p lies outside the picture (or is NaN).
bool pixel_of(Vec2 p, Size s, int& x, int& y) {
    if (!(p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(s.width) &&
          p.y < static_cast<float>(s.height)))
        return false;
    x = static_cast<int>(p.x);
    y = static_cast<int>(p.y);
    return true;
}

bool inside_at(ViewU8x1 mask, Vec2 p) {
    int x = 0;
    int y = 0;
    return pixel_of(p, mask.size(), x, y) && mask.row(y)[x] == 255;
}

// Solves q + cur_from_next(q) = p for q.
bool invert_at(const FlowField& cur_from_next, ViewU8x1 inside, Vec2 p, Vec2 guess, Vec2& q) {
    q = guess;
    for (int i = 0; i < kFixedPointSteps; ++i) {
        Vec2 b;
        if (!lookup_motion(cur_from_next, inside, q, b)) return false;
        const Vec2 miss = q + b - p;
        if (std::hypot(miss.x, miss.y) < 1e-3f) return true;
        q -= miss;
    }
    Vec2 b;
    if (!lookup_motion(cur_from_next, inside, q, b)) return false;
    return std::hypot(q.x + b.x - p.x, q.y + b.y - p.y) < kInverseSettledPx;
}

// For each pixel of the target frame, the pixel of the source frame that lands nearest to its
// centre, as a first guess of the inverse; -1 if none lands.
Image<std::int32_t, 1> landings(const FlowField& f, ViewU8x1 inside) {
    Image<std::int32_t, 1> out(f.size(), -1);
    ImageF1 nearest(f.size(), std::numeric_limits<float>::infinity());
    for (int y = 0; y < f.d.height(); ++y) {
        for (int x = 0; x < f.d.width(); ++x) {
            if (inside.row(y)[x] != 255) continue;
            const Vec2 p = centre(x, y) + motion_at(f, x, y);
            int u = 0;
            int v = 0;
            if (!pixel_of(p, f.size(), u, v)) continue;
            const Vec2 off = p - centre(u, v);
            const float d = off.x * off.x + off.y * off.y;
            if (d >= nearest.at(u, v)) continue;
            nearest.at(u, v) = d;
            out.at(u, v) = y * f.d.width() + x;
        }
    }
    return out;
}

// A pixel that lands at p's pixel or, where the motion spreads pixels apart, right beside it.
bool first_guess(const Image<std::int32_t, 1>& lands, Vec2 p, Vec2& guess) {
    constexpr int kOrder[9][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                  {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    int x = 0;
    int y = 0;
    if (!pixel_of(p, lands.size(), x, y)) return false;
    for (const auto& o : kOrder) {
        const int u = x + o[0];
        const int v = y + o[1];
        if (u < 0 || v < 0 || u >= lands.width() || v >= lands.height()) continue;
        const std::int32_t from = lands.at(u, v);
        if (from < 0) continue;
        guess = centre(from % lands.width(), from / lands.width());
        return true;
    }
    return false;
}

struct Triangle {
    Vec2 p[3];  // Where the corners lie on the current frame.
    Vec2 ref[3];
};

// Writes ref − pixel at every pixel centre that the triangle covers, edges included.
void draw(const Triangle& t, ViewU8x1 inside, FlowField& out) {
    const auto cross = [](Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; };
    const float area = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
    if (!(std::abs(area) > 1e-6f)) return;
    const auto [x_min, x_max] = std::minmax({t.p[0].x, t.p[1].x, t.p[2].x});
    const auto [y_min, y_max] = std::minmax({t.p[0].y, t.p[1].y, t.p[2].y});
    const int x0 = std::max(0, static_cast<int>(std::ceil(x_min - 0.5f)));
    const int y0 = std::max(0, static_cast<int>(std::ceil(y_min - 0.5f)));
    const int x1 = std::min(out.d.width() - 1, static_cast<int>(std::floor(x_max - 0.5f)));
    const int y1 = std::min(out.d.height() - 1, static_cast<int>(std::floor(y_max - 0.5f)));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            if (out.valid.at(x, y) != 0 || inside.row(y)[x] != 255) continue;
            const Vec2 c = centre(x, y);
            const float b1 = cross(c - t.p[0], t.p[2] - t.p[0]) / area;
            const float b2 = cross(t.p[1] - t.p[0], c - t.p[0]) / area;
            const float b0 = 1.0f - b1 - b2;
            constexpr float kEdge = -1e-5f;
            if (b0 < kEdge || b1 < kEdge || b2 < kEdge) continue;
            const Vec2 d = b0 * t.ref[0] + b1 * t.ref[1] + b2 * t.ref[2] - c;
            out.d.at(x, y, 0) = d.x;
            out.d.at(x, y, 1) = d.y;
            out.valid.at(x, y) = 255;
        }
    }
}

// Calls `step(from, here, motion)` for every point that is still tracked: its start, its current
// position, and the motion between them, which `step` extends. False: the point is lost.
template <class Step>
void follow(FlowField& chain, const Step& step) {
    parallel_rows(chain.d.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < chain.d.width(); ++x) {
                std::uint8_t& alive = chain.valid.at(x, y);
                if (alive == 0) continue;
                const Vec2 from = centre(x, y);
                alive = step(from, from + motion_at(chain, x, y), chain.d.pixel(x, y)) ? 255 : 0;
            }
        }
    });
}

// A pixel of the surface that spreads over more than this is a tear.
constexpr float kMostSpreadPx = 8.0f;

}  // namespace

bool lookup_motion(const FlowField& field, ViewU8x1 inside, Vec2 p, Vec2& motion) {
    const float x = p.x - 0.5f;
    const float y = p.y - 0.5f;
    if (!(x > -1.0f && y > -1.0f && x < static_cast<float>(field.d.width()) &&
          y < static_cast<float>(field.d.height())))
        return false;
    const int ix = static_cast<int>(std::floor(x));
    const int iy = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    Vec2 sum{0, 0};
    float weight = 0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const int u = ix + i;
            const int v = iy + j;
            if (u < 0 || v < 0 || u >= field.d.width() || v >= field.d.height()) continue;
            if (inside.row(v)[u] != 255 || field.valid.at(u, v) == 0) continue;
            const float w = (i == 0 ? 1.0f - fx : fx) * (j == 0 ? 1.0f - fy : fy);
            sum += w * motion_at(field, u, v);
            weight += w;
        }
    }
    if (weight < 0.5f) return false;
    motion = sum / weight;
    return true;
}

Matte landing_is_single(const FlowField& f, ViewU8x1 inside) {
    // Smallest and largest motion that lands in each target pixel.
    constexpr float kNone = std::numeric_limits<float>::infinity();
    Image<float, 4> range(f.size(), kNone);  // min x, min y, −max x, −max y
    const auto considered = [&](int x, int y) {
        return inside.row(y)[x] == 255 && f.valid.at(x, y) != 0;
    };
    for (int y = 0; y < f.d.height(); ++y) {
        for (int x = 0; x < f.d.width(); ++x) {
            int u = 0;
            int v = 0;
            const Vec2 d = motion_at(f, x, y);
            if (!considered(x, y) || !pixel_of(centre(x, y) + d, f.size(), u, v)) continue;
            float* r = range.pixel(u, v);
            r[0] = std::min(r[0], d.x);
            r[1] = std::min(r[1], d.y);
            r[2] = std::min(r[2], -d.x);
            r[3] = std::min(r[3], -d.y);
        }
    }
    Matte out(f.size());
    parallel_rows(f.d.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < f.d.width(); ++x) {
                int u = 0;
                int v = 0;
                const Vec2 d = motion_at(f, x, y);
                if (!considered(x, y) || !pixel_of(centre(x, y) + d, f.size(), u, v)) continue;
                const float tolerance = 1.0f + 0.1f * std::hypot(d.x, d.y);
                bool single = true;
                for (int b = std::max(0, v - 1); b <= std::min(f.d.height() - 1, v + 1); ++b) {
                    for (int a = std::max(0, u - 1); a <= std::min(f.d.width() - 1, u + 1); ++a) {
                        const float* r = range.pixel(a, b);
                        single = single && d.x - r[0] <= tolerance && d.y - r[1] <= tolerance &&
                                 -r[2] - d.x <= tolerance && -r[3] - d.y <= tolerance;
                    }
                }
                out.at(x, y) = single ? 255 : 0;
            }
        }
    });
    return out;
}

MotionChain::MotionChain(ViewU8x1 matte, int edge_margin_px)
    : cur_from_ref_(matte.size()),
      cur_inside_(eroded_inside(matte, edge_margin_px)),
      margin_px_(edge_margin_px) {
    cur_from_ref_.valid = cur_inside_;
}

void MotionChain::advance(const FlowField& next_from_cur, ViewU8x1 next_matte) {
    const Matte single = landing_is_single(next_from_cur, cur_inside_);
    Matte next_inside = eroded_inside(next_matte, margin_px_);
    follow(cur_from_ref_, [&](Vec2, Vec2 here, float* motion) {
        Vec2 w{0, 0};
        if (!inside_at(single, here) || !lookup_motion(next_from_cur, single, here, w) ||
            !inside_at(next_inside, here + w))
            return false;
        motion[0] += w.x;
        motion[1] += w.y;
        return true;
    });
    cur_inside_ = std::move(next_inside);
}

void MotionChain::advance_inverse(const FlowField& cur_from_next, ViewU8x1 next_matte) {
    Matte next_inside = eroded_inside(next_matte, margin_px_);
    const Matte single = landing_is_single(cur_from_next, next_inside);
    const Image<std::int32_t, 1> lands = landings(cur_from_next, single);
    follow(cur_from_ref_, [&](Vec2 from, Vec2 here, float* motion) {
        Vec2 guess, there;
        if (!inside_at(cur_inside_, here) || !first_guess(lands, here, guess) ||
            !invert_at(cur_from_next, single, here, guess, there) || !inside_at(next_inside, there))
            return false;
        const Vec2 d = there - from;
        motion[0] = d.x;
        motion[1] = d.y;
        return true;
    });
    cur_inside_ = std::move(next_inside);
}

FlowField MotionChain::ref_from_cur() const {
    FlowField out(cur_from_ref_.size());
    out.valid = Matte(out.size(), 0);
    const auto alive = [&](int x, int y) { return cur_from_ref_.valid.at(x, y) != 0; };
    const auto corner = [&](Triangle& t, int i, int x, int y) {
        t.ref[i] = centre(x, y);
        t.p[i] = t.ref[i] + motion_at(cur_from_ref_, x, y);
    };
    for (int y = 0; y + 1 < out.d.height(); ++y) {
        for (int x = 0; x + 1 < out.d.width(); ++x) {
            if (!alive(x, y) || !alive(x + 1, y) || !alive(x, y + 1) || !alive(x + 1, y + 1))
                continue;
            Triangle t;
            corner(t, 0, x, y);
            corner(t, 1, x + 1, y);
            corner(t, 2, x, y + 1);
            Triangle s;
            corner(s, 0, x + 1, y + 1);
            s.p[1] = t.p[1];
            s.ref[1] = t.ref[1];
            s.p[2] = t.p[2];
            s.ref[2] = t.ref[2];
            const Vec2 a = t.p[1] - t.p[2];
            const Vec2 b = s.p[0] - t.p[0];
            if (std::max(std::hypot(a.x, a.y), std::hypot(b.x, b.y)) > kMostSpreadPx) continue;
            draw(t, cur_inside_, out);
            draw(s, cur_inside_, out);
        }
    }
    return out;
}

}  // namespace weft
