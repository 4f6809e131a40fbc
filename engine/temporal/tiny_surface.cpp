#include "engine/temporal/tiny_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "engine/mask/matte_box.h"

namespace weft {
namespace {

constexpr int kFewestInside = 150;  // pixels
constexpr int kEdge_px = 3;         // that registration leaves out
constexpr float kOutline = 20;      // levels that a mismatch of the mattes weighs
constexpr std::size_t kMostPixels = 4000;
constexpr int kStepReach_px = 4, kAnchorReach_px = 2;
constexpr float kFinest_px = 1.0f / 32;

float sample(ViewU8x1 picture, Vec2 at) {
    const float x = std::clamp(at.x - 0.5f, 0.0f, static_cast<float>(picture.width() - 1));
    const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(picture.height() - 1));
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const int i1 = std::min(i + 1, picture.width() - 1), j1 = std::min(j + 1, picture.height() - 1);
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    const std::uint8_t *a = picture.row(j), *b = picture.row(j1);
    const float top = static_cast<float>(a[i]) + fx * static_cast<float>(a[i1] - a[i]);
    const float low = static_cast<float>(b[i]) + fx * static_cast<float>(b[i1] - b[i]);
    return top + fy * (low - top);
}

std::vector<Vec2> covered(ViewU8x1 matte) {
    std::vector<Vec2> out;
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            if (matte.row(y)[x] > 0)
                out.emplace_back(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    if (out.size() <= kMostPixels) return out;
    const std::size_t step = out.size() / kMostPixels + 1;
    for (std::size_t k = 0; k * step < out.size(); ++k)
        out[k] = out[k * step];
    out.resize(out.size() / step);
    return out;
}

std::optional<Vec2> centre_of(ViewU8x1 matte) {
    double x = 0, y = 0, all = 0;
    for (int j = 0; j < matte.height(); ++j) {
        for (int i = 0; i < matte.width(); ++i) {
            const double m = matte.row(j)[i];
            x += m * (i + 0.5), y += m * (j + 0.5), all += m;
        }
    }
    if (!(all > 0)) return std::nullopt;
    return Vec2(static_cast<float>(x / all), static_cast<float>(y / all));
}

// How two frames agree under a map.
struct Agreement {
    double picture = 0;  // mean deviation of the lumas' difference from its mean, levels
    double outline = 0;  // mean difference of the full mattes, 0–1
    double share = 0;    // of what is visible, that the other frame shows, too
    [[nodiscard]] double cost() const { return picture + kOutline * outline; }
};

// Compares pixels of `cur` with places of `there`.
class Comparison {
  public:
    Comparison(const StepFrame& there, const StepFrame& cur, const LatticeField& there_from_cur)
        : there_(there.view()),
          cur_(cur.view()),
          places_(covered(cur.view().extent)),
          moved_(there_from_cur.at(places_)),
          differences_(places_.size()),
          weights_(places_.size()) {}

    [[nodiscard]] Agreement at(Vec2 by) {
        double weight = 0, sum = 0, apart = 0, all = 0, visible = 0;
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const Vec2 p = places_[k], q = p + moved_[k] + by;
            weights_[k] = 0;
            if (q.x < 0 || q.y < 0 || q.x > static_cast<float>(there_.luma.width()) ||
                q.y > static_cast<float>(there_.luma.height()))
                continue;  // out of the picture, which says nothing
            const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
            const float full = static_cast<float>(cur_.extent.row(y)[x]) / 255;
            apart += std::abs(full - sample(there_.extent, q) / 255);
            all += full;
            const float seen = static_cast<float>(cur_.visible.row(y)[x]) / 255;
            const float both = seen * sample(there_.visible, q) / 255;
            visible += seen;
            weights_[k] = both;
            differences_[k] = static_cast<float>(cur_.luma.row(y)[x]) - sample(there_.luma, q);
            weight += both, sum += both * differences_[k];
        }
        Agreement out;
        if (!(weight > 0)) return {1e9, 1, 0};
        const double mean = sum / weight;
        for (std::size_t k = 0; k < places_.size(); ++k)
            out.picture += weights_[k] * std::abs(differences_[k] - mean) / weight;
        out.outline = all > 0 ? apart / all : 1;
        out.share = visible > 0 ? weight / visible : 0;
        return out;
    }

    // The displacement within `reach` px under which they agree most.
    [[nodiscard]] Vec2 best(int reach) {
        Vec2 found(0, 0);
        double least = at(found).cost();
        const auto look = [&](Vec2 by) {
            const double cost = at(by).cost();
            if (!(cost < least)) return;
            least = cost;
            found = by;
        };
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                look({static_cast<float>(x), static_cast<float>(y)});
        float step = 0.5f;
        while (step >= kFinest_px) {
            const Vec2 about = found;
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x)
                    look(about + step * Vec2(static_cast<float>(x), static_cast<float>(y)));
            step /= 2;
        }
        return found;
    }

  private:
    OutlineView there_, cur_;
    std::vector<Vec2> places_, moved_;
    std::vector<float> differences_, weights_;
};

LatticeField displaced(LatticeField field, Vec2 by) {
    for (int j = 0; j < field.nodes().height(); ++j)
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, field.node(i, j) + by);
    return field;
}

// The deviation of the visible lumas from their mean.
double contrast_of(const OutlineView& view) {
    double sum = 0, all = 0, apart = 0;
    const auto each = [&](const auto& add) {
        for (int y = 0; y < view.luma.height(); ++y)
            for (int x = 0; x < view.luma.width(); ++x)
                if (view.visible.row(y)[x] > 0) add(view.visible.row(y)[x], view.luma.row(y)[x]);
    };
    each([&](double m, double luma) { sum += m * luma, all += m; });
    if (!(all > 0)) return 0;
    each([&](double m, double luma) { apart += m * std::abs(luma - sum / all); });
    return apart / all;
}

}  // namespace

bool is_tiny(const StepFrame& frame) {
    const ViewU8x1 matte = frame.view().extent;
    const Recti box = matte_box(matte);
    if (box.empty()) return false;
    const ViewU8x1 part = matte.crop(box);
    const cv::Mat all(part.height(), part.width(), CV_8UC1, const_cast<std::uint8_t*>(part.data()),
                      static_cast<std::size_t>(part.stride()));
    cv::Mat inside;
    const int side = 2 * kEdge_px + 1;
    cv::erode(all >= 128, inside, cv::Mat::ones(side, side, CV_8UC1), {-1, -1}, 1,
              cv::BORDER_CONSTANT, 0);
    return cv::countNonZero(inside) < kFewestInside;
}

LatticeField tiny_motion(const StepFrame& prev, const StepFrame& cur,
                         const LatticeField& by_picture, const LatticeField& by_outline) {
    const LatticeField still(by_picture.full_size(), by_picture.spacing());
    std::vector<LatticeField> candidates{by_picture, by_outline, still};
    const auto before = centre_of(prev.view().extent), now = centre_of(cur.view().extent);
    if (before && now) candidates.push_back(displaced(still, *before - *now));
    std::optional<LatticeField> out;
    double least = 0;
    for (const LatticeField& candidate : candidates) {
        Comparison comparison(prev, cur, candidate);
        const Vec2 by = comparison.best(kStepReach_px);
        const double cost = comparison.at(by).cost();
        if (out && !(cost < least)) continue;
        least = cost;
        out = displaced(candidate, by);
    }
    return *out;
}

Registered register_tiny(const Anchor& anchor, const StepFrame& cur, const LatticeField& initial) {
    constexpr double kLeastContrast = 2;  // levels
    Comparison comparison(*anchor.frame, cur, initial);
    const Vec2 by = comparison.best(kAnchorReach_px);
    const Agreement found = comparison.at(by);
    const double contrast = std::max(kLeastContrast, contrast_of(cur.view()));
    return {displaced(initial, by), {found.picture / contrast, found.share}, true};
}

}  // namespace weft
