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

TEST(FullPhotographs, RefinementTakesATenthOfTheEnergyAway) {
    const auto paths = photographs();
    if (paths.empty()) GTEST_SKIP() << "the texture photographs are not there";
    double before = 0, after = 0;
    for (std::size_t i = 0; i < 50; ++i) {
        const ImageU8x3 sample = load_photograph(paths[i * paths.size() / 50], 96);
        PlaneOptions o;
        o.refine_passes = 0;
        const auto once = grow_plane(sample, o);
        o.refine_passes = kDefaultRefinePasses;
        const auto refined = grow_plane(sample, o);
        ASSERT_TRUE(once && refined);
        EXPECT_LE(refined->stats.seam_energy, once->stats.seam_energy);
        before += once->stats.seam_energy_per_area;
        after += refined->stats.seam_energy_per_area;
    }
    EXPECT_LT(after, 0.9 * before);
}

}  // namespace
}  // namespace weft::test
