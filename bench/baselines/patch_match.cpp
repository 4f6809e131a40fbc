#include "bench/baselines/patch_match.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr int kPatch = 7;
constexpr int kMostLevels = 4;
constexpr int kSmallestSample = 24;  // of the coarsest level, a side
constexpr int kCoarseVotes = 6, kFineVotes = 2;

using Cost = std::int32_t;  // 7·7·3·255² fits

ImageU8x3 halved(const ImageU8x3& image) {
    ImageU8x3 out(image.width() / 2, image.height() / 2);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                const int sum = image.at(2 * x, 2 * y, c) + image.at(2 * x + 1, 2 * y, c) +
                                image.at(2 * x, 2 * y + 1, c) + image.at(2 * x + 1, 2 * y + 1, c);
                out.at(x, y, c) = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return out;
}

// One level: the picture, and for the patch that begins at each of its pixels (except the last ones
// of a row or column) the start of its nearest neighbour in the sample.
class Level {
  public:
    Level(const ImageU8x3& sample, Size size, const PatchMatchOptions& options, int level)
        : sample_(sample),
          picture_(size),
          patches_{size.width - kPatch + 1, size.height - kPatch + 1},
          places_{sample.width() - kPatch + 1, sample.height() - kPatch + 1},
          field_(patches_),
          cost_(patches_),
          rng_(options.seed, options.region, options.frame,
               0x50617463'00000000ull + static_cast<std::uint64_t>(level)) {}

    void start_at_random() {
        for (int y = 0; y < patches_.height; ++y)
            for (int x = 0; x < patches_.width; ++x)
                field_.at(x, y) = anywhere();
        for (int y = 0; y < picture_.height(); ++y) {
            for (int x = 0; x < picture_.width(); ++x) {
                const Vec2i at = anywhere();
                std::copy_n(sample_.pixel(at.x, at.y), 3, picture_.pixel(x, y));
            }
        }
        score_all();
    }

    // Starts from the coarser level's places, at twice the resolution, and the picture that they
    // make.
    void start_from(const Level& coarse) {
        for (int y = 0; y < patches_.height; ++y) {
            for (int x = 0; x < patches_.width; ++x) {
                const int u = std::min(x / 2, coarse.patches_.width - 1);
                const int v = std::min(y / 2, coarse.patches_.height - 1);
                const Vec2i from = coarse.field_.at(u, v);
                field_.at(x, y) = {std::clamp(2 * from.x + (x - 2 * u), 0, places_.width - 1),
                                   std::clamp(2 * from.y + (y - 2 * v), 0, places_.height - 1)};
                cost_.at(x, y) = 0;
            }
        }
        vote();
        score_all();
    }

    void improve(int votes, int rounds) {
        for (int k = 0; k < votes; ++k) {
            for (int round = 0; round < rounds; ++round)
                search(round % 2 == 1);
            if (k + 1 == votes) return;
            vote();
            score_all();
        }
    }

    // Each pixel as the mean of the patches that cover it, weighted exp(−d / 2σ²); σ² is the three
    // quarter quantile of d (Wexler et al. 2007).
    void vote() {
        const float scale = vote_scale();
        Image<float, 4> sum(picture_.size());
        for (int y = 0; y < patches_.height; ++y) {
            for (int x = 0; x < patches_.width; ++x) {
                const float w = std::exp(-static_cast<float>(cost_.at(x, y)) * scale) + 1e-6f;
                const Vec2i from = field_.at(x, y);
                for (int j = 0; j < kPatch; ++j) {
                    const std::uint8_t* s = sample_.pixel(from.x, from.y + j);
                    float* t = sum.pixel(x, y + j);
                    for (int i = 0; i < kPatch; ++i, s += 3, t += 4) {
                        for (int c = 0; c < 3; ++c)
                            t[c] += w * static_cast<float>(s[c]);
                        t[3] += w;
                    }
                }
            }
        }
        for (int y = 0; y < picture_.height(); ++y) {
            for (int x = 0; x < picture_.width(); ++x) {
                const float* s = sum.pixel(x, y);
                for (int c = 0; c < 3; ++c)
                    picture_.at(x, y, c) = static_cast<std::uint8_t>(s[c] / s[3] + 0.5f);
            }
        }
    }

    // Each pixel from the best patch that covers it.
    [[nodiscard]] ImageU8x3 copied() const {
        ImageU8x3 out(picture_.size());
        Image<Cost, 1> best(picture_.size(), std::numeric_limits<Cost>::max());
        for (int y = 0; y < patches_.height; ++y) {
            for (int x = 0; x < patches_.width; ++x) {
                const Vec2i from = field_.at(x, y);
                for (int j = 0; j < kPatch; ++j) {
                    for (int i = 0; i < kPatch; ++i) {
                        if (cost_.at(x, y) >= best.at(x + i, y + j)) continue;
                        best.at(x + i, y + j) = cost_.at(x, y);
                        std::copy_n(sample_.pixel(from.x + i, from.y + j), 3,
                                    out.pixel(x + i, y + j));
                    }
                }
            }
        }
        return out;
    }

  private:
    Vec2i anywhere() {
        return {static_cast<int>(rng_.below(static_cast<std::uint64_t>(places_.width))),
                static_cast<int>(rng_.below(static_cast<std::uint64_t>(places_.height)))};
    }

    [[nodiscard]] Cost distance(int x, int y, Vec2i from, Cost limit) const {
        Cost sum = 0;
        for (int j = 0; j < kPatch; ++j) {
            const std::uint8_t* a = picture_.pixel(x, y + j);
            const std::uint8_t* b = sample_.pixel(from.x, from.y + j);
            for (int i = 0; i < 3 * kPatch; ++i) {
                const Cost d = a[i] - b[i];
                sum += d * d;
            }
            if (sum >= limit) break;
        }
        return sum;
    }

    void score_all() {
        for (int y = 0; y < patches_.height; ++y) {
            for (int x = 0; x < patches_.width; ++x) {
                cost_.at(x, y) = distance(x, y, field_.at(x, y), std::numeric_limits<Cost>::max());
            }
        }
    }

    void attempt(int x, int y, Vec2i from) {
        if (from.x < 0 || from.y < 0 || from.x >= places_.width || from.y >= places_.height) return;
        const Cost d = distance(x, y, from, cost_.at(x, y));
        if (d >= cost_.at(x, y)) return;
        cost_.at(x, y) = d;
        field_.at(x, y) = from;
    }

    // In scanline order, reversed in every other round; the random search shrinks by half (Barnes
    // et al. 2009, eq. 1).
    void search(bool reverse) {
        const int step = reverse ? -1 : 1;
        for (int k = 0; k < patches_.height; ++k) {
            const int y = reverse ? patches_.height - 1 - k : k;
            for (int i = 0; i < patches_.width; ++i) {
                const int x = reverse ? patches_.width - 1 - i : i;
                if (i > 0) attempt(x, y, field_.at(x - step, y) + Vec2i(step, 0));
                if (k > 0) attempt(x, y, field_.at(x, y - step) + Vec2i(0, step));
                for (int r = std::max(places_.width, places_.height); r >= 1; r /= 2) {
                    const auto span = static_cast<std::uint64_t>(2 * r + 1);
                    const int dx = static_cast<int>(rng_.below(span)) - r;
                    const int dy = static_cast<int>(rng_.below(span)) - r;
                    attempt(x, y, field_.at(x, y) + Vec2i(dx, dy));
                }
            }
        }
    }

    [[nodiscard]] float vote_scale() const {
        std::vector<Cost> all(cost_.data(), cost_.data() + cost_.size_bytes() / sizeof(Cost));
        const auto at = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 3 / 4);
        std::nth_element(all.begin(), at, all.end());
        return 0.5f / std::max(1.0f, static_cast<float>(*at));
    }

    template <class T>
    class Grid {
      public:
        explicit Grid(Size s)
            : width_(s.width),
              cells_(static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height)) {}
        T& at(int x, int y) { return cells_[index(x, y)]; }
        const T& at(int x, int y) const { return cells_[index(x, y)]; }

      private:
        [[nodiscard]] std::size_t index(int x, int y) const {
            return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x);
        }
        int width_;
        std::vector<T> cells_;
    };

    const ImageU8x3& sample_;
    ImageU8x3 picture_;
    Size patches_, places_;
    Grid<Vec2i> field_;
    Image<Cost, 1> cost_;
    Rng rng_;
};

ImageU8x3 repeated(const ImageU8x3& sample, Size size) {
    ImageU8x3 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            std::copy_n(sample.pixel(x % sample.width(), y % sample.height()), 3, out.pixel(x, y));
    }
    return out;
}

ImageU8x3 cropped(const ImageU8x3& image, Size size) {
    ImageU8x3 out(size);
    for (int y = 0; y < size.height; ++y)
        std::copy_n(image.row(y), 3 * size.width, out.row(y));
    return out;
}

}  // namespace

ImageU8x3 patch_match_texture(ViewU8x3 sample, const PatchMatchOptions& options) {
    std::vector<ImageU8x3> samples(1, ImageU8x3(sample.size()));
    for (int y = 0; y < sample.height(); ++y)
        std::copy_n(sample.row(y), 3 * sample.width(), samples[0].row(y));
    if (std::min(sample.width(), sample.height()) <= kPatch)
        return repeated(samples[0], options.size);
    while (static_cast<int>(samples.size()) < kMostLevels &&
           std::min(samples.back().width(), samples.back().height()) >= 2 * kSmallestSample) {
        samples.push_back(halved(samples.back()));
    }
    const int levels = static_cast<int>(samples.size());
    // An integer size at every level, and at least a patch wide at the coarsest.
    const auto size_at = [&](int level) {
        const int unit = 1 << (levels - 1);
        const auto side = [&](int wanted) {
            return std::max((wanted + unit - 1) / unit, kPatch) * (unit >> level);
        };
        return Size{side(options.size.width), side(options.size.height)};
    };
    std::optional<Level> at;
    for (int level = levels - 1; level >= 0; --level) {
        Level next(samples[static_cast<std::size_t>(level)], size_at(level), options, level);
        if (at) {
            next.start_from(*at);
        } else {
            next.start_at_random();
        }
        next.improve(level == levels - 1 ? kCoarseVotes : kFineVotes, options.search_rounds);
        at.emplace(std::move(next));
    }
    return cropped(at->copied(), options.size);
}

}  // namespace weft
