#include <gtest/gtest.h>

#include "tests/synthesis/photographs.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

TEST(Photographs, EveryTwelfthIsFilledAndRecounts) {
    const auto paths = photographs();
    if (paths.empty()) GTEST_SKIP() << "the texture photographs are not there";
    for (std::size_t i = 0; i < paths.size(); i += 12) {
        SCOPED_TRACE(paths[i]);
        const ImageU8x3 sample = load_photograph(paths[i], i % 24 ? 0 : 96);
        PlaneOptions o;
        o.size = {256, 256};
        o.tileable = true;
        const auto plane = grow_plane(sample, o);
        ASSERT_TRUE(plane) << plane.error().text();
        expect_sound(sample, *plane, o);
    }
}

}  // namespace
}  // namespace weft::test
