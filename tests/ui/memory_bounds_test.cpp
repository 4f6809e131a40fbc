// The editor's memory for a long shot of large frames stays within its bounds.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/mattes/matte_shelf.h"
#include "app/preview/plate_player.h"

namespace weft::test {
namespace {

// A thousand frames of 3840 × 2160, made when they are read.
class LongPlate final : public FrameReader {
  public:
    LongPlate() {
        for (int frame = 1; frame <= 1000; ++frame)
            frames_.push_back(frame);
    }
    [[nodiscard]] const std::vector<int>& frames() const override { return frames_; }
    [[nodiscard]] Size size() const override { return {3840, 2160}; }
    [[nodiscard]] double fps() const override { return 24; }
    [[nodiscard]] PixelDepth depth() const override { return PixelDepth::kU8; }
    [[nodiscard]] bool display_encoded() const override { return true; }
    [[nodiscard]] std::string path_of(int frame) const override { return std::to_string(frame); }
    [[nodiscard]] Expected<PlateFrame> read(int frame) const override {
        PlateFrame out;
        out.rgb = ImageF3(size(), static_cast<float>(frame % 256) / 255.0f);
        return out;
    }
    [[nodiscard]] Expected<Hash128> stamp(int) const override { return Hash128{}; }

  private:
    std::vector<int> frames_;
};

bool wait(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    // Not repeated once true, because a later attempt may fail.
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

TEST(MemoryBounds, PlayingALongShotKeepsNoMoreThanItsBudget) {
    constexpr std::size_t kFrame = std::size_t{3840} * 2160 * 3, kBudget = 4 * kFrame + kFrame / 2;
    auto plate = std::make_shared<LongPlate>();
    PlatePlayer player(plate, nullptr, nullptr, kBudget);
    for (const int from : {1, 500, 990}) {
        std::vector<int> wanted;
        for (int frame = from; frame <= std::min(1000, from + 60); ++frame)
            wanted.push_back(frame);
        PlatePlayer::Reading reading;
        ASSERT_TRUE(wait([&] { return player.try_want(wanted); }));
        std::size_t most = 0;
        ASSERT_TRUE(wait([&] {
            if (player.try_read(from, reading)) most = std::max(most, reading.bytes);
            return reading.frame == from && reading.picture && reading.bytes >= 3 * kFrame;
        })) << "the frame that is looked at comes";
        // The next frames are decoded ahead, within the bound.
        for (int k = 0; k < 200; ++k) {
            if (player.try_read(from, reading)) most = std::max(most, reading.bytes);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        EXPECT_LE(most, kBudget) << "from frame " << from;
        EXPECT_TRUE(reading.picture) << "the most urgent one stays";
    }
}

TEST(MemoryBounds, MattesOfManyFramesKeepNoMoreThanTheirBudget) {
    constexpr Size kMatteSize{1920, 1080};
    constexpr std::size_t kMatte = std::size_t{1920} * 1080;
    MatteShelf shelf(6 * kMatte);
    std::vector<std::weak_ptr<const Matte>> seen;
    for (int frame = 0; frame < 60; ++frame) {
        const std::string name = "matte " + std::to_string(frame);
        MattePtr matte;
        ASSERT_TRUE(wait([&] {
            matte = shelf.get(name, [&]() -> Expected<Matte> { return Matte(kMatteSize, 7); });
            return matte != nullptr;
        }));
        seen.push_back(matte);
        matte.reset();
        std::size_t alive = 0;
        for (const auto& one : seen)
            alive += !one.expired();
        ASSERT_LE(alive, 7u) << "after " << frame;
    }
    EXPECT_FALSE(seen.back().expired()) << "the newest stays";
}

}  // namespace
}  // namespace weft::test
