#include "engine/motion/stripes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/core/smooth_step.h"

namespace weft {
namespace {

constexpr int kReach_px = 2;   // of a slope
constexpr int kBorder_px = 4;  // within which a matte's edge is not the surface's structure

bool is_inside(ViewU8x1 visible, int x, int y) {
    for (const int d : {-kBorder_px, 0, kBorder_px})
        if (visible.row(y + d)[x] < 128 || visible.row(y)[x + d] < 128) return false;
    return true;
}

// Between means of five pixels on either side.
glm::dvec2 slope_at(ViewU8x1 luma, int x, int y) {
    int across = 0, down = 0;
    for (int k = -kReach_px; k <= kReach_px; ++k) {
        across += luma.row(y + k)[x + kReach_px] - luma.row(y + k)[x - kReach_px];
        down += luma.row(y + kReach_px)[x + k] - luma.row(y - kReach_px)[x + k];
    }
    return {across, down};
}

// How far a region moves along its stripes: a + b · (p − middle) / unit, px.
class Slide {
  public:
    static std::optional<Slide> along_edge(const LatticeField& outline, ViewU8x1 extent,
                                           Vec2 along);
    [[nodiscard]] float at(Vec2 p) const {
        const Vec2 q = (p - middle_) / unit_;
        return static_cast<float>(terms_[0] + terms_[1] * static_cast<double>(q.x) +
                                  terms_[2] * static_cast<double>(q.y));
    }

  private:
    Vec2 middle_{0};
    float unit_ = 1;
    std::array<double, 3> terms_{};
};

std::optional<Slide> Slide::along_edge(const LatticeField& outline, ViewU8x1 extent, Vec2 along) {
    constexpr double kFewest = 20, kUpright = 0.4;
    constexpr double kLean = 0.5;  // a ridge on the slopes, in shares of all places
    Slide out;
    out.middle_ = 0.5f * Vec2(extent.width(), extent.height());
    out.unit_ = 0.5f * static_cast<float>(std::max(extent.width(), extent.height()));
    std::array<std::array<double, 4>, 3> a{};  // normal equations, the right side last
    for (int y = kBorder_px; y < extent.height() - kBorder_px; ++y) {
        for (int x = kBorder_px; x < extent.width() - kBorder_px; ++x) {
            const Vec2 normal(extent.row(y)[x + kReach_px] - extent.row(y)[x - kReach_px],
                              extent.row(y + kReach_px)[x] - extent.row(y - kReach_px)[x]);
            const float steep = glm::length(normal);
            if (steep < 128) continue;
            const double across = std::abs(static_cast<double>(glm::dot(normal, along) / steep));
            if (across < kUpright) continue;
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 q = (p - out.middle_) / out.unit_;
            const std::array<double, 4> row{1, q.x, q.y, glm::dot(outline.at(p), along)};
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 4; ++k)
                    a[j][k] += across * across * row[j] * row[k];
        }
    }
    const double total = a[0][0];
    if (total < kFewest) return std::nullopt;
    a[1][1] += kLean * total;
    a[2][2] += kLean * total;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t r = 0; r < 3; ++r) {
            if (r == k) continue;
            const double f = a[r][k] / a[k][k];  // positive definite: no pivots
            for (std::size_t c = k; c < 4; ++c)
                a[r][c] -= f * a[k][c];
        }
    }
    for (std::size_t k = 0; k < 3; ++k)
        out.terms_[k] = a[k][3] / a[k][k];
    return out;
}

}  // namespace

Stripes stripes_of(ViewU8x1 luma, ViewU8x1 visible) {
    constexpr int kStep = 2;
    constexpr double kLines = 0.06, kNoLines = 0.12;
    double xx = 0, xy = 0, yy = 0;
    for (int y = kBorder_px; y < luma.height() - kBorder_px; y += kStep) {
        for (int x = kBorder_px; x < luma.width() - kBorder_px; x += kStep) {
            if (!is_inside(visible, x, y)) continue;
            const glm::dvec2 s = slope_at(luma, x, y);
            xx += s.x * s.x;
            xy += s.x * s.y;
            yy += s.y * s.y;
        }
    }
    const double mean = (xx + yy) / 2, half = (xx - yy) / 2;
    const double apart = std::sqrt(half * half + xy * xy);
    if (!(apart > 0)) return {};
    // The eigenvector of the smaller eigenvalue; of two forms the one that is not small.
    const glm::dvec2 along =
        half > 0 ? glm::dvec2(-xy, half + apart) : glm::dvec2(half - apart, xy);
    const double ratio = (mean - apart) / (mean + apart);
    return {Vec2(glm::normalize(along)),
            static_cast<float>(std::clamp((kNoLines - ratio) / (kNoLines - kLines), 0.0, 1.0))};
}

Stripes stripes_of(const RegistrationPicture& picture) {
    constexpr float kMiddle = 128, kDeviation = 40;  // codes
    Matte codes(picture.value.size()), inside(picture.value.size());
    for (int y = 0; y < codes.height(); ++y) {
        for (int x = 0; x < codes.width(); ++x) {
            const float code = kMiddle + kDeviation * picture.value.at(x, y);
            codes.at(x, y) = static_cast<std::uint8_t>(std::clamp(code, 0.0f, 255.0f));
            inside.at(x, y) = picture.inside.at(x, y) >= 0.5f ? 255 : 0;
        }
    }
    return stripes_of(codes, inside);
}

LatticeField along_stripes(const LatticeField& field, const LatticeField& outline, ViewU8x1 extent,
                           const Stripes& stripes) {
    const auto along = Slide::along_edge(outline, extent, stripes.along);
    if (!along) return field;
    LatticeField out = field;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const float differs =
                along->at(field.node_position(i, j)) - glm::dot(field.node(i, j), stripes.along);
            out.set_node(i, j, field.node(i, j) + stripes.share * differs * stripes.along);
        }
    }
    return out;
}

float departure(const LatticeField& field, const LatticeField& held, ViewU8x1 visible) {
    double sum = 0;
    int count = 0;
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            const int x = std::clamp(static_cast<int>(p.x), 0, visible.width() - 1);
            const int y = std::clamp(static_cast<int>(p.y), 0, visible.height() - 1);
            if (visible.row(y)[x] < 128) continue;
            sum += static_cast<double>(distance(field.node(i, j), held.node(i, j)));
            ++count;
        }
    }
    return count > 0 ? static_cast<float>(sum / count) : 0.0f;
}

LatticeField held_where_dragged(const LatticeField& field, const LatticeField& held) {
    constexpr float kOwn_px = 4, kDragged_px = 8;  // of a frame 480 wide
    LatticeField out = field;
    const float unit = static_cast<float>(field.full_size().width) / 480;
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 back = held.node(i, j) - field.node(i, j);
            const float share = smooth_step(glm::length(back) / unit, kOwn_px, kDragged_px);
            out.set_node(i, j, field.node(i, j) + share * back);
        }
    }
    return out;
}

LatticeField changed_across_stripes(LatticeField field, const LatticeField& before,
                                    const Stripes& stripes) {
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 change = field.node(i, j) - before.node(i, j);
            const float along = stripes.share * glm::dot(change, stripes.along);
            field.set_node(i, j, field.node(i, j) - along * stripes.along);
        }
    }
    return field;
}

}  // namespace weft
