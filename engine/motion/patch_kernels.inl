// Internal to patch_search.cpp, which includes this once for each set of instructions: the compiler
// splits wide vectors by the target under which a function is written, not by that of its caller,
// and inlines nothing that is written for another one.
// A row of a patch is eight lanes, as many registers as `kRegister` floats give; all sets add the
// same lanes in the same order.

#define WEFT_INLINE [[gnu::always_inline]] inline

// NOLINTNEXTLINE(modernize-use-using): only a typedef takes the attribute.
typedef float Floats __attribute__((vector_size(kRegister * sizeof(float))));

struct Row {
    static constexpr std::size_t kParts = kPatch / kRegister;
    Floats part[kParts];  // NOLINT(modernize-avoid-c-arrays): kept in registers
};

WEFT_INLINE void load(const float* from, Row& row) {
    std::memcpy(&row, from, sizeof row);
}
WEFT_INLINE void store(const Row& row, float* to) {
    std::memcpy(to, &row, sizeof row);
}
WEFT_INLINE float sum(const Row& row) {
    alignas(32) float v[kPatch];  // NOLINT(modernize-avoid-c-arrays)
    store(row, v);
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

// `sum_gg`: of gx², gx·gy and gy².
WEFT_INLINE void invert(Patch& patch, Vec2 sum_g, glm::vec3 sum_gg) {
    patch.sum_g = sum_g;
    // The slopes of grain alone: a blank patch stays where it starts.
    constexpr float kNoise = 0.04f * kPixels;
    const float xx = sum_gg.x - sum_g.x * sum_g.x * kShare + kNoise;
    const float xy = sum_gg.y - sum_g.x * sum_g.y * kShare;
    const float yy = sum_gg.z - sum_g.y * sum_g.y * kShare + kNoise;
    const float one_over = 1.0f / (xx * yy - xy * xy);
    patch.inverse = {yy * one_over, -xy * one_over, xx * one_over};
}

WEFT_INLINE void take_patch(const SearchPicture& picture, int x, int y, Patch& patch) {
    Row sx{}, sy{}, sxx{}, sxy{}, syy{};
    for (int r = 0; r < kPatch; ++r) {
        const float* row = picture.at(x, y + r);
        Row value, left, right, above, below;
        load(row, value);
        load(row - 1, left);
        load(row + 1, right);
        load(row - picture.stride(), above);
        load(row + picture.stride(), below);
        for (std::size_t p = 0; p < Row::kParts; ++p) {
            left.part[p] = (right.part[p] - left.part[p]) * 0.5f;
            above.part[p] = (below.part[p] - above.part[p]) * 0.5f;
            sx.part[p] += left.part[p];
            sy.part[p] += above.part[p];
            sxx.part[p] += left.part[p] * left.part[p];
            sxy.part[p] += left.part[p] * above.part[p];
            syy.part[p] += above.part[p] * above.part[p];
        }
        const auto at = static_cast<std::size_t>(r * kPatch);
        store(value, &patch.value[at]);
        store(left, &patch.gx[at]);
        store(above, &patch.gy[at]);
    }
    invert(patch, {sum(sx), sum(sy)}, {sum(sxx), sum(sxy), sum(syy)});
}

// One row of the target between its pixels, across.
WEFT_INLINE void across(const float* from, float fx, Row& row) {
    Row right;
    load(from, row);
    load(from + 1, right);
    for (std::size_t p = 0; p < Row::kParts; ++p)
        row.part[p] += fx * (right.part[p] - row.part[p]);
}

// The target's row below `above`, whose next row is `below`, less the patch's.
WEFT_INLINE void miss_of(const Row& above, const Row& below, float fy, const float* patch,
                         Row& miss) {
    Row value;
    load(patch, value);
    for (std::size_t p = 0; p < Row::kParts; ++p)
        miss.part[p] = above.part[p] + fy * (below.part[p] - above.part[p]) - value.part[p];
}

WEFT_INLINE Fit fit_of(const Patch& patch, float sum_d, float sum_dd, Vec2 sum_dg) {
    const float mean = sum_d * kShare;
    const Vec2 b = sum_dg - patch.sum_g * mean;
    return {sum_dd - mean * mean * kPixels,
            {-(patch.inverse.x * b.x + patch.inverse.y * b.y),
             -(patch.inverse.y * b.x + patch.inverse.z * b.y)}};
}

WEFT_INLINE Place place_at(const SearchPicture& target, Vec2 p) {
    constexpr float kLeast = 1.0f - SearchPicture::kBorder;
    constexpr float kBeyond = SearchPicture::kBorder - kPatch - 2;
    const float x =
        std::min(std::max(p.x, kLeast), static_cast<float>(target.size().width) + kBeyond);
    const float y =
        std::min(std::max(p.y, kLeast), static_cast<float>(target.size().height) + kBeyond);
    constexpr int kBias = SearchPicture::kBorder;  // truncation of positive numbers rounds down
    const int ix = static_cast<int>(x + kBias) - kBias, iy = static_cast<int>(y + kBias) - kBias;
    return {target.at(ix, iy), x - static_cast<float>(ix), y - static_cast<float>(iy)};
}

WEFT_INLINE Fit fit_at(const Patch& patch, const SearchPicture& target, Vec2 p) {
    const Place at = place_at(target, p);
    Row d{}, dd{}, dx{}, dy{}, above, below;
    across(at.pixel, at.fx, above);
    for (int r = 0; r < kPatch; ++r) {
        const auto k = static_cast<std::size_t>(r * kPatch);
        across(at.pixel + (r + 1) * target.stride(), at.fx, below);
        Row miss, gx, gy;
        miss_of(above, below, at.fy, &patch.value[k], miss);
        load(&patch.gx[k], gx);
        load(&patch.gy[k], gy);
        for (std::size_t i = 0; i < Row::kParts; ++i) {
            d.part[i] += miss.part[i];
            dd.part[i] += miss.part[i] * miss.part[i];
            dx.part[i] += miss.part[i] * gx.part[i];
            dy.part[i] += miss.part[i] * gy.part[i];
        }
        above = below;
    }
    return fit_of(patch, sum(d), sum(dd), {sum(dx), sum(dy)});
}

// From the best of some displacements downhill.
inline Found descend(const Patch& patch, const SearchPicture& target, Vec2 origin,
                     const Vec2* starts, int count, int iterations) {
    Vec2 d = starts[0];
    Fit fit = fit_at(patch, target, origin + d);
    for (int k = 1; k < count; ++k) {
        if (!apart(starts[k], d)) continue;
        const Fit other = fit_at(patch, target, origin + starts[k]);
        if (other.cost < fit.cost) d = starts[k], fit = other;
    }
    const Found start{d, fit.cost};
    for (int k = 0; k < iterations; ++k) {
        if (glm::dot(fit.step, fit.step) < kSettled_px * kSettled_px) break;
        const Vec2 next = d + fit.step;
        const Fit there = fit_at(patch, target, origin + next);
        if (!(there.cost < fit.cost)) break;
        d = next, fit = there;
    }
    const Vec2 gone = d - start.d;
    if (glm::dot(gone, gone) > kFurthest_px * kFurthest_px) return start;
    return {d, fit.cost};
}

inline void search_band(PatchGrid& grid, int r0, int r1) {
    Patch patch;
    for (int row = r0; row < r1; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            take_patch(grid.source, column * kStride, row * kStride, patch);
            std::array<Vec2, 3> starts{grid.expected(column, row)};
            int count = 1;
            if (column > 0) starts[static_cast<std::size_t>(count++)] = grid.at(column - 1, row).d;
            if (row > r0) starts[static_cast<std::size_t>(count++)] = grid.at(column, row - 1).d;
            grid.at(column, row) = descend(patch, grid.target, grid.origin(column, row),
                                           starts.data(), count, grid.iterations);
        }
    }
    // Back, from the neighbours that the first pass had not seen; only where they moved otherwise.
    for (int row = r1; row-- > r0;) {
        for (int column = grid.columns; column-- > 0;) {
            Found& here = grid.at(column, row);
            std::array<Vec2, 2> starts{};
            int count = 0;
            const auto consider = [&](const Found& other) {
                if (apart(other.d, here.d)) starts[static_cast<std::size_t>(count++)] = other.d;
            };
            if (column + 1 < grid.columns) consider(grid.at(column + 1, row));
            if (row + 1 < r1) consider(grid.at(column, row + 1));
            if (count == 0) continue;
            take_patch(grid.source, column * kStride, row * kStride, patch);
            const Found other = descend(patch, grid.target, grid.origin(column, row), starts.data(),
                                        count, grid.iterations / 2);
            if (other.cost < here.cost) here = other;
        }
    }
}

// Adds a patch's motion to the sums of a band, in which `at` is the patch's first pixel.
WEFT_INLINE void vote(const float* patch, std::ptrdiff_t stride, const Place& place,
                      std::ptrdiff_t target_stride, Vec2i at, Vec2 d, VoteSums& sums) {
    alignas(32) std::array<float, kPixels> misses;
    Row total{}, above, below;
    across(place.pixel, place.fx, above);
    for (int r = 0; r < kPatch; ++r) {
        across(place.pixel + (r + 1) * target_stride, place.fx, below);
        Row miss;
        miss_of(above, below, place.fy, patch + r * stride, miss);
        for (std::size_t k = 0; k < Row::kParts; ++k)
            total.part[k] += miss.part[k];
        store(miss, &misses[static_cast<std::size_t>(r * kPatch)]);
        above = below;
    }
    const float mean = sum(total) * kShare;
    for (int r = std::max(0, -at.y); r < std::min(kPatch, sums.weight.height() - at.y); ++r) {
        Row miss, w, u, v;
        load(&misses[static_cast<std::size_t>(r * kPatch)], miss);
        float* const pw = sums.weight.pixel(at.x, at.y + r);
        float* const pu = sums.x.pixel(at.x, at.y + r);
        float* const pv = sums.y.pixel(at.x, at.y + r);
        load(pw, w);
        load(pu, u);
        load(pv, v);
        for (std::size_t k = 0; k < Row::kParts; ++k) {
            const Floats off = miss.part[k] - mean;
            const Floats own = 1.0f / (kGrain + off * off);
            w.part[k] += own;
            u.part[k] += own * d.x;
            v.part[k] += own * d.y;
        }
        store(w, pw);
        store(u, pu);
        store(v, pv);
    }
}

inline void vote_band(PatchGrid& grid, int y0, int y1, VoteSums& sums) {
    const int first = std::max(0, (y0 - kPatch) / kStride);
    const int last = std::min(grid.rows - 1, (y1 - 1) / kStride);
    for (int row = first; row <= last; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const Vec2 d = grid.at(column, row).d;
            vote(grid.source.at(column * kStride, row * kStride), grid.source.stride(),
                 place_at(grid.target, grid.origin(column, row) + d), grid.target.stride(),
                 {column * kStride, row * kStride - y0}, d, sums);
        }
    }
}

#undef WEFT_INLINE
