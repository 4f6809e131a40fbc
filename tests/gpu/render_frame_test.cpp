// A whole frame through the pipeline: on a device it is what the CPU renders, and stays so whatever
// fails.
#include "engine/pipeline/render_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/compute/backend_registry.h"
#include "tests/gpu/backends.h"
#include "tests/pipeline/memory_shot.h"

namespace weft::test {
namespace {

class DeviceFrame : public testing::Test {
  protected:
    DeviceFrame() : shot_(make_wall(true)) {
        RegionPlan lit = make_region(flat_texture({0.9f, 0.6f, 0.7f}));
        lit.has_holdout = true;
        lit.light_source = LightSource::kPlate;
        plan_ = make_plan(lit, 1, 3);
        // A smaller region over the first one.
        RegionPlan above = make_region(sample_texture());
        above.random_key = 6;
        plan_.regions.push_back(above);
        for (int frame = kFirst; frame <= kLast; ++frame)
            shot_.mattes[{1, frame}] = box_matte({60, 40, 120, 80});
        const Status status = analyse_shot(shot_, plan_, store_, {}, {});
        EXPECT_TRUE(status) << (status ? "" : status.error().text());
        for (int k = 0; k < 2; ++k)
            scenes_.push_back(std::move(*make_scene(shot_, plan_, store_, k, {}, {})));
    }

    [[nodiscard]] RenderedFrame rendered(const Backend& backend) const {
        auto frame = render_frame(shot_, plan_, scenes_, store_, backend, 3);
        EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
        return frame ? std::move(*frame) : RenderedFrame{};
    }

    MemoryShot shot_;
    ShotPlan plan_;
    MemoryAnalysisStore store_;
    std::vector<RegionScene> scenes_;
};

void expect_same_frame(const RenderedFrame& is, const RenderedFrame& should) {
    EXPECT_EQ(is.pixels, should.pixels);
    EXPECT_EQ(is.touched, should.touched);
    EXPECT_EQ(is.above_one, should.above_one);
    EXPECT_EQ(is.filled, should.filled);
}

TEST_F(DeviceFrame, IsWhatTheCpuRenders) {
    const auto device = std::make_shared<EmulatedDevice>();
    const GpuBackend backend(device);
    expect_same_frame(rendered(backend), rendered(*make_cpu_backend()));
    EXPECT_GT(device->copies(), 10) << "the device was not used";
    EXPECT_THAT(backend.remarks(), testing::IsEmpty());
}

TEST_F(DeviceFrame, ComesFromTheCpuWhenTheDeviceFailsHalfWay) {
    const RenderedFrame should = rendered(*make_cpu_backend());
    bool failed = true;
    for (int call = 0; failed; call += 3) {
        SCOPED_TRACE("call " + std::to_string(call));
        const auto device = std::make_shared<EmulatedDevice>();
        device->fail_at(call, ErrorCode::kNoBackend);
        const GpuBackend backend(device);
        expect_same_frame(rendered(backend), should);
        failed = device->has_failed();
        // At the very last call the frame is there already.
        EXPECT_LE(backend.remarks().size(), failed ? 1u : 0u);
    }
}

TEST_F(DeviceFrame, IsTheCpusWhereTheLightIsNotAGain) {
    plan_.regions[0].light.form = LightForm::kLiteral;
    const auto device = std::make_shared<EmulatedDevice>();
    const GpuBackend backend(device);
    expect_same_frame(rendered(backend), rendered(*make_cpu_backend()));
}

}  // namespace
}  // namespace weft::test
