#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/temporal/surface_walker.h"
#include "tests/temporal/jointed_scene.h"

namespace weft {
namespace {

constexpr int kLast = 9;

class Walk {
  public:
    explicit Walk(const JointedScene& scene)
        : scene_(scene), last_(scene.frame(0, nullptr)), walker(last_, {}) {}

    // `shown`: of the frames' mattes; empty: all of it.
    void go_to(int last, const Matte& shown = {}) {
        while (at_ < last) {
            ++at_;
            auto cur = scene_.frame(at_, last_.get());
            if (!shown.empty()) cur = cur->part(shown, last_.get());
            StepEvidence evidence =
                gather_evidence(*last_, *cur, scene_.flow(at_), FlowQuality::kFinal, 8);
            evidence.raw = std::make_shared<const FlowField>(scene_.flow(at_));
            walker.advance(WalkStep{cur, evidence});
            last_ = std::move(cur);
        }
    }

  private:
    const JointedScene& scene_;
    std::shared_ptr<const StepFrame> last_;
    int at_ = 0;

  public:
    SurfaceWalker walker;
};

// Whether the pixels around are of the same part.
bool is_inner(const JointedScene& scene, Vec2 p, int t) {
    constexpr float kBeside_px = 4;
    const bool arm = scene.in_arm(p, t);
    for (const Vec2 d :
         {Vec2(kBeside_px, 0), Vec2(-kBeside_px, 0), Vec2(0, kBeside_px), Vec2(0, -kBeside_px)}) {
        if (scene.in_arm(p + d, t) != arm) return false;
    }
    return true;
}

// The 90 % quantile of by how much the positions on the reference frame are off, of what is seen
// there on frame `t` and `belongs`.
template <class Belongs>
float most_off(const JointedScene& scene, const LatticeField& ref_from_cur, int t, bool arm,
               const Belongs& belongs) {
    const Vec2 back = arm ? -scene.of_arm(t) : -JointedScene::of_body(t);
    std::vector<float> off;
    for (int y = 20; y < 156; ++y) {
        for (int x = 34; x < 212; ++x) {
            const Vec2 p = centre_of(x, y);
            if (is_inner(scene, p, t) && scene.in_arm(p, t) == arm && belongs(p))
                off.push_back(distance(ref_from_cur.at(p), back));
        }
    }
    std::sort(off.begin(), off.end());
    return off.empty() ? 1e6f : off[off.size() * 9 / 10];
}

TEST(JointedParts, AnArmAndWhatItUncoversAreFollowedEachByItself) {
    const JointedScene scene;
    Walk walk(scene);
    walk.go_to(kLast);
    EXPECT_EQ(walk.walker.part_count(), 2);
    const LatticeField& field = walk.walker.ref_from_cur();
    EXPECT_LT(most_off(scene, field, kLast, true, [](Vec2) { return true; }), 0.5f);
    EXPECT_LT(most_off(scene, field, kLast, false, [](Vec2) { return true; }), 0.5f);
    // The arm was in front of it for several frames.
    EXPECT_LT(most_off(scene, field, kLast, false,
                       [&](Vec2 p) { return scene.in_arm(p, 5) && !scene.in_arm(p, 0); }),
              1.0f);
}

TEST(JointedParts, OneMotionHasNoParts) {
    // The arm moves as far as the registration of one surface reaches.
    const JointedScene scene(0.5f);
    Walk walk(scene);
    walk.go_to(3);
    EXPECT_EQ(walk.walker.part_count(), 0);
    EXPECT_EQ(walk.walker.ref_from_cur().spacing(), 8);
}

TEST(JointedParts, APartThatHasAllButGoneIsTheBodysAgain) {
    const JointedScene scene;
    Walk walk(scene);
    walk.go_to(3);
    ASSERT_EQ(walk.walker.part_count(), 2);
    // Something else is in front of the arm and leaves a few pixels of it.
    Matte shown = scene.matte(4);
    for (int y = 0; y < shown.height(); ++y) {
        for (int x = 0; x < shown.width(); ++x)
            if (scene.in_arm(centre_of(x, y), 4) && (x > 106 || y > 66)) shown.at(x, y) = 0;
    }
    walk.go_to(4, shown);
    EXPECT_EQ(walk.walker.part_count(), 1) << "the body";
    for (const Vec2 p : {Vec2(60, 90), Vec2(190, 120), Vec2(104, 62)})
        EXPECT_LT(distance(walk.walker.ref_from_cur().at(p), -JointedScene::of_body(4)), 1.0f);
}

TEST(JointedParts, ACopyWalksOnByItself) {
    const JointedScene scene;
    Walk walk(scene);
    walk.go_to(3);
    Walk copy = walk;
    walk.go_to(6);
    copy.go_to(6);
    EXPECT_EQ(walk.walker.ref_from_cur().nodes(), copy.walker.ref_from_cur().nodes());
}

TEST(JointedParts, APlacementMovesAllParts) {
    const JointedScene scene;
    Walk walk(scene);
    walk.go_to(3);
    LatticeField placed = walk.walker.ref_from_cur();
    for (int j = 0; j < placed.nodes().height(); ++j) {
        for (int i = 0; i < placed.nodes().width(); ++i)
            placed.set_node(i, j, placed.node(i, j) + Vec2(2, -1));
    }
    walk.walker.anchor_here(&placed);
    for (const Vec2 p : {Vec2(124, 75), Vec2(60, 90), Vec2(190, 120)})
        EXPECT_LT(distance(walk.walker.ref_from_cur().at(p), placed.at(p)), 0.05f);
    walk.go_to(5);
    const Vec2 arm(124, 85), body(60, 90);
    EXPECT_LT(distance(walk.walker.ref_from_cur().at(arm), Vec2(2, -1) - scene.of_arm(5)), 0.5f);
    EXPECT_LT(distance(walk.walker.ref_from_cur().at(body), Vec2(2, -1) - JointedScene::of_body(5)),
              0.5f);
}

TEST(JointedParts, AHeldDrawingKeepsThem) {
    const JointedScene scene;
    Walk walk(scene);
    walk.go_to(3);
    const ImageF2 before = walk.walker.ref_from_cur().nodes();
    walk.walker.hold();
    EXPECT_EQ(walk.walker.ref_from_cur().nodes(), before);
    EXPECT_EQ(walk.walker.prev_from_cur().at({60, 90}), Vec2(0));
}

}  // namespace
}  // namespace weft
