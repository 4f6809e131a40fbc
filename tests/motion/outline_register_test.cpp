#include "engine/motion/outline_register.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kShieldFrame{320, 240};

// A flat shield in its own coordinates, and an arm that swings over it in the picture's.
float shield(Vec2 q) {
    return std::max(std::abs(q.x) - 60 - 0.15f * q.y, std::abs(q.y) - 70);
}
bool arm(Vec2 p, float turn) {
    const Vec2 q = p - Vec2(185, 60);
    const float along = q.x * std::sin(turn) + q.y * std::cos(turn);
    const float aside = q.x * std::cos(turn) - q.y * std::sin(turn);
    return along > 0 && along < 120 && std::abs(aside) < 14;
}

struct Drawing {
    Matte luma, extent, visible;
    [[nodiscard]] OutlineShape shape() const { return OutlineShape({luma, extent, visible}); }
};

// `material`: where a place of the picture lies on the shield. Inside there is one belt and one
// fold, too little for any window.
template <class F>
Drawing draw_one(const F& material, float turn) {
    Drawing out;
    out.extent = draw(kShieldFrame, [&](Vec2 p) { return shield(material(p)) < 0 ? 1.0f : 0.0f; });
    out.visible = out.extent;
    out.luma = draw(kShieldFrame, [&](Vec2 p) {
        const Vec2 q = material(p);
        if (arm(p, turn)) return 0.8f;
        if (shield(q) > 0) return 0.3f + 0.3f * std::sin(p.x / 9);
        const bool ink = std::abs(q.y - 20) < 1.5f || std::abs(q.x - 0.2f * q.y + 25) < 1.2f;
        return ink ? 0.1f : 0.55f;
    });
    for (int y = 0; y < kShieldFrame.height; ++y) {
        for (int x = 0; x < kShieldFrame.width; ++x) {
            if (arm(centre_of(x, y), turn)) out.visible.at(x, y) = 0;
        }
    }
    return out;
}

// Mean error of prev_from_cur over the extent, `prev_at` saying where the material was.
template <class F, class G>
float mean_material_error(const LatticeField& field, const Drawing& cur, const F& material,
                          const G& prev_at) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < kShieldFrame.height; y += 3) {
        for (int x = 0; x < kShieldFrame.width; x += 3) {
            if (cur.extent.at(x, y) < 128) continue;
            const Vec2 p = centre_of(x, y);
            sum += distance(p + field.at(p), prev_at(material(p)));
            ++count;
        }
    }
    return static_cast<float>(sum / count);
}

TEST(OutlineRegister, FollowsAFlatShapeUnderASwingingArm) {
    const auto before = [](Vec2 p) { return p - Vec2(150, 120); };
    // Moved, turned by 4 degrees and stretched.
    const auto after = [](Vec2 p) {
        const Vec2 q = p - Vec2(159, 116);
        return Vec2((0.9976f * q.x + 0.0698f * q.y) / 1.04f, -0.0698f * q.x + 0.9976f * q.y);
    };
    const Drawing prev = draw_one(before, 0.2f), cur = draw_one(after, -0.3f);
    const LatticeField still(kShieldFrame, 8);
    const auto prev_at = [](Vec2 q) { return q + Vec2(150, 120); };
    EXPECT_GT(mean_material_error(still, cur, after, prev_at), 7.0f);
    const LatticeField found = register_outline(prev.shape(), cur.shape(), still);
    EXPECT_LT(mean_material_error(found, cur, after, prev_at), 0.25f);
}

TEST(OutlineRegister, BendsWhereNoPlaneFits) {
    const auto before = [](Vec2 p) { return p - Vec2(150, 120); };
    const auto after = [](Vec2 p) {
        const Vec2 q = p - Vec2(154, 120);
        return q - Vec2(9 * std::sin(q.y / 30), 0);
    };
    const Drawing prev = draw_one(before, 0.2f), cur = draw_one(after, 0.2f);
    const LatticeField still(kShieldFrame, 8);
    const auto prev_at = [](Vec2 q) { return q + Vec2(150, 120); };
    const float unmoved = mean_material_error(still, cur, after, prev_at);
    const LatticeField found = register_outline(prev.shape(), cur.shape(), still);
    EXPECT_LT(mean_material_error(found, cur, after, prev_at), 0.25f * unmoved);
}

TEST(OutlineRegister, FindsAShapeThatTurnedFar) {
    const auto before = [](Vec2 p) { return p - Vec2(150, 120); };
    constexpr float kCos = 0.5f, kSin = 0.8660254f;  // 60°
    const auto after = [](Vec2 p) {
        const Vec2 q = p - Vec2(185, 110);
        return Vec2(kCos * q.x + kSin * q.y, -kSin * q.x + kCos * q.y);
    };
    const Drawing prev = draw_one(before, 0.2f), cur = draw_one(after, 0.2f);
    const auto prev_at = [](Vec2 q) { return q + Vec2(150, 120); };
    const LatticeField still(kShieldFrame, 8);
    EXPECT_GT(mean_material_error(still, cur, after, prev_at), 40.0f);
    EXPECT_LT(mean_material_error(register_outline(prev.shape(), cur.shape(), still), cur, after,
                                  prev_at),
              0.5f);
    // Nor is an estimate needed.
    EXPECT_LT(
        mean_material_error(register_outline(prev.shape(), cur.shape(), 8), cur, after, prev_at),
        0.5f);
}

// A flag: what bends between its corners is not where the bends were.
TEST(OutlineRegister, KeepsTheCornersOfAFlagOnItsCorners) {
    constexpr float kAmplitude = 26;
    const auto waves = [](float phase) {
        return [phase](Vec2 p) {
            const Vec2 q = p - Vec2(160, 120);
            return q - Vec2(0, kAmplitude * std::sin(q.x / 32 + phase));
        };
    };
    const auto flag = [](const auto& material) {
        Drawing out;
        out.extent = draw(kShieldFrame, [&](Vec2 p) {
            const Vec2 q = material(p);
            return std::abs(q.x) < 95 && std::abs(q.y) < 45 ? 1.0f : 0.0f;
        });
        out.visible = out.extent;
        out.luma = draw(kShieldFrame, [&](Vec2 p) {
            const Vec2 q = material(p);
            return std::abs(q.x) < 95 && std::abs(q.y) < 45 ? 0.55f : 0.3f;
        });
        return out;
    };
    const auto before = waves(0), after = waves(1.6f);
    const Drawing prev = flag(before), cur = flag(after);
    const auto prev_at = [](Vec2 q) {
        return q + Vec2(160, 120 + kAmplitude * std::sin(q.x / 32));
    };
    const LatticeField still(kShieldFrame, 8);
    EXPECT_GT(mean_material_error(still, cur, after, prev_at), 20.0f);
    EXPECT_LT(mean_material_error(register_outline(prev.shape(), cur.shape(), still), cur, after,
                                  prev_at),
              4.0f);
}

// The walk registers a frame while its step to the next one is prepared.
TEST(OutlineRegister, AShapeServesSeveralThreads) {
    const auto before = [](Vec2 p) { return p - Vec2(150, 120); };
    const auto after = [](Vec2 p) { return p - Vec2(157, 116); };
    const Drawing prev = draw_one(before, 0.2f), cur = draw_one(after, -0.3f);
    const LatticeField alone = register_outline(prev.shape(), cur.shape(), 8);
    const OutlineShape a = prev.shape(), b = cur.shape();
    std::vector<LatticeField> found(8);
    std::vector<std::thread> threads;
    for (LatticeField& field : found)
        threads.emplace_back([&] { field = register_outline(a, b, 8); });
    for (std::thread& thread : threads)
        thread.join();
    for (const LatticeField& field : found)
        EXPECT_EQ(field.nodes(), alone.nodes());
}

TEST(OutlineRegister, WithoutAShapeNothingIsChanged) {
    const Matte empty(kShieldFrame);
    LatticeField initial(kShieldFrame, 8);
    initial.set_node(5, 5, {1, 2});
    const LatticeField out = register_outline(OutlineShape({empty, empty, empty}),
                                              OutlineShape({empty, empty, empty}), initial);
    EXPECT_EQ(out.nodes(), initial.nodes());
}

}  // namespace
}  // namespace weft
