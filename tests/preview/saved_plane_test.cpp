// A picture that is painted on in another program while the preview shows it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/base/file_watch.h"
#include "app/preview/preview.h"
#include "engine/media/frame_writer.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
constexpr Size kSmall{96, 64};

class SavedPlane : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("weft_saved_plane_" + std::to_string(getpid()));
        fs::create_directories(folder_);
        ImageF3 plate(kSmall);
        for (int y = 0; y < kSmall.height; ++y)
            for (int x = 0; x < kSmall.width; ++x)
                for (int c = 0; c < 3; ++c)
                    plate.at(x, y, c) =
                        0.3f + 0.2f * static_cast<float>((x * 7 + y * 13) % 11) / 11;
        put("plate.0001.png", plate);
        put("matte.0001.png", ImageF3(kSmall, 1.0f));
        paint(0.8f, 0.2f);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string in(const std::string& name) const { return (folder_ / name).string(); }
    void put(const std::string& name, const ImageF3& picture) const {
        WriteOptions write;
        write.rule = WriteRule::own();
        const auto written = write_image(in(name), picture, {}, write);
        ASSERT_TRUE(written) << written.error().text();
    }
    void paint(float red, float green) const {
        ImageF3 picture(kSmall);
        for (int y = 0; y < kSmall.height; ++y)
            for (int x = 0; x < kSmall.width; ++x)
                picture.at(x, y, 0) = red, picture.at(x, y, 1) = green;
        put("painted.png", picture);
    }
    PreviewRequest request() const {
        Region region;
        region.id = 1;
        region.name = "wall";
        MatteSource matte;
        matte.files = in("matte.####.png");
        region.matte = Leaf<MatteSource>(matte);
        region.texture.plane = in("painted.png");
        region.light.source = LightSource::kNone;
        region.grade.match = 0;
        region.finish.grain = region.finish.focus = 0;
        PreviewRequest out;
        out.project.plate.path = in("plate.####.png");
        out.project.regions = {Leaf<Region>(region)};
        out.frame = 1;
        out.range = {1};
        return out;
    }

    fs::path folder_;
};

// Waits for a picture whose middle is more red than green, or the other way; seconds, or −1.
double wait_for(Preview& preview, bool red) {
    const auto start = std::chrono::steady_clock::now();
    const auto waited = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    while (waited() < 30) {
        PreviewReading reading;
        if (preview.try_read(1, 1, 0, reading)) {
            const auto& shown = reading.frame.stages[static_cast<std::size_t>(Stage::kFinal)];
            if (shown) {
                const Vec3 middle = shown->at(shown->size.width / 2, shown->size.height / 2);
                if ((middle.x > middle.y) == red) return waited();
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return -1;
}

TEST_F(SavedPlane, ASaveIsShown) {
    AnalysisCacheOptions cache;
    cache.folder = in("cache");
    Preview preview(cache);
    while (!preview.try_request(request()))
        std::this_thread::yield();
    ASSERT_GE(wait_for(preview, true), 0);
    paint(0.2f, 0.8f);
    const double seconds = wait_for(preview, false);
    ASSERT_GE(seconds, 0) << "the save was not noticed";
    RecordProperty("milliseconds", static_cast<int>(1000 * seconds));
    std::printf("shown %.2f s after the save\n", seconds);
    // Half a file, as another program may leave it for a while, is no reason to stop watching.
    fs::resize_file(in("painted.png"), 40);
    std::this_thread::sleep_for(std::chrono::milliseconds(900));
    paint(0.8f, 0.2f);
    EXPECT_GE(wait_for(preview, true), 0);
}

TEST_F(SavedPlane, AWatchTellsOfEachSaveOnce) {
    FileWatch watch;
    EXPECT_TRUE(watch.empty());
    watch.watch({in("painted.png"), in("missing.png")});
    const auto look = [&] {
        std::this_thread::sleep_for(FileWatch::kLook + std::chrono::milliseconds(20));
        return watch.saved();
    };
    EXPECT_FALSE(look());
    EXPECT_FALSE(look());
    paint(0.5f, 0.5f);
    EXPECT_FALSE(look());  // it may still be written
    EXPECT_TRUE(look());
    EXPECT_FALSE(look());
    fs::remove(in("painted.png"));
    EXPECT_FALSE(look());
    EXPECT_FALSE(look());
    put("missing.png", ImageF3(kSmall, 0.5f));
    EXPECT_FALSE(look());
    EXPECT_TRUE(look());
}

}  // namespace
}  // namespace weft
