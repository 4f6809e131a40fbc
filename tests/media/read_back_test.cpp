// A file that was just written must say what it was to hold, or it does not count.
#include "engine/media/read_back.h"

#include <gmock/gmock.h>

#include "engine/media/exr_frame.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

using ::testing::HasSubstr;

class ReadBack : public ReadBackTest {
  protected:
    Status picture_of(const std::string& name, Size size, int channels) const {
        const WrittenPart part{size, channels};
        return check_written_picture(in(name), "shown.png", {&part, 1});
    }
};

TEST_F(ReadBack, APictureHasItsSizeAndChannels) {
    const ImageF3 image = picture(kSize, 0);
    for (const auto& [name, depth] : {std::pair{"a.png", PixelDepth::kU16},
                                      {"a.jpg", PixelDepth::kU8},
                                      {"a.tif", PixelDepth::kFloat},
                                      {"a.exr", PixelDepth::kHalf},
                                      {"a.dpx", PixelDepth::kU16}}) {
        WriteOptions options;
        options.depth = depth;
        ASSERT_TRUE(write_image(in(name), image, {}, options)) << name;
        EXPECT_TRUE(picture_of(name, kSize, 3)) << name;
        expect_refused(picture_of(name, {40, 31}, 3), "40x31");
        expect_refused(picture_of(name, kSize, 4), "4 channels");
        cut(name, 0);
        expect_refused(picture_of(name, kSize, 3), "cannot be opened");
    }
}

TEST_F(ReadBack, AnExrIsReadToItsEnd) {
    const ImageF3 image = random_codes({64, 64}, 255, 3);
    ASSERT_TRUE(write_exr(in("a.exr"), {image, {}, "", "", {}, {}}, {}));
    ASSERT_TRUE(picture_of("a.exr", {64, 64}, 3));
    cut("a.exr", 0.7);
    expect_refused(picture_of("a.exr", {64, 64}, 3), "ends early");
}

}  // namespace
}  // namespace weft
