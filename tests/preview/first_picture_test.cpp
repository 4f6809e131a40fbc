// How long an artist waits for the first picture on the demo shot. Disabled: a measurement, not a
// test. Run it with --gtest_also_run_disabled_tests --gtest_filter='*FirstPicture*'.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "app/preview/preview.h"
#include "app/project/codec/project_file.h"
#include "tests/support/places.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class FirstPicture : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(cache_);
        const std::string path = test::source_folder() + "/assets/demo/demo.weft";
        auto project = load_project(path);
        ASSERT_TRUE(project) << project.error().text();
        request_.project = resolve_paths(*project, project_dir(path));
        request_.project.settings.quality = Quality::kDraft;
        request_.frame = 1001;
        for (int frame = 1001; frame <= 1048; ++frame)
            request_.range.push_back(frame);
        AnalysisCacheOptions options;
        options.folder = cache_.string();
        preview_ = std::make_unique<Preview>(options);
    }
    void TearDown() override {
        preview_.reset();
        fs::remove_all(cache_);
    }
    void keep_regions(std::size_t count) { request_.project.regions.resize(count); }
    void keep_only(std::size_t region) {
        request_.project.regions = {request_.project.regions[region]};
    }
    template <class Change>
    void change(Change&& change) {
        request_.project.regions[0] = request_.project.regions[0].with(change);
    }
    void set_texture(std::size_t region, const std::string& name) {
        request_.project.regions[region] = request_.project.regions[region].with([&](Region& r) {
            r.texture.sample = test::source_folder() + "/assets/demo/textures/" + name;
        });
    }
    // Sends the request and waits for the exact picture; prints when each picture came.
    void measure(const char* what) {
        while (!preview_->try_request(request_))
            std::this_thread::yield();
        const auto start = Clock::now();
        std::printf("%-38s", what);
        PicturePtr last;
        for (;;) {
            PreviewReading reading;
            if (preview_->try_read(request_.frame, 0, 0, reading)) {
                ASSERT_NE(reading.view.state, PreviewView::State::kFailed) << reading.view.error;
                const PreviewFrame& frame = reading.frame;
                const PicturePtr& shown = frame.stages[static_cast<std::size_t>(Stage::kFinal)];
                if (shown && shown != last) {
                    last = shown;
                    const bool exact = !frame.approximate && !frame.provisional;
                    std::printf(" %s %.2f s",
                                exact               ? "exact"
                                : frame.provisional ? "provisional"
                                                    : "approximate",
                                seconds_since(start));
                    if (exact) break;
                }
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        std::printf("\n");
    }

    fs::path cache_ = fs::temp_directory_path() / ("weft_first_" + std::to_string(getpid()));
    PreviewRequest request_;
    std::unique_ptr<Preview> preview_;
};

TEST_F(FirstPicture, DISABLED_OfTheDemoWithAnEmptyCache) {
    measure("demo, empty cache");
}

TEST_F(FirstPicture, DISABLED_OfAnotherTexture) {
    keep_regions(1);
    request_.range = {1001};
    measure("wall, empty cache");
    set_texture(0, "knit.png");
    measure("another texture on an analysed shot");
}

TEST_F(FirstPicture, DISABLED_OfThreeRegions) {
    request_.frame = 1038;
    measure("three regions on frame 1038");
}

TEST_F(FirstPicture, DISABLED_OfAMovedPin) {
    keep_only(1);
    request_.frame = 1030;
    measure("cape, empty cache");
    for (const double moved : {5.0, 9.0}) {
        change([&](Region& r) { r.corrections[1030] = {{{480, 300}, {480 + moved, 300}}}; });
        measure("a pin moved");
    }
}

// A stroke on frame 1030 between two keyframes, and the mattes of the frames beside it.
TEST_F(FirstPicture, DISABLED_OfAStroke) {
    keep_only(1);
    const std::string mattes = test::source_folder() + "/assets/demo/mattes/cape/";
    const auto paint = [&](const std::vector<int>& frames) {
        change([&](Region& r) {
            MatteSource matte;
            for (const int frame : frames)
                matte.keyframes[frame].path = mattes + std::to_string(frame) + ".png";
            r.matte = Leaf<MatteSource>(matte);
        });
    };
    paint({1020, 1040});
    request_.frame = 1030;
    measure("cape of two keyframes");
    const RegionId region = request_.project.regions[0]->id;
    const auto matte_on = [&](int frame) {
        auto matte = preview_->propagated_matte(region, 0, frame);
        return matte ? std::move(*matte) : Matte();
    };
    const std::vector<int> frames{1030, 1031, 1029};
    std::vector<Matte> before;
    before.reserve(frames.size());
    for (const int frame : frames)
        before.push_back(matte_on(frame));
    paint({1020, 1030, 1040});
    while (!preview_->try_request(request_))
        std::this_thread::yield();
    const auto start = Clock::now();
    for (std::size_t k = 0; k < frames.size(); ++k) {
        for (Matte now; now.empty() || now == before[k]; now = matte_on(frames[k]))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::printf("matte on %d after %.2f s\n", frames[k], seconds_since(start));
    }
    measure("a stroke");
}

TEST_F(FirstPicture, DISABLED_OfSixCards) {
    keep_regions(1);
    measure("wall, whole range");
    for (const double scale : {0.5, 0.7, 0.9, 1.1, 1.3, 1.5}) {
        CardRequest card;
        card.project = request_.project;
        card.project.regions[0] = card.project.regions[0].with([&](Region& r) {
            r.texture.sample = test::source_folder() + "/assets/demo/textures/knit.png";
            r.placement.scale = scale;
        });
        card.frame = 1001;
        card.around = 1;
        card.key = strip_key(card);
        request_.cards.push_back(card);
    }
    while (!preview_->try_request(request_))
        std::this_thread::yield();
    const auto start = Clock::now();
    double first = -1;
    double all = -1;
    for (bool exact = false; !exact;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        PreviewReading reading;
        if (!preview_->try_read(1001, 0, 0, reading)) continue;
        const bool complete = reading.cards.size() == request_.cards.size();
        if (!reading.cards.empty() && first < 0) first = seconds_since(start);
        if (complete && all < 0) all = seconds_since(start);
        exact = complete && std::none_of(reading.cards.begin(), reading.cards.end(),
                                         [](const auto& card) { return card.second.provisional; });
    }
    std::printf("six cards: first %6.2f s, all %6.2f s, exact %6.2f s\n", first, all,
                seconds_since(start));
}

}  // namespace
}  // namespace weft
