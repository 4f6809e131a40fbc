// A device that is full or lost at any moment is an error or a fall-back, never a crash and never a
// wrong result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/compute/plane_sampler.h"
#include "tests/gpu/backends.h"
#include "tests/gpu/frame_cases.h"

namespace weft::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class Failing : public testing::TestWithParam<ErrorCode> {
  protected:
    /// Runs `work` on a fresh device that fails at its first call, its second call, … until it has
    /// no more calls to fail at.
    template <class Work>
    void at_every_call(Work work) {
        int call = 0;
        for (bool failed = true; failed; ++call) {
            SCOPED_TRACE("call " + std::to_string(call));
            ASSERT_LT(call, 500);
            const auto device = std::make_shared<EmulatedDevice>();
            device->fail_at(call, GetParam());
            const GpuBackend backend(device);
            work(backend, *device);
            failed = device->has_failed();
        }
        EXPECT_GT(call, 4) << "too few calls to be the real work";
    }
};

TEST_P(Failing, SamplingGoesOnOnTheCpu) {
    const FrameCase c = frame_cases()[0];
    const FrameLayer& l = c.layers[0];
    const SampleRequest request{&l.plane, l.coords, l.matte, l.quality};
    ImageF3 should(l.matte.size());
    sample_plane_cpu(request, should);
    at_every_call([&](const GpuBackend& backend, const EmulatedDevice& device) {
        for (int frame = 0; frame < 3; ++frame) {
            ImageF3 is(l.matte.size());
            backend.sample_plane(request, is);
            EXPECT_EQ(is, should);
        }
        // Short of memory, it first frees what it can and tries again.
        if (backend.remarks().empty()) return;
        EXPECT_TRUE(device.has_failed());
        EXPECT_THAT(backend.remarks(), SizeIs(1));
        EXPECT_THAT(backend.remarks()[0], HasSubstr("The emulated device failed at"));
        EXPECT_THAT(backend.remarks()[0], HasSubstr("The CPU sampled the texture instead."));
    });
}

TEST_P(Failing, AFrameIsAnErrorOrRight) {
    const FrameCase c = frame_cases()[3];
    const FrameResult should = composited_on_cpu(c);
    int errors = 0, right = 0;
    at_every_call([&](const GpuBackend& backend, const EmulatedDevice&) {
        ImageF3 now = c.frame, out = c.frame;
        const auto canvas = backend.open_frame(c.frame);
        bool ok = canvas != nullptr;
        for (const FrameLayer& l : c.layers) {
            if (!ok) break;
            ok = canvas->read(box_of(l), now.view().crop(box_of(l))) &&
                 canvas->add(request_of(l, old_surface(now, l)));
        }
        ok = ok && canvas->finish(c.knee, out);
        ++(ok ? right : errors);
        EXPECT_EQ(out, ok ? should.pixels : c.frame);
        if (ok) return;
        ASSERT_THAT(backend.remarks(), SizeIs(1));
        EXPECT_THAT(backend.remarks()[0], HasSubstr("The CPU composited the frame instead."));
        EXPECT_FALSE(canvas && canvas->finish(c.knee, out)) << "a failed frame goes on";
    });
    EXPECT_GT(errors, 10);
    EXPECT_GT(right, 0);
}

TEST_P(Failing, ASearchIsAnErrorOrRight) {
    SearchCase owner;
    const PlaneSearchSetup setup = growing(owner, true, true);
    const auto plain = make_plain_search(setup);
    const auto should = grow_with(*plain, setup);
    int errors = 0;
    at_every_call([&](const GpuBackend& backend, const EmulatedDevice&) {
        const auto search = backend.open_plane_search(setup);
        const auto is = search ? grow_with(*search, setup) : std::vector<PlaneSearchResult>{};
        ASSERT_LE(is.size(), should.size());
        for (std::size_t i = 0; i < is.size(); ++i) {
            EXPECT_EQ(is[i].best, should[i].best);
            EXPECT_EQ(is[i].good, should[i].good);
        }
        if (is.size() == should.size()) return;
        ++errors;
        ASSERT_THAT(backend.remarks(), SizeIs(1));
        EXPECT_THAT(backend.remarks()[0], HasSubstr("The CPU searched for placements instead."));
    });
    EXPECT_GT(errors, 20);
}

INSTANTIATE_TEST_SUITE_P(Device, Failing,
                         testing::Values(ErrorCode::kNoSpace, ErrorCode::kNoBackend),
                         [](const auto& test) {
                             return test.param == ErrorCode::kNoSpace ? "Full" : "Lost";
                         });

class FullDevice : public testing::Test {
  protected:
    static ImageF3 sampled(const Backend& backend, const FrameLayer& l) {
        ImageF3 out(l.matte.size());
        backend.sample_plane({&l.plane, l.coords, l.matte, l.quality}, out);
        return out;
    }
    static ImageF3 should(const FrameLayer& l) {
        ImageF3 out(l.matte.size());
        sample_plane_cpu({&l.plane, l.coords, l.matte, l.quality}, out);
        return out;
    }

    const FrameCase case_ = frame_cases()[3];
};

TEST_F(FullDevice, MakesRoomByForgettingOtherPlanes) {
    const auto device = std::make_shared<EmulatedDevice>();
    const GpuBackend backend(device);
    // Room for one plane (about 100 kB) and the frame's buffers, not for two.
    device->limit_memory(250'000);
    for (int round = 0; round < 2; ++round) {
        for (const FrameLayer& l : case_.layers)
            EXPECT_EQ(sampled(backend, l), should(l));
    }
    EXPECT_THAT(backend.remarks(), IsEmpty());
}

TEST_F(FullDevice, KeepsNoMorePlanesThanItMay) {
    const auto device = std::make_shared<EmulatedDevice>();
    const FrameLayer &a = case_.layers[0], &b = case_.layers[1];
    const GpuBackend backend(device, {"emulated", SearchStrategy::kTiled, 150'000});
    const auto copies = [&](const FrameLayer& l) {
        const int before = device->copies();
        EXPECT_EQ(sampled(backend, l), should(l));
        return device->copies() - before;
    };
    const int first = copies(a);
    EXPECT_LT(copies(a), first) << "the plane was not kept";
    EXPECT_GT(copies(b), 3);
    EXPECT_EQ(copies(a), first) << "two planes were kept";
}

TEST_F(FullDevice, TooSmallForAnythingLeavesAllToTheCpu) {
    const auto device = std::make_shared<EmulatedDevice>();
    device->limit_memory(1000);
    const GpuBackend backend(device);
    for (int frame = 0; frame < 2; ++frame)
        EXPECT_EQ(sampled(backend, case_.layers[0]), should(case_.layers[0]));
    EXPECT_FALSE(backend.open_frame(case_.frame));
    SearchCase owner;
    EXPECT_FALSE(backend.open_plane_search(growing(owner, false, false)));
    EXPECT_THAT(backend.remarks(), SizeIs(3)) << "one for each operation, not for each frame";
}

TEST_F(FullDevice, IsUsedAgainWhenThereIsRoom) {
    const auto device = std::make_shared<EmulatedDevice>();
    const GpuBackend backend(device);
    device->limit_memory(1000);
    EXPECT_EQ(sampled(backend, case_.layers[0]), should(case_.layers[0]));
    device->limit_memory(10'000'000);
    EXPECT_EQ(sampled(backend, case_.layers[0]), should(case_.layers[0]));
    EXPECT_GT(device->copies(), 3);
}

TEST_F(FullDevice, ALostOneIsNotAskedAgain) {
    const auto device = std::make_shared<EmulatedDevice>();
    const GpuBackend backend(device);
    device->fail_at(3, ErrorCode::kNoBackend);
    EXPECT_EQ(sampled(backend, case_.layers[0]), should(case_.layers[0]));
    EXPECT_TRUE(device->has_failed());
    const int copies = device->copies();
    EXPECT_EQ(sampled(backend, case_.layers[0]), should(case_.layers[0]));
    EXPECT_FALSE(backend.open_frame(case_.frame));
    SearchCase owner;
    EXPECT_FALSE(backend.open_plane_search(growing(owner, false, false)));
    EXPECT_EQ(device->copies(), copies);
    EXPECT_THAT(backend.remarks(), SizeIs(1));
}

}  // namespace
}  // namespace weft::test
