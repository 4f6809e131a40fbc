// Every search finds what the definition says: cost, winner and shortlist, to the last integer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "tests/gpu/backends.h"

namespace weft::test {
namespace {

class SearchContract : public testing::TestWithParam<Searcher> {
  protected:
    ~SearchContract() override { set_thread_count(0); }

    std::unique_ptr<PlaneSearch> open(const PlaneSearchSetup& setup) {
        std::string why;
        auto search = GetParam().open(setup, why);
        if (!search) skipped_ = "Not tested here: " + why;
        return search;
    }

    std::string skipped_;
};

void expect_same_found(const PlaneSearchResult& is, const PlaneSearchResult& should) {
    EXPECT_EQ(is.best, should.best);
    EXPECT_EQ(is.best_cost.ssd, should.best_cost.ssd);
    EXPECT_EQ(is.best_cost.weight, should.best_cost.weight);
    EXPECT_EQ(is.good, should.good);
}

PlaneSearchResult by_definition(const SearchCase& c, const PlaneSearchRequest& request) {
    const auto plain = make_plain_search(c.setup());
    EXPECT_TRUE(plain->update(rect_of(c.canvas), c.pixels, c.filled));
    return *plain->find(request);
}

struct Answer {
    SearchCase c;
    PlaneSearchResult should;
};

const std::vector<Answer>& answers() {
    static const std::vector<Answer> all = [] {
        std::vector<Answer> out;
        for (SearchCase& c : search_cases()) {
            PlaneSearchRequest request = c.request;
            request.allowed = c.allowed;
            const PlaneSearchResult should = by_definition(c, request);
            out.push_back({std::move(c), should});
        }
        return out;
    }();
    return all;
}

TEST_P(SearchContract, FindsWhatTheDefinitionSays) {
    for (const int threads : {1, 2}) {
        set_thread_count(threads);
        for (const auto& [c, should] : answers()) {
            SCOPED_TRACE(c.name + ", threads: " + std::to_string(threads));
            const auto search = open(c.setup());
            if (!search) GTEST_SKIP() << skipped_;
            PlaneSearchRequest request = c.request;
            request.allowed = c.allowed;
            ASSERT_TRUE(search->update(rect_of(c.canvas), c.pixels, c.filled));
            const auto found = search->find(request);
            ASSERT_TRUE(found) << found.error().text();
            expect_same_found(*found, should);
            if (!GetParam().gives_costs) continue;
            EXPECT_EQ(found->costs, should.costs);
        }
    }
}

TEST_P(SearchContract, TheFactorOfGoodOnesIsTheRequests) {
    if (!GetParam().gives_costs) GTEST_SKIP() << "The CPU's factor is fixed.";
    const SearchCase& c = answers().front().c;
    for (const std::uint32_t numerator : {100u, 101u, 130u, 100000u}) {
        const auto search = open(c.setup());
        if (!search) GTEST_SKIP() << skipped_;
        PlaneSearchRequest request = c.request;
        request.good_numerator = numerator;
        ASSERT_TRUE(search->update(rect_of(c.canvas), c.pixels, c.filled));
        const auto found = search->find(request);
        ASSERT_TRUE(found);
        expect_same_found(*found, by_definition(c, request));
        if (numerator == 100u) {
            EXPECT_THAT(found->good, testing::SizeIs(testing::Lt(5u)));
        } else if (numerator == 100000u) {
            EXPECT_THAT(found->good, testing::SizeIs(request.count()));
        }
    }
}

TEST_P(SearchContract, GrowsTheSamePlane) {
    for (const bool torus : {false, true}) {
        for (const bool guided : {false, true}) {
            SearchCase owner;
            const PlaneSearchSetup setup = growing(owner, torus, guided);
            const auto search = open(setup);
            if (!search) GTEST_SKIP() << skipped_;
            const auto plain = make_plain_search(setup);
            const auto is = grow_with(*search, setup), should = grow_with(*plain, setup);
            ASSERT_EQ(is.size(), should.size());
            EXPECT_GT(is.size(), 8u);
            for (std::size_t i = 0; i < is.size(); ++i) {
                SCOPED_TRACE("placement " + std::to_string(i));
                expect_same_found(is[i], should[i]);
            }
        }
    }
}

TEST_P(SearchContract, OneSearchServesRequestsOfAllSizes) {
    const SearchCase& c = answers().front().c;
    const auto search = open(c.setup());
    if (!search) GTEST_SKIP() << skipped_;
    ASSERT_TRUE(search->update(rect_of(c.canvas), c.pixels, c.filled));
    // Larger, smaller, larger again: what is left of the one before must not show.
    for (const int slack : {3, 24, 1, 30}) {
        PlaneSearchRequest request = c.request;
        request.want_costs = false;
        request.lo = {-slack, 0};
        request.hi = {slack, slack};
        const auto found = search->find(request);
        ASSERT_TRUE(found);
        expect_same_found(*found, by_definition(c, request));
    }
}

INSTANTIATE_TEST_SUITE_P(Search, SearchContract, testing::ValuesIn(searchers()),
                         [](const auto& test) { return test.param.name; });

class BadRequest : public testing::TestWithParam<std::function<void(PlaneSearchRequest&)>> {};

TEST_P(BadRequest, IsAnErrorAndLeavesTheSearchUsable) {
    const SearchCase& c = answers().front().c;
    const auto search = emulated_backend()->open_plane_search(c.setup());
    ASSERT_TRUE(search);
    ASSERT_TRUE(search->update(rect_of(c.canvas), c.pixels, c.filled));
    PlaneSearchRequest bad = c.request;
    GetParam()(bad);
    const auto found = search->find(bad);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    const auto again = search->find(c.request);
    ASSERT_TRUE(again);
    expect_same_found(*again, by_definition(c, c.request));
}

const std::uint8_t kOne[1] = {1};

INSTANTIATE_TEST_SUITE_P(Search, BadRequest,
                         testing::Values([](PlaneSearchRequest& r) { r.sample = 1; },
                                         [](PlaneSearchRequest& r) { r.sample = -1; },
                                         [](PlaneSearchRequest& r) { r.window.x1 += 1; },
                                         [](PlaneSearchRequest& r) { r.window = {}; },
                                         [](PlaneSearchRequest& r) { r.block = {}; },
                                         [](PlaneSearchRequest& r) { r.hi.x = r.lo.x - 1; },
                                         [](PlaneSearchRequest& r) { r.allowed = kOne; }));

TEST(PlaneSearchSetup, ThatContradictsItselfOpensNoSearch) {
    const SearchCase& c = answers().front().c;
    PlaneSearchSetup none = c.setup();
    none.samples.clear();
    EXPECT_FALSE(emulated_backend()->open_plane_search(none));
    PlaneSearchSetup guide = c.setup();
    guide.guide = c.samples[0];
    EXPECT_FALSE(emulated_backend()->open_plane_search(guide));
}

TEST(PlaneSearch, RefusesAnUpdateOutsideOfTheCanvas) {
    const SearchCase& c = answers().front().c;
    const auto search = emulated_backend()->open_plane_search(c.setup());
    ASSERT_TRUE(search);
    const Recti outside{-1, 0, c.canvas.width - 1, c.canvas.height};
    EXPECT_EQ(search->update(outside, c.pixels, c.filled).error().code, ErrorCode::kUsage);
    const Recti smaller{0, 0, 5, 5};
    EXPECT_EQ(search->update(smaller, c.pixels, c.filled).error().code, ErrorCode::kUsage);
}

TEST(PlaneSearch, TimesWhatTheDeviceDoes) {
    const SearchCase& c = answers().front().c;
    const auto search = emulated_backend()->open_plane_search(c.setup());
    ASSERT_TRUE(search);
    PlaneSearchRequest request = c.request;
    EXPECT_EQ(search->find(request)->device_ms, 0);
    request.want_time = true;
    EXPECT_EQ(search->find(request)->device_ms, 0.5);
}

}  // namespace
}  // namespace weft::test
