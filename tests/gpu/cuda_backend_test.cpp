#include "gpu/cuda_backend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu/cuda_probe.h"

namespace weft {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(CudaProbe, SaysWhatItFoundOrWhyNot) {
    const CudaProbe probe = probe_cuda();
    EXPECT_FALSE(probe.detail.empty());
    EXPECT_GE(probe.devices, 0);
    if (!probe.compiled) {
        EXPECT_EQ(probe.devices, 0);
        EXPECT_THAT(probe.detail, HasSubstr("no CUDA in it"));
    }
}

TEST(CudaBackend, TheRegistryRepeatsTheReason) {
    BackendRegistry registry;
    register_cuda(registry);
    EXPECT_THAT(registry.names(), testing::ElementsAre("cuda", "cpu"));
    const CudaProbe probe = probe_cuda();
    const auto choice = registry.choose("cuda");
    ASSERT_FALSE(choice);
    EXPECT_EQ(choice.error().code, ErrorCode::kNoBackend);
    EXPECT_THAT(choice.error().text(), HasSubstr(probe.detail));
    EXPECT_THAT(choice.error().text(), HasSubstr("Usable here: cpu"));
    EXPECT_THAT(choice.error().text(),
                HasSubstr(probe.devices > 0 ? "no CUDA kernels" : "cannot be used here"));
}

TEST(CudaBackend, AutoGoesOnToTheCpuAndSaysWhy) {
    BackendRegistry registry;
    register_cuda(registry);
    const auto choice = registry.choose("auto");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->backend->name(), "cpu");
    ASSERT_THAT(choice->passed_over, SizeIs(1));
    EXPECT_THAT(choice->passed_over[0], HasSubstr("cuda: "));
    EXPECT_THAT(choice->passed_over[0], HasSubstr(probe_cuda().detail));
}

}  // namespace
}  // namespace weft
