#include "engine/motion/outline_owner.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kOwnerFrame{200, 160};

struct Scene {
    Matte luma, extent;
    FlowField raw{kOwnerFrame};
};

// A window of a surface; around it everything moves by `outside`, and it by `inside`.
Scene scene(Vec2 inside, Vec2 outside, bool structure) {
    const WaveTexture texture(3);
    Scene out;
    out.extent = draw(kOwnerFrame, [](Vec2 p) {
        return std::abs(p.x - 100) < 50 && std::abs(p.y - 80) < 40 ? 1.0f : 0.0f;
    });
    out.luma = draw(kOwnerFrame, [&](Vec2 p) { return structure ? texture(p) : 0.5f; });
    for (int y = 0; y < kOwnerFrame.height; ++y) {
        for (int x = 0; x < kOwnerFrame.width; ++x) {
            const Vec2 d = out.extent.at(x, y) >= 128 ? inside : outside;
            out.raw.d.pixel(x, y)[0] = d.x, out.raw.d.pixel(x, y)[1] = d.y;
            out.raw.valid.at(x, y) = 255;
        }
    }
    return out;
}

TEST(OutlineOwner, AnEdgeThatMovesWithItsOutsideIsAnOccluders) {
    const Vec2 still(0, 0), moves(-3, -3);
    const Scene behind = scene(still, moves, true);
    EXPECT_GT(occluded_share(behind.luma, behind.extent, moved_by(kOwnerFrame, moves),
                             moved_by(kOwnerFrame, still), behind.raw),
              0.9);
    // The same edge, standing still with its inside.
    EXPECT_EQ(occluded_share(behind.luma, behind.extent, moved_by(kOwnerFrame, still),
                             moved_by(kOwnerFrame, still), behind.raw),
              0);
}

TEST(OutlineOwner, SaysNothingWhereNothingCanBeTold) {
    const Vec2 still(0, 0), moves(-3, -3);
    // A flat fill outside moves with the nearest line.
    const Scene flat = scene(still, moves, false);
    EXPECT_EQ(occluded_share(flat.luma, flat.extent, moved_by(kOwnerFrame, moves),
                             moved_by(kOwnerFrame, still), flat.raw),
              0);
    const Scene together = scene(moves, moves, true);
    EXPECT_EQ(occluded_share(together.luma, together.extent, moved_by(kOwnerFrame, moves),
                             moved_by(kOwnerFrame, moves), together.raw),
              0);
}

}  // namespace
}  // namespace weft
