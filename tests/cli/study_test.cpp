#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

class StudyCommand : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        make_shot(3);
    }
};

TEST_F(StudyCommand, PrintsOneObjectAndWritesTheReport) {
    const Outcome run =
        this->run({"study", "--plate", in("frames/####.png"), "--matte", in("masks/####.png"),
                   "--plane", in("tile.png"), "--quality", "draft", "--frames", "1-3", "--methods",
                   "still,paper", "--alphas", "0.5,1", "-o", in("study"), "--json"});
    expect_success(run);
    const auto json = nlohmann::json::parse(run.out);
    std::vector<std::string> ids;
    for (const auto& entry : json.at("runs"))
        ids.push_back(entry.at("id"));
    EXPECT_THAT(ids, testing::ElementsAre("still", "paper-0.5", "paper-1", "locked"));
    EXPECT_TRUE(json.at("ideal_by_estimate"));
    EXPECT_THAT(names("study"), testing::ElementsAre("frames", "plane.png", "report.csv",
                                                     "report.html", "report.json"));
    EXPECT_EQ(names("study/frames/paper-1").size(), 3u);
}

TEST_F(StudyCommand, NamesAnUnknownMethod) {
    expect_failure(run({"study", "--plate", in("frames/####.png"), "--matte", in("masks/####.png"),
                        "--plane", in("tile.png"), "--methods", "magic", "-o", in("study")}),
                   2, {"magic", "poisson"});
    EXPECT_TRUE(names("study").empty());
}

}  // namespace
}  // namespace weft::test
