#pragma once
// How long an artist waits for the editor's pictures. Measurements, not tests: they are disabled.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "app/preview/preview.h"
#include "app/preview/propagation_key.h"
#include "app/project/codec/project_file.h"

namespace weft {

/// Has the preview open `project` with an empty cache and prints how long its pictures take.
class Waits : public testing::Test {
  protected:
    using Clock = std::chrono::steady_clock;
    static double seconds_since(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }

    void open(const std::string& path, int first, int last, int shown) {
        std::filesystem::remove_all(cache_);
        auto project = load_project(path);
        ASSERT_TRUE(project) << project.error().text();
        request_.project = resolve_paths(*project, project_dir(path));
        request_.project.settings.quality = Quality::kDraft;
        request_.frame = shown;
        for (int frame = first; frame <= last; ++frame)
            request_.range.push_back(frame);
        AnalysisCacheOptions options;
        options.folder = cache_.string();
        preview_ = std::make_unique<Preview>(options);
    }
    void TearDown() override {
        preview_.reset();
        std::filesystem::remove_all(cache_);
    }

    template <class Change>
    void change(Change&& change) {
        request_.project.regions[0] = request_.project.regions[0].with(change);
    }
    Clock::time_point send() {
        while (!preview_->try_request(request_))
            std::this_thread::yield();
        return Clock::now();
    }

    // Sends the request and waits for the exact picture; prints when each picture came.
    void measure(const char* what) {
        const auto start = send();
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

    // Six cards of region 0 in `sample` on the frame shown; prints when they came.
    void measure_cards(const std::string& sample) {
        for (const double scale : {0.5, 0.7, 0.9, 1.1, 1.3, 1.5}) {
            CardRequest card;
            card.project = request_.project;
            card.project.regions[0] = card.project.regions[0].with([&](Region& r) {
                r.texture.sample = sample;
                r.placement.scale = scale;
            });
            card.frame = request_.frame;
            card.around = 1;
            card.key = strip_key(card);
            request_.cards.push_back(card);
        }
        const auto start = send();
        double first = -1;
        double all = -1;
        for (bool exact = false; !exact;) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            PreviewReading reading;
            if (!preview_->try_read(request_.frame, 0, 0, reading)) continue;
            const bool complete = reading.cards.size() == request_.cards.size();
            if (!reading.cards.empty() && first < 0) first = seconds_since(start);
            if (complete && all < 0) all = seconds_since(start);
            exact =
                complete && std::none_of(reading.cards.begin(), reading.cards.end(),
                                         [](const auto& card) { return card.second.provisional; });
        }
        std::printf("six cards: first %6.2f s, all %6.2f s, exact %6.2f s\n", first, all,
                    seconds_since(start));
        request_.cards.clear();
    }

    // A propagated matte of region 0; empty while there is none.
    Matte matte_on(int frame) {
        const Region& region = *request_.project.regions[0];
        WantedMatte wanted{region.id, 0, frame, propagation_key(request_.project, region, 0)};
        auto matte = preview_->propagated_matte(wanted);
        wanted.walk = WantedMatte::Walk::kForward;
        if (!matte) matte = preview_->propagated_matte(wanted);
        return matte ? std::move(*matte) : Matte();
    }
    // Sends the request and prints when the mattes of these frames are others than before.
    void measure_mattes(const std::vector<int>& frames) {
        std::vector<Matte> before;
        before.reserve(frames.size());
        for (const int frame : frames)
            before.push_back(matte_on(frame));
        const auto start = send();
        for (std::size_t k = 0; k < frames.size(); ++k) {
            for (Matte now; now.empty() || now == before[k]; now = matte_on(frames[k])) {
                PreviewReading reading;
                if (preview_->try_read(request_.frame, 0, 0, reading)) {
                    ASSERT_NE(reading.view.state, PreviewView::State::kFailed)
                        << reading.view.error;
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            std::printf("matte on %d after %.2f s\n", frames[k], seconds_since(start));
        }
    }

    std::filesystem::path cache_ =
        std::filesystem::temp_directory_path() / ("weft_waits_" + std::to_string(getpid()));
    PreviewRequest request_;
    std::unique_ptr<Preview> preview_;
};

}  // namespace weft
