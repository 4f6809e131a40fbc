#include "gpu/cuda_backend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu/cuda_device.h"

namespace weft {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

BackendRegistry with_cuda() {
    BackendRegistry registry;
    register_cuda(registry);
    return registry;
}

TEST(CudaBackend, IsRegisteredWithThePapersStrategiesBehindTheCpu) {
    EXPECT_THAT(with_cuda().names(),
                testing::ElementsAre("cuda", "cpu", "cuda-candidate", "cuda-pixel"));
}

TEST(CudaBackend, TheRegistryRepeatsTheReason) {
    const auto device = open_cuda_device();
    if (device) GTEST_SKIP() << "There is a GPU here: " << (*device)->description();
    EXPECT_EQ(device.error().code, ErrorCode::kNoBackend);
    for (const std::string name : {"cuda", "cuda-candidate", "cuda-pixel"}) {
        const auto choice = with_cuda().choose(name);
        ASSERT_FALSE(choice);
        EXPECT_EQ(choice.error().code, ErrorCode::kNoBackend);
        EXPECT_THAT(choice.error().text(), HasSubstr("CUDA cannot be used here: "));
        EXPECT_THAT(choice.error().text(), HasSubstr(device.error().text()));
        EXPECT_THAT(choice.error().text(), HasSubstr("Available: cpu."));
    }
}

TEST(CudaBackend, AutoGoesOnToTheCpuAndSaysWhyOnce) {
    const auto device = open_cuda_device();
    if (device) GTEST_SKIP() << "There is a GPU here: " << (*device)->description();
    const auto choice = with_cuda().choose("auto");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->backend->name(), "cpu");
    ASSERT_THAT(choice->passed_over, SizeIs(1));
    EXPECT_EQ(choice->passed_over[0], "cuda: " + device.error().text());
}

TEST(CudaBackend, AutoTakesAGpuThatIsThere) {
    const auto device = open_cuda_device();
    if (!device) GTEST_SKIP() << "Not tested here: " << device.error().text();
    const auto choice = with_cuda().choose("auto");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->backend->name(), "cuda");
    EXPECT_EQ(choice->backend->description(), (*device)->description());
}

}  // namespace
}  // namespace weft
