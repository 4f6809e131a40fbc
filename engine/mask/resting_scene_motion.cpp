// How a resting scene lies on a frame: where its places are, and what moves over them.
#include <glm/mat3x3.hpp>
#include <utility>

#include "engine/mask/resting_scene.h"
#include "engine/mask/scene_picture.h"
#include "engine/motion/resting_view.h"

namespace weft {

// What is blank says nothing of its motion; what is measured there is that of what passes.
std::optional<Vec2> RestingScene::rests_as_on_key(ViewU8x3 frame, ViewF1 phi) const {
    Matte inside(phi.size());
    for (int y = 0; y < inside.height(); ++y)
        for (int x = 0; x < inside.width(); ++x)
            inside.at(x, y) = phi.row(y)[x] > 0 ? 255 : 0;
    constexpr double kMostly = 0.6;
    const Matte luma = luma_codes(frame);
    if (blank_share(luma, inside) <= kMostly) return std::nullopt;
    return rests_in_view(key_luma_, luma, inside);
}

// Nothing moves by which nothing changes.
void RestingScene::keep_resting(Vec2 shift, const ImageF3& before, Matte moving) {
    for (int y = 0; y < moving.height(); ++y) {
        for (int x = 0; x < moving.width(); ++x) {
            const float change = color_difference(color_at(now_, x, y), color_at(before, x, y));
            if (change < kMatches * noise_levels_) moving.at(x, y) = 0;
        }
    }
    moving_ = std::move(moving);
    key_from_cur_ = glm::dmat3(1);
    key_from_cur_[2] = {shift.x, shift.y, 1};
    fits_ = true;
}

void RestingScene::move(ViewU8x3 frame, const FlowField& prev_from_cur, ViewF1 phi) {
    // What comes close in front may fill most of the surroundings for a while.
    constexpr float kInFront = 0.25f;
    const ImageF3 before = std::exchange(now_, reduced_floats(frame, scale_.step));
    SceneStep step = scene_step(prev_from_cur, phi, scale_);
    fits_ = step.surface == SceneMotion::kRests && step.around == SceneMotion::kRests;
    const auto at_rest =
        !fits_ && !step.moving.empty() ? rests_as_on_key(frame, phi) : std::optional<Vec2>();
    if (at_rest) {
        keep_resting(*at_rest, before, std::move(step.moving));
        return;
    }
    if (step.surface == SceneMotion::kMoves)
        against_ += 1;
    else if (step.around == SceneMotion::kMoves)
        against_ += kInFront;
    key_from_cur_ = key_from_cur_ * step.prev_from_cur;
    if (fits_) moving_ = std::move(step.moving);
}

// Steps add up to a drift: the frame is laid on what is known of the surface and what is near it.
void RestingScene::stay_on_place(ViewF1 phi, const ImageF1& luma) {
    Matte known(scale_.size);
    const ImageF1 expected = expected_luma();
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            const bool near = depth(phi, x, y) > -kNear_px * scale_.unit_px && !passes(x, y);
            known.at(x, y) = near && expected.at(x, y) > 0 ? 255 : 0;
        }
    }
    if (const auto shift = expected_from_cur(expected, luma, known, scale_))
        key_from_cur_ = key_from_cur_ * *shift;
}

}  // namespace weft
