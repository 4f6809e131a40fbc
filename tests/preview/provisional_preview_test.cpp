// The picture that is shown before the analysis.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/base/background.h"
#include "app/cache/analysis_cache.h"
#include "app/preview/preview.h"
#include "app/shot/shot.h"
#include "engine/media/frame_writer.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr Size kPlate{160, 96};
constexpr Recti kLeft{16, 16, 72, 80}, kRight{88, 16, 144, 80};
constexpr int kFrames = 6;

class ProvisionalPreview : public testing::Test {
  protected:
    void SetUp() override {
        keep_thread_priority();  // what is waited for would take minutes on a busy machine
        for (const char* name : {"plate", "left", "right"})
            fs::create_directories(folder_ / name);
        for (int frame = 1; frame <= kFrames; ++frame) {
            const std::string file = "000" + std::to_string(frame) + ".png";
            ImageF3 plate(kPlate, 0.2f);
            for (int y = 0; y < kPlate.height; ++y)
                for (int x = 0; x < kPlate.width; ++x)
                    plate.pixel(x, y)[1] = plate_at(x, y, frame, 1);
            write("plate/" + file, plate);
            write("left/" + file, box(kLeft));
            write("right/" + file, box(kRight));
        }
        ImageF3 tile(96, 96, 0.4f);
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x)
                tile.pixel(x, y)[0] = static_cast<float>((x * 7 + y * 13) % 32) / 32.0f;
        write("tile.png", tile);
        for (int k = 0; k < 96; ++k)
            tile.pixel(k, k)[2] = 1;
        write("other.png", tile);
        request_.project.plate.path = (folder_ / "plate/####.png").string();
        add_region("left", 1);
        request_.frame = 1;
        for (int frame = 1; frame <= kFrames; ++frame)
            request_.range.push_back(frame);
        make_preview("cache");
    }
    void TearDown() override {
        preview_.reset();
        fs::remove_all(folder_);
    }
    void make_preview(const char* cache) {
        AnalysisCacheOptions options;
        options.folder = (folder_ / cache).string();
        preview_ = std::make_unique<Preview>(options);
    }
    void write(const std::string& name, const ImageF3& picture) const {
        ASSERT_TRUE(write_image((folder_ / name).string(), picture, {}, {}));
    }
    static ImageF3 box(const Recti& inside) {
        ImageF3 out(kPlate, 0.0f);
        for (int y = inside.y0; y < inside.y1; ++y)
            std::fill(out.pixel(inside.x0, y), out.pixel(inside.x1, y), 1.0f);
        return out;
    }
    void add_region(const char* name, int reference) {
        Region region;
        region.id = request_.project.next_region_id++;
        region.name = name;
        MatteSource matte;
        matte.files = (folder_ / name / "####.png").string();
        region.matte = Leaf<MatteSource>(matte);
        region.texture.sample = (folder_ / "tile.png").string();
        region.reference_frames = {reference};
        request_.project.regions.push_back(Leaf<Region>(region));
    }
    void set_texture(const char* name) {
        request_.project.regions[0] = request_.project.regions[0].with(
            [&](Region& r) { r.texture.sample = (folder_ / name).string(); });
    }
    void ask() {
        while (!preview_->try_request(request_))
            std::this_thread::yield();
    }
    // Waits until `done` holds for what the preview shows of the requested frame.
    template <class Done>
    bool wait(Done&& done, std::chrono::milliseconds patience = std::chrono::minutes(1)) {
        const auto end = std::chrono::steady_clock::now() + patience;
        while (std::chrono::steady_clock::now() < end) {
            if (preview_->try_read(request_.frame, 1, 0, now_) && done(now_)) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }
    [[nodiscard]] static const PicturePtr& final_of(const PreviewReading& reading) {
        return reading.frame.stages[static_cast<std::size_t>(Stage::kFinal)];
    }
    static bool shows_provisional(const PreviewReading& reading) {
        return final_of(reading) && reading.frame.provisional;
    }
    static bool shows_exact(const PreviewReading& reading) {
        return final_of(reading) && !reading.frame.provisional && !reading.frame.approximate;
    }
    // The first frame as it is.
    static ImageU8x3 plate_alone() {
        ImageU8x3 out(kPlate);
        for (int y = 0; y < kPlate.height; ++y)
            for (int x = 0; x < kPlate.width; ++x)
                for (int c = 0; c < 3; ++c)
                    out.pixel(x, y)[c] =
                        static_cast<std::uint8_t>(std::lround(255 * plate_at(x, y, 1, c)));
        return out;
    }
    static float plate_at(int x, int y, int frame, int c) {
        return c == 1 ? 0.3f + static_cast<float>((x - frame + 3 * y) % 11) / 40 : 0.2f;
    }
    static int different(const ImageU8x3& a, const ImageU8x3& b, const Recti& in) {
        int count = 0;
        for (int y = in.y0; y < in.y1; ++y)
            for (int x = in.x0; x < in.x1; ++x)
                count += !std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y));
        return count;
    }
    static double mean_difference(const ImageU8x3& a, const ImageU8x3& b, const Recti& in) {
        double sum = 0;
        for (int y = in.y0; y < in.y1; ++y)
            for (int x = in.x0; x < in.x1; ++x)
                for (int c = 0; c < 3; ++c)
                    sum += std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]);
        return sum / (3.0 * in.width() * in.height());
    }
    // The exact picture from a preview that does nothing else.
    ImageU8x3 alone() {
        make_preview("cache_alone");
        ask();
        EXPECT_TRUE(wait(shows_exact)) << now_.view.error;
        return final_of(now_) ? final_of(now_)->srgb : ImageU8x3();
    }

    fs::path folder_ = fs::temp_directory_path() / ("weft_provisional_" + std::to_string(getpid()));
    PreviewRequest request_;
    PreviewReading now_;
    std::unique_ptr<Preview> preview_;
};

TEST_F(ProvisionalPreview, ComesBeforeTheAnalysisAndIsReplacedByItsResult) {
    preview_->pause();
    ask();
    ASSERT_TRUE(wait(shows_provisional)) << now_.view.error;
    EXPECT_EQ(now_.view.state, PreviewView::State::kAnalysing);
    EXPECT_TRUE(now_.rendered.empty()) << "it is no result";
    EXPECT_TRUE(now_.health.empty());
    EXPECT_GT(now_.view.first_seconds, 0);
    const double first = now_.view.first_seconds;
    preview_->resume();
    ASSERT_TRUE(wait([](const PreviewReading& r) { return final_of(r) && !r.frame.provisional; }));
    ASSERT_TRUE(wait(shows_exact));
    EXPECT_EQ(now_.rendered, std::vector<int>{1});
    EXPECT_EQ(now_.view.first_seconds, first);
    EXPECT_FALSE(wait(shows_provisional, std::chrono::milliseconds(100)));
    const ImageU8x3 shown = final_of(now_)->srgb;
    EXPECT_EQ(different(shown, alone(), rect_of(kPlate)), 0);
}

TEST_F(ProvisionalPreview, ARegionOfWhichNothingIsKnownIsFollowedInDraft) {
    add_region("right", 4);
    preview_->pause();
    ask();
    // The left one at once, and the right one when it has been followed from frame 4.
    const auto shows_right = [&](const PreviewReading& r) {
        return shows_provisional(r) && different(final_of(r)->srgb, plate_alone(), kRight) > 1000;
    };
    ASSERT_TRUE(wait([&](const PreviewReading& r) {
        EXPECT_TRUE(!shows_provisional(r) || r.frame.partial || shows_right(r));
        return shows_right(r);
    })) << now_.view.error;
    EXPECT_FALSE(now_.frame.partial);
    EXPECT_GT(different(final_of(now_)->srgb, plate_alone(), kLeft), 1000);
    EXPECT_TRUE(now_.rendered.empty());
    preview_->resume();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    const ImageU8x3 exact = final_of(now_)->srgb;
    EXPECT_EQ(different(exact, alone(), rect_of(kPlate)), 0);
    request_.project.regions.pop_back();
    EXPECT_EQ(different(exact, alone(), kLeft), 0);
}

TEST_F(ProvisionalPreview, FollowsToAFrameBesideTheReference) {
    preview_->pause();
    request_.frame = 3;
    ask();
    ASSERT_TRUE(wait(shows_provisional)) << now_.view.error;
    EXPECT_TRUE(now_.rendered.empty());
    const ImageU8x3 third = final_of(now_)->srgb;
    request_.frame = 1;
    ask();
    ASSERT_TRUE(wait(shows_provisional)) << now_.view.error;
    EXPECT_GT(different(final_of(now_)->srgb, third, kLeft), 100) << "it moves with the plate";
    request_.frame = 3;
    ask();
    preview_->resume();
    EXPECT_TRUE(wait(shows_exact)) << now_.view.error;
}

TEST_F(ProvisionalPreview, AMovedPinIsSeenBeforeAnythingIsFollowedAgain) {
    // Where the texture lies, alone: a plane that is given, without the light of other frames.
    request_.project.regions[0] = request_.project.regions[0].with([&](Region& r) {
        r.texture.sample.clear();
        r.texture.plane = (folder_ / "tile.png").string();
        r.light.source = LightSource::kNone;
        r.finish.focus = 0;
    });
    ask();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    request_.frame = 4;
    ask();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    const ImageU8x3 before = final_of(now_)->srgb;
    preview_->pause();
    ImageU8x3 last = before;
    for (const double moved : {3.0, 7.0}) {
        request_.project.regions[0] = request_.project.regions[0].with([&](Region& r) {
            r.reference_frames = {1, 4};
            r.corrections[4] = {{{40, 40}, {40 + moved, 40}}};
        });
        ask();
        ASSERT_TRUE(wait(shows_provisional)) << now_.view.error;
        const ImageU8x3 shown = final_of(now_)->srgb;
        EXPECT_GT(different(shown, last, kLeft), 500) << moved;
        last = shown;
    }
    preview_->resume();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    const ImageU8x3 exact = final_of(now_)->srgb;
    EXPECT_LT(mean_difference(exact, last, kLeft), 0.2) << "its pin settles it on this frame";
    EXPECT_GT(mean_difference(exact, before, kLeft), 4.0);
    EXPECT_EQ(different(exact, alone(), rect_of(kPlate)), 0);
}

TEST_F(ProvisionalPreview, NeverReplacesAnExactPicture) {
    ask();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    preview_->pause();
    for (int k = 0; k < 5; ++k) {
        request_.stages = k % 2 == 0;
        ask();
        EXPECT_FALSE(wait(shows_provisional, std::chrono::milliseconds(40)));
        EXPECT_TRUE(final_of(now_));
    }
}

TEST_F(ProvisionalPreview, AnotherTextureIsShownBeforeItsPlaneIsFinished) {
    ask();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    set_texture("other.png");
    ask();
    ASSERT_TRUE(wait([](const PreviewReading& r) { return final_of(r) != nullptr; }));
    EXPECT_FALSE(now_.frame.provisional) << "the light is known";
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    const ImageU8x3 shown = final_of(now_)->srgb;
    EXPECT_EQ(different(shown, alone(), rect_of(kPlate)), 0);
}

TEST_F(ProvisionalPreview, OtherFramesAndProjectsMayComeInBetween) {
    add_region("right", 4);
    const Project both = request_.project;
    for (int k = 0; k < 24; ++k) {
        request_.project = both;
        if (k % 3 == 1) request_.project.regions.pop_back();
        set_texture(k % 2 == 0 ? "tile.png" : "other.png");
        request_.frame = 1 + k % kFrames;
        request_.stages = k % 5 == 0;
        ask();
        (void)wait([](const PreviewReading& r) { return final_of(r) != nullptr; },
                   std::chrono::milliseconds(7 * (k % 6)));
        if (k % 7 == 6) preview_->clear();
    }
    request_.project = both;
    request_.stages = false;
    request_.frame = 4;
    ask();
    ASSERT_TRUE(wait(shows_exact)) << now_.view.error;
    const ImageU8x3 shown = final_of(now_)->srgb;
    EXPECT_EQ(different(shown, alone(), rect_of(kPlate)), 0);
    // It may also be closed while a picture is under way.
    make_preview("cache_closed");
    ask();
}

TEST_F(ProvisionalPreview, CardsTakeTheSameWay) {
    for (const char* texture : {"tile.png", "other.png"}) {
        CardRequest card;
        card.label = texture;
        card.project = request_.project;
        card.project.regions[0] = card.project.regions[0].with(
            [&](Region& r) { r.texture.sample = (folder_ / texture).string(); });
        card.frame = 1;
        card.around = 1;
        card.key = strip_key(card);
        request_.cards.push_back(card);
    }
    preview_->pause();
    ask();
    const auto all = [](bool provisional) {
        return [provisional](const PreviewReading& r) {
            return r.cards.size() == 2 &&
                   std::all_of(r.cards.begin(), r.cards.end(), [&](const auto& card) {
                       return card.second.picture && card.second.provisional == provisional;
                   });
        };
    };
    ASSERT_TRUE(wait(all(true))) << now_.view.error;
    preview_->resume();
    ASSERT_TRUE(wait(all(false))) << now_.view.error;
}

// The propagation of mattes was not.
TEST_F(ProvisionalPreview, AllOfTheAnalysisIsCountedFromItsFirstStep) {
    const auto steps = [&](const char* cache) {
        make_preview(cache);
        ask();
        int most = 0;
        EXPECT_TRUE(wait([&](const PreviewReading& now) {
            EXPECT_LE(now.view.done, now.view.total);
            most = std::max(most, now.view.total);
            return shows_exact(now) && !now.view.analysing;
        }));
        return most;
    };
    const int from_files = steps("cache_files");
    request_.project.regions[0] = request_.project.regions[0].with([&](Region& region) {
        MatteSource painted;
        painted.keyframes[1].path = (folder_ / "left" / "0001.png").string();
        region.matte = Leaf<MatteSource>(painted);
    });
    EXPECT_GE(steps("cache_painted"), from_files + kFrames - 1);
}

TEST_F(ProvisionalPreview, ThePausedRenderOfTheSameShotIsNotWaitedFor) {
    AnalysisCacheOptions options;
    options.folder = (folder_ / "cache").string();
    const auto shot = open_shot(request_.project, {});
    ASSERT_TRUE(shot) << shot.error().text();
    std::vector<std::string> warnings;
    const auto render = open_analysis_cache(**shot, options, warnings);
    ASSERT_TRUE(render) << render.error().text();
    const auto claim = (*render)->try_claim();
    ASSERT_TRUE(claim && !claim->empty());
    request_.frame = 3;  // its track has to be analysed
    ask();
    EXPECT_FALSE(wait(shows_exact, std::chrono::seconds(2))) << "the render is at work on it";
    preview_->set_render_paused(true);
    EXPECT_TRUE(wait(shows_exact, std::chrono::seconds(13)));
}

}  // namespace
}  // namespace weft
