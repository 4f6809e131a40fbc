// Internal to plane_sampler.cpp, which includes this once for each set of instructions: the
// compiler splits wide vectors by the target under which a function is written, not by that of its
// caller. Sixteen texels are added as two columns of pairs; all sets add the same lanes in the same
// order.

// Sums over pairs of neighbouring texels: the even ones in the first four lanes, the odd ones in
// the others.
struct Pair {
    Lanes part[8 / kRegister];  // NOLINT(modernize-avoid-c-arrays): kept in registers
};

[[gnu::always_inline]] inline Pair load_pair(const float* from) {
    Pair v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
[[gnu::always_inline]] inline void add(float weight, const Pair& texels, Pair& sum) {
    for (std::size_t k = 0; k < 8 / kRegister; ++k)
        sum.part[k] += weight * texels.part[k];
}
[[gnu::always_inline]] inline void add(const Pair& weight, const Pair& texels, Pair& sum) {
    for (std::size_t k = 0; k < 8 / kRegister; ++k)
        sum.part[k] += weight.part[k] * texels.part[k];
}
// The weights of two neighbouring texels, of all channels.
template <int Even>
[[gnu::always_inline]] inline Pair weights_of(F4 w) {
    const F4 a = __builtin_shufflevector(w, w, Even, Even, Even, Even);
    const F4 b = __builtin_shufflevector(w, w, Even + 1, Even + 1, Even + 1, Even + 1);
    Pair v;
    join(a, b, v.part);
    return v;
}
[[gnu::always_inline]] inline F4 folded_sum(const Pair& sum) {
    return added(sum.part);
}

[[gnu::always_inline]] inline Pair load_two(const float* even, const float* odd) {
    F4 a, b;
    std::memcpy(&a, even, sizeof a);
    std::memcpy(&b, odd, sizeof b);
    Pair v;
    join(a, b, v.part);
    return v;
}

// Adds the cubic lookup at level coordinates anywhere; W is the wrap mode.
template <WrapMode W>
void add_wrapped(const PlanePyramid::Level& level, float u, float v, Pair& sum) {
    const float gx = u - 0.5f, gy = v - 0.5f;
    const float bx = std::floor(gx), by = std::floor(gy);
    const F4 wx = cubic_weights(gx - bx), wy = cubic_weights(gy - by);
    const auto column = [&](int k) {
        return 4 * wrapped_index(static_cast<int>(bx) + k - 1, level.width(), W);
    };
    const int c0 = column(0), c1 = column(1), c2 = column(2), c3 = column(3);
    Pair left{}, right{};
    for (int k = 0; k < 4; ++k) {
        const float* row =
            level.row(wrapped_index(static_cast<int>(by) + k - 1, level.height(), W));
        add(wy[k], load_two(row + c0, row + c1), left);
        add(wy[k], load_two(row + c2, row + c3), right);
    }
    add(weights_of<0>(wx), left, sum);
    add(weights_of<2>(wx), right, sum);
}

// The same if all sixteen texels lie inside: no wrapping.
[[gnu::always_inline]] inline void add_inside(const PlanePyramid::Level& level, float u, float v,
                                              Pair& sum) {
    const float gx = u - 0.5f, gy = v - 0.5f;
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    const F4 wx = cubic_weights(gx - static_cast<float>(x)),
             wy = cubic_weights(gy - static_cast<float>(y));
    const float* row = level.pixel(x - 1, y - 1);
    Pair left{}, right{};
    for (int k = 0; k < 4; ++k, row += level.stride()) {
        add(wy[k], load_pair(row), left);
        add(wy[k], load_pair(row + 8), right);
    }
    add(weights_of<0>(wx), left, sum);
    add(weights_of<2>(wx), right, sum);
}

template <WrapMode W>
class Sampler {
  public:
    Sampler(const SampleRequest& request, ImageView<float, 3> out)
        : request_(request),
          out_(out),
          density_(density(request.quality)),
          plane_level_(static_cast<std::size_t>(request.plane->plane_level())) {
        for (const auto& level : request.plane->levels()) {
            levels_.push_back({&level,
                               static_cast<float>(level.width()) /
                                   static_cast<float>(request.plane->size().width),
                               static_cast<float>(level.height()) /
                                   static_cast<float>(request.plane->size().height)});
        }
    }

    void row(int y) const {
        const ViewU8x1& matte = request_.matte;
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.at(x, y) == 0) continue;
            const F4 colour = pixel(x, y);
            float* o = out_.pixel(x, y);
            // The cubic may undershoot next to a highlight.
            for (int c = 0; c < 3; ++c)
                o[c] = std::max(0.0f, colour[c]);
        }
    }

  private:
    // Half of the difference between the neighbours, one-sided at the border.
    [[nodiscard]] Vec2 slope(int xa, int ya, int xb, int yb) const {
        const float *a = request_.coords.pixel(xa, ya), *b = request_.coords.pixel(xb, yb);
        const int steps = std::max(1, (xb - xa) + (yb - ya));
        return {(b[0] - a[0]) / static_cast<float>(steps),
                (b[1] - a[1]) / static_cast<float>(steps)};
    }

    [[nodiscard]] F4 pixel(int x, int y) const {
        const ViewF2& uv = request_.coords;
        const Vec2 jx = slope(std::max(0, x - 1), y, std::min(uv.width() - 1, x + 1), y);
        const Vec2 jy = slope(x, std::max(0, y - 1), x, std::min(uv.height() - 1, y + 1));
        const float lx = std::sqrt(jx.x * jx.x + jx.y * jx.y);
        const float ly = std::sqrt(jy.x * jy.x + jy.y * jy.y);
        const float* centre = uv.pixel(x, y);
        // False where the coordinates are unknown or too large to be meaningful.
        const bool known = std::abs(centre[0]) < 1e9f && std::abs(centre[1]) < 1e9f;
        if (!(known && lx < 1e6f && ly < 1e6f)) return F4{};
        const int nx = density_.cells(lx), ny = density_.cells(ly);
        // A level's texel spans 2^k texels of the plane; a cell should not span more than about
        // one.
        const float cell = std::max(lx / static_cast<float>(nx), ly / static_cast<float>(ny));
        std::size_t level = plane_level_;
        for (float span = 1.0f; cell > span && level + 1 < levels_.size(); span *= 2)
            ++level;
        const float finer = finer_levels(std::min(lx, ly), cell);
        level -= static_cast<std::size_t>(finer);
        const F4 here = at_level(levels_[level], centre, jx, jy, nx, ny);
        const float share = finer - std::floor(finer);
        if (!(share > 0)) return here;
        const F4 next = at_level(levels_[level - 1], centre, jx, jy, nx, ny);
        return here + share * (next - here);
    }

    // How many levels above the plane show a magnified pixel: each comes in while the texels of the
    // one below grow from one pixel to two, along the axis along which they are the largest, and
    // only if the cells along the other one are fine enough for it.
    [[nodiscard]] float finer_levels(float shortest, float cell) const {
        float out = 0, span = 1;
        for (std::size_t k = 0; k < plane_level_; ++k, span *= 0.5f) {
            const float share =
                std::clamp(std::min(2 - 2 * shortest / span, 2 - 2 * cell / span), 0.0f, 1.0f);
            out += share;
            if (share < 1) break;
        }
        return out;
    }

    [[nodiscard]] F4 at_level(const LevelView& view, const float* centre, Vec2 jx, Vec2 jy, int nx,
                              int ny) const {
        const Vec2 scale(view.scale_x, view.scale_y);
        const Size size = request_.plane->size();
        const Vec2 at =
            Vec2(folded(centre[0], size.width, W), folded(centre[1], size.height, W)) * scale;
        const Vec2 step_x = jx * scale / static_cast<float>(nx);
        const Vec2 step_y = jy * scale / static_cast<float>(ny);
        const Vec2 first = at - step_x * (0.5f * static_cast<float>(nx - 1)) -
                           step_y * (0.5f * static_cast<float>(ny - 1));
        return sum(*view.texels, at, first, step_x, step_y, nx, ny) *
               spread(1.0f / static_cast<float>(nx * ny));
    }

    [[nodiscard]] static F4 sum(const PlanePyramid::Level& level, Vec2 at, Vec2 first, Vec2 step_x,
                                Vec2 step_y, int nx, int ny) {
        const float reach_x = std::abs(at.x - first.x) +
                              std::abs(step_x.x) * static_cast<float>(nx) +
                              std::abs(step_y.x) * static_cast<float>(ny) + 2;
        const float reach_y = std::abs(at.y - first.y) +
                              std::abs(step_x.y) * static_cast<float>(nx) +
                              std::abs(step_y.y) * static_cast<float>(ny) + 2;
        const bool inside = at.x - reach_x >= 0 && at.y - reach_y >= 0 &&
                            at.x + reach_x < static_cast<float>(level.width()) &&
                            at.y + reach_y < static_cast<float>(level.height());
        Pair total{};
        for (int j = 0; j < ny; ++j) {
            Vec2 p = first + step_y * static_cast<float>(j);
            for (int i = 0; i < nx; ++i, p += step_x) {
                if (inside)
                    add_inside(level, p.x, p.y, total);
                else
                    add_wrapped<W>(level, p.x, p.y, total);
            }
        }
        return folded_sum(total);
    }

    SampleRequest request_;
    ImageView<float, 3> out_;
    Density density_;
    std::size_t plane_level_;
    std::vector<LevelView> levels_;
};

template <WrapMode W>
void sample_rows(const SampleRequest& request, ImageView<float, 3> out, int y0, int y1) {
    const Sampler<W> sampler(request, out);
    for (int y = y0; y < y1; ++y)
        sampler.row(y);
}
