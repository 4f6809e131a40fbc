#pragma once
// A body with an arm in front of it, painted as one.

#include <array>
#include <memory>

#include "engine/motion/optical_flow.h"
#include "engine/temporal/step_motion.h"
#include "tests/motion/pictures.h"

namespace weft {

/// A textured body that moves to the right by a pixel a frame, and a bar in front of it that moves
/// down along it. Both have the same kind of paint.
class JointedScene {
  public:
    static constexpr Size kFrame{256, 176};
    static constexpr float kBody_px = 1, kArm_px = 7;

    explicit JointedScene(float arm_px = kArm_px) : arm_px_(arm_px) {}

    [[nodiscard]] static Vec2 of_body(int t) { return {kBody_px * static_cast<float>(t), 0}; }
    [[nodiscard]] Vec2 of_arm(int t) const { return {0, arm_px_ * static_cast<float>(t)}; }
    [[nodiscard]] bool in_arm(Vec2 p, int t) const {
        const Vec2 q = p - of_arm(t);
        return q.x > 100 && q.x < 148 && q.y > 30 && q.y < 78;
    }
    [[nodiscard]] static bool in_body(Vec2 p, int t) {
        const Vec2 q = p - of_body(t);
        return q.x > 30 && q.x < 216 && q.y > 16 && q.y < 160;
    }

    [[nodiscard]] ImageU8x3 display(int t) const {
        ImageU8x3 out(kFrame);
        for (int y = 0; y < kFrame.height; ++y) {
            for (int x = 0; x < kFrame.width; ++x) {
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = code_of(value(centre_of(x, y), t, c));
            }
        }
        return out;
    }
    [[nodiscard]] Matte matte(int t) const {
        return draw(kFrame, [&](Vec2 p) { return in_body(p, t) || in_arm(p, t) ? 1.0f : 0.0f; });
    }
    [[nodiscard]] std::shared_ptr<const StepFrame> frame(int t, const StepFrame* before) const {
        const ImageU8x3 picture = display(t);
        return std::make_shared<const StepFrame>(luma_of(picture), matte(t), matte(t),
                                                 std::make_shared<const ImageU8x3>(picture),
                                                 before);
    }
    /// prev_from_cur of frame `t` as the pictures show it.
    [[nodiscard]] FlowField flow(int t) const {
        const Matte cur = luma_of(display(t)), prev = luma_of(display(t - 1));
        FlowPair found = estimate_flows(cur, prev, FlowQuality::kFinal);
        check_consistency(found.b_from_a, found.a_from_b);
        return found.b_from_a;
    }

  private:
    [[nodiscard]] float value(Vec2 p, int t, int c) const {
        const auto k = static_cast<std::size_t>(c);
        if (in_arm(p, t)) return arm_[k](p - of_arm(t));
        return in_body(p, t) ? body_[k](p - of_body(t)) : 0.3f + 0.4f * wall_(p);
    }
    [[nodiscard]] static Matte luma_of(const ImageU8x3& picture) {
        Matte out(picture.size());
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const std::uint8_t* p = picture.pixel(x, y);
                out.at(x, y) = static_cast<std::uint8_t>((p[0] + p[1] + p[2]) / 3);
            }
        }
        return out;
    }

    float arm_px_;
    std::array<WaveTexture, 3> body_{WaveTexture(1), WaveTexture(2), WaveTexture(3)};
    std::array<WaveTexture, 3> arm_{WaveTexture(4), WaveTexture(5), WaveTexture(6)};
    WaveTexture wall_{7};
};

}  // namespace weft
