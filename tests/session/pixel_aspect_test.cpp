// A plate whose pixels the project says are not square.
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

class SessionPixelAspect : public SessionByActions {
  protected:
    void say(ParameterValue aspect) {
        act(DoEdit{SetProjectParameter{"plate.pixel_aspect", std::move(aspect)}});
    }
    bool shows(double aspect) {
        return wait([&] {
            return view().plate.state == PlateView::State::kOpen && view().plate_picture &&
                   view().plate.pixel_aspect == aspect;
        });
    }
    // Of the region's matte on this frame.
    Recti painted() {
        EXPECT_TRUE(wait([&] { return view().mattes.size() == 1 && view().mattes[0].keep; }));
        Recti box{};
        const ViewU8x1& matte = view().mattes[0].pixels;
        for (int y = 0; y < matte.height(); ++y)
            for (int x = 0; x < matte.width(); ++x)
                if (matte.at(x, y) >= 128) box = box.united({x, y, x + 1, y + 1});
        return box;
    }
};

TEST_F(SessionPixelAspect, TheBrushIsRoundOnWhatIsSeen) {
    open();
    EXPECT_EQ(view().plate.pixel_aspect, 1);
    say(2.0);
    ASSERT_TRUE(shows(2));
    act(BeginStroke{pen(), {48, 32}, 1});
    act(EndStroke{});
    update();
    EXPECT_EQ(painted(), (Recti{44, 24, 52, 40}));
    act(Undo{});
    act(Undo{});
    ASSERT_TRUE(shows(1));
    act(BeginStroke{pen(), {48, 32}, 1});
    act(EndStroke{});
    update();
    EXPECT_EQ(painted(), (Recti{40, 24, 56, 40}));
}

TEST_F(SessionPixelAspect, TheTextureFollowsIt) {
    open();
    paint();
    act(ApplyTexture{in("tile.png"), 0});
    ASSERT_TRUE(wait([&] { return view().result_current; })) << view().preview.error;
    say(2.0);
    ASSERT_TRUE(shows(2));
    ASSERT_TRUE(wait([&] {
        const auto places = view().stages.places.find(region().id);
        return view().result_current && places != view().stages.places.end() &&
               places->second->at({30, 30}).x > 50;
    }));
    EXPECT_EQ(view().stages.places.at(region().id)->at({30, 30}), Vec2(60, 30));
}

}  // namespace
}  // namespace weft::test
