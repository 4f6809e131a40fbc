#include "engine/core/image.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Image, PixelsAreRowMajorAndInterleaved) {
    Image<int, 2> image(3, 2);
    image.at(2, 1, 1) = 5;
    EXPECT_EQ(image.data()[(1 * 3 + 2) * 2 + 1], 5);
    EXPECT_EQ(image.size_bytes(), 3 * 2 * 2 * sizeof(int));
}

TEST(Image, CropSharesPixelsAndStride) {
    Image<int, 1> image(4, 3);
    const ImageView<int, 1> part = image.view().crop({1, 1, 3, 3});
    part.at(0, 0) = 7;
    EXPECT_EQ(image.at(1, 1), 7);
    EXPECT_EQ(part.stride(), 4);
    EXPECT_EQ(part.size(), (Size{2, 2}));
}

TEST(Recti, IntersectionAndUnion) {
    const Recti a{0, 0, 4, 4}, b{2, 3, 6, 5};
    EXPECT_EQ(a.intersected(b), (Recti{2, 3, 4, 4}));
    EXPECT_EQ(a.united(b), (Recti{0, 0, 6, 5}));
    EXPECT_EQ(a.united(Recti{}), a);
    EXPECT_TRUE(a.intersected({4, 0, 5, 5}).empty());
}

TEST(Project, DividesByTheThirdCoordinate) {
    const Mat3 m(2, 0, 0, 0, 2, 0, 0, 0, 4);  // columns: scales by 1/2
    EXPECT_EQ(project(m, {3, 5}), Vec2(1.5f, 2.5f));
}

}  // namespace
}  // namespace weft
