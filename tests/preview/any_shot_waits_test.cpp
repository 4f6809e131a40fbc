// How long an artist waits on a shot of one's own: on the middle frame of a project whose first
// region has a propagated matte and a texture. Disabled: a measurement, not a test.
//   WEFT_WAITS=PROJECT WEFT_WAITS_FRAMES=0-49 test_preview --gtest_also_run_disabled_tests
//       --gtest_filter='*AnyShot*'
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "engine/media/frame_writer.h"
#include "tests/preview/waits.h"
#include "tests/support/places.h"

namespace weft {
namespace {

std::string knit() {
    return test::source_folder() + "/assets/demo/textures/knit.png";
}

// The pixel of a matte, whose holes may be in its middle, that is nearest to its middle.
Vec2i middle_of(const Matte& matte) {
    std::vector<Vec2i> inside;
    Vec2 sum(0);
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            if (matte.at(x, y) < 128) continue;
            inside.emplace_back(x, y);
            sum += Vec2(x, y);
        }
    }
    if (inside.empty()) return {matte.width() / 2, matte.height() / 2};
    const Vec2 middle = sum / static_cast<float>(inside.size());
    const auto far = [&](Vec2i p) { return glm::length(Vec2(p) - middle); };
    return *std::min_element(inside.begin(), inside.end(),
                             [&](Vec2i a, Vec2i b) { return far(a) < far(b); });
}

// As a stroke leaves it: with a hole of a tenth of the height in its middle.
Matte with_hole(Matte matte) {
    const Vec2i at = middle_of(matte);
    const int radius = std::max(4, matte.height() / 20);
    for (int y = std::max(0, at.y - radius); y < std::min(matte.height(), at.y + radius); ++y)
        for (int x = std::max(0, at.x - radius); x < std::min(matte.width(), at.x + radius); ++x)
            if ((x - at.x) * (x - at.x) + (y - at.y) * (y - at.y) < radius * radius)
                matte.at(x, y) = 0;
    return matte;
}

class AnyShot : public Waits {
  protected:
    void SetUp() override {
        // No thread runs yet. NOLINTBEGIN(concurrency-mt-unsafe)
        const char* project = std::getenv("WEFT_WAITS");
        const char* frames = std::getenv("WEFT_WAITS_FRAMES");
        // NOLINTEND(concurrency-mt-unsafe)
        int first = 0, last = 0;
        if (!project || !frames || std::sscanf(frames, "%d-%d", &first, &last) != 2)
            GTEST_SKIP() << "WEFT_WAITS and WEFT_WAITS_FRAMES name no shot";
        open(project, first, last, (first + last) / 2);
    }
};

TEST_F(AnyShot, DISABLED_Waits) {
    const int frame = request_.frame;
    measure("empty cache");
    change([](Region& r) { r.texture.sample = knit(); });
    measure("another texture");
    measure_cards(knit());
    const Matte matte = matte_on(frame);
    ASSERT_FALSE(matte.empty());
    const Vec2i at = middle_of(matte);
    for (const double moved : {5.0, 9.0}) {
        change([&](Region& r) {
            r.corrections[frame] = {{{double(at.x), double(at.y)}, {at.x + moved, double(at.y)}}};
        });
        measure("a pin moved");
    }
    std::filesystem::create_directories(cache_);
    const std::string painted = (cache_ / "painted.png").string();
    ASSERT_TRUE(write_matte(painted, with_hole(matte)));
    change([&](Region& r) {
        MatteSource source = *r.matte;
        source.keyframes[frame].path = painted;
        r.matte = Leaf<MatteSource>(source);
    });
    measure_mattes({frame, frame + 1});
    measure("a stroke");
}

}  // namespace
}  // namespace weft
