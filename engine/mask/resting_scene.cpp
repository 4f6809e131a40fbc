#include "engine/mask/resting_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "engine/core/block_means.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/mask/scene_light.h"
#include "engine/mask/scene_picture.h"
#include "engine/mask/scene_pieces.h"
#include "engine/mask/signed_distance.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

constexpr float kKnown = 3;        // frames in which a colour was seen …
constexpr float kSure = 6;         // … and from which on it decides
constexpr float kClear_px = 1.5f;  // of the boundary
constexpr float kUsuallyInside = 0.8f,
                kUsuallyOutside = 0.2f;  // of the frames in which a place was seen

}  // namespace

RestingScene::RestingScene(ViewU8x3 key_frame, ViewF1 key_phi)
    : scale_(key_frame.size()),
      key_area_px_(area_of(key_phi)),
      places_(scale_.size),
      key_luma_(luma_codes(key_frame)),
      now_(reduced_floats(key_frame, scale_.step)),
      gain_(scale_.size, 1.0f),
      moving_(scale_.size),
      returning_(scale_.size),
      misses_(scale_.size),
      seen_(static_cast<std::size_t>(scale_.size.width) *
            static_cast<std::size_t>(scale_.size.height)) {
    constexpr int kLeastSide = 32;
    rests_ = std::min(scale_.size.width, scale_.size.height) >= kLeastSide;
    see_places(key_phi);
    is_key_ = false;
}

std::size_t RestingScene::index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(scale_.size.width) +
           static_cast<std::size_t>(x);
}

float RestingScene::depth(ViewF1 phi, int x, int y) const {
    const Vec2i p = scale_.pixel(x, y);
    return phi.row(p.y)[p.x];
}

Vec2i RestingScene::place_of(int x, int y) const {
    constexpr float kFar = 1e6f;  // beyond a plane's horizon
    const Vec2 k =
        (mapped(key_from_cur_, scale_.middle(x, y)) + 0.5f) / static_cast<float>(scale_.step);
    return Vec2i(glm::floor(glm::clamp(k, -kFar, kFar))) + places_.origin();
}

// The frame's colour in the light of the keyframe.
Vec3 RestingScene::unlit(int x, int y) const {
    return color_at(now_, x, y) / gain_.at(x, y);
}

// Of the usual colours, as the frame is expected to show them; 0 where none is known.
ImageF1 RestingScene::expected_luma() const {
    ImageF1 out(scale_.size);
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < out.width(); ++x)
                if (const ScenePlace* place = places_.known(place_of(x, y)))
                    out.at(x, y) = std::max(1.0f, luma_709(&place->usual.color.x));
    });
    return out;
}

// The known colour of a place that is nearest to `color`, code values, if it is nearer than
// `least`.
float RestingScene::nearest(Vec2i place, Vec3 color, float least, Seen& seen) const {
    const ScenePlace* known = places_.known(place);
    if (!known) return least;
    for (const PlaceMode* mode : {&known->usual, &known->other}) {
        if (mode->frames < kKnown) continue;
        const float d = color_difference(color, mode->color);
        if (d >= least) continue;
        least = d;
        seen = {mode->frames, mode->inside / mode->frames, !mode->of_key};
    }
    return least;
}

// How far a block is from the colours that are known of its place, or else of those beside it; or,
// if that is farther, these from the block and those beside it: a fraction of a block is no
// difference, but a line that is not there is. Code values; 0 where nothing is known.
float RestingScene::miss(int x, int y, Seen& seen) const {
    constexpr float kFar = 255;
    const Vec2i at = place_of(x, y);
    const Vec3 color = unlit(x, y);
    float here = nearest(at, color, kFar, seen);
    if (seen.frames == 0) return 0;
    if (here < kMatches * noise_levels_) return here;
    for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u)
            here = nearest(at + Vec2i(u, v), color, here, seen);
    float there = kFar;
    Seen unused;
    for (int v = std::max(0, y - 1); v <= std::min(y + 1, now_.height() - 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(x + 1, now_.width() - 1); ++u)
            there = nearest(at, unlit(u, v), there, unused);
    return std::max(here, there);
}

// What each block shows, and how far that is from what is known, in windows of 5 × 5.
void RestingScene::compare() {
    constexpr float kMost = 10;  // noise
    constexpr int kSide = 5;
    cv::Mat misses(scale_.size.height, scale_.size.width, CV_32F, misses_.data());
    parallel_rows(misses.rows, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < misses.cols; ++x) {
                Seen& seen = seen_[index_of(x, y)];
                seen = {};
                misses_.at(x, y) = std::min(kMost, miss(x, y, seen) / noise_levels_);
            }
        }
    });
    cv::blur(misses, misses, {kSide, kSide});
}

bool RestingScene::is_there(int x, int y) const {
    return misses_.at(x, y) < kMatches;
}

// Whether most of what is near shows what is known, and how closely.
void RestingScene::measure_noise(ViewF1 phi) {
    constexpr double kOfNear = 0.6;
    constexpr float kLeast_levels = 1.5f, kMost_levels = 6, kFollow = 0.3f, kOfMedian = 1.5f;
    std::vector<float> misses;
    std::size_t hits = 0;
    for (int y = 0; y < misses_.height(); y += 2) {
        for (int x = 0; x < misses_.width(); x += 2) {
            if (depth(phi, x, y) < -kNear_px * scale_.unit_px) continue;
            if (seen_[index_of(x, y)].frames == 0) continue;
            misses.push_back(misses_.at(x, y));
            hits += is_there(x, y) ? 1 : 0;
        }
    }
    if (misses.empty()) return;
    fits_ = static_cast<double>(hits) > kOfNear * static_cast<double>(misses.size());
    const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
    std::nth_element(misses.begin(), middle, misses.end());
    const float levels = noise_levels_ * kOfMedian * *middle;
    noise_levels_ += kFollow * (std::clamp(levels, kLeast_levels, kMost_levels) - noise_levels_);
}

float RestingScene::odds(const SurfacePalette& palette, int x, int y) const {
    std::array<std::uint8_t, 3> code{};
    const float* color = now_.pixel(x, y);
    std::transform(color, color + 3, code.begin(),
                   [](float v) { return static_cast<std::uint8_t>(v); });
    return palette.odds(code.data());
}

RestingScene::Verdict RestingScene::judged(int x, int y, float inside_px,
                                           const SurfacePalette& palette) const {
    const bool rests = is_there(x, y) && !passes(x, y);
    const Seen seen = seen_[index_of(x, y)];
    const bool is_like = odds(palette, x, y) > 0, is_sure = seen.frames >= kSure;
    if (inside_px > 0) {
        const bool leaves = rests ? is_sure && seen.inside < kUsuallyOutside
                                  : passes(x, y) && is_outside(place_of(x, y));
        return leaves && !is_like ? Verdict::kLeaves : Verdict::kAsFound;
    }
    if (!rests || seen.frames < kKnown) return Verdict::kAsFound;
    if (is_sure && seen.inside > kUsuallyInside) return Verdict::kReturns;
    if (seen.is_new) return is_like ? Verdict::kUncovered : Verdict::kAsFound;
    return seen.inside < kUsuallyOutside ? Verdict::kOther : Verdict::kAsFound;
}

// Whatever it shows: what passes there is none of it.
bool RestingScene::is_outside(Vec2i place) const {
    const ScenePlace* known = places_.known(place);
    return known && known->frames >= kSure && known->inside < kUsuallyOutside * known->frames;
}

// 255 where the scene has another word than phi.
Matte RestingScene::to_change(ViewF1 phi, const SurfacePalette& palette) const {
    constexpr float kBoundary_px = 1;
    constexpr double kAlone = 0.01;  // of the keyframe's matte comes back far from the rest
    Matte out(scale_.size), returns(scale_.size), uncovered(scale_.size), beside(scale_.size);
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float inside_px = depth(phi, x, y);
                if (inside_px > 0) beside.at(x, y) = static_cast<std::uint8_t>(Beside::kSurface);
                if (std::abs(inside_px) < kBoundary_px) continue;
                const Verdict verdict = judged(x, y, inside_px, palette);
                if (verdict == Verdict::kLeaves) out.at(x, y) = 255;
                if (verdict == Verdict::kReturns) returns.at(x, y) = 255;
                if (verdict == Verdict::kUncovered) uncovered.at(x, y) = 255;
                if (verdict == Verdict::kOther)
                    beside.at(x, y) = static_cast<std::uint8_t>(Beside::kOther);
            }
        }
    });
    keep_joined(returns, beside, kAlone * key_area_px_ / (scale_.step * scale_.step));
    keep_joined(uncovered, beside, std::numeric_limits<double>::infinity());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            if (returns.at(x, y) != 0 || uncovered.at(x, y) != 0) out.at(x, y) = 255;
    return out;
}

double RestingScene::leaving_blocks(const Matte& change, ViewF1 phi) const {
    double blocks = 0;
    for (int y = 0; y < change.height(); ++y)
        for (int x = 0; x < change.width(); ++x)
            blocks += change.at(x, y) != 0 && depth(phi, x, y) > 0 ? 1 : 0;
    return blocks;
}

// What is to be changed, by blocks, if the scene explains the frame.
Matte RestingScene::explain(ViewF1 phi, const SurfacePalette& palette) {
    constexpr float kForgotten = 0.5f;
    constexpr double kLeast_px = 100, kMostLeaves = 0.05;  // of 854×480; of the keyframe's matte
    const ImageF1 luma = luma_of(now_);
    fits_ = shows_anything(luma);
    if (!fits_) return {};
    stay_on_place(phi, luma);
    gain_ = scene_gain(expected_luma(), luma, moving_);
    compare();
    measure_noise(phi);
    Matte change;
    if (fits_) {
        change = returning_ = to_change(phi, palette);
        const double blocks = 1.0 / (scale_.step * scale_.step);
        keep_large(change,
                   blocks * kLeast_px * static_cast<double>(scale_.unit_px * scale_.unit_px));
        // Much of a surface does not leave it.
        fits_ = leaving_blocks(change, phi) < blocks * kMostLeaves * key_area_px_;
    }
    against_ = fits_ ? std::max(0.0f, against_ - kForgotten) : against_ + 1;
    return change;
}

Matte RestingScene::corrected(ViewU8x3 frame, ViewF1 phi, const FlowField& prev_from_cur,
                              const SurfacePalette& palette) {
    constexpr float kRefuted = 4;
    if (!rests_) return {};
    move(frame, prev_from_cur, phi);
    Matte change;
    if (fits_) change = explain(phi, palette);
    rests_ = against_ < kRefuted;
    if (!rests_) places_ = ScenePlaces({});  // they are the most of its memory
    if (!rests_ || !fits_) return {};
    bool any = false;
    for (int y = 0; y < change.height(); ++y) {
        for (int x = 0; x < change.width(); ++x) {
            const bool changes = change.at(x, y) != 0;
            if (changes || depth(phi, x, y) > 0) returning_.at(x, y) = 0;
            any = any || changes;
        }
    }
    if (!any) return {};
    Matte inside(phi.size());
    for (int y = 0; y < inside.height(); ++y) {
        for (int x = 0; x < inside.width(); ++x) {
            const bool changes = change.at(x / scale_.step, y / scale_.step) != 0;
            inside.at(x, y) = (phi.row(y)[x] > 0) != changes ? 255 : 0;
        }
    }
    return inside;
}

// The places that the frame can show.
Recti RestingScene::shown_places() const {
    const int w = scale_.size.width - 1, h = scale_.size.height - 1;
    Recti box;
    for (const Vec2i corner : {Vec2i(0, 0), Vec2i(w, 0), Vec2i(0, h), Vec2i(w, h)}) {
        const Vec2i p = place_of(corner.x, corner.y);
        box = box.united({p.x, p.y, p.x + 1, p.y + 1});
    }
    return box.grown(1).intersected(rect_of(places_.size()));
}

std::vector<Matte> RestingScene::remember(ViewF1 phi, const SurfacePalette& palette) {
    if (!rests_ || !fits_) {
        past_.forget();
        return {};
    }
    see_places(phi);
    return found_late(phi, palette);
}

std::vector<Matte> RestingScene::found_late(ViewF1 phi, const SurfacePalette& palette) {
    SceneView view{key_from_cur_, ImageF3(scale_.size), Matte(scale_.size), Matte(scale_.size)};
    parallel_rows(scale_.size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < scale_.size.width; ++x) {
                const Vec3 color = unlit(x, y);
                std::copy_n(&color.x, 3, view.colors.pixel(x, y));
                const float inside_px = depth(phi, x, y);
                if (inside_px > 0) view.inside.at(x, y) = 255;
                // What was given back for some frames only, wrongly, is not given back on more.
                const Seen& seen = seen_[index_of(x, y)];
                const bool sure = inside_px > 0 && is_there(x, y) && !passes(x, y) &&
                                  seen.frames >= kSure && seen.inside > 0.5f &&
                                  odds(palette, x, y) > 0;
                if (sure) view.sure.at(x, y) = 255;
            }
        }
    });
    return past_.advance(std::move(view), scale_, kMatches * noise_levels_);
}

void RestingScene::see_places(ViewF1 phi) {
    const glm::dmat3 cur_from_key = glm::inverse(key_from_cur_);
    const Recti shown = shown_places();
    parallel_rows(shown.height(), 16, [&](int y0, int y1) {
        for (int y = shown.y0 + y0; y < shown.y0 + y1; ++y) {
            for (int x = shown.x0; x < shown.x1; ++x) {
                const Vec2i at(x, y), key = at - places_.origin();
                const Vec2 p = mapped(cur_from_key, scale_.middle(key.x, key.y));
                if (!(p.x >= 0 && p.y >= 0 && p.x <= static_cast<float>(phi.width() - 1) &&
                      p.y <= static_cast<float>(phi.height() - 1)))
                    continue;
                const Vec2i b = Vec2i(p + 0.5f) / scale_.step;
                if (passes(b.x, b.y) || returning_.at(b.x, b.y) != 0) continue;
                const float inside_px = sample_bilinear(phi, p.x, p.y);
                if (std::abs(inside_px) < kClear_px) continue;
                places_.at(at).see({unlit(b.x, b.y), 1, inside_px > 0 ? 1.0f : 0.0f, is_key_},
                                   kMatches * noise_levels_, is_there(b.x, b.y));
            }
        }
    });
}

void RestingScene::correct(ViewU8x1 where, ViewU8x1 inside) {
    past_.forget();
    for (int y = 0; y < scale_.size.height; ++y) {
        for (int x = 0; x < scale_.size.width; ++x) {
            const Vec2i p = scale_.pixel(x, y), at = place_of(x, y);
            if (where.row(p.y)[p.x] != 0 && places_.has(at))
                places_.at(at).correct(inside.row(p.y)[p.x] != 0);
        }
    }
}

}  // namespace weft
