// Edge tools in the session: shown at once, kept out of what is painted and frozen.
#include <cstdio>

#include "engine/mask/matte_edge.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"
#include "tests/session/session_fixture.h"

namespace weft::test {
namespace {

double area(ViewU8x1 matte) {
    double sum = 0;
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            sum += matte.row(y)[x] / 255.0;
    return sum;
}

class MatteEdges : public SessionByActions {
  protected:
    void open_painted() {
        open();
        paint();
        ASSERT_TRUE(wait([&] { return view().mattes.size() == 1 && view().mattes[0].keep; }));
    }
    [[nodiscard]] Edit choke(double px) const {
        return SetRegionParameter{{region().id, {}}, "matte.choke_px", px};
    }
};

TEST_F(MatteEdges, AreShownAndLeaveTheMatteItself) {
    open_painted();
    const MattePtr before = view().mattes[0].keep;
    const double plain = area(view().mattes[0].pixels);
    act(TryEdit{choke(3)});
    ASSERT_TRUE(wait([&] { return view().mattes[0].edged != nullptr; }));
    EXPECT_GT(area(view().mattes[0].pixels), plain + 20);
    EXPECT_EQ(view().mattes[0].keep, before);
    // While a slider moves, the last edge that was made stays shown.
    for (const double px : {3.1, 3.2, 3.3, 6.0}) {
        act(TryEdit{choke(px)});
        update();
        EXPECT_NE(view().mattes[0].edged, nullptr);
    }
    const double wanted = area(with_edge(*before, {.choke_px = 6}));
    EXPECT_TRUE(wait([&] { return area(view().mattes[0].pixels) == wanted; }));
    act(DoEdit{choke(6)});
    act(Undo{});
    update();
    EXPECT_EQ(view().mattes[0].edged, nullptr);
    EXPECT_EQ(area(view().mattes[0].pixels), plain);
}

TEST_F(MatteEdges, AreExportedAndNotFrozen) {
    open_painted();
    act(DoEdit{choke(3)});
    const int frame = view().frame;
    const MattePtr painted = view().mattes[0].keep;
    act(MarkRange{frame, frame});
    const std::string out = in("out.####.png");
    act(ExportMattes{out});
    char name[16];
    std::snprintf(name, sizeof name, "out.%04d.png", frame);
    ASSERT_TRUE(wait([&] { return fs::exists(in(name)); }));
    const auto written = read_matte(in(name), {}, painted->size());
    ASSERT_TRUE(written);
    EXPECT_EQ(*written, with_edge(*painted, {.choke_px = 3}));
    act(FreezeMattes{true});
    ASSERT_TRUE(wait([&] { return !region().matte->frozen.empty(); }));
    const auto pattern = SequencePattern::parse(region().matte->frozen_files);
    ASSERT_TRUE(pattern);
    const auto frozen = read_matte(pattern->path_for(frame), {}, painted->size());
    ASSERT_TRUE(frozen) << frozen.error().text();
    EXPECT_EQ(*frozen, *painted);
}

}  // namespace
}  // namespace weft::test
