#include "app/preview/matte_propagator.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/preview/preview.h"
#include "app/preview/propagation_key.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/matte_pass.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr Size kCarriedPlate{96, 64};

class MattePropagatorTest : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_);
        for (int frame = 1; frame <= 4; ++frame) {
            ImageF3 plate(kCarriedPlate, 0.2f);
            for (int y = 16; y < 48; ++y)
                for (int x = 24; x < 64; ++x)
                    plate.pixel(x, y)[0] = 0.5f + static_cast<float>((x + y) % 7) / 35.0f;
            write("plate.000" + std::to_string(frame) + ".png", plate);
        }
        write("tile.png", ImageF3(64, 64, 0.4f));
        write("key.png", painted(255));
        options_.folder = (folder_ / "cache").string();
        project_.plate.path = (folder_ / "plate.####.png").string();
        Region region;
        region.id = 1;
        MatteSource matte;
        matte.keyframes[1].path = (folder_ / "key.png").string();
        region.matte = Leaf<MatteSource>(matte);
        project_.regions.push_back(Leaf<Region>(region));
        propagator_ = std::make_unique<MattePropagator>(options_);
    }
    void TearDown() override {
        propagator_.reset();
        fs::remove_all(folder_);
    }
    void write(const std::string& name, const ImageF3& picture) const {
        ASSERT_TRUE(write_image((folder_ / name).string(), picture, {}, {}));
    }
    static ImageF3 painted(int code) {
        ImageF3 out(kCarriedPlate, 0.0f);
        for (int y = 16; y < 48; ++y)
            for (int x = 24; x < 64; ++x)
                std::fill_n(out.pixel(x, y), 3, static_cast<float>(code) / 255.0f);
        return out;
    }
    [[nodiscard]] WantedMatte wanted(int frame) const {
        return {1, 0, frame, propagation_key(project_, *project_.regions[0], 0)};
    }
    bool wait_for(int frame, std::chrono::milliseconds patience = std::chrono::minutes(1)) const {
        const auto end = std::chrono::steady_clock::now() + patience;
        while (std::chrono::steady_clock::now() < end) {
            if (const auto matte = propagator_->matte(wanted(frame)))
                return matte->at(44, 32) > 200 && matte->at(4, 4) == 0;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
    void set_keys(const std::vector<int>& frames) {
        MatteSource matte;
        for (const int frame : frames)
            matte.keyframes[frame].path = (folder_ / "key.png").string();
        project_.regions[0] =
            project_.regions[0].with([&](Region& r) { r.matte = Leaf<MatteSource>(matte); });
    }
    // The steps that are left once the region has a texture.
    [[nodiscard]] int steps_left() {
        project_.regions[0] = project_.regions[0].with(
            [&](Region& r) { r.texture.sample = (folder_ / "tile.png").string(); });
        const auto shot = open_shot(project_);
        EXPECT_TRUE(shot) << shot.error().text();
        std::vector<std::string> warnings;
        const auto store = open_analysis_cache(**shot, options_, warnings);
        EXPECT_TRUE(store) << store.error().text();
        return count_matte_steps((*shot)->plan, **store);
    }

    const fs::path folder_ =
        fs::temp_directory_path() / ("weft_propagator_" + std::to_string(getpid()));
    AnalysisCacheOptions options_;
    Project project_;
    std::unique_ptr<MattePropagator> propagator_;
};

TEST_F(MattePropagatorTest, MattesAreThereWhenATextureIsChosen) {
    propagator_->propagate(project_, {}, 1);
    for (const int frame : {1, 3, 4})
        EXPECT_TRUE(wait_for(frame)) << frame;
    EXPECT_GT(propagator_->changes(), 0u);
    propagator_.reset();  // waits
    EXPECT_EQ(steps_left(), 0);
}

TEST_F(MattePropagatorTest, AMatteFromMemoryCountsOnceItsFileIsThere) {
    const auto key = read_matte((folder_ / "key.png").string(), {}, kCarriedPlate);
    ASSERT_TRUE(key);
    fs::remove(folder_ / "key.png");
    const std::string path = (folder_ / "key.png").string();
    propagator_->propagate(project_, {{path, std::make_shared<const Matte>(*key)}}, 1);
    EXPECT_TRUE(wait_for(4));
    write("key.png", painted(255));
    propagator_->propagate(project_, {}, 1);
    // The mattes from memory are shown meanwhile: they are the same.
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (steps_left() > 0 && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(steps_left(), 0);
}

TEST_F(MattePropagatorTest, AStrokeChangesWhatLiesBetweenItsNeighboursOnly) {
    set_keys({1, 2, 4});
    propagator_->propagate(project_, {}, 3);
    for (const int frame : {1, 2, 3, 4})
        EXPECT_TRUE(wait_for(frame)) << frame;
    propagator_.reset();
    write("other.png", painted(200));
    project_.regions[0] = project_.regions[0].with([&](Region& r) {
        r.matte = r.matte.with(
            [&](MatteSource& m) { m.keyframes[4].path = (folder_ / "other.png").string(); });
    });
    // Forwards from 2 to 4, back from 4 to 2, and 3 is merged; frame 1 is kept.
    EXPECT_EQ(steps_left(), 3 + 3 + 1);
    set_keys({1, 2, 4});
    EXPECT_EQ(steps_left(), 0) << "undone";
}

TEST_F(MattePropagatorTest, AMatteOfAnotherStateIsNone) {
    propagator_->propagate(project_, {}, 1);
    EXPECT_TRUE(wait_for(4));
    const WantedMatte before = wanted(4);
    set_keys({1, 2});
    EXPECT_FALSE(propagator_->matte(wanted(4))) << "asked for before it is propagated";
    EXPECT_TRUE(propagator_->matte(before)) << "until then the one before is there";
    propagator_->propagate(project_, {}, 1);
    EXPECT_TRUE(wait_for(4));
    EXPECT_FALSE(propagator_->matte(before));
}

TEST_F(MattePropagatorTest, PausesAndForgets) {
    propagator_->pause();
    propagator_->propagate(project_, {}, 1);
    EXPECT_FALSE(wait_for(4, std::chrono::milliseconds(150)));
    propagator_->resume();
    EXPECT_TRUE(wait_for(4));
    propagator_->clear();
    EXPECT_FALSE(propagator_->matte(wanted(4))) << "it may be another matte by now";
    propagator_->propagate(project_, {}, 1);
    EXPECT_TRUE(wait_for(4));
}

}  // namespace
}  // namespace weft
