#include <gtest/gtest.h>

#include "tests/synthesis/photographs.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

TEST(FullPhotographs, EachIsFilledAndRecountsSmallAndWhole) {
    const auto paths = photographs();
    if (paths.empty()) GTEST_SKIP() << "the texture photographs are not there";
    for (const std::string& path : paths) {
        for (const int crop_px : {96, 0}) {
            for (const bool tileable : {false, true}) {
                SCOPED_TRACE(path + (crop_px ? ", 96 px" : ", whole") +
                             (tileable ? ", tileable" : ""));
                const ImageU8x3 sample = load_photograph(path, crop_px);
                PlaneOptions o;
                o.tileable = tileable;
                const auto plane = grow_plane(sample, o);
                ASSERT_TRUE(plane) << plane.error().text();
                expect_sound(sample, *plane, o);
            }
        }
    }
}

}  // namespace
}  // namespace weft::test
