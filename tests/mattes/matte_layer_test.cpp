#include "app/mattes/matte_layer.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(MatteLayer, NumbersTheHoldouts) {
    Region region;
    region.name = "wall";
    EXPECT_EQ(layer_name(region, 0), "wall");
    EXPECT_EQ(layer_name(region, 2), "holdout 2 of wall");
    EXPECT_TRUE(layer_source(region, 1).empty());
}

}  // namespace
}  // namespace weft
