// What is seen while a setting is dragged: pictures of the way, and at its end the exact one.
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

class Dragging : public SessionByActions {
  protected:
    void SetUp() override {
        SessionByActions::SetUp();
        open();
        paint();
        act(ApplyTexture{in("tile.png"), 0});
        ASSERT_TRUE(wait([&] { return view().result_current; })) << view().preview.error;
    }
    [[nodiscard]] static std::vector<CorrectionPin> pin_moved_by(double px) {
        return {{{40, 32}, {40 + px, 32}}};
    }
    // One frame of the window, in real time.
    void next_frame() {
        constexpr int kFrameMs = 2;
        session_->update(now_s_ += 1e-3 * kFrameMs);
        std::this_thread::sleep_for(std::chrono::milliseconds(kFrameMs));
    }
};

TEST_F(Dragging, APinMovesTheTextureWhileTheMouseMoves) {
    const RegionRef wall{region().id, {}};
    const int frame = view().frame;
    const PicturePtr before = view().result_picture;
    int pictures = 0;
    PicturePtr last = before;
    // The mouse never rests as long as it takes to make a picture.
    for (int k = 0; k < 20'000 && pictures < 3; ++k) {
        act(TryEdit{SetCorrection{wall, frame, pin_moved_by(0.01 * (k % 400))}});
        next_frame();
        if (view().result_picture == last) continue;
        last = view().result_picture;
        ++pictures;
    }
    EXPECT_EQ(pictures, 3);
    act(DoEdit{SetCorrection{wall, frame, pin_moved_by(3)}});
    update();
    EXPECT_FALSE(view().result_current);
    EXPECT_TRUE(wait([&] { return view().result_current; })) << view().preview.error;
}

}  // namespace
}  // namespace weft::test
