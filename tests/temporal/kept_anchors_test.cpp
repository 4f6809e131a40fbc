#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kBentFrame{240, 160};
constexpr Vec2 kElsewhere{1.2f, 0};
constexpr Recti kArm{100, 50, 160, 110};

// A surface that bends: where what the second frame shows was on the first one.
Vec2 bent(Vec2 p) {
    return {0, 2.5f * std::sin(p.x / 25)};
}

// On the first frame something in front of it hides a part, with what the surface shows
// 1.2 px beside.
std::shared_ptr<const StepFrame> bent_frame(bool first) {
    const WaveTexture texture(3);
    const Matte luma = draw(kBentFrame, [&](Vec2 p) {
        if (!first) return texture(p + bent(p));
        const bool arm = kArm.contains(static_cast<int>(p.x), static_cast<int>(p.y));
        return texture(arm ? p + kElsewhere : p);
    });
    const Matte all(kBentFrame, 255);
    return std::make_shared<const StepFrame>(luma, all, all);
}

// How far the middle of what was hidden is drawn aside on the next frame, which is followed
// rightly.
float drawn_aside(bool keep) {
    SurfaceWalkerOptions options;
    options.kind = SurfaceKind::kCloth;
    SurfaceWalker walker(bent_frame(true), options);
    if (keep) {
        Matte others(kBentFrame, 255);
        for (int y = kArm.y0; y < kArm.y1; ++y) {
            for (int x = kArm.x0; x < kArm.x1; ++x)
                others.at(x, y) = 0;
        }
        walker.keep_on_anchors(others);
    }
    StepEvidence step;
    step.by_picture = LatticeField(kBentFrame, options.spacing_px);
    for (int j = 0; j < step.by_picture.nodes().height(); ++j) {
        for (int i = 0; i < step.by_picture.nodes().width(); ++i)
            step.by_picture.set_node(i, j, bent(step.by_picture.node_position(i, j)));
    }
    walker.advance(WalkStep{bent_frame(false), step});
    constexpr Vec2 kMiddle{130, 80};
    return distance(walker.ref_from_cur().at(kMiddle), bent(kMiddle));
}

TEST(KeptAnchors, WhatIsNotTheSurfacesDrawsNothingAside) {
    EXPECT_GT(drawn_aside(false), 0.4f) << "as long as it is taken for the surface";
    EXPECT_LT(drawn_aside(true), 0.15f);
}

}  // namespace
}  // namespace weft
