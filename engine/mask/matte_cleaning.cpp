#include "engine/mask/matte_cleaning.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace weft {
namespace {

enum class Neighbours { kFour, kEight };
enum class AtBorder { kCounts, kStays };

constexpr std::int32_t kNobody = -1;

// Sets of pixels, by union and find; each is named by its lowest pixel.
class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    std::int32_t find(std::int32_t i) {
        while (parent_[static_cast<std::size_t>(i)] != i) {
            std::int32_t& up = parent_[static_cast<std::size_t>(i)];
            up = parent_[static_cast<std::size_t>(up)];
            i = up;
        }
        return i;
    }
    void join(std::int32_t a, std::int32_t b) {
        a = find(a), b = find(b);
        parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

  private:
    std::vector<std::int32_t> parent_;
};

class Islands {
  public:
    Islands(const ImageF1& alpha, Neighbours neighbours, AtBorder at_border)
        : alpha_(alpha), diagonal_(neighbours == Neighbours::kEight), at_border_(at_border) {}

    // What of the image is to go.
    Matte small(int min_px) {
        owner_.assign(
            static_cast<std::size_t>(alpha_.width()) * static_cast<std::size_t>(alpha_.height()),
            kNobody);
        label([](float a) { return a >= 0.5f; });
        claim_rims();
        label([](float a) { return a > 0; });
        return mark(min_px);
    }

  private:
    [[nodiscard]] std::int32_t index(int x, int y) const { return y * alpha_.width() + x; }
    std::int32_t& owner(std::int32_t i) { return owner_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] float value(std::int32_t i) const { return alpha_.data()[i]; }

    // Gives every connected set of pixels that have no owner and are `wanted` its lowest pixel.
    template <class Wanted>
    void label(Wanted&& wanted) {
        Sets sets(owner_.size());
        std::vector<std::uint8_t> mine(owner_.size());
        for (int y = 0; y < alpha_.height(); ++y) {
            for (int x = 0; x < alpha_.width(); ++x) {
                const std::int32_t i = index(x, y);
                if (owner(i) != kNobody || !wanted(value(i))) continue;
                mine[static_cast<std::size_t>(i)] = 1;
                const auto join = [&](int u, int v) {
                    if (u < 0 || v < 0 || u >= alpha_.width()) return;
                    if (mine[static_cast<std::size_t>(index(u, v))]) sets.join(i, index(u, v));
                };
                join(x - 1, y);
                join(x, y - 1);
                if (!diagonal_) continue;
                join(x - 1, y - 1);
                join(x + 1, y - 1);
            }
        }
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(owner_.size()); ++i)
            if (mine[static_cast<std::size_t>(i)]) owner(i) = sets.find(i);
    }

    // Soft pixels go to the set from which they are reached downhill, as waters part (Vincent &
    // Soille 1991): from the highest coverage to the lowest, in the order of their discovery.
    void claim_rims() {
        constexpr int kSteps = 255;
        std::vector<std::vector<std::int32_t>> fronts(kSteps + 1);
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(owner_.size()); ++i)
            if (owner(i) != kNobody && touches_soft(i)) fronts[kSteps].push_back(i);
        for (int step = kSteps; step >= 0; --step) {
            auto& front = fronts[static_cast<std::size_t>(step)];
            for (std::size_t k = 0; k < front.size(); ++k) {
                const std::int32_t i = front[k];
                for_neighbours(i, [&](std::int32_t j) {
                    if (owner(j) != kNobody || !(value(j) > 0)) return;
                    owner(j) = owner(i);
                    const int own = static_cast<int>(value(j) * kSteps);
                    fronts[static_cast<std::size_t>(std::min(step, own))].push_back(j);
                });
            }
            front = {};
        }
    }
    bool touches_soft(std::int32_t i) {
        bool found = false;
        for_neighbours(
            i, [&](std::int32_t j) { found = found || (owner(j) == kNobody && value(j) > 0); });
        return found;
    }
    template <class Visit>
    void for_neighbours(std::int32_t i, Visit&& visit) {
        const int x = i % alpha_.width(), y = i / alpha_.width();
        for (int v = std::max(0, y - 1); v <= std::min(alpha_.height() - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(alpha_.width() - 1, x + 1); ++u)
                if ((u != x || v != y) && (diagonal_ || u == x || v == y)) visit(index(u, v));
    }

    Matte mark(int min_px) {
        std::vector<std::int64_t> area(owner_.size());
        std::vector<double> cover(owner_.size());
        std::vector<std::uint8_t> stays(owner_.size());
        for (int y = 0; y < alpha_.height(); ++y) {
            for (int x = 0; x < alpha_.width(); ++x) {
                const std::int32_t i = index(x, y);
                if (owner(i) == kNobody) continue;
                const auto k = static_cast<std::size_t>(owner(i));
                if (value(i) >= 0.5f) ++area[k];
                cover[k] += static_cast<double>(value(i));
                const bool edge =
                    x == 0 || y == 0 || x + 1 == alpha_.width() || y + 1 == alpha_.height();
                if (edge && at_border_ == AtBorder::kStays) stays[k] = 1;
            }
        }
        Matte out(alpha_.size());
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(owner_.size()); ++i) {
            if (owner(i) == kNobody) continue;
            const auto k = static_cast<std::size_t>(owner(i));
            const bool small = area[k] > 0 ? area[k] < min_px : cover[k] < min_px;
            out.data()[i] = small && !stays[k] ? 1 : 0;
        }
        return out;
    }

    const ImageF1& alpha_;
    bool diagonal_;
    AtBorder at_border_;
    std::vector<std::int32_t> owner_;
};

std::span<float> values_of(ImageF1& image) {
    return {image.data(), image.size_bytes() / sizeof(float)};
}

}  // namespace

void remove_islands(ImageF1& alpha, int min_px) {
    const Matte small = Islands(alpha, Neighbours::kEight, AtBorder::kCounts).small(min_px);
    const std::span<float> values = values_of(alpha);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (small.data()[i]) values[i] = 0;
}

void fill_holes(ImageF1& alpha, int min_px) {
    ImageF1 inverted(alpha.size());
    const std::span<float> values = values_of(alpha);
    std::transform(values.begin(), values.end(), inverted.data(), [](float a) { return 1 - a; });
    const Matte small = Islands(inverted, Neighbours::kFour, AtBorder::kStays).small(min_px);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (small.data()[i]) values[i] = 1;
}

}  // namespace weft
