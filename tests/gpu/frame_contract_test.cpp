// Texture, light, composite and roll-off on a device give what the CPU gives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/compute/plane_sampler.h"
#include "engine/core/parallel.h"
#include "tests/gpu/backends.h"
#include "tests/gpu/frame_cases.h"

namespace weft::test {
namespace {

class FrameContract : public testing::TestWithParam<Framer> {
  protected:
    ~FrameContract() override { set_thread_count(0); }

    std::shared_ptr<const Backend> backend() {
        std::string why;
        auto made = GetParam().make(why);
        if (!made) skipped_ = "Not tested here: " + why;
        return made;
    }
    void expect_close(const ImageF3& is, const ImageF3& should) const {
        ASSERT_EQ(is.size(), should.size());
        if (GetParam().exact) {
            EXPECT_EQ(std::memcmp(is.data(), should.data(), is.size_bytes()), 0);
        }
        float worst = 0;
        for (std::size_t k = 0; k < is.size_bytes() / sizeof(float); ++k) {
            const float a = is.data()[k], b = should.data()[k];
            if (a == b || (std::isnan(a) && std::isnan(b))) continue;
            worst = std::fmax(worst, std::isfinite(a - b) ? std::abs(a - b) : HUGE_VALF);
        }
        EXPECT_LE(worst, 1.0f / 255.0f);
    }

    std::string skipped_;
};

FrameResult composited(const Backend& backend, const FrameCase& c, ImageF3 out) {
    FrameResult result{std::move(out), 0};
    const auto canvas = backend.open_frame(c.frame);
    EXPECT_TRUE(canvas);
    if (!canvas) return result;
    ImageF3 now = c.frame;
    for (const FrameLayer& l : c.layers) {
        const Status read = canvas->read(box_of(l), now.view().crop(box_of(l)));
        EXPECT_TRUE(read);
        const Status added = canvas->add(request_of(l, old_surface(now, l)));
        EXPECT_TRUE(added);
    }
    const auto exceeded = canvas->finish(c.knee, result.pixels);
    EXPECT_TRUE(exceeded);
    result.exceeded = exceeded.value_or(-1);
    return result;
}

TEST_P(FrameContract, CompositesAsTheCpuDoes) {
    const auto made = backend();
    if (!made) GTEST_SKIP() << skipped_;
    for (const int threads : {1, 2}) {
        set_thread_count(threads);
        for (const FrameCase& c : frame_cases()) {
            SCOPED_TRACE(c.name);
            const FrameResult should = composited_on_cpu(c);
            const FrameResult is = composited(*made, c, c.frame);
            expect_close(is.pixels, should.pixels);
            if (GetParam().exact) {
                EXPECT_EQ(is.exceeded, should.exceeded);
            }
        }
    }
}

// Not even those that hold NaN, or lie inside the layer's box.
TEST_P(FrameContract, LeavesPixelsOutsideOfTheMattesAlone) {
    const auto made = backend();
    if (!made) GTEST_SKIP() << skipped_;
    const FrameCase c = frame_cases()[2];
    const ImageF3 is = composited(*made, c, ImageF3(c.frame.size(), -7.0f)).pixels;
    const FrameLayer& l = c.layers[0];
    int outside = 0, inside = 0;
    for (int y = 0; y < is.height(); ++y) {
        for (int x = 0; x < is.width(); ++x) {
            const bool matte =
                box_of(l).contains(x, y) && l.matte.at(x - l.origin.x, y - l.origin.y) != 0;
            for (int k = 0; k < 3; ++k)
                (matte ? inside : outside) += is.at(x, y, k) == -7.0f;
            outside -= matte ? 0 : 3;
        }
    }
    EXPECT_EQ(outside, 0);
    EXPECT_EQ(inside, 0);
}

TEST_P(FrameContract, SamplesAsTheCpuDoes) {
    const auto made = backend();
    if (!made) GTEST_SKIP() << skipped_;
    for (const FrameCase& c : frame_cases()) {
        for (const FrameLayer& l : c.layers) {
            SCOPED_TRACE(c.name);
            const SampleRequest request{&l.plane, l.coords, l.matte, l.quality};
            ImageF3 is(l.matte.size(), -7.0f), should(l.matte.size(), -7.0f);
            made->sample_plane(request, is);
            sample_plane_cpu(request, should);
            expect_close(is, should);
        }
    }
    EXPECT_TRUE(made->remarks().empty());
}

// The same backend serves many frames at once, each on its own queue.
TEST_P(FrameContract, FramesAtTheSameTimeDoNotMeet) {
    const auto made = backend();
    if (!made) GTEST_SKIP() << skipped_;
    set_thread_count(4);
    const std::vector<FrameCase> cases = frame_cases();
    std::vector<FrameResult> should;
    for (const FrameCase& c : cases)
        should.push_back(composited_on_cpu(c));
    std::vector<FrameResult> is(24);
    parallel_for(is.size(), [&](std::size_t i) {
        is[i] = composited(*made, cases[i % cases.size()], cases[i % cases.size()].frame);
    });
    for (std::size_t i = 0; i < is.size(); ++i) {
        SCOPED_TRACE(cases[i % cases.size()].name);
        expect_close(is[i].pixels, should[i % cases.size()].pixels);
    }
}

INSTANTIATE_TEST_SUITE_P(Frame, FrameContract, testing::ValuesIn(framers()),
                         [](const auto& test) { return test.param.name; });

TEST(FrameCanvas, AFrameCrossesTheBusOnceEachWay) {
    const auto device = std::make_shared<EmulatedDevice>();
    const GpuBackend backend(device);
    const FrameCase c = frame_cases()[1];
    const ImageF3 surface = old_surface(c.frame, c.layers[0]);
    ImageF3 out = c.frame;
    const auto frame = [&] {
        const int before = device->copies();
        const auto canvas = backend.open_frame(c.frame);
        EXPECT_TRUE(canvas->add(request_of(c.layers[0], surface)));
        EXPECT_TRUE(canvas->finish(c.knee, out));
        return device->copies() - before;
    };
    const int levels = static_cast<int>(c.layers[0].plane.levels().size());
    // There: frame, coordinates, matte, soft pixels, shading. Back: count, frame, union of mattes.
    EXPECT_EQ(frame(), levels + 8);
    // The plane is there already.
    EXPECT_EQ(frame(), 8);
}

TEST(FrameCanvas, RefusesWhatDoesNotFit) {
    const auto backend = emulated_backend();
    const FrameCase c = frame_cases()[0];
    const FrameLayer& l = c.layers[0];
    const ImageF3 surface = old_surface(c.frame, l);
    const auto refused = [&](auto spoil) {
        LayerRequest r = request_of(l, surface);
        spoil(r);
        const auto canvas = backend->open_frame(c.frame);
        const Status status = canvas->add(r);
        return !status && status.error().code == ErrorCode::kUsage;
    };
    EXPECT_TRUE(refused([](LayerRequest& r) { r.origin = {-1, 0}; }));
    EXPECT_TRUE(refused([](LayerRequest& r) { r.origin = {40, 40}; }));
    EXPECT_TRUE(refused([](LayerRequest& r) { r.texture.plane = nullptr; }));
    EXPECT_TRUE(refused([](LayerRequest& r) { r.old_surface = {}; }));
    EXPECT_TRUE(refused([](LayerRequest& r) { r.gain = GainRequest{}; }));
    EXPECT_FALSE(refused([](LayerRequest&) {}));
}

}  // namespace
}  // namespace weft::test
