#include "engine/motion/patch_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "engine/core/isa.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

#define WEFT_INLINE [[gnu::always_inline]] inline

constexpr int kPatch = 8, kStride = 4;
constexpr int kPixels = kPatch * kPatch;
constexpr float kShare = 1.0f / kPixels;
// A patch that has moved further than its size from where it started is lost.
constexpr float kFurthest_px = kPatch;

// NOLINTBEGIN(modernize-use-using): only a typedef takes the attributes.
struct FourFloats {
    typedef float V __attribute__((vector_size(16)));
};
struct EightFloats {
    typedef float V __attribute__((vector_size(32)));
};
// NOLINTEND(modernize-use-using)

// A row of a patch. All sets of instructions add the same lanes in the same order.
template <class T>
struct Row {
    static constexpr std::size_t kParts = kPatch * sizeof(float) / sizeof(typename T::V);
    std::array<typename T::V, kParts> part;
};

template <class T>
WEFT_INLINE void load(const float* from, Row<T>& row) {
    std::memcpy(row.part.data(), from, sizeof row);
}
template <class T>
WEFT_INLINE void store(const Row<T>& row, float* to) {
    std::memcpy(to, row.part.data(), sizeof row);
}
template <class T>
WEFT_INLINE float sum(const Row<T>& row) {
    alignas(32) std::array<float, kPatch> v;
    store(row, v.data());
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

// The source's patch: values, slopes, and the inverse of their normal equations.
struct Patch {
    alignas(32) std::array<float, kPixels> value, gx, gy;
    float sum_gx = 0, sum_gy = 0;
    float xx = 0, xy = 0, yy = 0;  // the inverse
};

template <class T>
WEFT_INLINE void take_patch(const SearchPicture& picture, int x, int y, Patch& patch) {
    Row<T> sx{}, sy{}, sxx{}, sxy{}, syy{};
    for (int r = 0; r < kPatch; ++r) {
        const float* row = picture.at(x, y + r);
        Row<T> value, left, right, above, below;
        load(row, value);
        load(row - 1, left);
        load(row + 1, right);
        load(row - picture.stride(), above);
        load(row + picture.stride(), below);
        for (std::size_t p = 0; p < Row<T>::kParts; ++p) {
            const typename T::V gx = (right.part[p] - left.part[p]) * 0.5f;
            const typename T::V gy = (below.part[p] - above.part[p]) * 0.5f;
            sx.part[p] += gx;
            sy.part[p] += gy;
            sxx.part[p] += gx * gx;
            sxy.part[p] += gx * gy;
            syy.part[p] += gy * gy;
            left.part[p] = gx;
            above.part[p] = gy;
        }
        const auto at = static_cast<std::size_t>(r * kPatch);
        store(value, &patch.value[at]);
        store(left, &patch.gx[at]);
        store(above, &patch.gy[at]);
    }
    patch.sum_gx = sum(sx);
    patch.sum_gy = sum(sy);
    // The slopes of grain alone: a blank patch stays where it starts.
    constexpr float kNoise = 0.25f * kPixels;
    const float xx = sum(sxx) - patch.sum_gx * patch.sum_gx * kShare + kNoise;
    const float xy = sum(sxy) - patch.sum_gx * patch.sum_gy * kShare;
    const float yy = sum(syy) - patch.sum_gy * patch.sum_gy * kShare + kNoise;
    const float one_over = 1.0f / (xx * yy - xy * xy);
    patch.xx = yy * one_over;
    patch.xy = -xy * one_over;
    patch.yy = xx * one_over;
}

// Where a patch lies in the target: its top left pixel, and the fractions beyond it.
struct Place {
    const float* pixel;
    float fx, fy;
};

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

// Calls visit(row, values of the target less the patch's).
template <class T, class Visit>
WEFT_INLINE void compare(const Patch& patch, const Place& at, std::ptrdiff_t stride,
                         const Visit& visit) {
    const auto across = [&](const float* from, Row<T>& row) __attribute__((always_inline)) {
        Row<T> left, right;
        load(from, left);
        load(from + 1, right);
        for (std::size_t p = 0; p < Row<T>::kParts; ++p)
            row.part[p] = left.part[p] + at.fx * (right.part[p] - left.part[p]);
    };
    Row<T> above, below, value;
    across(at.pixel, above);
    for (int r = 0; r < kPatch; ++r) {
        across(at.pixel + (r + 1) * stride, below);
        load(&patch.value[static_cast<std::size_t>(r * kPatch)], value);
        for (std::size_t p = 0; p < Row<T>::kParts; ++p) {
            value.part[p] = above.part[p] + at.fy * (below.part[p] - above.part[p]) - value.part[p];
        }
        visit(r, value);
        above = below;
    }
}

// How well a displacement fits: the squared difference less that of the means, which a change of
// light explains; and the step that Gauss–Newton takes from there.
struct Fit {
    float cost;
    Vec2 step;
};

template <class T>
WEFT_INLINE Fit fit_at(const Patch& patch, const SearchPicture& target, Vec2 p) {
    Row<T> d{}, dd{}, dx{}, dy{};
    compare<T>(patch, place_at(target, p), target.stride(),
               [&](int r, const Row<T>& miss) __attribute__((always_inline)) {
                   Row<T> gx, gy;
                   load(&patch.gx[static_cast<std::size_t>(r * kPatch)], gx);
                   load(&patch.gy[static_cast<std::size_t>(r * kPatch)], gy);
                   for (std::size_t k = 0; k < Row<T>::kParts; ++k) {
                       d.part[k] += miss.part[k];
                       dd.part[k] += miss.part[k] * miss.part[k];
                       dx.part[k] += miss.part[k] * gx.part[k];
                       dy.part[k] += miss.part[k] * gy.part[k];
                   }
               });
    const float mean = sum(d) * kShare;
    const float bx = sum(dx) - patch.sum_gx * mean, by = sum(dy) - patch.sum_gy * mean;
    return {sum(dd) - mean * mean * kPixels,
            {-(patch.xx * bx + patch.xy * by), -(patch.xy * bx + patch.yy * by)}};
}

struct Found {
    Vec2 d;
    float cost;
};

// From the best of some displacements downhill.
template <class T>
WEFT_INLINE Found descend(const Patch& patch, const SearchPicture& target, Vec2 origin,
                          const Vec2* starts, int count, int iterations) {
    Vec2 d = starts[0];
    Fit fit = fit_at<T>(patch, target, origin + d);
    for (int k = 1; k < count; ++k) {
        if (starts[k] == d) continue;
        const Fit other = fit_at<T>(patch, target, origin + starts[k]);
        if (other.cost < fit.cost) d = starts[k], fit = other;
    }
    const Found start{d, fit.cost};
    constexpr float kSettled_px = 0.01f;
    for (int k = 0; k < iterations; ++k) {
        if (glm::dot(fit.step, fit.step) < kSettled_px * kSettled_px) break;
        const Vec2 next = d + fit.step;
        const Fit there = fit_at<T>(patch, target, origin + next);
        if (!(there.cost < fit.cost)) break;
        d = next, fit = there;
    }
    const Vec2 gone = d - start.d;
    if (glm::dot(gone, gone) > kFurthest_px * kFurthest_px) return start;
    return {d, fit.cost};
}

// All patches of a level.
class PatchGrid {
  public:
    PatchGrid(const SearchPicture& source, const SearchPicture& target, const ImageF2& coarser,
              int iterations)
        : source_(source),
          target_(target),
          coarser_(coarser),
          iterations_(iterations),
          columns_(count(source.size().width)),
          rows_(count(source.size().height)),
          found_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

    void search() {
        parallel_rows(rows_, kBand, [&](int r0, int r1) { dispatch(Job::kSearch, r0, r1); });
    }
    // Each pixel's motion: the mean of what the patches over it found, weighted by how well they
    // fit there.
    ImageF2 dense() {
        out_ = ImageF2(source_.size());
        parallel_rows(source_.size().height, 32,
                      [&](int y0, int y1) { dispatch(Job::kDense, y0, y1); });
        return std::move(out_);
    }

  private:
    // Propagation between neighbours ends at the bands, which do not depend on the threads.
    static constexpr int kBand = 16;
    enum class Job { kSearch, kDense };

    static int count(int extent) {
        return std::max(0, (extent - kPatch + kStride - 1) / kStride) + 1;
    }
    [[nodiscard]] Found& at(int column, int row) {
        return found_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
    }
    [[nodiscard]] Vec2 expected(int column, int row) const {
        if (coarser_.empty()) return Vec2(0);
        const int x = std::min((column * kStride + kPatch / 2) / 2, coarser_.width() - 1);
        const int y = std::min((row * kStride + kPatch / 2) / 2, coarser_.height() - 1);
        const float* d = coarser_.pixel(x, y);
        return {2 * d[0], 2 * d[1]};
    }

    template <class T>
    WEFT_INLINE void search_band(int r0, int r1) {
        Patch patch;
        for (int row = r0; row < r1; ++row) {
            for (int column = 0; column < columns_; ++column) {
                take_patch<T>(source_, column * kStride, row * kStride, patch);
                std::array<Vec2, 3> starts{expected(column, row)};
                int count = 1;
                if (column > 0) starts[static_cast<std::size_t>(count++)] = at(column - 1, row).d;
                if (row > r0) starts[static_cast<std::size_t>(count++)] = at(column, row - 1).d;
                const Vec2 origin(static_cast<float>(column * kStride),
                                  static_cast<float>(row * kStride));
                at(column, row) =
                    descend<T>(patch, target_, origin, starts.data(), count, iterations_);
            }
        }
        // Back, from the neighbours that the first pass had not seen; only where one fits better.
        for (int row = r1; row-- > r0;) {
            for (int column = columns_; column-- > 0;) {
                Found& here = at(column, row);
                std::array<Vec2, 2> starts{};
                int count = 0;
                const auto consider = [&](const Found& other) {
                    const Vec2 apart = other.d - here.d;
                    constexpr float kApart_px = 0.25f;
                    if (glm::dot(apart, apart) > kApart_px * kApart_px)
                        starts[static_cast<std::size_t>(count++)] = other.d;
                };
                if (column + 1 < columns_) consider(at(column + 1, row));
                if (row + 1 < r1) consider(at(column, row + 1));
                if (count == 0) continue;
                take_patch<T>(source_, column * kStride, row * kStride, patch);
                const Vec2 origin(static_cast<float>(column * kStride),
                                  static_cast<float>(row * kStride));
                const Found other =
                    descend<T>(patch, target_, origin, starts.data(), count, iterations_ / 2);
                if (other.cost < here.cost) here = other;
            }
        }
    }

    template <class T>
    WEFT_INLINE void dense_band(int y0, int y1) {
        const int width = (columns_ - 1) * kStride + kPatch;
        ImageF1 weight(width, y1 - y0), dx(width, y1 - y0), dy(width, y1 - y0);
        const int first = std::max(0, (y0 - kPatch) / kStride);
        const int last = std::min(rows_ - 1, (y1 - 1) / kStride);
        Patch patch;
        for (int row = first; row <= last; ++row) {
            for (int column = 0; column < columns_; ++column) {
                const int x = column * kStride, y = row * kStride;
                for (int r = 0; r < kPatch; ++r)
                    std::memcpy(&patch.value[static_cast<std::size_t>(r * kPatch)],
                                source_.at(x, y + r), kPatch * sizeof(float));
                vote<T>(patch, {x, y - y0}, Vec2(static_cast<float>(x), static_cast<float>(y)),
                        at(column, row).d, weight, dx, dy);
            }
        }
        for (int y = y0; y < y1; ++y) {
            float* out = out_.row(y);
            const float *w = weight.row(y - y0), *u = dx.row(y - y0), *v = dy.row(y - y0);
            for (int x = 0; x < out_.width(); ++x) {
                out[2 * x] = u[x] / w[x];
                out[2 * x + 1] = v[x] / w[x];
            }
        }
    }

    // Adds a patch's motion to the sums of a band, whose first row is row 0. `at`: the patch's
    // first pixel there.
    template <class T>
    WEFT_INLINE void vote(const Patch& patch, Vec2i at, Vec2 origin, Vec2 d, ImageF1& weight,
                          ImageF1& dx, ImageF1& dy) const {
        alignas(32) std::array<float, kPixels> misses;
        Row<T> total{};
        compare<T>(patch, place_at(target_, origin + d), target_.stride(),
                   [&](int r, const Row<T>& miss) __attribute__((always_inline)) {
                       for (std::size_t k = 0; k < Row<T>::kParts; ++k)
                           total.part[k] += miss.part[k];
                       store(miss, &misses[static_cast<std::size_t>(r * kPatch)]);
                   });
        const float mean = sum(total) * kShare;
        for (int r = std::max(0, -at.y); r < std::min(kPatch, weight.height() - at.y); ++r) {
            Row<T> miss, w, u, v;
            load(&misses[static_cast<std::size_t>(r * kPatch)], miss);
            float* const pw = weight.pixel(at.x, at.y + r);
            float* const pu = dx.pixel(at.x, at.y + r);
            float* const pv = dy.pixel(at.x, at.y + r);
            load(pw, w);
            load(pu, u);
            load(pv, v);
            for (std::size_t k = 0; k < Row<T>::kParts; ++k) {
                const typename T::V off = miss.part[k] - mean;
                const typename T::V own = 1.0f / (1.0f + off * off);
                w.part[k] += own;
                u.part[k] += own * d.x;
                v.part[k] += own * d.y;
            }
            store(w, pw);
            store(u, pu);
            store(v, pv);
        }
    }

    template <class T>
    WEFT_INLINE void run(Job job, int from, int to) {
        if (job == Job::kSearch)
            search_band<T>(from, to);
        else
            dense_band<T>(from, to);
    }
#if defined(__x86_64__)
    [[gnu::target("avx2")]] void run_avx2(Job job, int from, int to) {
        run<EightFloats>(job, from, to);
    }
#endif
    void dispatch(Job job, int from, int to) {
#if defined(__x86_64__)
        if (current_isa() != Isa::kScalar) return run_avx2(job, from, to);
#endif
        run<FourFloats>(job, from, to);
    }

    const SearchPicture& source_;
    const SearchPicture& target_;
    const ImageF2& coarser_;
    int iterations_;
    int columns_, rows_;
    std::vector<Found> found_;
    ImageF2 out_;
};

}  // namespace

SearchPicture::SearchPicture(Size size)
    : size_(size), pixels_(size.width + 2 * kBorder, size.height + 2 * kBorder) {}

SearchPicture::SearchPicture(ViewU8x1 luma) : SearchPicture(luma.size()) {
    for (int y = 0; y < size_.height; ++y) {
        const std::uint8_t* in = luma.row(y);
        std::copy(in, in + size_.width, pixels_.pixel(kBorder, y + kBorder));
    }
    repeat_border();
}

void SearchPicture::repeat_border() {
    for (int y = kBorder; y < kBorder + size_.height; ++y) {
        float* row = pixels_.row(y);
        std::fill(row, row + kBorder, row[kBorder]);
        float* end = row + kBorder + size_.width;
        std::fill(end, end + kBorder, end[-1]);
    }
    const auto repeat = [&](int from, int to) {
        std::copy(pixels_.row(from), pixels_.row(from) + pixels_.stride(), pixels_.row(to));
    };
    for (int y = 0; y < kBorder; ++y) {
        repeat(kBorder, y);
        repeat(kBorder + size_.height - 1, kBorder + size_.height + y);
    }
}

SearchPicture SearchPicture::halved() const {
    SearchPicture out(Size{(size_.width + 1) / 2, (size_.height + 1) / 2});
    for (int y = 0; y < out.size_.height; ++y) {
        const float *a = at(0, 2 * y), *b = at(0, 2 * y + 1);
        float* row = out.pixels_.pixel(kBorder, y + kBorder);
        for (int x = 0; x < out.size_.width; ++x)
            row[x] = 0.25f * ((a[2 * x] + a[2 * x + 1]) + (b[2 * x] + b[2 * x + 1]));
    }
    out.repeat_border();
    return out;
}

std::vector<SearchPicture> search_pyramid(ViewU8x1 luma) {
    std::vector<SearchPicture> levels{SearchPicture(luma)};
    constexpr int kLeast = 3 * kPatch;
    while (std::min(levels.back().size().width, levels.back().size().height) >= kLeast)
        levels.push_back(levels.back().halved());
    return levels;
}

ImageF2 search_level(const SearchPicture& source, const SearchPicture& target,
                     const ImageF2& coarser, int iterations) {
    PatchGrid grid(source, target, coarser, iterations);
    grid.search();
    return grid.dense();
}

}  // namespace weft
