#include "engine/temporal/part_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mask/band_cut.h"
#include "engine/mask/surface_palette.h"
#include "engine/motion/surface_fit.h"

namespace weft {
namespace {

constexpr float kCore_px = 10;  // inside of a cell: more than any clearance

// What a motion explains of a frame.
struct Explained {
    LatticeField motion;
    ImageF2 way;     // its displacements
    ImageF1 misfit;  // levels: by how much colours differ from those it leads to
};

LatticeField motion_of(int part, const StepFrame& cur, const FlowField& prev_from_cur,
                       const MovingParts& parts, int spacing_px) {
    constexpr int kBorder_px = 1;
    const ViewU8x1 visible = cur.view().visible;
    Matte own(cur.size());
    for (int y = 0; y < own.height(); ++y) {
        for (int x = 0; x < own.width(); ++x)
            own.at(x, y) = parts.at(x, y) == part ? visible.at(x, y) : std::uint8_t{0};
    }
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    return fit_surface_motion(prev_from_cur.d,
                              motion_weights(cur.view().luma, own, prev_from_cur.valid, kBorder_px),
                              fit);
}

// The mean difference over the channels of a colour and what `picture` shows at p, bilinearly.
float color_difference(const std::uint8_t* color, const ImageU8x3& picture, Vec2 p) {
    constexpr float kInside = 1.001f;
    const float u = std::clamp(p.x, 0.0f, static_cast<float>(picture.width()) - kInside);
    const float v = std::clamp(p.y, 0.0f, static_cast<float>(picture.height()) - kInside);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
    const std::uint8_t *a = picture.pixel(i, j), *b = picture.pixel(i, j + 1);
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
        const float top = static_cast<float>(a[c]) + fx * static_cast<float>(a[c + 3] - a[c]);
        const float low = static_cast<float>(b[c]) + fx * static_cast<float>(b[c + 3] - b[c]);
        sum += std::abs(top + fy * (low - top) - static_cast<float>(color[c]));
    }
    return sum / 3;
}

// Means over 5×5 pixels, fewer at the border.
ImageF1 local_means(const ImageF1& of) {
    constexpr int kReach = 2;
    ImageF1 out(of.size());
    parallel_rows(of.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < of.width(); ++x) {
                float sum = 0;
                int n = 0;
                for (int v = std::max(0, y - kReach); v <= std::min(of.height() - 1, y + kReach);
                     ++v) {
                    for (int u = std::max(0, x - kReach); u <= std::min(of.width() - 1, x + kReach);
                         ++u, ++n)
                        sum += of.at(u, v);
                }
                out.at(x, y) = sum / static_cast<float>(n);
            }
        }
    });
    return out;
}

Explained explained_by(LatticeField motion, const StepFrame& prev, const StepFrame& cur) {
    Explained out;
    out.way = motion.dense(rect_of(cur.size()));
    ImageF1 each(cur.size());
    parallel_rows(each.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < each.width(); ++x) {
                const float* d = out.way.pixel(x, y);
                const Vec2 p(static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]);
                each.at(x, y) = color_difference(cur.display().pixel(x, y), prev.display(), p);
            }
        }
    });
    out.misfit = local_means(each);
    out.motion = std::move(motion);
    return out;
}

class Cutter {
  public:
    Cutter(const StepFrame& cur, const MovingParts& parts, const std::vector<Explained>& by)
        : display_(cur.display()),
          visible_(cur.view().visible),
          parts_(parts),
          by_(by),
          taken_(cur.size()) {}

    // The next part, of what no earlier one has taken.
    [[nodiscard]] Matte cut(int part) {
        constexpr int kRounds = 2;  // the second knows the part's outline
        part_ = part;
        usual_ = usual_misfit();
        cells_ = ImageF1(display_.size());
        for_pixels([&](int x, int y) { cells_.at(x, y) = of_cell(x, y); });
        const SurfacePalette palette(display_, cells_);
        inside_ = {};
        for (int round = 0; round < kRounds; ++round)
            inside_ = labels(palette);
        Matte out(display_.size());
        for_pixels([&](int x, int y) {
            if (inside_.at(x, y) == 0 || !is_free(x, y)) return;
            out.at(x, y) = taken_.at(x, y) = 255;
        });
        return out;
    }

  private:
    template <class Visit>
    void for_pixels(const Visit& visit) const {
        for (int y = 0; y < display_.height(); ++y) {
            for (int x = 0; x < display_.width(); ++x)
                visit(x, y);
        }
    }
    [[nodiscard]] bool is_free(int x, int y) const {
        return visible_.at(x, y) >= 128 && taken_.at(x, y) == 0;
    }
    // Positive in the part's cells, negative in others', 0 where nothing is known.
    [[nodiscard]] float of_cell(int x, int y) const {
        const int of = parts_.at(x, y);
        if (!is_free(x, y) || of == MovingParts::kUnknown) return 0;
        return of == part_ ? kCore_px : -kCore_px;
    }
    // In a cell of the part with such cells on all sides.
    [[nodiscard]] bool is_sure(int x, int y) const {
        const int step = parts_.cell_px;
        const int right = std::min(x + step, display_.width() - 1);
        const int below = std::min(y + step, display_.height() - 1);
        return cells_.at(x, y) > 0 && parts_.at(std::max(0, x - step), y) == part_ &&
               parts_.at(right, y) == part_ && parts_.at(x, std::max(0, y - step)) == part_ &&
               parts_.at(x, below) == part_;
    }
    // The part's own, where its cells are.
    [[nodiscard]] float usual_misfit() const {
        std::vector<float> own;
        for_pixels([&](int x, int y) {
            if (is_free(x, y) && parts_.at(x, y) == part_)
                own.push_back(by_[static_cast<std::size_t>(part_)].misfit.at(x, y));
        });
        if (own.empty()) return 0;
        const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
        std::nth_element(own.begin(), middle, own.end());
        return *middle;
    }
    // Whether the part was in front of what the body shows here: from the body's place on the frame
    // before, the part's motion leads back into it.
    [[nodiscard]] bool was_hidden(int x, int y) const {
        const float* body = by_[0].way.pixel(x, y);
        const float* own = by_[static_cast<std::size_t>(part_)].way.pixel(x, y);
        const auto back = [](int from, float d, int size) {
            return std::clamp(from + static_cast<int>(std::lround(d)), 0, size - 1);
        };
        const int u = back(x, body[0] - own[0], display_.width());
        const int v = back(y, body[1] - own[1], display_.height());
        return inside_.empty() ? parts_.at(u, v) == part_ : inside_.at(u, v) != 0;
    }
    // The least misfit of the other motions.
    [[nodiscard]] float others_misfit(int x, int y) const {
        float least = by_[0].misfit.at(x, y);
        for (std::size_t k = 1; k < by_.size(); ++k) {
            if (static_cast<int>(k) != part_) least = std::min(least, by_[k].misfit.at(x, y));
        }
        return least;
    }
    [[nodiscard]] float odds(const SurfacePalette& palette, int x, int y) const {
        constexpr float kEachLevel = 0.5f, kMost = 4, kColors = 0.5f;
        constexpr float kPoor = 2, kPoor_levels = 3;  // times the usual misfit, and beyond it
        const float own = by_[static_cast<std::size_t>(part_)].misfit.at(x, y);
        const float poor = kPoor * usual_ + kPoor_levels;
        float others = others_misfit(x, y);
        if (was_hidden(x, y)) others = std::min(others, poor);
        return cells_.at(x, y) / kCore_px + std::clamp(kEachLevel * (others - own), -kMost, kMost) -
               std::clamp(kEachLevel * (own - poor), 0.0f, kMost) +
               kColors * palette.odds(display_.pixel(x, y));
    }
    [[nodiscard]] Image<std::uint8_t, 1> labels(const SurfacePalette& palette) const {
        constexpr float kSmoothness = 3;
        ImageF1 evidence(display_.size()), prior(display_.size());
        Image<std::uint8_t, 1> undecided(display_.size());
        parallel_rows(display_.height(), 16, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                for (int x = 0; x < display_.width(); ++x) {
                    const bool sure = is_free(x, y) && is_sure(x, y);
                    prior.at(x, y) = sure ? kCore_px : -kCore_px;
                    undecided.at(x, y) = is_free(x, y) && !sure ? 1 : 0;
                    if (undecided.at(x, y) != 0) evidence.at(x, y) = odds(palette, x, y);
                }
            }
        });
        auto out = cut_band(display_, evidence, prior, undecided, kSmoothness);
        remove_islands(out, prior, 0.5f * kCore_px, display_.width() * display_.height());
        return out;
    }

    const ImageU8x3& display_;
    ViewU8x1 visible_;
    const MovingParts& parts_;
    const std::vector<Explained>& by_;  // of the body, then of each part
    Matte taken_;
    int part_ = 0;
    float usual_ = 0;
    ImageF1 cells_;
    Image<std::uint8_t, 1> inside_;  // as the last round found it
};

}  // namespace

PartOutlines part_outlines(const StepFrame& prev, const StepFrame& cur,
                           const FlowField& prev_from_cur, const MovingParts& parts,
                           int spacing_px) {
    std::vector<Explained> by;
    for (int part = 0; part <= parts.count; ++part)
        by.push_back(
            explained_by(motion_of(part, cur, prev_from_cur, parts, spacing_px), prev, cur));
    PartOutlines out;
    Cutter cutter(cur, parts, by);
    for (int part = 1; part <= parts.count; ++part)
        out.parts.push_back({cutter.cut(part), by[static_cast<std::size_t>(part)].motion});
    out.body_motion = std::move(by[0].motion);
    return out;
}

}  // namespace weft
