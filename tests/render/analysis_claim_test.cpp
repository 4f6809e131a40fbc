// Two programs that need one analysis at the same time make it once.
#include "app/cache/analysis_claim.h"

#include <atomic>
#include <thread>

#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using std::chrono::milliseconds;

class AnalysisClaims : public ShotTest {
  protected:
    std::shared_ptr<weft::AnalysisCache> open() {
        if (!shot_) {
            auto shot = open_shot(spec("out").project);
            EXPECT_TRUE(shot) << shot.error().text();
            shot_ = *shot;
        }
        AnalysisCacheOptions options;
        options.folder = in("claims");
        std::vector<std::string> warnings;
        auto store = open_analysis_cache(*shot_, options, warnings);
        EXPECT_TRUE(store) << store.error().text();
        return *store;
    }
    std::shared_ptr<const Shot> shot_;
};

TEST_F(AnalysisClaims, OneExcludesTheOthersUntilItIsLetGo) {
    const auto first = open(), second = open();
    auto claim = first->try_claim();
    ASSERT_TRUE(claim);
    EXPECT_FALSE(claim->empty());
    EXPECT_FALSE(second->try_claim());
    claim.reset();
    EXPECT_TRUE(second->try_claim());
}

TEST_F(AnalysisClaims, WhoWaitsTakesOverWhenTheOtherEnds) {
    const auto first = open(), second = open();
    auto claim = first->try_claim();
    std::atomic<int> asked = 0;
    std::thread other([&] {
        while (asked < 2)
            std::this_thread::sleep_for(milliseconds(1));
        claim.reset();
    });
    const auto taken = claim_analysis(*second, std::chrono::minutes(1), {}, [&] {
        ++asked;
        return 1;
    });
    other.join();
    EXPECT_FALSE(taken.empty());
    EXPECT_GE(asked, 2);
}

TEST_F(AnalysisClaims, NobodyWaitsForOneThatStandsStillOrForNothing) {
    const auto first = open(), second = open();
    const auto claim = first->try_claim();
    const auto never = [] { return 1; };
    EXPECT_TRUE(claim_analysis(*second, milliseconds(1), {}, never).empty()) << "it is paused";
    EXPECT_TRUE(claim_analysis(*second, std::chrono::minutes(1), {}, [] { return 0; }).empty())
        << "all is there";
    const CancelToken cancelled;
    cancelled.cancel();
    EXPECT_TRUE(claim_analysis(*second, std::chrono::minutes(1), cancelled, never).empty());
}

// A job of eight frames does not wait for the editor, which goes through the whole shot and stores
// something all the time.
TEST_F(AnalysisClaims, NobodyWaitsForWhatIsNotNeeded) {
    const auto first = open(), second = open();
    const auto claim = first->try_claim();
    int frame = 1000;
    const auto busy = [&] {
        const AnalysisKey other{0, ++frame, AnalysisKind::kMatteForward, 0};
        EXPECT_TRUE(first->put(other, {1, 2, 3}));
        return 1;
    };
    EXPECT_TRUE(claim_analysis(*second, milliseconds(300), {}, busy).empty());
    EXPECT_LT(frame, 1010);
}

TEST_F(AnalysisClaims, TwoRendersAtOnceAnalyseTheShotOnce) {
    JobSpec alone = spec("alone");
    alone.cache.folder = in("another cache");
    const int once = analysed_steps(alone);
    int steps[2] = {0, 0};
    std::thread first([&] { steps[0] = analysed_steps(spec("first")); });
    std::thread second([&] { steps[1] = analysed_steps(spec("second")); });
    first.join();
    second.join();
    EXPECT_EQ(steps[0] + steps[1], once);
    EXPECT_EQ(contents("first"), contents("alone"));
    EXPECT_EQ(contents("second"), contents("alone"));
}

}  // namespace
}  // namespace weft::test
