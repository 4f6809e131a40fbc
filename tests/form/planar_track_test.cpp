#include "engine/form/planar_track.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

namespace weft {
namespace {

constexpr Size kTrackPlate{200, 120};

std::vector<Vec2> places() {
    std::vector<Vec2> out;
    for (int y = 30; y <= 90; y += 6)
        for (int x = 40; x <= 160; x += 6)
            out.emplace_back(x, y);
    return out;
}

constexpr Quad<double> kBox{{{40, 30}, {160, 30}, {160, 90}, {40, 90}}};
constexpr Quad<double> kFloor{{{60, 34}, {140, 30}, {170, 100}, {30, 96}}};

TEST(PlanarTracker, FindsAPlanesMotion) {
    PlanarTracker tracker(places());
    ASSERT_TRUE(tracker.add(1, plane_motion(kBox, kBox, kTrackPlate, 8)));
    ASSERT_TRUE(tracker.add(2, plane_motion(kBox, kFloor, kTrackPlate, 8)));
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_LT(glm::distance(tracker.track().at(1)[k], kBox[k]), 0.05);
        EXPECT_LT(glm::distance(tracker.track().at(2)[k], kFloor[k]), 0.3);
    }
}

// A corner that something else moved does not bend the plane.
TEST(PlanarTracker, LeavesOutWhatMovesOtherwise) {
    LatticeField motion = plane_motion(kBox, kFloor, kTrackPlate, 8);
    for (int j = 0; j < motion.nodes().height(); ++j)
        for (int i = 0; i < motion.nodes().width(); ++i) {
            const Vec2 at = motion.node_position(i, j);
            if (at.x > 135 && at.y > 60) motion.set_node(i, j, {-40, 25});
        }
    PlanarTracker tracker(places());
    ASSERT_TRUE(tracker.add(2, motion));
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LT(glm::distance(tracker.track().at(2)[k], kFloor[k]), 4) << k;
}

TEST(PlanarTracker, RefusesWhatIsNoPlane) {
    PlanarTracker few({{10, 10}, {20, 10}, {20, 20}});
    const Status small = few.add(1, LatticeField(kTrackPlate, 8));
    ASSERT_FALSE(small);
    EXPECT_NE(small.error().sentence().find("too small"), std::string::npos);
    LatticeField folded(kTrackPlate, 8);
    for (int j = 0; j < folded.nodes().height(); ++j)
        for (int i = 0; i < folded.nodes().width(); ++i) {
            const Vec2 at = folded.node_position(i, j);
            folded.set_node(i, j, {100 - at.x, 60 - at.y});
        }
    PlanarTracker tracker(places());
    EXPECT_FALSE(tracker.add(7, folded));
    EXPECT_TRUE(tracker.track().empty());
}

}  // namespace
}  // namespace weft
