// How long an artist waits for the first picture on the demo shot. Disabled: a measurement, not a
// test. Run it with --gtest_also_run_disabled_tests --gtest_filter='*FirstPicture*'.
#include "tests/preview/waits.h"
#include "tests/support/places.h"

namespace weft {
namespace {

std::string demo(const std::string& path) {
    return test::source_folder() + "/assets/demo/" + path;
}

class FirstPicture : public Waits {
  protected:
    void SetUp() override { open(demo("demo.weft"), 1001, 1048, 1001); }
    void keep_regions(std::size_t count) { request_.project.regions.resize(count); }
    void keep_only(std::size_t region) {
        request_.project.regions = {request_.project.regions[region]};
    }
};

TEST_F(FirstPicture, DISABLED_OfTheDemoWithAnEmptyCache) {
    measure("demo, empty cache");
}

TEST_F(FirstPicture, DISABLED_OfAnotherTexture) {
    keep_regions(1);
    request_.range = {1001};
    measure("wall, empty cache");
    change([](Region& r) { r.texture.sample = demo("textures/knit.png"); });
    measure("another texture on an analysed shot");
}

TEST_F(FirstPicture, DISABLED_OfThreeRegions) {
    request_.frame = 1038;
    measure("three regions on frame 1038");
}

TEST_F(FirstPicture, DISABLED_OfAMovedPin) {
    keep_only(1);
    request_.frame = 1030;
    measure("cape, empty cache");
    for (const double moved : {5.0, 9.0}) {
        change([&](Region& r) { r.corrections[1030] = {{{480, 300}, {480 + moved, 300}}}; });
        measure("a pin moved");
    }
}

// A stroke on frame 1030 between two keyframes, and the mattes of the frames beside it.
TEST_F(FirstPicture, DISABLED_OfAStroke) {
    keep_only(1);
    const auto paint = [&](const std::vector<int>& frames) {
        change([&](Region& r) {
            MatteSource matte;
            for (const int frame : frames)
                matte.keyframes[frame].path = demo("mattes/cape/" + std::to_string(frame) + ".png");
            r.matte = Leaf<MatteSource>(matte);
        });
    };
    paint({1020, 1040});
    request_.frame = 1030;
    measure("cape of two keyframes");
    paint({1020, 1030, 1040});
    measure_mattes({1030, 1031, 1029});
    measure("a stroke");
}

TEST_F(FirstPicture, DISABLED_OfSixCards) {
    keep_regions(1);
    measure("wall, whole range");
    measure_cards(demo("textures/knit.png"));
}

}  // namespace
}  // namespace weft
