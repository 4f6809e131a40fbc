#include "engine/compute/backend_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class NamedBackend final : public Backend {
  public:
    explicit NamedBackend(std::string name) : name_(std::move(name)) {}
    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] std::string description() const override { return "test"; }
    void sample_plane(const SampleRequest&, ImageView<float, 3>) const override {}

  private:
    std::string name_;
};

BackendEntry there(const std::string& name, int score) {
    return {name, score, [name]() -> Expected<std::shared_ptr<const Backend>> {
                return std::make_shared<const NamedBackend>(name);
            }};
}

BackendEntry missing(const std::string& name, int score, const std::string& why) {
    return {name, score, [why]() -> Expected<std::shared_ptr<const Backend>> {
                return fail(ErrorCode::kNoBackend, why);
            }};
}

TEST(BackendRegistry, AlwaysHasTheCpu) {
    const BackendRegistry registry;
    EXPECT_THAT(registry.names(), ElementsAre("cpu"));
    for (const std::string name : {"auto", "cpu"}) {
        const auto choice = registry.choose(name);
        ASSERT_TRUE(choice);
        EXPECT_EQ(choice->backend->name(), "cpu");
        EXPECT_THAT(choice->backend->description(), HasSubstr("thread"));
        EXPECT_THAT(choice->passed_over, IsEmpty());
    }
}

TEST(BackendRegistry, AutoTakesTheBest) {
    BackendRegistry registry;
    registry.add(there("slow", -5));
    registry.add(there("fast", 50));
    EXPECT_THAT(registry.names(), ElementsAre("fast", "cpu", "slow"));
    const auto choice = registry.choose("auto");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->backend->name(), "fast");
    EXPECT_EQ(registry.choose("slow")->backend->name(), "slow");
}

TEST(BackendRegistry, AutoSaysWhyBetterOnesWerePassedOver) {
    BackendRegistry registry;
    registry.add(missing("cuda", 100, "No driver."));
    registry.add(missing("quantum", 200, "Too warm."));
    const auto choice = registry.choose("auto");
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->backend->name(), "cpu");
    EXPECT_THAT(choice->passed_over, ElementsAre("quantum: Too warm.", "cuda: No driver."));
}

TEST(BackendRegistry, ANamedOneThatIsMissingIsAnError) {
    BackendRegistry registry;
    registry.add(missing("cuda", 100, "No driver."));
    const auto choice = registry.choose("cuda");
    ASSERT_FALSE(choice);
    EXPECT_EQ(choice.error().code, ErrorCode::kNoBackend);
    EXPECT_EQ(choice.error().text(),
              "No driver. Available: cpu. Choose one of these or auto (run.backend).");
}

TEST(BackendRegistry, AnUnknownNameListsTheKnownOnes) {
    BackendRegistry registry;
    registry.add(missing("cuda", 100, "No driver."));
    for (const std::string name : {"opencl", "", "CPU"}) {
        const auto choice = registry.choose(name);
        ASSERT_FALSE(choice) << name;
        EXPECT_EQ(choice.error().code, ErrorCode::kUsage);
        EXPECT_THAT(choice.error().text(), HasSubstr("'" + name + "'"));
        EXPECT_THAT(choice.error().text(), HasSubstr("auto, cuda, cpu"));
    }
}

TEST(Backend, WithoutADeviceLeavesSearchesAndFramesToItsCaller) {
    const NamedBackend plain("plain");
    EXPECT_EQ(plain.open_plane_search({}), nullptr);
    EXPECT_EQ(plain.open_frame({}), nullptr);
    EXPECT_THAT(plain.remarks(), IsEmpty());
    const auto cpu = make_cpu_backend();
    EXPECT_EQ(cpu->open_plane_search({}), nullptr);
    EXPECT_EQ(cpu->open_frame({}), nullptr);
}

}  // namespace
}  // namespace weft
