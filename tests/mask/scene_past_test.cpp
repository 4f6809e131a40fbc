// A wall by blocks, which a box passes from left to right.
#include "engine/mask/scene_past.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

const SceneScale& scale_of_past() {
    static const SceneScale scale(Size{240, 120});  // a pixel a block
    return scale;
}
constexpr int kBoxWidth = 40, kBoxStep = 6, kLaterBy = 3;  // px, px a frame, frames

int left_of_box(int frame) {
    return 30 + kBoxStep * frame;
}
bool is_boxed(int x, int frame, int width) {
    return x >= left_of_box(frame) && x < left_of_box(frame) + width;
}

// What the box uncovers is found kLaterBy frames later.
SceneView view_of(int frame, int width) {
    const Size size = scale_of_past().size;
    SceneView view{glm::dmat3(1), ImageF3(size), Matte(size), Matte(size)};
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const bool boxed = is_boxed(x, frame, width);
            const float code = boxed ? 60.0f : 200.0f + static_cast<float>((x + y) % 3);
            std::fill_n(view.colors.pixel(x, y), 3, code);
            const bool found =
                !boxed && (x >= left_of_box(frame) || x < left_of_box(frame - kLaterBy));
            if (!found) continue;
            view.inside.at(x, y) = view.sure.at(x, y) = 255;
        }
    }
    return view;
}

constexpr int kLastFrame = 8;

// What is found of each frame by the last one.
std::vector<Matte> found_late(int width) {
    ScenePast past;
    std::vector<Matte> of_frame(kLastFrame);
    for (int frame = 0; frame <= kLastFrame; ++frame) {
        auto late = past.advance(view_of(frame, width), scale_of_past(), 8);
        for (std::size_t k = 0; k < late.size(); ++k)
            if (!late[k].empty())
                of_frame[static_cast<std::size_t>(frame) - 1 - k] = std::move(late[k]);
    }
    return of_frame;
}

TEST(ScenePast, WhatIsUncoveredIsTheSurfaceFromTheFirstFrameThatShowsIt) {
    const std::vector<Matte> late = found_late(kBoxWidth);
    const int sure_to = left_of_box(kLastFrame - kLaterBy);  // on the last frame
    for (int frame = 0; frame < kLastFrame; ++frame) {
        const Matte& then = late[static_cast<std::size_t>(frame)];
        ASSERT_FALSE(then.empty()) << frame;
        for (int x = 0; x < then.width(); ++x) {
            const bool missed = x >= left_of_box(frame - kLaterBy) && x < left_of_box(frame);
            if (x == sure_to || x == left_of_box(frame)) continue;
            EXPECT_EQ(then.at(x, 60) != 0, missed && x < sure_to) << frame << ": " << x;
        }
    }
}

TEST(ScenePast, AThinThingThatPassesIsNotPaintedOver) {
    const std::vector<Matte> late = found_late(2);
    for (int frame = 0; frame < kLastFrame; ++frame) {
        const Matte& then = late[static_cast<std::size_t>(frame)];
        ASSERT_FALSE(then.empty()) << frame;
        EXPECT_EQ(then.at(left_of_box(frame), 60), 0) << frame;
        EXPECT_EQ(then.at(left_of_box(frame) + 1, 60), 0) << frame;
    }
}

TEST(ScenePast, StripsAlongTheBoundaryStayAsTheyWereFound) {
    ScenePast past;
    SceneView first = view_of(0, kBoxWidth), second = view_of(0, kBoxWidth);
    for (int y = 0; y < 120; ++y)  // two blocks less, right of the box
        for (int x : {70, 71})
            first.inside.at(x, y) = 0;
    static_cast<void>(past.advance(std::move(first), scale_of_past(), 8));
    const auto late = past.advance(std::move(second), scale_of_past(), 8);
    ASSERT_EQ(late.size(), 1u);
    EXPECT_EQ(late[0].at(70, 60), 0);
    EXPECT_EQ(late[0].at(71, 60), 0);
}

}  // namespace
}  // namespace weft
