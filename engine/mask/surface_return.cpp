#include "engine/mask/surface_return.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "engine/core/block_means.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/mask/signed_distance.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

constexpr int kLattice_px = 8;
constexpr float kWellInside_px = 2;   // of where the surface is expected
constexpr double kLeastShare = 0.01;  // of the keyframe's matte, that is missing or comes back
constexpr double kLostShare = 0.1;    // of it is seen: where it is is not known any more
constexpr double kLeast_px = 150;     // of a frame 854 wide

ImageF1 luma_of(ViewU8x3 frame, const Recti& area) {
    ImageF1 out(area.size());
    for (int y = 0; y < out.height(); ++y) {
        const std::uint8_t* p = frame.pixel(area.x0, area.y0 + y);
        for (int x = 0; x < out.width(); ++x, p += 3)
            out.at(x, y) = luma_709(static_cast<float>(p[0]), static_cast<float>(p[1]),
                                    static_cast<float>(p[2]));
    }
    return out;
}

bool covers_any(const Matte& matte) {
    const std::uint8_t* codes = matte.data();
    return std::any_of(codes, codes + matte.size_bytes(), [](int code) { return code != 0; });
}

}  // namespace

SurfaceReturn::SurfaceReturn(ViewU8x3 key_frame, ViewF1 key_phi)
    : unit_px_(static_cast<float>(key_frame.width()) / 854.0f),
      step_(std::max(1, static_cast<int>(std::lround(2 * unit_px_)))),
      key_luma_(block_means(luma_of(key_frame, rect_of(key_frame.size())), step_)),
      key_phi_(key_phi.size()),
      key_area_px_(area_of(key_phi)) {
    for (int y = 0; y < key_phi.height(); ++y)
        std::copy_n(key_phi.row(y), key_phi.width(), key_phi_.row(y));
}

void SurfaceReturn::move(ViewF2 prev_from_cur) {
    // A plane's motion, from a few places over the frame.
    constexpr int kPlaces = 12;
    std::vector<PlacePair> pairs;
    for (int j = 0; j < kPlaces; ++j) {
        for (int i = 0; i < kPlaces; ++i) {
            const int x = (2 * i + 1) * prev_from_cur.width() / (2 * kPlaces);
            const int y = (2 * j + 1) * prev_from_cur.height() / (2 * kPlaces);
            const float* d = prev_from_cur.pixel(x, y);
            const Vec2 p(x, y);
            pairs.push_back({p, p + Vec2(d[0], d[1])});
        }
    }
    key_from_cur_ = key_from_cur_ * fit_plane(pairs);
}

void SurfaceReturn::follow(ViewF1 phi, ViewF2 key_from_cur, const Recti& area) {
    constexpr double kEnough = 0.3, kPairs = 200;
    if (area_of(phi) < kEnough * key_area_px_) return;
    const int step = std::max(1, static_cast<int>(std::sqrt(area_of(phi) / kPairs)));
    std::vector<PlacePair> pairs;
    for (int y = step / 2; y < phi.height(); y += step) {
        for (int x = step / 2; x < phi.width(); x += step) {
            if (phi.row(y)[x] < 1) continue;
            const float* k = key_from_cur.pixel(x, y);
            pairs.push_back({Vec2(area.x0 + x, area.y0 + y), Vec2(k[0], k[1])});
        }
    }
    if (pairs.size() < 8) return;
    key_from_cur_ = key_from_seen_ = fit_plane(pairs);
    constexpr float kNear_px = 3;
    const auto near = std::count_if(pairs.begin(), pairs.end(), [&](const PlacePair& pair) {
        return glm::length(mapped(key_from_cur_, pair.from) - pair.to) < kNear_px * unit_px_;
    });
    is_piece_ = 2 * near > static_cast<std::ptrdiff_t>(pairs.size());
}

Vec2 SurfaceReturn::key_place(int x, int y) const {
    return mapped(key_from_cur_, Vec2(x, y));
}

float SurfaceReturn::expected(int x, int y) const {
    const Vec2 k = key_place(x, y);
    const bool there = k.x >= 0 && k.y >= 0 && k.x <= static_cast<float>(key_phi_.width() - 1) &&
                       k.y <= static_cast<float>(key_phi_.height() - 1);
    return there ? sample_bilinear(key_phi_, k.x, k.y) : -1.0f;
}

// What is missing, on a coarse grid: how much, and where.
std::pair<double, Recti> SurfaceReturn::missing(ViewF1 phi) const {
    constexpr int kStep = 3;
    std::pair<double, Recti> out{0, {}};
    for (int y = 0; y < phi.height(); y += kStep) {
        for (int x = 0; x < phi.width(); x += kStep) {
            if (phi.row(y)[x] > -1 || expected(x, y) < kWellInside_px) continue;
            out.first += kStep * kStep;
            out.second = out.second.united({x, y, x + 1, y + 1});
        }
    }
    return out;
}

PatternPair SurfaceReturn::pair_in(const Recti& box, ViewU8x3 frame, ViewF1 phi) const {
    const Size size = blocks_of(box.size(), step_);
    const auto step = static_cast<float>(step_);
    PatternPair pair{ImageF1(size), block_means(luma_of(frame, box), step_), ImageF1(size),
                     ImageF1(size)};
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const int u = box.x0 + step_ * x, v = box.y0 + step_ * y;
                const float depth = expected(u, v);
                if (depth <= 0) continue;
                const Vec2 k =
                    (mapped(key_from_cur_, Vec2(u, v) + 0.5f * (step - 1)) + 0.5f) / step;
                pair.key.at(x, y) = sample_bilinear(key_luma_, k.x - 0.5f, k.y - 0.5f);
                pair.known.at(x, y) = 1;
                const bool outside = phi.row(v)[u] <= -1;
                pair.wanted.at(x, y) = outside && depth >= kWellInside_px ? 1.0f : 0.0f;
            }
        }
    });
    return pair;
}

// Of a surface of which nothing is seen: it may have moved otherwise than its background.
void SurfaceReturn::look_around(ViewU8x3 frame) {
    const int step = 2 * step_;
    const Size size = blocks_of(frame.size(), step);
    const glm::dmat3 moved = std::exchange(key_from_cur_, key_from_seen_);
    ImageF1 key(size), known(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            if (expected(step * x, step * y) < kWellInside_px) continue;
            const auto by = static_cast<float>(step_);
            const Vec2 k = (key_place(step * x, step * y) + 0.5f) / by;
            key.at(x, y) = sample_bilinear(key_luma_, k.x - 0.5f, k.y - 0.5f);
            known.at(x, y) = 1;
        }
    }
    const ImageF1 picture = block_means(luma_of(frame, rect_of(frame.size())), step);
    if (const auto shift = find_anywhere(key, known, picture))
        shift_by(step * *shift);
    else
        key_from_cur_ = moved;
}

void SurfaceReturn::shift_by(Vec2i px) {
    glm::dmat3 back(1);
    back[2] = {-px.x, -px.y, 1};
    key_from_cur_ = key_from_cur_ * back;
}

// The same place more closely: the registration of both pictures (register_planar()).
void SurfaceReturn::register_near(ViewU8x3 frame, const Recti& box) {
    const auto step = static_cast<float>(step_);
    const Size size = blocks_of(frame.size(), step_);
    const auto reduced = [&](const ImageF1& luma) {
        Matte out(luma.size());
        std::transform(luma.data(), luma.data() + luma.size_bytes() / sizeof(float), out.data(),
                       [](float v) { return static_cast<std::uint8_t>(std::lround(v)); });
        return out;
    };
    Matte key_inside(size), around(size);
    LatticeField start(size, kLattice_px);
    for (int j = 0; j < start.nodes().height(); ++j) {
        for (int i = 0; i < start.nodes().width(); ++i) {
            const Vec2 p = start.node_position(i, j);
            const Vec2 k = (mapped(key_from_cur_, p * step - 0.5f) + 0.5f) / step;
            start.set_node(i, j, k - p);
        }
    }
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const int u = step_ * x, v = step_ * y;
            key_inside.at(x, y) = key_phi_.at(u, v) > 0 ? 255 : 0;
            around.at(x, y) = box.contains(u, v) && expected(u, v) > 0 ? 255 : 0;
        }
    }
    const PlanarRegistration found = register_planar(
        registration_picture(reduced(key_luma_), key_inside),
        registration_picture(reduced(block_means(luma_of(frame, rect_of(frame.size())), step_)),
                             around),
        start, {});
    if (!found.found) return;
    std::vector<PlacePair> pairs;
    for (int y = 0; y < size.height; y += kLattice_px) {
        for (int x = 0; x < size.width; x += kLattice_px) {
            if (around.at(x, y) == 0) continue;
            const Vec2 p = Vec2(x, y) + 0.5f, k = p + found.anchor_from_cur.at(p);
            pairs.push_back({p * step - 0.5f, k * step - 0.5f});
        }
    }
    if (pairs.size() >= 8) key_from_cur_ = fit_plane(pairs);
}

Matte SurfaceReturn::returned(ViewU8x3 frame, ViewF1 phi) {
    const double least =
        std::max(kLeastShare * key_area_px_, kLeast_px * static_cast<double>(unit_px_ * unit_px_));
    if (!is_piece_ || std::exchange(waits_, false)) return {};
    const glm::dmat3 before = key_from_cur_;
    if (area_of(phi) < kLostShare * key_area_px_) look_around(frame);
    const auto [count, where] = missing(phi);
    if (count < least) return {};
    const float unit = unit_px_ / static_cast<float>(step_);
    const int radius = std::max(4, static_cast<int>(std::lround(8 * unit)));
    const Recti box = where.grown(4 * radius * step_).intersected(rect_of(phi.size()));
    int halvings = 0;  // so that ± 4 px there are ± 16 px of a frame 854 wide
    while (std::ldexp(4 * unit, -halvings) >= 1.5f)
        ++halvings;
    const double least_here = least / (step_ * step_);
    const auto shift = find_shift(pair_in(box, frame, phi), radius, halvings, least_here);
    if (shift) {
        shift_by(step_ * *shift);
        register_near(frame, box.grown(4 * radius * step_));
        const Matte found = found_again(pair_in(box, frame, phi), radius, least_here);
        if (covers_any(found)) return expanded(found, box, phi.size());
    }
    key_from_cur_ = before;
    waits_ = true;
    return {};
}

// A matte of reduced pixels of `box` in the frame.
Matte SurfaceReturn::expanded(const Matte& found, const Recti& box, Size frame) const {
    Matte out(frame);
    for (int y = 0; y < box.height(); ++y)
        for (int x = 0; x < box.width(); ++x)
            out.at(box.x0 + x, box.y0 + y) = found.at(x / step_, y / step_);
    return out;
}

}  // namespace weft
