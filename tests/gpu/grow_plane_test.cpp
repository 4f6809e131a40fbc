// A whole plane through grow_plane(): with the search of a device it is the CPU's to the last
// decision, and stays so whatever fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "engine/synthesis/texture_plane.h"
#include "tests/gpu/backends.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

void expect_same_plane(const Expected<TexturePlane>& is, const Expected<TexturePlane>& should) {
    ASSERT_TRUE(is) << is.error().text();
    ASSERT_TRUE(should) << should.error().text();
    EXPECT_EQ(is->source, should->source);
    EXPECT_EQ(is->origin, should->origin);
    EXPECT_EQ(is->pixels, should->pixels);
    EXPECT_EQ(is->stats.placements, should->stats.placements);
    EXPECT_EQ(is->stats.refinements, should->stats.refinements);
    EXPECT_EQ(is->stats.seam_energy, should->stats.seam_energy);
}

struct Growth {
    const char* name;
    std::vector<ImageU8x3> samples;
    PlaneOptions options;
    bool guided = false;
};

std::ostream& operator<<(std::ostream& out, const Growth& g) {
    return out << g.name;
}

PlaneOptions sized(int w, int h, int refine_passes) {
    PlaneOptions o;
    o.size = {w, h};
    o.overlap_px = 16;
    o.refine_passes = refine_passes;
    return o;
}

std::vector<Growth> growths() {
    const ImageU8x3 a = blob_sample(48, 40, 1), b = blob_sample(44, 52, 2);
    std::vector<Growth> out{{"OneSweep", {a}, sized(150, 110, 0)},
                            {"Refined", {a}, sized(150, 110, 3)},
                            {"Torus", {a}, sized(130, 120, 2)},
                            {"TurnedAndSeveral", {a, b}, sized(140, 100, 2)},
                            {"Guided", {a}, sized(120, 100, 0), true},
                            {"TorusThatIsSmallerThanTheSample", {a}, sized(40, 30, 2)},
                            {"ByDp", {a}, sized(120, 100, 0)}};
    out[2].options.tileable = out[5].options.tileable = true;
    out[3].options.orientations = {.rotations = true, .mirror = true};
    out[6].options.seam = SeamMethod::kDynamicProgramming;
    return out;
}

class DeviceGrowth : public testing::TestWithParam<Growth> {
  protected:
    ~DeviceGrowth() override { set_thread_count(0); }

    [[nodiscard]] Expected<TexturePlane> grown(const Backend* backend) const {
        const Growth& g = GetParam();
        PlaneOptions o = g.options;
        o.backend = backend;
        const ImageU8x3 target = blob_sample(o.size.width, o.size.height, 9);
        Image<std::uint8_t, 1> known(o.size, 255);
        for (int y = 0; y < o.size.height / 2; ++y)
            std::fill_n(known.row(y), o.size.width / 3, std::uint8_t{0});
        if (g.guided) o.guide = PlaneGuide{target, known, 0.7f};
        return grow_plane({g.samples.begin(), g.samples.end()}, o);
    }
};

TEST_P(DeviceGrowth, IsTheCpus) {
    const auto should = grown(nullptr);
    for (const SearchStrategy strategy : {SearchStrategy::kTiled, SearchStrategy::kCandidate}) {
        for (const int threads : {1, 2}) {
            set_thread_count(threads);
            const auto device = std::make_shared<EmulatedDevice>();
            const GpuBackend backend(device, {"emulated", strategy, 0});
            expect_same_plane(grown(&backend), should);
            EXPECT_GE(device->copies(), should->stats.placements) << "the device was not used";
            EXPECT_THAT(backend.remarks(), testing::IsEmpty());
        }
    }
}

TEST_P(DeviceGrowth, IsTheCpusWhenTheDeviceFailsHalfWay) {
    const auto should = grown(nullptr);
    bool failed = true;
    for (int call = 0; failed; call += 17) {
        SCOPED_TRACE("call " + std::to_string(call));
        const auto device = std::make_shared<EmulatedDevice>();
        device->fail_at(call, ErrorCode::kNoBackend);
        const GpuBackend backend(device);
        expect_same_plane(grown(&backend), should);
        failed = device->has_failed();
        EXPECT_LE(backend.remarks().size(), failed ? 1u : 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(Plane, DeviceGrowth, testing::ValuesIn(growths()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace weft::test
